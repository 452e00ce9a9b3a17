//! X6: merging by wall segments and the Radon transform, beside Saeedi et al.

mod figures;
mod histograms;
mod record;
mod search;
mod tables;
mod tuning;

use std::path::Path;

use crate::cases::team_world::team;
use crate::measured::Measured;
use crate::options::Options;
use crate::report::Section;

const SEARCH_ANALYSIS: &str = "\
Two robots with the paper's lidar in a random office floor each, maps in frames of random heading, \
nothing given. Segments that look alike propose poses; each is judged by how walls meet; the best \
sixteen are tuned and verified. The hypothesis that is listed is the first at the pose in the \
order in which they were made. An answer is right within 0.25 m and 1°.";

const PAIRS_ANALYSIS: &str = "\
Real maps, no tags. Two maps are merged only where nine in ten walls meet within a cell, so maps \
that drift has bent are refused. Right in candidates says whether the true pose is among those \
that were tuned.";

/// X6a, X6b and X6c.
pub(crate) fn measure(options: &Options) -> anyhow::Result<Measured> {
    let maps = team(options.seed)?;
    let mut translation = tuning::translations(&maps)?;
    translation.figures = figures::draw(&maps)?;
    let mut measured = Measured::of_section(translation);
    measured.extend(Measured::of_section(tuning::rotations(&maps)?));
    let searched = search::plans(options)?;
    let section = Section {
        id: "X6c".to_owned(),
        title: "The search from scratch".to_owned(),
        analysis: SEARCH_ANALYSIS.to_owned(),
        tables: vec![tables::table(&searched)],
        figures: Vec::new(),
        criteria: vec![tables::success(&searched), tables::no_wrong("X6c wrong", &searched)],
    };
    measured.extend(record::measured("X6c", section, searched, options.seed));
    Ok(measured)
}

/// The search on every pair below `folder`.
pub(crate) fn measure_pairs(options: &Options, folder: &Path) -> anyhow::Result<Measured> {
    let searched = search::pairs(options, folder)?;
    let section = Section {
        id: "X6 pairs".to_owned(),
        title: "Real pairs by wall segments".to_owned(),
        analysis: PAIRS_ANALYSIS.to_owned(),
        tables: vec![tables::table(&searched)],
        figures: Vec::new(),
        criteria: vec![tables::no_wrong("X6 pairs wrong", &searched)],
    };
    Ok(record::measured("X6 pairs", section, searched, options.seed))
}
