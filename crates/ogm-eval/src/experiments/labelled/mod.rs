//! X7: how often the matcher is right, and whether it knows, on labelled pairs of maps.

mod criteria;
mod record;
mod reliability;
mod run;
mod tables;

use crate::measured::Measured;
use crate::options::Options;
use crate::report::Section;

const ANALYSIS: &str = "\
Pairs of maps drawn at random: floors of eight kinds, the parts that two robots explore, their \
sensors and resolutions, drift, moved furniture, the mappers that saved the maps. A merge is right \
if the root mean square displacement over the walls that both maps show is below 0.4 m, besides the \
residual of the best rigid transform of bent maps, and the turn below 3°.

The weights behind the probability were fitted on other seeds. Two kinds of floor repeat \
themselves: equal rooms, and offices that half a turn maps onto themselves. Where the robots saw \
parts that look alike and nothing else, no matcher can tell, so these kinds are counted apart, and \
of these the pairs of parts that do not overlap are in no criterion: half of a half-turn floor \
looks like the other half.";

/// Draws and matches the pairs.
pub(crate) fn measure(options: &Options) -> anyhow::Result<Measured> {
    let (drawn, judged) = run::run(options)?;
    let (curve, figure, of_curve) = reliability::curve(&judged, options.quick);
    let mut criteria = criteria::criteria(&judged, options.quick);
    criteria.extend(of_curve);
    let section = Section {
        id: "X7".to_owned(),
        title: "Maps without tags or start: how often right, and how sure".to_owned(),
        analysis: ANALYSIS.to_owned(),
        tables: vec![
            tables::by_kind(&judged, drawn),
            tables::by_overlap(&judged),
            tables::by_bend(&judged),
            tables::accuracy(&judged),
            tables::by_style(&judged),
            tables::to_refuse(&judged),
            curve,
        ],
        figures: vec![figure],
        criteria,
    };
    let runs = judged.iter().map(record::row).collect();
    Ok(Measured { runs, ..Measured::of_section(section) })
}
