//! The methods on real map pairs: tags on walls that both maps saw, ranges along simulated drives.

mod criteria;
mod figures;
mod record;
mod run;
mod tables;
mod tags;

use std::path::Path;

use crate::measured::Measured;
use crate::options::Options;
use crate::report::Section;

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

/// Runs the methods on every pair below `folder`.
pub(crate) fn measure(options: &Options, folder: &Path) -> anyhow::Result<Measured> {
    let answered = run::run(options, folder)?;
    let section = Section {
        id: "pairs".to_owned(),
        title: "Real map pairs".to_owned(),
        analysis: ANALYSIS.to_owned(),
        tables: vec![tables::table(&answered)],
        figures: figures::draw(&answered)?,
        criteria: criteria::criteria(&answered),
    };
    let runs = answered.into_iter().flat_map(|one| one.answers.runs).collect();
    Ok(Measured { runs, ..Measured::of_section(section) })
}
