//! X8: robots that place themselves by their own sensors, and three of them that share their maps.

mod criteria;
mod figures;
mod filters;
mod record;
mod run;
mod scan_matching;
mod tables;
mod teams;

use crate::measured::Measured;
use crate::options::Options;
use crate::report::Section;

const FILTER_ANALYSIS: &str = "\
Differential-drive robots in a plan of 17 × 10 m, sensors as in section III of Saeedi et al.: \
encoders, a laser of 513 beams 0.36° apart and 4.5 m, a gyroscope. Dead reckoning adds up the \
encoders; the EKF corrects them by the gyroscope; with scans also by the motion between consecutive \
scans as ICP finds it, one after the other. Each scan lends its odd beams to the match with the one \
before and its even beams to the one after, so that no range is counted twice. Errors are those of the \
last pose, in the robot's own frame. NEES is the squared error in units of the stated covariance, \
three on average for a filter that knows how wrong it is.

The paper prints neither noise nor errors: the noise is that of `SensorParams::sa`, and the filter is \
told the same.";

const TEAM_ANALYSIS: &str = "\
Three of these robots, each with the map that its own filter makes. After each third of their way they \
share their maps, and the first robot fuses them in its frame by wall segments and the Radon \
transform, told nothing about where the others started. A map is placed rightly as in X7, where both \
robots were: within 0.4 m and 3°, besides what drift bent. Walls of the fused map are right within 0.15 m of a wall of the plan. The paper verifies \
its two alignments at 97 % and 98 %.";

/// The filters and the team.
pub(crate) fn measure(options: &Options) -> anyhow::Result<Measured> {
    let teams = run::run(options)?;
    let robots: Vec<_> = teams.iter().flat_map(|team| &team.robots).collect();
    let filters = Section {
        id: "X8a".to_owned(),
        title: "One robot: dead reckoning, EKF, EKF with scans".to_owned(),
        analysis: FILTER_ANALYSIS.to_owned(),
        tables: vec![tables::filters(&robots)],
        figures: vec![figures::paths(&teams)?],
        criteria: criteria::filters(&robots),
    };
    let sharing = Section {
        id: "X8b".to_owned(),
        title: "Three robots share their maps".to_owned(),
        analysis: TEAM_ANALYSIS.to_owned(),
        tables: vec![tables::shares(&teams), tables::fused(&teams)],
        figures: vec![figures::fused(&teams)?],
        criteria: criteria::teams(&teams, options.quick),
    };
    let runs = teams.iter().flat_map(record::rows).collect();
    Ok(Measured { sections: vec![filters, sharing], runs, ..Measured::default() })
}
