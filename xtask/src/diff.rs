//! `cargo xtask diff`: what changed between two records.

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::{SystemTime, UNIX_EPOCH};

use ogm_eval::record::Record;

/// Shows what changed between two records of `compare`; fails if a criterion no longer holds.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The earlier record, such as crates/ogm-eval/record/2026-11-25-quick.json.
    before: PathBuf,
    /// The later record.
    after: PathBuf,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<ExitCode> {
    let diff = Record::read(&args.before)?.diff(&Record::read(&args.after)?);
    print!("{}", diff.text());
    for id in &diff.newly_failed {
        println!("FAILED {id}: it held before");
    }
    Ok(if diff.newly_failed.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Today's date, UTC.
pub(crate) fn today() -> String {
    #[expect(clippy::disallowed_methods, reason = "a record has a date")]
    let now = SystemTime::now();
    let seconds = now.duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    date(seconds / 86_400)
}

/// The date of a day counted from 1970-01-01, in the Gregorian calendar (Hinnant,
/// *chrono-Compatible Low-Level Date Algorithms*, `civil_from_days`).
fn date(days: u64) -> String {
    // Years begin in March, so that a leap day is the last of its year.
    let days = days + 719_468;
    let (era, of_era) = (days / 146_097, days % 146_097);
    let year_of_era = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let from_march = (5 * of_year + 2) / 153;
    let day = of_year - (153 * from_march + 2) / 5 + 1;
    let month = if from_march < 10 { from_march + 3 } else { from_march - 9 };
    let year = 400 * era + year_of_era + u64::from(month <= 2);
    format!("{year}-{month:02}-{day:02}")
}

#[cfg(test)]
mod tests {
    use super::date;

    #[test]
    fn dates_are_those_of_the_calendar() {
        for (days, expected) in [
            (0, "1970-01-01"),
            (11_016, "2000-02-29"),
            (11_017, "2000-03-01"),
            (20_782, "2026-11-25"),
            (20_818, "2026-12-31"),
        ] {
            assert_eq!(date(days), expected);
        }
    }
}
