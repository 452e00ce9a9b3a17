//! Synthetic pairs of any size: an estate of many different floors, mapped twice.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use anyhow::Context;
use nalgebra::{Point2, Vector2};
use ogm_core::{Grid, GridFrame, Occupancy, OccupancyGrid, Se2};
use ogm_io::WriteOptions;
use ogm_sim::{FloorPlan, LidarParams, MappingParams, PairParams, survey};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use serde_json::json;

use crate::report;

/// Columns and rows of the maps: the size in Tsardoulias et al., section 5.1, and two larger ones.
const SIZES: [(usize, usize); 3] = [(700, 600), (2000, 2000), (4000, 4000)];
/// Metres a cell.
const RESOLUTION: f64 = 0.05;
/// From the corner of one floor to that of the next, metres: room for the largest and an alley.
const PITCH: f64 = 18.0;
/// Heading of the source's frame, radians: far from the directions of the walls.
const HEADING: f64 = 0.6;
/// From the middle of the target to that of the source, as shares of the target's sides.
const SHIFT: [f64; 2] = [0.15, 0.1];

/// Writes, for each size, a pair that matches and one of two estates, each into a folder of its own
/// below `folder`; gives these.
///
/// # Errors
/// A file that cannot be written.
pub(crate) fn write_pairs(folder: &Path) -> anyhow::Result<Vec<PathBuf>> {
    let mut written = Vec::new();
    let mut of_target = Estate::new(1, 1);
    let mut of_sources = [("match", Estate::new(1, 2)), ("refuse", Estate::new(2, 2))];
    for size in SIZES {
        let target = of_target.map(Se2::identity(), size)?;
        for (kind, of_source) in &mut of_sources {
            let target_from_source = frame_of_source(size);
            let source = of_source.map(target_from_source, size)?;
            let truth = (of_source.number == of_target.number).then_some(target_from_source);
            let pair = folder.join(format!("{kind}-{}x{}", size.0, size.1));
            write_pair(&pair, &target, &source, truth)?;
            written.push(pair);
        }
    }
    Ok(written)
}

fn write_pair(
    folder: &Path,
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    target_from_source: Option<Se2>,
) -> anyhow::Result<()> {
    std::fs::create_dir_all(folder)
        .with_context(|| format!("cannot create {}", folder.display()))?;
    let options = WriteOptions { overwrite: true, ..WriteOptions::default() };
    ogm_io::write_map(&folder.join("a.yaml"), target, &options)?;
    ogm_io::write_map(&folder.join("b.yaml"), source, &options)?;
    let truth = json!({
        "match": target_from_source.is_some(),
        "dx": target_from_source.map(|truth| truth.x()),
        "dy": target_from_source.map(|truth| truth.y()),
        "theta_deg": target_from_source.map(|truth| truth.theta().to_degrees()),
    });
    report::write_file(&folder.join("truth.json"), format!("{truth:#}\n").as_bytes())
}

/// The pose of the source's frame in the estate, whose frame is the target's.
fn frame_of_source(size: (usize, usize)) -> Se2 {
    let sides = Vector2::new(size.0 as f64, size.1 as f64) * RESOLUTION;
    let middle = Point2::from(sides / 2.0 + sides.component_mul(&Vector2::from(SHIFT)));
    let turned = Se2::new(0.0, 0.0, HEADING) * Point2::from(sides / 2.0);
    Se2::new(middle.x - turned.x, middle.y - turned.y, HEADING)
}

/// Floors without end on a lattice of blocks, no two alike.
struct Estate {
    /// Which plans.
    number: u64,
    /// Seed of the sensors.
    noise: u64,
    /// The surveys made so far, each in the frame of its plan.
    floors: BTreeMap<[i64; 2], OccupancyGrid>,
}

impl Estate {
    fn new(number: u64, noise: u64) -> Self {
        Self { number, noise, floors: BTreeMap::new() }
    }

    /// What a map of `size` cells shows whose frame lies at `estate_from_map`.
    fn map(&mut self, estate_from_map: Se2, size: (usize, usize)) -> anyhow::Result<OccupancyGrid> {
        let blocks = GridFrame::new(PITCH, Se2::identity())?;
        let frame = GridFrame::new(RESOLUTION, Se2::identity())?;
        let mut cells = Grid::filled(size.0, size.1, Occupancy::UNKNOWN)?;
        let points: Vec<Point2<f64>> = (0..size.0 * size.1)
            .map(|position| estate_from_map * frame.cell_centre(cells.index_of(position)))
            .collect();
        let mut seen: Vec<[i64; 2]> = points.iter().map(|&p| blocks.lattice_cell(p)).collect();
        seen.dedup();
        self.survey(&seen.into_iter().collect())?;
        for (cell, point) in cells.cells_mut().iter_mut().zip(points) {
            let place = blocks.lattice_cell(point);
            if let Some(floor) = self.floors.get(&place) {
                let [x, y] = place.map(|block| block as f64 * PITCH);
                *cell = floor.at(Point2::new(point.x - x, point.y - y));
            }
        }
        Ok(OccupancyGrid::new(frame, cells))
    }

    /// Surveys the floors at these places that are not known yet.
    fn survey(&mut self, places: &BTreeSet<[i64; 2]>) -> anyhow::Result<()> {
        let missing: Vec<[i64; 2]> =
            places.iter().filter(|place| !self.floors.contains_key(*place)).copied().collect();
        let surveyed: Vec<([i64; 2], OccupancyGrid)> = missing
            .into_par_iter()
            .map(|place| Ok((place, self.floor(place)?)))
            .collect::<anyhow::Result<_>>()?;
        self.floors.extend(surveyed);
        Ok(())
    }

    fn floor(&self, [x, y]: [i64; 2]) -> anyhow::Result<OccupancyGrid> {
        // Blocks left of and below the origin count as well.
        let [column, row] = [u64::try_from(x + 500)?, u64::try_from(y + 500)?];
        let plan = FloorPlan::random(self.number * 1_000_000 + column * 1000 + row)?;
        let mapping = MappingParams { resolution: RESOLUTION, ..MappingParams::default() };
        let lidar = LidarParams { beams: 541, ..LidarParams::rf() };
        let robots = PairParams { seed: self.noise, mapping, lidar, ..PairParams::default() };
        Ok(survey(&plan, 0.0, &robots)?.map)
    }
}

#[cfg(test)]
mod tests {
    use super::{Estate, RESOLUTION, frame_of_source};
    use ogm_core::{ClassThresholds, NearestCells, Se2};

    /// 400 × 300 cells hold parts of two floors.
    const SIZE: (usize, usize) = (400, 300);

    #[test]
    fn walls_of_one_estate_lie_on_each_other_and_those_of_two_do_not() {
        let thresholds = ClassThresholds::default();
        let target_from_source = frame_of_source(SIZE);
        let target = Estate::new(1, 1).map(Se2::identity(), SIZE).unwrap();
        let nearest = NearestCells::new(&target.occupied_mask(&thresholds)).unwrap();
        let share_on_walls = |number| {
            let source = Estate::new(number, 2).map(target_from_source, SIZE).unwrap();
            let walls = source.occupied_points(&thresholds);
            let images = walls.iter().map(|&wall| target_from_source * wall);
            let known = images.filter_map(|image| {
                let at = target.cell_at(image).filter(|_| target.at(image).is_known())?;
                let wall = target.frame().cell_centre(nearest.nearest(at)?);
                Some((wall - image).norm() < 2.0 * RESOLUTION)
            });
            let known: Vec<bool> = known.collect();
            assert!(known.len() > 500, "{} walls to compare", known.len());
            known.iter().filter(|&&on_wall| on_wall).count() as f64 / known.len() as f64
        };
        assert!(share_on_walls(1) > 0.95);
        assert!(share_on_walls(2) < 0.5);
    }
}
