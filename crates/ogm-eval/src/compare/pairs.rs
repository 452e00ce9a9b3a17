//! The methods on real map pairs: tags on walls that both maps saw, ranges along simulated drives.

use std::path::Path;

use grid_match::{MatchParams, match_maps};
use ogm_core::{Outcome, Se2};
use ogm_merge::{Evidence, Method, RfidParams, RobotMap, align};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

use super::evaluation::Overlap;
use super::methods::MATCH;
use super::pair_tags::localised_tags;
use super::record::{Run, RunResult, TransformError, pose_error};
use super::{Args, Measured, pair_figures, progress};
use crate::map_pair::{MapPair, Truth, read_pairs};
use crate::report::{Criterion, Section, Table};

const METHODS: [(&str, Method); 3] =
    [("#1", Method::Rfid1), ("#2", Method::Rfid2), ("#3", Method::Rfid3)];

/// The columns of the table and the order of the runs.
const NAMES: [&str; 4] = ["#1", "#2", "#3", MATCH];

const ANALYSIS: &str = "\
The maps are real, the tags are not. Each robot drives through the free space that its own map \
knows; sixteen tags are placed by seed, spread over the walls that both maps saw and both drives \
pass within 2 m under the true transform; ranges to them have the paper's noise. From there on the code \
path is that of the simulation. Pairs that must be refused get the same tags at unrelated walls, so \
that #3 has to refuse them for what the walls say; #1 and #2 do not look at that.

Errors are taken at the centroid of the source's known cells. An answer is inside when it is \
within the pair's own tolerance; strict when within one cell of the target and 0.5°. The truth of \
pairs from one corrected trajectory is exact; of the others it is good to 0.1 to 0.25 m.

match gets the two maps and nothing else.";

/// What the methods answered on one pair.
#[derive(Default)]
struct Answers {
    runs: Vec<Run>,
    /// What #3 saw.
    evidence: Evidence,
    /// What #3 answered.
    target_from_source: Option<Se2>,
}

/// Runs the methods on every pair below `folder`.
pub(super) fn run(args: &Args, folder: &Path) -> anyhow::Result<Measured> {
    let pairs = read_pairs(folder)?;
    let bar = progress("pairs", pairs.len() as u64);
    let answers: Vec<Answers> = pairs
        .par_iter()
        .map(|pair| {
            let answers = answer(pair, args.seed);
            bar.inc(1);
            answers
        })
        .collect::<anyhow::Result<_>>()?;
    bar.finish_and_clear();

    let verdicts: Vec<[Verdict; 4]> = pairs
        .iter()
        .zip(&answers)
        .map(|(p, a)| NAMES.map(|name| Verdict::of(p, a, name)))
        .collect();
    let overlaid: Vec<_> =
        pairs.iter().zip(&answers).map(|(p, a)| (p, a.target_from_source)).collect();
    let section = Section {
        id: "pairs".to_owned(),
        title: "Real map pairs".to_owned(),
        analysis: ANALYSIS.to_owned(),
        tables: vec![table(&pairs, &answers, &verdicts)],
        figures: pair_figures::draw(&overlaid)?,
        criteria: criteria(&pairs, &verdicts),
    };
    let runs = answers.into_iter().flat_map(|answers| answers.runs).collect();
    Ok(Measured { sections: vec![section], runs, timings: Vec::new() })
}

fn answer(pair: &MapPair, seed: u64) -> anyhow::Result<Answers> {
    let run = |variant: &str, result| Run {
        experiment: "pairs",
        case: pair.name.clone(),
        variant: variant.to_owned(),
        seed,
        result,
    };
    let judged = |outcome| match (outcome, &pair.truth) {
        (Outcome::Refused(refusal), _) => RunResult::Refused(refusal),
        (Outcome::Found(target_from_source), Some(truth)) => {
            RunResult::Transform(errors(pair, truth, &target_from_source))
        }
        (Outcome::Found(_), None) => RunResult::FalseMerge,
    };
    let mut answers = Answers::default();
    match localised_tags(pair, seed)? {
        Ok([target_tags, source_tags]) => {
            let target = RobotMap { map: &pair.target, tags: &target_tags };
            let source = RobotMap { map: &pair.source, tags: &source_tags };
            let params = RfidParams::default();
            for (name, method) in METHODS {
                let report = align(method, &target, &source, &params)?;
                answers.target_from_source = report.outcome.clone().found();
                answers.runs.push(run(name, judged(report.outcome)));
                answers.evidence = report.evidence;
            }
        }
        Err(refusal) => {
            let refused = METHODS.map(|(name, _)| run(name, RunResult::Refused(refusal.clone())));
            answers.runs.extend(refused);
        }
    }
    let matched = match_maps(&pair.target, &pair.source, &MatchParams::default())?;
    answers.runs.push(run(MATCH, judged(matched.outcome)));
    Ok(answers)
}

fn errors(pair: &MapPair, truth: &Truth, target_from_source: &Se2) -> TransformError {
    let overlap = Overlap::new(&pair.target, &pair.source, truth.target_from_source);
    let (translation_m, rotation) =
        pose_error(target_from_source, &truth.target_from_source, pair.source_centroid());
    TransformError { translation_m, rotation, ..overlap.errors(target_from_source) }
}

/// How the answer of a method is judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Verdict {
    Strict,
    Inside,
    Outside,
    Missed,
    RightlyRefused,
    FalseMerge,
}

impl Verdict {
    fn of(pair: &MapPair, answers: &Answers, method: &str) -> Self {
        let result = answers.runs.iter().find(|run| run.variant == method).map(|run| &run.result);
        match (result, &pair.truth) {
            (Some(RunResult::Transform(e)), Some(truth)) => {
                let cell = pair.target.frame().resolution();
                if e.translation_m < cell && e.rotation < 0.5_f64.to_radians() {
                    Self::Strict
                } else if e.translation_m < truth.tolerance_m && e.rotation < truth.tolerance {
                    Self::Inside
                } else {
                    Self::Outside
                }
            }
            (_, Some(_)) => Self::Missed,
            (Some(RunResult::Refused(_)), None) => Self::RightlyRefused,
            (_, None) => Self::FalseMerge,
        }
    }

    fn is_inside(self) -> bool {
        matches!(self, Self::Strict | Self::Inside)
    }

    fn text(self) -> &'static str {
        match self {
            Self::Strict => "strict",
            Self::Inside => "inside",
            Self::Outside => "OUTSIDE",
            Self::Missed => "refused",
            Self::RightlyRefused => "rightly refused",
            Self::FalseMerge => "FALSE MERGE",
        }
    }
}

fn table(pairs: &[MapPair], answers: &[Answers], verdicts: &[[Verdict; 4]]) -> Table {
    let rows = pairs.iter().zip(answers).zip(verdicts).map(|((pair, answers), verdicts)| {
        let [.., by_3, by_match] = verdicts;
        let [first, second, third, matched] = NAMES.map(|name| shown(answers, name));
        let truth = match &pair.truth {
            Some(truth) if truth.exact => "exact".to_owned(),
            Some(truth) => format!("{:.2} m", truth.tolerance_m),
            None => "no match".to_owned(),
        };
        let common_tags = answers.evidence.common_tags.len().to_string();
        let agreement = answers.evidence.wall_agreement.and_then(|agreement| agreement.share());
        vec![
            pair.name.clone(),
            truth,
            common_tags,
            first,
            second,
            third,
            by_3.text().to_owned(),
            matched,
            by_match.text().to_owned(),
            agreement.map_or("–".to_owned(), |share| format!("{share:.2}")),
            remarks(answers),
        ]
    });
    let [first, second, third, matched] = [0, 1, 2, 3].map(|method| tally(verdicts, method));
    let empty = String::new;
    let all = vec![
        format!("all {}", pairs.len()),
        empty(),
        empty(),
        first,
        second,
        third,
        empty(),
        matched,
        empty(),
        empty(),
        empty(),
    ];
    Table {
        caption: "Error of each method, and the verdicts on #3 and match. Right: inside or \
                  strict; wrong: outside; refused: although the maps match; false: merged although \
                  they do not."
            .to_owned(),
        header: [
            "pair",
            "truth",
            "common tags",
            "#1",
            "#2",
            "#3",
            "verdict on #3",
            MATCH,
            "verdict on match",
            "walls agree",
            "remarks on #3",
        ]
        .map(str::to_owned)
        .to_vec(),
        rows: rows.chain([all]).collect(),
    }
}

/// What a method answered on a pair.
fn shown(answers: &Answers, method: &str) -> String {
    let run = answers.runs.iter().find(|run| run.variant == method);
    match run.map(|run| &run.result) {
        Some(RunResult::Transform(e)) => {
            format!("{:.3} m, {:.2}°", e.translation_m, e.rotation.to_degrees())
        }
        Some(RunResult::FalseMerge | RunResult::Direction(_)) => "merged".to_owned(),
        Some(RunResult::Refused(_)) | None => "refused".to_owned(),
    }
}

/// How often the method, by its place in [`NAMES`], was how good.
fn tally(verdicts: &[[Verdict; 4]], method: usize) -> String {
    let count = |good: fn(Verdict) -> bool| verdicts.iter().filter(|all| good(all[method])).count();
    format!(
        "{} right ({} strict), {} wrong, {} refused, {} false",
        count(Verdict::is_inside),
        count(|verdict| verdict == Verdict::Strict),
        count(|verdict| verdict == Verdict::Outside),
        count(|verdict| verdict == Verdict::Missed),
        count(|verdict| verdict == Verdict::FalseMerge),
    )
}

/// Why #3 refused, or what makes its answer less sure than it looks.
fn remarks(answers: &Answers) -> String {
    let refusals = answers.runs.iter().filter(|run| run.variant == "#3");
    let refusals = refusals.filter_map(|run| match &run.result {
        RunResult::Refused(refusal) => Some(refusal.to_string()),
        _ => None,
    });
    let warnings = answers.evidence.warnings().into_iter().map(|warning| warning.to_string());
    refusals.chain(warnings).collect::<Vec<_>>().join("; ")
}

fn criteria(pairs: &[MapPair], verdicts: &[[Verdict; 4]]) -> Vec<Criterion> {
    let [.., by_3, by_match] = [0, 1, 2, 3].map(|method| {
        let verdicts: Vec<Verdict> = verdicts.iter().map(|all| all[method]).collect();
        criteria_of(NAMES[method], pairs, &verdicts)
    });
    by_3.into_iter().chain(by_match).collect()
}

fn criteria_of(method: &str, pairs: &[MapPair], verdicts: &[Verdict]) -> Vec<Criterion> {
    let judged = |of_interest: fn(&Truth) -> bool, good: fn(Verdict) -> bool| {
        let chosen = pairs.iter().zip(verdicts);
        let chosen: Vec<Verdict> = chosen
            .filter(|(pair, _)| pair.truth.as_ref().is_some_and(of_interest))
            .map(|(_, verdict)| *verdict)
            .collect();
        (chosen.iter().filter(|verdict| good(**verdict)).count(), chosen.len())
    };
    let share = |(good, all): (usize, usize)| good as f64 / all as f64;
    let criterion = |what: &str, statement: String, counts, need: f64| Criterion {
        id: format!("pairs: {method} {what}"),
        statement,
        paper: None,
        ours: share(counts),
        interval: None,
        pass: share(counts) >= need,
    };
    let inside = judged(|_| true, Verdict::is_inside);
    let strict = judged(|truth| truth.exact, |verdict| verdict == Verdict::Strict);
    let false_merges = verdicts.iter().filter(|v| **v == Verdict::FalseMerge).count();
    vec![
        criterion(
            "inside",
            format!(
                "{method} inside the pair's tolerance on {} of {}, at least 22 of 25",
                inside.0, inside.1
            ),
            inside,
            22.0 / 25.0,
        ),
        criterion(
            "strict",
            format!(
                "{method} within one cell and 0.5° on {} of {} with exact truth, at least 12 of 15",
                strict.0, strict.1
            ),
            strict,
            12.0 / 15.0,
        ),
        Criterion {
            id: format!("pairs: {method} false merges"),
            statement: format!("no pair that must be refused is merged by {method}"),
            paper: None,
            ours: false_merges as f64,
            interval: None,
            pass: false_merges == 0,
        },
    ]
}
