//! What X5 is run on: rescue-like maps of 100 × 100 cells and starts off by a stated amount.

use carpin_walk::{DistanceParams, MapDistance, Placement};
use ogm_core::{GridFrame, Occupancy, OccupancyGrid, RobotId, Se2, warp_nearest, wrap_period};
use ogm_sim::{FloorPlan, PairParams, RobotRun, SOURCE, TARGET, map_along_path, survey};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::judge::PoseError;

/// Cells of a map's side, the paper's.
const SIDE: usize = 100;

/// Columns that the longer side of a building spans, so that a map turned by the largest heading
/// still has all of it.
const SPAN: f64 = 84.0;

/// Largest angle between the rows of the two maps, degrees.
const HEADING: f64 = 15.0;

/// What both robots saw.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Coverage {
    /// All of the building, each on drives of its own noise.
    Full,
    /// The same, but each map is cut to its side of the building so that they share 60 %.
    Partial,
    /// What lies along their own drives: less than 60 % with a sensor that reaches 4 m.
    Drives,
}

/// Largest error of a start: uniform in x, y and turn.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StartError {
    pub(crate) cells: f64,
    pub(crate) degrees: f64,
}

/// One of the four cases.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Case {
    pub(crate) name: &'static str,
    pub(crate) coverage: Coverage,
    pub(crate) start: StartError,
}

const NEAR: StartError = StartError { cells: 5.0, degrees: 7.5 };
const FAR: StartError = StartError { cells: 15.0, degrees: 22.5 };

pub(crate) const CASES: [Case; 6] = [
    Case { name: "full, ≤ 5 cells, 7.5°", coverage: Coverage::Full, start: NEAR },
    Case { name: "full, ≤ 15 cells, 22.5°", coverage: Coverage::Full, start: FAR },
    Case { name: "60 %, ≤ 5 cells, 7.5°", coverage: Coverage::Partial, start: NEAR },
    Case { name: "60 %, ≤ 15 cells, 22.5°", coverage: Coverage::Partial, start: FAR },
    Case { name: "drives, ≤ 5 cells, 7.5°", coverage: Coverage::Drives, start: NEAR },
    Case { name: "drives, ≤ 15 cells, 22.5°", coverage: Coverage::Drives, start: FAR },
];

/// Two maps of one building and the truth about them.
#[derive(Debug)]
pub(crate) struct RescuePair {
    pub(crate) target: OccupancyGrid,
    pub(crate) source: OccupancyGrid,
    pub(crate) target_from_source: Se2,
    pub(crate) seed: u64,
}

impl RescuePair {
    /// The pair of a random building.
    pub(crate) fn random(coverage: Coverage, seed: u64) -> anyhow::Result<Self> {
        Self::of(&FloorPlan::random(seed)?, coverage, seed)
    }

    /// The robots of Carpin and Birk in one building, in map frames turned against each other.
    pub(crate) fn of(plan: &FloorPlan, coverage: Coverage, seed: u64) -> anyhow::Result<Self> {
        let heading = generator(seed, 0).random_range(-HEADING..HEADING).to_radians();
        let map = |robot: RobotId, heading: f64| -> anyhow::Result<(OccupancyGrid, Se2)> {
            // Robots that cover the whole building differ by the seed of their noise.
            let noise = 2 * seed + u64::from(robot == SOURCE);
            let mut robots = PairParams { seed: noise, ..PairParams::cb() };
            robots.mapping.resolution = plan.size().max() / SPAN;
            let run = match coverage {
                Coverage::Full => survey(plan, heading, &robots)?,
                Coverage::Partial => half(plan, robot, survey(plan, heading, &robots)?),
                Coverage::Drives => {
                    let path = plan.path(robot, robots.step)?;
                    let world_from_map = Se2::new(0.0, 0.0, heading);
                    map_along_path(plan, &path, &[], world_from_map, robot, &robots)?
                }
            };
            Ok((square(&run.map)?, run.world_from_map))
        };
        let (target, world_from_target) = map(TARGET, 0.0)?;
        let (source, world_from_source) = map(SOURCE, heading)?;
        let target_from_source = world_from_target.between(&world_from_source);
        Ok(Self { target, source, target_from_source, seed })
    }

    /// Cells that both maps know, as a share of those that one knows on average.
    pub(crate) fn shared(&self) -> anyhow::Result<f64> {
        let (target, source) = (&self.target, &self.source);
        let unknown = Occupancy::UNKNOWN;
        let seen = warp_nearest(
            source.cells(),
            source.frame(),
            target.frame(),
            (target.width(), target.height()),
            &self.target_from_source,
            unknown,
        )?;
        let known = |cells: &[Occupancy]| cells.iter().filter(|cell| cell.is_known()).count();
        let cells = target.cells().cells();
        let both = cells.iter().zip(seen.cells()).filter(|(a, b)| a.is_known() && b.is_known());
        let all = known(cells) + known(source.cells().cells());
        Ok(2.0 * both.count() as f64 / all as f64)
    }

    /// The distance of the maps for looking at placements; its canvas is the default one.
    pub(crate) fn distance(&self) -> anyhow::Result<MapDistance> {
        Ok(MapDistance::new(&self.target, &self.source, &DistanceParams::default())?)
    }

    /// The truth, off by at most `error`.
    pub(crate) fn start(&self, error: StartError) -> anyhow::Result<Se2> {
        let distance = self.distance()?;
        let mut placement = distance.placement(&self.target_from_source);
        let mut rng = generator(self.seed, 1);
        let limits = [error.cells, error.cells, error.degrees];
        for (part, limit) in placement.iter_mut().zip(limits) {
            *part += rng.random_range(-limit..limit);
        }
        Ok(distance.target_from_source(&placement))
    }

    /// The error of a pose at the source's centre, by the walk's own placements.
    pub(crate) fn error(&self, found_target_from_source: &Se2) -> anyhow::Result<PoseError> {
        let distance = self.distance()?;
        let placements = [found_target_from_source, &self.target_from_source];
        let [found, truth]: [Placement; 2] = placements.map(|motion| distance.placement(motion));
        let turn = wrap_period(found[2] - truth[2], 360.0).abs();
        let cells = (found[0] - truth[0]).hypot(found[1] - truth[1]);
        let displacement = cells * self.target.frame().resolution();
        Ok(PoseError { displacement, turn: turn.to_radians() })
    }
}

/// Share of a building's length that each of two robots keeps so that 60 % of either is common.
const KEPT: f64 = 1.0 / 1.4;

/// The run with a map of its robot's side of the building only.
fn half(plan: &FloorPlan, robot: RobotId, mut run: RobotRun) -> RobotRun {
    let axis = usize::from(plan.size().y > plan.size().x);
    let length = plan.size()[axis];
    let (frame, world_from_map) = (*run.map.frame(), run.world_from_map);
    let cells = run.map.cells_mut();
    for position in 0..cells.cells().len() {
        let at = (world_from_map * frame.cell_centre(cells.index_of(position)))[axis] / length;
        let kept = match robot {
            TARGET => at <= KEPT,
            _ => at >= 1.0 - KEPT,
        };
        if !kept {
            cells.cells_mut()[position] = Occupancy::UNKNOWN;
        }
    }
    run
}

fn generator(seed: u64, stream: u64) -> ChaCha8Rng {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(0xcb00 + stream);
    rng
}

/// 100 × 100 cells of the same lattice around the middle of what the map knows.
fn square(map: &OccupancyGrid) -> anyhow::Result<OccupancyGrid> {
    let known = map.cells().indexed().filter(|(_, cell)| cell.is_known()).map(|(at, _)| at);
    let (mut low, mut high) = ([usize::MAX; 2], [0; 2]);
    for at in known {
        for (axis, at) in [at.column, at.row].into_iter().enumerate() {
            (low[axis], high[axis]) = (low[axis].min(at), high[axis].max(at));
        }
    }
    anyhow::ensure!(low[0] <= high[0], "a robot that saw nothing");
    let first = |axis: usize| -> anyhow::Result<i64> {
        Ok(i64::try_from((low[axis] + high[axis]).div_ceil(2))? - i64::try_from(SIDE / 2)?)
    };
    let frame: GridFrame = map.frame().shifted(first(0)?, first(1)?);
    let unknown = Occupancy::UNKNOWN;
    let (cells, size) = (map.cells(), (SIDE, SIDE));
    let cells = warp_nearest(cells, map.frame(), &frame, size, &Se2::identity(), unknown)?;
    Ok(OccupancyGrid::new(frame, cells))
}
