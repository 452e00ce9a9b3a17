//! Dated results: what is kept of a comparison, and what changed between two.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context, ensure};
use serde::{Deserialize, Serialize};

use crate::measured::{Run, RunResult};
use crate::report::{self, Report, Table, number};
use crate::stats::median;

/// The results of one day, without wall times.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Record {
    date: String,
    command: String,
    version: String,
    criteria: Vec<Judgement>,
    /// By experiment, case and variant.
    numbers: BTreeMap<String, Numbers>,
}

/// A criterion and whether it held.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Judgement {
    id: String,
    criterion: String,
    /// `None` if nothing could be measured.
    ours: Option<f64>,
    pass: bool,
}

/// What came of the runs of one variant on one case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Numbers {
    runs: usize,
    refused: usize,
    #[serde(default, skip_serializing_if = "is_zero")]
    false_merges: usize,
    /// Medians of those that were found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    error_m: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    error_deg: Option<f64>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// What changed between two records.
#[derive(Debug, Clone)]
pub struct Diff {
    changes: Table,
    /// The criteria that held and no longer do.
    pub newly_failed: Vec<String>,
}

impl Record {
    pub(crate) fn of(report: &Report, runs: &[Run], date: &str) -> Self {
        let info = |key: &str| {
            let found = report.info.iter().find(|(name, _)| name == key);
            found.map_or_else(String::new, |(_, value)| value.clone())
        };
        let criteria = report.criteria().map(|(_, criterion)| Judgement {
            id: criterion.id.clone(),
            criterion: criterion.statement.clone(),
            ours: criterion.ours.is_finite().then_some(criterion.ours),
            pass: criterion.pass,
        });
        let mut groups: BTreeMap<String, Vec<&Run>> = BTreeMap::new();
        for run in runs {
            let key = format!("{} | {} | {}", run.experiment, run.case, run.variant);
            groups.entry(key).or_default().push(run);
        }
        let numbers = groups.into_iter().map(|(key, runs)| (key, Numbers::of(&runs)));
        Self {
            date: date.to_owned(),
            command: info("command"),
            version: info("version"),
            criteria: criteria.collect(),
            numbers: numbers.collect(),
        }
    }

    /// Where the record of a name is kept: in the source of this crate, by date.
    ///
    /// # Errors
    /// A name that is no name for a file.
    pub fn path(&self, name: &str) -> anyhow::Result<PathBuf> {
        let plain = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'-';
        ensure!(!name.is_empty() && name.bytes().all(plain), "{name:?} is no name for a record");
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("record");
        Ok(folder.join(format!("{}-{name}.json", self.date)))
    }

    /// Writes it as JSON.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self, path: &Path) -> anyhow::Result<()> {
        let text = serde_json::to_string_pretty(self).context("cannot write the record")?;
        report::write_file(path, (text + "\n").as_bytes())
    }

    /// Reads what [`Record::write`] wrote.
    ///
    /// # Errors
    /// A file that cannot be read or is no record.
    pub fn read(path: &Path) -> anyhow::Result<Self> {
        let text = std::fs::read_to_string(path)
            .with_context(|| format!("cannot read {}", path.display()))?;
        serde_json::from_str(&text).with_context(|| format!("{} is no record", path.display()))
    }

    /// What changed from this record to `later`.
    #[must_use]
    pub fn diff(&self, later: &Self) -> Diff {
        let before = || self.criteria.iter().map(|one| (one.id.as_str(), one));
        let after = || later.criteria.iter().map(|one| (one.id.as_str(), one));
        let mut rows = changes(before(), after(), Judgement::text);
        let numbers = |record| <&BTreeMap<String, Numbers>>::into_iter(record);
        let named = |(name, numbers): (&'_ String, _)| (name.as_str().to_owned(), numbers);
        let old: Vec<(String, &Numbers)> = numbers(&self.numbers).map(named).collect();
        let new: Vec<(String, &Numbers)> = numbers(&later.numbers).map(named).collect();
        rows.extend(changes(
            old.iter().map(|(name, numbers)| (name.as_str(), *numbers)),
            new.iter().map(|(name, numbers)| (name.as_str(), *numbers)),
            Numbers::text,
        ));
        let held: Vec<&str> = before().filter(|(_, one)| one.pass).map(|(id, _)| id).collect();
        let failed = after().filter(|(id, one)| !one.pass && held.contains(id));
        Diff {
            newly_failed: failed.map(|(id, _)| id.to_owned()).collect(),
            changes: Table {
                caption: String::new(),
                header: ["what", &self.date, &later.date].map(str::to_owned).to_vec(),
                rows,
            },
        }
    }
}

/// A row for each name whose text differs, in the order of `before`, then what is new.
fn changes<'a, T: 'a>(
    before: impl Iterator<Item = (&'a str, &'a T)> + Clone,
    after: impl Iterator<Item = (&'a str, &'a T)> + Clone,
    text: impl Fn(&T) -> String,
) -> Vec<Vec<String>> {
    let dash = || "–".to_owned();
    let old: BTreeMap<&str, String> = before.clone().map(|(id, one)| (id, text(one))).collect();
    let new: BTreeMap<&str, String> = after.clone().map(|(id, one)| (id, text(one))).collect();
    let known = before.map(|(id, _)| id);
    let added = after.map(|(id, _)| id).filter(|id| !old.contains_key(id));
    let row = |id: &str| {
        let texts = [&old, &new].map(|texts| texts.get(id).cloned().unwrap_or_else(dash));
        let [then, now] = texts;
        (then != now).then(|| vec![id.to_owned(), then, now])
    };
    known.chain(added).filter_map(row).collect()
}

impl Judgement {
    fn text(&self) -> String {
        let verdict = if self.pass { "pass" } else { "FAIL" };
        format!("{verdict} {} ({})", number(self.ours.unwrap_or(f64::NAN)), self.criterion)
    }
}

impl Numbers {
    fn of(runs: &[&Run]) -> Self {
        let count =
            |holds: fn(&RunResult) -> bool| runs.iter().filter(|run| holds(&run.result)).count();
        let metres = runs.iter().filter_map(|run| Some(run.errors()?.pose.displacement));
        let turns = runs.iter().filter_map(|run| match &run.result {
            RunResult::Transform(error) => Some(error.pose.turn),
            RunResult::Direction(error) => Some(error.abs()),
            _ => None,
        });
        // To a tenth of a millimetre: sines differ in the last bit between processors.
        let rounded = |value: f64| (value * 1e4).round() / 1e4;
        Self {
            runs: runs.len(),
            refused: count(|result| matches!(result, RunResult::Refused(_))),
            false_merges: count(|result| matches!(result, RunResult::FalseMerge)),
            error_m: median(&metres.collect::<Vec<_>>()).map(rounded),
            error_deg: median(&turns.map(f64::to_degrees).collect::<Vec<_>>()).map(rounded),
        }
    }

    fn text(&self) -> String {
        let error = |value: Option<f64>, unit: &str| {
            value.map_or_else(String::new, |value| format!(", {value}{unit}"))
        };
        format!(
            "{} runs, {} refused, {} false{}{}",
            self.runs,
            self.refused,
            self.false_merges,
            error(self.error_m, " m"),
            error(self.error_deg, "°")
        )
    }
}

impl Diff {
    /// The changes as a table in Markdown, or a sentence.
    #[must_use]
    pub fn text(&self) -> String {
        if self.changes.rows.is_empty() {
            return "nothing changed\n".to_owned();
        }
        report::markdown_table(&self.changes)
    }
}

#[cfg(test)]
mod tests {
    use super::{Judgement, Numbers, Record};

    fn record(date: &str, criteria: &[(&str, f64, bool)], refused: usize) -> Record {
        let judgement = |&(id, ours, pass): &(&str, f64, bool)| Judgement {
            id: id.to_owned(),
            criterion: "at least 1".to_owned(),
            ours: ours.is_finite().then_some(ours),
            pass,
        };
        let numbers =
            Numbers { runs: 9, refused, false_merges: 0, error_m: Some(0.01), error_deg: None };
        Record {
            date: date.to_owned(),
            command: "cargo xtask compare".to_owned(),
            version: "0.1.0".to_owned(),
            criteria: criteria.iter().map(judgement).collect(),
            numbers: [("X4 | random plan | #3".to_owned(), numbers)].into(),
        }
    }

    #[test]
    fn what_held_and_no_longer_does_is_named() {
        let old = record("2026-11-25", &[("A", 1.5, true), ("B", 0.5, false), ("C", 1.0, true)], 2);
        let new =
            record("2026-12-01", &[("A", 0.5, false), ("B", 0.4, false), ("D", 2.0, true)], 3);
        let diff = old.diff(&new);
        assert_eq!(diff.newly_failed, ["A"]);
        let text = diff.text();
        for expected in [
            "| A | pass 1.500 (at least 1) | FAIL 0.5000 (at least 1) |",
            "| B | FAIL 0.5000",
            "| C | pass 1.000 (at least 1) | – |",
            "| D | – | pass 2.000 (at least 1) |",
            "| X4 \\| random plan \\| #3 | 9 runs, 2 refused",
        ] {
            assert!(text.contains(expected), "{expected} is not in {text}");
        }
        assert!(new.diff(&old).newly_failed.is_empty(), "a criterion that holds again is no loss");
    }

    #[test]
    fn a_record_on_disk_is_the_record() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("record.json");
        let written = record("2026-11-25", &[("A", f64::NAN, false)], 0);
        written.write(&path).unwrap();
        let read = Record::read(&path).unwrap();
        assert_eq!(read, written);
        assert_eq!(written.diff(&read).text(), "nothing changed\n");
        assert!(Record::read(folder.path()).is_err());
        assert!(written.path("../escape").is_err() && written.path("").is_err());
    }
}
