//! X10: bent maps made straight.

mod criteria;
mod figures;
mod known;
mod record;
mod run;
mod tables;

use std::path::Path;

use crate::measured::Measured;
use crate::options::Options;
use crate::report::Section;

const ANALYSIS: &str = "\
Pairs of overlapping maps drawn at random: floors that do not repeat, sensors, resolutions, moved \
furniture and map styles as in X7. What the robot of the source believes about its pose is displaced \
smoothly, by the given standard deviation an axis, over waves of 15 to 60 m, and its scans with it, \
each in one piece: a wall is displaced by where it was seen from. The target is straight, or in every \
third pair bent as much in its own way. Only pairs that the matcher merges rightly are made straight.

The residual is the root mean square distance of walls that both maps show between where the source \
is put and where the target shows them, which is the true floor where the target is straight. \
Doubled is the share of the source's wall with a wall of the target within 0.5 m but none within 1.5 \
cells. After is what `auto` gives: where held-out walls do not say that a bend is better, the map \
stays as it is. Known is what the same deformation gives where it is fitted to where every wall \
belongs: what is left then is beyond it, for one wall, or its two faces, may be displaced in several \
ways.";

const PAIRS: &str = "\
Under `auto`. Lost is the largest share of an input's wall that the fused map has no more, of the \
maps as they were fused.";

/// Draws the pairs and bends their maps.
pub(crate) fn measure(options: &Options) -> anyhow::Result<Measured> {
    let judged = run::run(options)?;
    let section = Section {
        id: "X10".to_owned(),
        title: "Bent maps made straight".to_owned(),
        analysis: ANALYSIS.to_owned(),
        tables: vec![
            tables::by_bend(&judged),
            tables::by_overlap(&judged),
            tables::by_style(&judged),
        ],
        figures: figures::draw()?,
        criteria: criteria::criteria(&judged, options.quick),
    };
    Ok(Measured::of_section(section))
}

/// Bends the maps of every pair below `folder` that is merged rightly.
pub(crate) fn measure_pairs(options: &Options, folder: &Path) -> anyhow::Result<Measured> {
    let real = run::real(options, folder)?;
    let section = Section {
        id: "X10 pairs".to_owned(),
        title: "Real pairs made straight".to_owned(),
        analysis: PAIRS.to_owned(),
        tables: vec![tables::real(&real)],
        figures: Vec::new(),
        criteria: criteria::of_pairs(&real),
    };
    Ok(Measured::of_section(section))
}
