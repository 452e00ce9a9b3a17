//! Three robots in plan B whose maps lie to each other exactly as the paper prints.

use nalgebra::Point2;
use ogm_core::{GridFrame, Occupancy, OccupancyGrid, Se2, warp_nearest};
use ogm_sim::{FloorPlan, PairParams, SOURCE, TARGET, map_along_path};

/// Metres a cell; the paper prints none.
pub(crate) const CELL: f64 = 0.05;

/// Cells a side of every map (Saeedi et al., section II.A).
const SIDE: usize = 400;

/// What the paper prints for one of the other maps: cells and degrees.
pub(crate) struct Printed {
    pub(crate) name: &'static str,
    pub(crate) approximate: [f64; 2],
    pub(crate) tuned: [f64; 2],
    pub(crate) degrees: f64,
    pub(crate) index: f64,
}

/// Map 2, then map 3 (section III).
pub(crate) const PRINTED: [Printed; 2] = [
    Printed {
        name: "map 2 to map 1",
        approximate: [43.0, -13.0],
        tuned: [40.0, -16.0],
        degrees: 19.8,
        index: 97.0,
    },
    Printed {
        name: "map 3 to map 1",
        approximate: [-74.0, 23.0],
        tuned: [-67.0, 32.0],
        degrees: 192.8,
        index: 98.0,
    },
];

impl Printed {
    /// The pose at `cells` with the printed angle.
    pub(crate) fn target_from_source(&self, cells: [f64; 2]) -> Se2 {
        Se2::new(cells[0] * CELL, cells[1] * CELL, self.degrees.to_radians())
    }
}

/// The three maps, each with the origin of its frame at the middle of its cells.
pub(crate) fn team(seed: u64) -> anyhow::Result<[OccupancyGrid; 3]> {
    let plan = FloorPlan::plan_b();
    let params = PairParams { seed, ..PairParams::sa() };
    let (first, second) = (plan.path(TARGET, params.step)?, plan.path(SOURCE, params.step)?);
    // The third robot drives the later part of the first one's way, backwards.
    let third: Vec<Point2<f64>> = first[first.len() / 3..].iter().rev().copied().collect();
    let middle = plan.size() / 2.0;
    let world_from_first = Se2::new(middle.x, middle.y, 0.0);
    let [world_from_second, world_from_third] =
        PRINTED.map(|printed| world_from_first * printed.target_from_source(printed.tuned));
    let map = |path: &[Point2<f64>], world_from_map: Se2, robot, seed| {
        let params = PairParams { seed, ..params };
        let run = map_along_path(&plan, path, &[], world_from_map, robot, &params)?;
        square(&run.map)
    };
    Ok([
        map(&first, world_from_first, TARGET, seed)?,
        map(&second, world_from_second, SOURCE, seed)?,
        map(&third, world_from_third, SOURCE, seed.wrapping_add(1))?,
    ])
}

/// The map in a square of cells around its origin.
fn square(map: &OccupancyGrid) -> anyhow::Result<OccupancyGrid> {
    let corner = -(SIDE as f64) / 2.0 * CELL;
    let frame = GridFrame::new(CELL, Se2::new(corner, corner, 0.0))?;
    let size = (SIDE, SIDE);
    let unknown = Occupancy::UNKNOWN;
    let here_from_map = Se2::identity();
    let cells = warp_nearest(map.cells(), map.frame(), &frame, size, &here_from_map, unknown)?;
    Ok(OccupancyGrid::new(frame, cells))
}
