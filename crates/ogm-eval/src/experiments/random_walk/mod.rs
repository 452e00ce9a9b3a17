//! X5: the Gaussian random walk of Carpin and Birk, corrected and as printed.

mod criteria;
mod figures;
mod real_pairs;
mod record;
mod run;
mod tables;
mod variants;

use crate::measured::{Measured, Run, Timing};
use crate::options::Options;
use crate::report::Section;

const ANALYSIS: &str = "\
Two robots with the paper's sensor (162°, 91 beams, 4 m, 1 % spurious readings), drifting odometry and a \
noisy compass each map a random building into 100 × 100 cells, their rows turned against each \
other by up to 15°. A walk of 200 samples starts at the true transform off by up to the stated amount, uniform \
in x, y and turn. It succeeds if it ends within 2 cells and 3° of the truth. Either both robots \
saw the whole building, or each map is cut to one side of it so that they share 60 %, or each robot \
saw what lies along its own drive.

With the whole building in both maps the picture distance is least at the truth, near enough; with a part it is \
not, and the column of runs that end below ψ(truth) shows that the walk finds what it looks for. The overlap \
objective, ours, counts only what both maps know.

Theorem 1 prints the limit 0 for the probability of being within ε of the optimum; it is 1, and \
the figure shows the share of walks that have been there after k samples.";

/// Walks in every case by every variant, then on real pairs where there are any.
pub(crate) fn measure(options: &Options) -> anyhow::Result<Measured> {
    let walked = run::run(options)?;
    let mut tables = tables::draw(&variants::variants(), &walked);
    let mut figures = figures::draw(options)?;
    let mut runs: Vec<Run> = walked.iter().map(|walk| walk.run.clone()).collect();
    if let Some(folder) = &options.pairs {
        let real = real_pairs::run(options, folder)?;
        tables.push(real.table);
        figures.extend(real.figures);
        runs.extend(real.runs);
    }
    let timings = walked.iter().map(|walk| Timing {
        experiment: "X5",
        step: walk.variant,
        seed: walk.run.seed,
        milliseconds: walk.milliseconds,
    });
    Ok(Measured {
        timings: timings.collect(),
        sections: vec![Section {
            id: "X5".to_owned(),
            title: "Stochastic map merging (Carpin and Birk)".to_owned(),
            analysis: ANALYSIS.to_owned(),
            tables,
            figures,
            criteria: criteria::criteria(&walked, options.quick),
        }],
        runs,
    })
}
