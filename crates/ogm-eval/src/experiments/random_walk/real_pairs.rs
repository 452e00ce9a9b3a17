//! The random walk on real map pairs, from the truth off by a stated amount.

use std::path::Path;

use carpin_walk::{Around, DistanceParams, Objective, Params};
use nalgebra::Vector2;
use ogm_core::{ClassThresholds, OccupancyGrid, Outcome, Se2};
use ogm_merge::{CarpinParams, align_carpin};
use ogm_view::{overlay, png, side_by_side};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};

use super::record::shown;
use super::variants::OVERLAP;
use crate::cases::map_pair::{MapPair, read_pairs};
use crate::judge::{Overlap, PoseError, TransformError, Truth, WALK};
use crate::measured::{Run, RunResult};
use crate::options::Options;
use crate::report::{Figure, Image, Table};
use crate::stats::Share;

/// Largest error of a start along x and y, metres, and of its turn, degrees.
const START_M: f64 = 1.0;
const START_DEG: f64 = 7.5;

/// Cells are at least this large for the walk, metres: a walk looks at the maps some 800 times.
const CELL_M: f64 = 0.2;

const OBJECTIVES: [(&str, Objective); 2] = [("ψ", Objective::Picture), ("overlap only", OVERLAP)];

/// What the report shows of the real pairs.
pub(super) struct RealPairs {
    pub(super) table: Table,
    pub(super) figures: Vec<Figure>,
    pub(super) runs: Vec<Run>,
}

struct Answer {
    row: Vec<String>,
    runs: Vec<Run>,
    right: [bool; 2],
    figure: Option<Figure>,
}

/// Walks on every pair below `folder` that matches.
pub(super) fn run(options: &Options, folder: &Path) -> anyhow::Result<RealPairs> {
    let pairs = read_pairs(folder)?;
    let matching: Vec<(&MapPair, Truth)> =
        pairs.iter().filter_map(|pair| pair.truth.map(|truth| (pair, truth))).collect();
    options.watch.begin("X5 pairs", matching.len() as u64);
    let answers: Vec<Answer> = matching
        .par_iter()
        .enumerate()
        .with_max_len(1)
        .map(|(index, (pair, truth))| {
            let answer = answer(pair, truth, options.seed, index as u64);
            options.watch.step();
            answer
        })
        .collect::<anyhow::Result<_>>()?;
    options.watch.end();

    let mut rows: Vec<_> = answers.iter().map(|answer| answer.row.clone()).collect();
    let right = |which: usize| shown(Share::holding(&answers, |answer| answer.right[which]));
    let all = ["right within the tolerance", "", "", &right(0), "", &right(1)];
    rows.push(all.map(str::to_owned).to_vec());
    Ok(RealPairs {
        table: Table {
            caption: format!(
                "Real pairs on cells of {CELL_M} m (coarser where a map is), 200 samples from the \
                 truth off by up to {START_M} m in x and y and {START_DEG}°. Errors at the \
                 source's centroid; right is within the pair's tolerance and two cells."
            ),
            header: ["pair", "start off by", "ψ(truth)", "ψ: error", "ψ found", "overlap: error"]
                .map(str::to_owned)
                .to_vec(),
            rows,
        },
        figures: answers.iter().filter_map(|answer| answer.figure.clone()).collect(),
        runs: answers.into_iter().flat_map(|answer| answer.runs).collect(),
    })
}

fn answer(pair: &MapPair, truth: &Truth, seed: u64, stream: u64) -> anyhow::Result<Answer> {
    let thresholds = ClassThresholds::default();
    let resolutions = [&pair.target, &pair.source].map(|map| map.frame().resolution());
    let resolution = resolutions[0].max(resolutions[1]).max(CELL_M);
    let coarse = |map: &OccupancyGrid| -> anyhow::Result<OccupancyGrid> {
        if map.frame().resolution() >= resolution {
            return Ok(map.clone());
        }
        Ok(grid_merge::coarsen(map, resolution, &thresholds)?)
    };
    let (target, source) = (coarse(&pair.target)?, coarse(&pair.source)?);
    let centroid = truth.centre;
    let true_target_from_source = truth.target_from_source;
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(stream);
    let [x, y] = std::array::from_fn(|_| rng.random_range(-START_M..START_M));
    let turn = rng.random_range(-START_DEG..START_DEG).to_radians();
    let start = Se2::about(true_target_from_source * centroid, turn, Vector2::new(x, y))
        * true_target_from_source;

    let overlap = Overlap::new(&pair.target, &pair.source, true_target_from_source);
    let shown =
        |error: PoseError| format!("{:.2} m, {:.1}°", error.displacement, error.turn.to_degrees());
    let mut psi_of_truth =
        carpin_walk::MapDistance::new(&target, &source, &DistanceParams::default())?;
    let mut row = vec![pair.name.clone(), shown(truth.error(&start))];
    row.push(format!("{:.2}", psi_of_truth.psi(&true_target_from_source)?.psi));
    let (mut runs, mut right, mut panels) = (Vec::new(), [false; 2], Vec::new());
    panels.push(overlay(&target, &source, start)?);
    for (which, (name, objective)) in OBJECTIVES.into_iter().enumerate() {
        let distance = DistanceParams { objective, thresholds, ..DistanceParams::default() };
        let search = Params { distance, seed, around: Around::Start, ..Params::default() };
        let params = CarpinParams { search, ..CarpinParams::default() };
        let report = align_carpin(&target, &source, start, &params, &())?;
        let result = match report.outcome {
            Outcome::Found(found) => {
                let pose = truth.error(&found.target_from_source);
                right[which] = truth.tolerance.or(WALK).admits(pose, report.resolution);
                row.push(shown(pose));
                if which == 0 {
                    row.push(format!("{:.2}", found.psi));
                }
                panels.push(overlay(&target, &source, found.target_from_source)?);
                let walls = overlap.errors(&found.target_from_source);
                RunResult::Transform(TransformError { pose, ..walls })
            }
            Outcome::Refused(refusal) => {
                row.extend(std::iter::repeat_n("refused".to_owned(), 2 - which));
                RunResult::Refused(refusal)
            }
        };
        let (case, variant) = (pair.name.clone(), name.to_owned());
        runs.push(Run { experiment: "X5 pairs", case, variant, seed, result });
    }
    let figure = Figure {
        name: format!("walk-pair-{}", pair.name),
        caption: format!("{}: the start, after the walk by ψ, and by the overlap.", pair.name),
        image: Image::Png(png(&side_by_side(&panels, 8))?),
    };
    Ok(Answer { row, runs, right, figure: Some(figure) })
}
