//! A better start where the given one lies outside the basin of the alignment.

use nalgebra::{Point2, Vector2};
use ogm_core::{Length, Outcome, Refusal, Se2, require};

use crate::sided::SidedIndex;
use crate::{IcpError, WallPoint, WallPoints};

/// How far and how finely to look around a start; see [`search_start`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StartParams {
    /// How far the maps may be shifted against each other, metres: 1.0, five times the step, what
    /// a tag that is misplaced by 0.2 m in both maps can cause at three sigma.
    pub reach: Length,
    /// How far they may be turned, radians: 5°, what the walls of a bent map can cause.
    pub max_rotation: f64,
    /// Distance between trial shifts, and at first between walls that match: 0.2 m, at least two
    /// cells of the coarser map.
    pub step: Length,
    /// Source points that vote: 400, enough that chance agreement averages out.
    pub max_points: usize,
    /// Another basin is taken only if its score exceeds that of the given start by this share:
    /// 0.05, so that noise along a corridor moves nothing.
    pub min_gain: f64,
    /// Share of its score that a basin at the end of the reach loses, growing with the square of
    /// the way there: 0.2, because bent maps fit about as well in wrong places and a start is
    /// rarely far off.
    pub far_penalty: f64,
}

impl Default for StartParams {
    fn default() -> Self {
        Self {
            reach: Length::metres(1.0),
            max_rotation: 5.0_f64.to_radians(),
            step: Length::metres(0.2).at_least_cells(2.0),
            max_points: 400,
            min_gain: 0.05,
            far_penalty: 0.2,
        }
    }
}

/// Basins that are followed to their top besides that of the given start.
const BASINS: usize = 5;
/// One voter of so many is asked about each trial of the first sweep.
const COARSE: usize = 4;
/// Most trial shifts from the start in one direction.
const MAX_STEPS: f64 = 20.0;
/// Furthest trial turn, radians: with the half degree of the finest turn, 115 of them.
const MAX_TURN: f64 = 0.5;
/// Halvings of the step on the way to the top.
const HALVINGS: usize = 3;

/// The start from which most walls come to lie on walls seen from the same side, out of shifts
/// and turns around `init_target_from_source`.
///
/// The given start itself comes back unless another basin is clearly better. [`align`] from here
/// converges where the given start was further off than its reach.
///
/// Refuses with [`Refusal::TooLittleStructure`] if either set is empty, and with
/// [`Refusal::TooFewPairs`] if no source point comes near the target.
///
/// # Errors
/// A non-finite start, or a parameter outside its range.
///
/// [`align`]: crate::align()
pub fn search_start(
    target: &WallPoints,
    source: &WallPoints,
    init_target_from_source: Se2,
    params: &StartParams,
) -> Result<Outcome<Se2>, IcpError> {
    let spacing = target.spacing().max(source.spacing());
    let (reach, step) = (params.reach.resolve(spacing), params.step.resolve(spacing));
    let steps = reach / step;
    require((0.0..=MAX_STEPS).contains(&steps), "reach", "0 to 20 steps", steps)?;
    let rotation = params.max_rotation;
    require((0.0..=MAX_TURN).contains(&rotation), "max_rotation", "0 to 0.5 rad", rotation)?;
    for (name, share) in [("min_gain", params.min_gain), ("far_penalty", params.far_penalty)] {
        require((0.0..=1.0).contains(&share), name, "in [0, 1]", share)?;
    }
    init_target_from_source.check_finite()?;

    let index = SidedIndex::new(target);
    let Some(index) = index.filter(|_| !source.points().is_empty()) else {
        return Ok(Outcome::Refused(Refusal::TooLittleStructure { have: 0, need: 1 }));
    };
    let near: Vec<WallPoint> = source
        .points()
        .iter()
        .filter(|point| index.is_near(init_target_from_source * point.position, reach))
        .copied()
        .collect();
    let Some(voters) = Voters::new(&near, init_target_from_source, params.max_points) else {
        return Ok(Outcome::Refused(Refusal::TooFewPairs { have: 0, need: 1 }));
    };
    let search = Search { index: &index, voters: &voters, step, finest: 1.5 * spacing };
    Ok(Outcome::Found(search.run(reach, params)))
}

/// Source points that vote, and the place that the source is turned about.
struct Voters {
    points: Vec<WallPoint>,
    init_target_from_source: Se2,
    /// In the target frame.
    centre: Point2<f64>,
    /// Distance of the furthest voter from the centre, metres.
    extent: f64,
}

impl Voters {
    /// Every so many of `near`, at most `max_points`.
    fn new(near: &[WallPoint], init_target_from_source: Se2, max_points: usize) -> Option<Self> {
        let every = near.len().div_ceil(max_points.max(1)).max(1);
        let points: Vec<WallPoint> = near.iter().step_by(every).copied().collect();
        let images = || points.iter().map(|point| init_target_from_source * point.position);
        let sum = images().fold(Vector2::zeros(), |sum, image| sum + image.coords);
        let centre = Point2::from(sum / points.len() as f64);
        let extent = images().map(|image| (image - centre).norm()).fold(0.0, f64::max);
        (!points.is_empty()).then_some(Self { points, init_target_from_source, centre, extent })
    }

    fn target_from_source(&self, offset: &Offset) -> Se2 {
        let shift = Vector2::new(offset.x, offset.y);
        Se2::about(self.centre, offset.theta, shift) * self.init_target_from_source
    }
}

/// A motion away from the given start: a turn about the voters' centre, then a shift.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Offset {
    x: f64,
    y: f64,
    theta: f64,
}

impl Offset {
    /// The squared way from the given start; 1 at the end of the reach or of the turn.
    fn way(&self, reach: f64, max_rotation: f64) -> f64 {
        let shift = if reach > 0.0 { self.x.hypot(self.y) / reach } else { 0.0 };
        let turn = if max_rotation > 0.0 { self.theta / max_rotation } else { 0.0 };
        shift * shift + turn * turn
    }
}

/// Where a climb ended.
struct Top {
    offset: Offset,
    score: f64,
}

struct Search<'a> {
    index: &'a SidedIndex,
    voters: &'a Voters,
    step: f64,
    /// Walls closer than this match as well as can be told.
    finest: f64,
}

impl Search<'_> {
    fn run(&self, reach: f64, params: &StartParams) -> Se2 {
        let given = Offset::default();
        let mut best = self.climb(given);
        for basin in self.basins(reach, params.max_rotation) {
            let mut top = self.climb(basin);
            top.score *= 1.0 - params.far_penalty * top.offset.way(reach, params.max_rotation);
            if top.score > best.score {
                best = top;
            }
        }
        let finest = (1.5 * self.step / f64::from(1 << HALVINGS)).max(self.finest);
        let as_given = self.score(&given, finest, 1);
        let is_better = best.score > as_given * (1.0 + params.min_gain);
        self.voters.target_from_source(if is_better { &best.offset } else { &given })
    }

    /// The turn that moves the furthest voter by one step, kept between half and two degrees.
    fn turn(&self) -> f64 {
        (self.step / self.voters.extent).clamp(0.5_f64.to_radians(), 2.0_f64.to_radians())
    }

    /// The best trial offsets that are more than two steps apart, by a part of the voters.
    fn basins(&self, reach: f64, max_rotation: f64) -> Vec<Offset> {
        let turn = self.turn();
        let mut trials = Vec::new();
        for theta in lattice(max_rotation, turn) {
            for y in lattice(reach, self.step) {
                for x in lattice(reach, self.step) {
                    let offset = Offset { x, y, theta };
                    trials.push((offset, self.score(&offset, self.step, COARSE)));
                }
            }
        }
        // Stable: equal scores stay in the order of the lattice.
        trials.sort_by(|a, b| b.1.total_cmp(&a.1));
        let mut chosen: Vec<Offset> = Vec::with_capacity(BASINS);
        for (offset, _) in trials {
            let apart = |other: &Offset| {
                (offset.x - other.x).hypot(offset.y - other.y) > 2.1 * self.step
                    || (offset.theta - other.theta).abs() > 2.1 * turn
            };
            if chosen.iter().all(apart) {
                chosen.push(offset);
                if chosen.len() == BASINS {
                    break;
                }
            }
        }
        chosen
    }

    /// Climbs from `offset` with ever smaller steps.
    fn climb(&self, offset: Offset) -> Top {
        let (mut step, mut turn) = (self.step, self.turn());
        let mut top = Top { offset, score: 0.0 };
        for _ in 0..HALVINGS {
            step /= 2.0;
            turn /= 2.0;
            let tolerance = (1.5 * step).max(self.finest);
            top.score = self.score(&top.offset, tolerance, 1);
            // A climb of a few steps stays within its basin.
            for _ in 0..4 {
                let here = top.offset;
                for (x, y, theta) in [
                    (step, 0.0, 0.0),
                    (-step, 0.0, 0.0),
                    (0.0, step, 0.0),
                    (0.0, -step, 0.0),
                    (0.0, 0.0, turn),
                    (0.0, 0.0, -turn),
                ] {
                    let next = Offset { x: here.x + x, y: here.y + y, theta: here.theta + theta };
                    let score = self.score(&next, tolerance, 1);
                    if score > top.score {
                        top = Top { offset: next, score };
                    }
                }
                if top.offset == here {
                    break;
                }
            }
        }
        top
    }

    /// How many voters, of every so many, lie on a wall seen from their side; each less the square
    /// of the share of the tolerance that it misses the wall by.
    fn score(&self, offset: &Offset, tolerance: f64, every: usize) -> f64 {
        let target_from_source = self.voters.target_from_source(offset);
        let votes = self.voters.points.iter().step_by(every).map(|point| {
            let side = point.free_side.map(|side| target_from_source * side);
            self.index
                .distance_sq(target_from_source * point.position, side, tolerance)
                .map_or(0.0, |distance_sq| 1.0 - distance_sq / (tolerance * tolerance))
        });
        votes.sum()
    }
}

/// Multiples of `step` from −`reach` to `reach`.
fn lattice(reach: f64, step: f64) -> impl Iterator<Item = f64> {
    let half = (reach / step).round();
    let from = -half;
    std::iter::successors(Some(from), |i| Some(i + 1.0))
        .take_while(move |&i| i <= half)
        .map(move |i| i * step)
}
