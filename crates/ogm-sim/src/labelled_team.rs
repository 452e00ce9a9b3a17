//! Teams of maps with the right answer, drawn at random.

use ogm_core::{OccupancyGrid, RobotId, Se2};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::conditions::{Conditions, direction};
use crate::draw::{Stream, generator};
use crate::explore::{Part, explore, free_space};
use crate::navigate::FreeSpace;
use crate::run::{bend, frame_at_start, random_heading};
use crate::truth::{PairTruth, pair_truth};
use crate::{FloorKind, FloorPlan, PairParams, RobotRun, SimError, map_along_path};

/// Share of a floor that one robot explores: two of them may have much in common or nothing.
const EXPLORED: [f64; 2] = [0.3, 0.7];
/// Share of the furniture that stands elsewhere when a robot comes, for one robot of four.
const MOVED: f64 = 0.3;

/// Maps of one floor, perhaps one of another, and the truth about them.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LabelledTeam {
    /// What each robot brings home.
    pub maps: Vec<OccupancyGrid>,
    /// Exact pose of every map frame in the plan; `None` of the stranger.
    pub world_from_map: Vec<Option<Se2>>,
    /// For target < source, what both observed of one floor; `None` if nothing.
    truths: Vec<Vec<Option<PairTruth>>>,
}

impl LabelledTeam {
    /// What `target` and `source` have in common and how they lie on each other there; `None` if
    /// they have nothing in common.
    #[must_use]
    pub fn truth(&self, target: usize, source: usize) -> Option<&PairTruth> {
        self.truths.get(target)?.get(source.checked_sub(target + 1)?)?.as_ref()
    }

    /// The map from another building, if there is one.
    #[must_use]
    pub fn stranger(&self) -> Option<usize> {
        self.world_from_map.iter().position(Option::is_none)
    }
}

/// Draws the maps of `robots` robots of one floor, and where `has_stranger` one more of another.
///
/// Parts explored, sensors, resolutions, drift, map styles and moved furniture are all decided by
/// `seed`, each robot's on its own. The stranger, if there is one, comes last.
///
/// # Errors
/// A floor that robots cannot explore as asked for: another seed may do.
pub fn labelled_team(
    kind: FloorKind,
    robots: usize,
    has_stranger: bool,
    seed: u64,
) -> Result<LabelledTeam, SimError> {
    let mut rng = generator(seed, Stream::Team, kind as u64);
    let plan = kind.draw(rng.random());
    let mut visits = Vec::with_capacity(robots + 1);
    for robot in (0..).map(RobotId).take(robots) {
        let moved = if rng.random_bool(0.25) { MOVED } else { 0.0 };
        let floor = plan.with_furniture_moved(moved, &mut rng);
        visits.push(Visit::draw(&floor, robot, &mut rng)?);
    }
    let truths = (0..robots).map(|target| {
        let pair = |source: usize| visits[target].truth(&visits[source]);
        (target + 1..robots).map(pair).collect::<Result<_, _>>()
    });
    let truths = truths.collect::<Result<_, SimError>>()?;
    if has_stranger {
        let other = FloorKind::ALL[rng.random_range(0..FloorKind::ALL.len())];
        let floor = if rng.random_bool(0.5) { kind } else { other }.draw(rng.random());
        visits.push(Visit::draw(&floor, RobotId(u32::MAX), &mut rng)?);
    }
    let world_from_map = visits.iter().enumerate();
    let world_from_map =
        world_from_map.map(|(index, visit)| (index < robots).then_some(visit.run.world_from_map));
    Ok(LabelledTeam {
        world_from_map: world_from_map.collect(),
        maps: visits.into_iter().map(|visit| visit.styled).collect(),
        truths,
    })
}

/// One robot on its floor.
struct Visit {
    run: RobotRun,
    robot: RobotId,
    params: PairParams,
    styled: OccupancyGrid,
}

impl Visit {
    fn draw(floor: &FloorPlan, robot: RobotId, rng: &mut ChaCha8Rng) -> Result<Self, SimError> {
        let conditions = Conditions::draw(rng);
        let params = conditions.target;
        let space: FreeSpace = free_space(floor)?;
        let share = rng.random_range(EXPLORED[0]..EXPLORED[1]);
        let part = Part::holding(share, &space, direction(rng));
        let middle = floor.size() / 2.0;
        let path = explore(&space, &part, params.step, rng)
            .ok_or(SimError::BlockedRoute { x: middle.x, y: middle.y })?;
        let world_from_map = frame_at_start(&path, random_heading(params.seed, robot));
        let run = map_along_path(floor, &path, &[], world_from_map, robot, &params)?;
        let styled = conditions.styles[0].apply(&run.map, params.seed);
        Ok(Self { run, robot, params, styled })
    }

    fn truth(&self, source: &Self) -> Result<Option<PairTruth>, SimError> {
        let bends = [self, source].map(|visit| bend(visit.robot, &visit.params));
        pair_truth(&self.run, &source.run, [&bends[0], &bends[1]])
    }
}
