//! The tags that a pair of real maps is given, as its robots localise them.

use nalgebra::Point2;
use ogm_core::{ClassThresholds, OccupancyGrid, Refusal, TagEstimate};
use ogm_sim::{DriveParams, TagParams, drive, tag_readings};
use rfid_loc::{FilterParams, localise};

use crate::cases::map_pair::MapPair;

/// Tags are placed where both robots come this near, metres: a tag that nobody passes is none.
const PASSING: f64 = 2.0;

/// Tags placed on each pair, as many as in the simulated worlds.
const TAGS: usize = 16;

/// The tags as each robot localises them on its own drive, target first.
///
/// The inner refusal is that of a map with nowhere to drive. Maps that do not match get the same
/// tags at unrelated walls: they must be refused for their walls, not for a lack of tags.
pub(super) fn localised_tags(
    pair: &MapPair,
    seed: u64,
) -> anyhow::Result<Result<[Vec<TagEstimate>; 2], Refusal>> {
    let (target_drive, source_drive) =
        match (path_through(&pair.target, seed)?, path_through(&pair.source, seed)?) {
            (Ok(target), Ok(source)) => (target, source),
            (Err(refusal), _) | (_, Err(refusal)) => return Ok(Err(refusal)),
        };
    let [in_target, in_source] = match &pair.truth {
        Some(truth) => {
            let mut walls = pair.walls_in_both(truth);
            walls.retain(|&wall| {
                passes(&source_drive, wall)
                    && passes(&target_drive, truth.target_from_source * wall)
            });
            let in_source = spread_out(&walls, TAGS, seed);
            let in_target = in_source.iter().map(|&tag| truth.target_from_source * tag).collect();
            [in_target, in_source]
        }
        None => {
            let walls = |map: &OccupancyGrid, drive: &[Point2<f64>]| {
                let mut walls = map.occupied_points(&ClassThresholds::default());
                walls.retain(|&wall| passes(drive, wall));
                spread_out(&walls, TAGS, seed)
            };
            [walls(&pair.target, &target_drive), walls(&pair.source, &source_drive)]
        }
    };
    Ok(Ok([localised(&target_drive, in_target, seed)?, localised(&source_drive, in_source, seed)?]))
}

/// A drive through what the map knows as free.
fn path_through(
    map: &OccupancyGrid,
    seed: u64,
) -> anyhow::Result<Result<Vec<Point2<f64>>, Refusal>> {
    let params = DriveParams { seed, length: drive_length(map), ..DriveParams::default() };
    Ok(drive(map, &params)?.into_result())
}

/// Whether a drive comes near enough to a place for a tag there to be read at length.
fn passes(drive: &[Point2<f64>], place: Point2<f64>) -> bool {
    drive.iter().step_by(10).any(|point| (point - place).norm() <= PASSING)
}

fn localised(
    drive: &[Point2<f64>],
    places: Vec<Point2<f64>>,
    seed: u64,
) -> anyhow::Result<Vec<TagEstimate>> {
    let tags: Vec<_> = (0..).zip(places).collect();
    let readings = tag_readings(drive, &tags, &TagParams::default(), seed)?;
    Ok(localise(&readings, &FilterParams::default(), &())?)
}

/// Two metres of drive for each free square metre, so that most places are passed more than once,
/// whatever the size of the map.
fn drive_length(map: &OccupancyGrid) -> f64 {
    let thresholds = ClassThresholds::default();
    let free = map.cells().cells().iter().filter(|&&cell| thresholds.is_free(cell)).count();
    let area = free as f64 * map.frame().resolution().powi(2);
    (2.0 * area).clamp(100.0, 1000.0)
}

/// `count` of `points`, each as far as possible from those before it; the first is the one at
/// `start` modulo their number.
fn spread_out(points: &[Point2<f64>], count: usize, start: u64) -> Vec<Point2<f64>> {
    let mut chosen = Vec::new();
    let mut distance_sq = vec![f64::INFINITY; points.len()];
    let mut next = usize::try_from(start).unwrap_or(0).checked_rem(points.len());
    while let Some(index) = next.filter(|_| chosen.len() < count) {
        let point = points[index];
        chosen.push(point);
        let mut farthest = None;
        for (i, (d, p)) in distance_sq.iter_mut().zip(points).enumerate() {
            *d = d.min((p - point).norm_squared());
            if *d > 0.0 && farthest.is_none_or(|(_, best)| *d > best) {
                farthest = Some((i, *d));
            }
        }
        next = farthest.map(|(i, _)| i);
    }
    chosen
}
