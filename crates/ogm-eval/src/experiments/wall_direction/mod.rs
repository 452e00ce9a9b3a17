//! X3: the direction of a building over many extractions, beside the paper's section 5.1.

mod criteria;
mod figures;
mod record;
mod run;
mod tables;

use crate::measured::Measured;
use crate::options::Options;
use crate::report::Section;

const ANALYSIS: &str = "\
One map of plan A (14 × 12 m, 700 × 600 px of 0.02 m) made along both robots' paths, extracted \
once for each seed. The paper's −45° is what an axis-aligned map reads: its vector is the bisector \
of two perpendicular walls. Walls fix a direction only modulo 90°, so errors are wrapped to ±45°.

X3a uses the values of the paper, the bisector, and the weights as printed; X3b the same lines with \
weights that prefer reliable walls; X3c the defaults. X3d turns the map by 45° and by 19 other \
angles. The paper's own mean is 2.8 standard errors from −45°; the 95 % interval of its σ over 1000 \
runs is 0.536 to 0.585.";

/// Extracts the direction of plan A's map for many seeds and headings.
pub(crate) fn measure(options: &Options) -> anyhow::Result<Measured> {
    let map = run::plan_a(options, 0.0)?;
    let mut measured = run::run(options, &map)?;
    let (runs, timings) = (&measured.runs, &measured.timings);
    let section = Section {
        id: "X3".to_owned(),
        title: "The direction of a building (section 5.1)".to_owned(),
        analysis: ANALYSIS.to_owned(),
        tables: vec![tables::directions(options, runs), tables::times(timings)],
        figures: figures::draw(&map, &measured, options.seed)?,
        criteria: criteria::criteria(runs, options.quick),
    };
    measured.sections.push(section);
    Ok(measured)
}
