//! X9: whole teams, pair by pair and together.

mod criteria;
mod record;
mod run;
mod tables;

use crate::measured::Measured;
use crate::options::Options;
use crate::report::Section;

const ANALYSIS: &str = "\
Teams of 3 to 12 robots drawn at random: each explores its own part of one floor, with sensors, \
resolution, drift and map style of its own; some never meet, and half of the teams have a map of \
another building among theirs. Pairs alone are what the matcher accepts for two maps by \
themselves; the team is what `merge_team` makes of all.

A pair is right as in X7. Two maps of one component that observed nothing in common are right \
within 1.5 m and 6°, besides what drift bent. A pair shares enough if at least 5 m of one map's \
wall lie on wall of the other.";

/// Draws and merges the teams.
pub(crate) fn measure(options: &Options) -> anyhow::Result<Measured> {
    let judged = run::run(options)?;
    let section = Section {
        id: "X9".to_owned(),
        title: "Teams: what many maps say together".to_owned(),
        analysis: ANALYSIS.to_owned(),
        tables: vec![
            tables::by_kind(&judged),
            tables::errors(&judged),
            tables::reliability(&judged),
        ],
        figures: Vec::new(),
        criteria: criteria::criteria(&judged, options.quick),
    };
    let runs = judged.iter().flat_map(record::rows).collect();
    Ok(Measured { runs, ..Measured::of_section(section) })
}
