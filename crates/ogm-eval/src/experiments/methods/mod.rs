//! X4: methods #1, #2 and #3 on simulated worlds, beside the paper's Table 4.

mod charts;
mod criteria;
mod figures;
mod readers;
mod record;
mod run;
mod tables;
mod variants;
mod worked_figures;

use crate::cases::worlds::Building;
use crate::measured::Measured;
use crate::options::Options;
use crate::report::Section;

const ANALYSIS: &str = "\
Every world is a random floor plan, two robots' paths and maps, and sixteen tags, from one seed. \
The paper does not say how far its tags were off, so each world is run as the tags were localised \
and with a Gaussian error of 2, 5 and 10 px (of 0.02 m) an axis added to each tag of each robot.

mse_disp is the mean squared displacement of the source's walls in the true overlap between the \
estimated and the true transform; it needs the truth and is zero for it. mse_nn is the mean \
squared distance of those walls to the nearest wall of the target, closest to what can be measured \
without a truth; it has a floor above zero and saturates inside a building.

With a corrected method #1 and tags located to less than a pixel, #1 is no worse than #2: the \
ordering of the paper's Table 4 needs tags that are off by some pixels, or the formulas of #1 as \
they are printed. The paper's 7178 px² is of the size that a rotation about the image centre with \
unrotated centroids gives; that is plausible, not proven.

Before it refines, the default #3 looks up to 1 m and 5° around the result of #2 for a place where \
more walls agree. The paper does not; \"#3 from where #2 ends\" and the rows below it leave that \
out. Where the walls have no clear direction, or tags and walls differ by more than 10°, it refines \
the tags' own rotation too. \"two tags\" is #3 from the two surest tags (the paper's future work), \
\"#1b + ICP\" refines the least-squares fit of the tags without looking for walls (its conclusions).

Every method refuses an answer that its own evidence speaks against: tags that no rigid motion \
brings together within 0.75 m, tags that lie apart under the answer, and less than 45 % of the \
common walls in agreement under it, or around it where it is not refined. #1 with tags that are off \
by 10 px is often refused so; the unguarded rows say what it would have answered. The rows paper() \
hold what is printed throughout: ICP over all nearest neighbours without a gate comes to rest \
far from the truth where the maps overlap in part.

match is ours and looks at the maps alone, without tags or a start, so it has one row for all regimes.";

/// Runs every variant on its share of the worlds.
pub(crate) fn measure(options: &Options) -> anyhow::Result<Measured> {
    let run::Everything { runs, timings, believed } = run::run(options)?;
    let mut figures = charts::draw(&runs);
    figures.extend(figures::draw(options.seed)?);
    let section = Section {
        id: "X4".to_owned(),
        title: "Methods #1, #2 and #3 (the paper's Table 4)".to_owned(),
        analysis: ANALYSIS.to_owned(),
        tables: vec![
            tables::table_4(options, &runs),
            tables::times(&timings),
            tables::variants(&runs, Building::Random),
            tables::variants(&runs, Building::PlanA),
            tables::strangers(&runs),
            readers::table(&runs, &believed),
            tables::failures(&runs),
        ],
        figures,
        criteria: [
            criteria::criteria(&runs, options.quick),
            readers::criteria(&believed, options.quick),
        ]
        .concat(),
    };
    Ok(Measured { sections: vec![section], runs, timings })
}
