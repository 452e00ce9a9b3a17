//! Radio tags on the walls, and what a robot reads of them.

use nalgebra::{Point2, Vector2};
use ogm_core::{RobotId, TagReading};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

use crate::draw::{Stream, generator};
use crate::navigate::FreeSpace;
use crate::plan::{Face, TARGET};
use crate::{FloorPlan, SimError, TagParams};

/// A tag hangs where a robot of this radius can stand in front of it, metres.
const ROBOT_RADIUS: f64 = 0.25;
/// Distance between two tags that is tried first, metres.
const SPACING: f64 = 1.5;
/// Tags never hang closer together than this, metres.
const LEAST_SPACING: f64 = 0.15;
/// Places tried before the spacing is relaxed.
const TRIALS: usize = 200;

/// Places `params.count` tags on walls that a robot can reach, numbered from 0; plan frame.
///
/// # Errors
/// A plan without enough reachable wall.
pub(crate) fn place_tags(
    plan: &FloorPlan,
    params: &TagParams,
    seed: u64,
) -> Result<Vec<(u32, Point2<f64>)>, SimError> {
    let mut rng = generator(seed, Stream::TagPlaces, 0);
    let (frame, solid) = plan.raster(0.05)?;
    let start = plan.route(TARGET).and_then(|route| route.first());
    let room = start.and_then(|&start| FreeSpace::around(&solid, &frame, ROBOT_RADIUS, start));
    let faces: Vec<Face> = plan.wall_faces().collect();
    let mut tags: Vec<(u32, Point2<f64>)> = Vec::with_capacity(params.count.min(1024));
    let mut spacing = SPACING;
    while tags.len() < params.count {
        let place =
            (0..TRIALS).filter_map(|_| on_a_face(&faces, &mut rng)).find(|(tag, outward)| {
                let apart = tags.iter().all(|(_, other)| (other - tag).norm() >= spacing);
                let in_front = tag + outward * (ROBOT_RADIUS + 0.1);
                apart && room.as_ref().is_some_and(|room| room.reaches(in_front))
            });
        match (place, u32::try_from(tags.len())) {
            (Some((tag, _)), Ok(id)) => tags.push((id, tag)),
            _ if spacing > LEAST_SPACING => spacing = (spacing / 2.0).max(LEAST_SPACING),
            _ => {
                return Err(SimError::NoPlaceForTags { placed: tags.len(), wanted: params.count });
            }
        }
    }
    Ok(tags)
}

/// A point drawn evenly from all faces, and the direction away from its wall.
fn on_a_face(faces: &[Face], rng: &mut ChaCha8Rng) -> Option<(Point2<f64>, Vector2<f64>)> {
    let total: f64 = faces.iter().map(Face::length).sum();
    let mut at = total * rng.random::<f64>();
    for face in faces {
        if at < face.length() {
            let along = (face.end - face.start).normalize();
            return Some((face.start + along * at, face.outward()));
        }
        at -= face.length();
    }
    None
}

/// What a robot reads of `tags` along `path`, all in one frame: at every point of the path, each
/// tag within reach, through walls too (an ideal omnidirectional antenna, as Tsardoulias et al.
/// assume).
///
/// A tag is in reach by its true distance. Gating on the measured one would bias ranges near the
/// limit.
///
/// # Errors
/// Parameters out of range.
pub fn tag_readings(
    path: &[Point2<f64>],
    tags: &[(u32, Point2<f64>)],
    params: &TagParams,
    seed: u64,
) -> Result<Vec<TagReading>, SimError> {
    read_along(path, path, tags, params, seed, TARGET)
}

/// Readings taken at `path` by a robot that believes itself at `believed`.
pub(crate) fn read_along(
    path: &[Point2<f64>],
    believed: &[Point2<f64>],
    tags: &[(u32, Point2<f64>)],
    params: &TagParams,
    seed: u64,
    robot: RobotId,
) -> Result<Vec<TagReading>, SimError> {
    params.check()?;
    let mut offsets = generator(seed, Stream::TagOffsets, robot.0.into());
    let displaced: Vec<(u32, Point2<f64>)> = tags
        .iter()
        .map(|&(id, tag)| {
            let offset = Vector2::from_fn(|_, _| offsets.sample::<f64, _>(StandardNormal));
            (id, tag + offset * params.tag_position_sigma)
        })
        .collect();
    let mut rng = generator(seed, Stream::TagRanges, robot.0.into());
    let mut echoes = generator(seed, Stream::TagEchoes, robot.0.into());
    let mut readings = Vec::new();
    for (position, &robot_position) in path.iter().zip(believed) {
        for &(tag_id, tag) in &displaced {
            let distance = (tag - position).norm();
            if distance <= params.max_range && distance + params.range_bias <= params.max_range {
                let noise = params.range_sigma * within_four_sigma(&mut rng);
                // Drawn whether or not they count, so that one share does not move the other.
                let [lost, reflected, detour] = [0; 3].map(|_| echoes.random::<f64>());
                if lost < params.lost_share {
                    continue;
                }
                let is_echo = reflected < params.echo_share;
                let detour = if is_echo { detour * params.echo_length } else { 0.0 };
                readings.push(TagReading {
                    tag_id: tag_id.into(),
                    robot_position,
                    range: (distance + params.range_bias + detour + noise).max(0.0),
                });
            }
        }
    }
    Ok(readings)
}

fn within_four_sigma(rng: &mut ChaCha8Rng) -> f64 {
    loop {
        let value: f64 = rng.sample(StandardNormal);
        if value.abs() <= 4.0 {
            return value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{place_tags, tag_readings};
    use crate::{FloorPlan, SimError, TagParams};
    use nalgebra::Point2;

    fn straight(count: u32) -> Vec<Point2<f64>> {
        (0..count).map(|i| Point2::new(0.03 * f64::from(i), 0.0)).collect()
    }

    #[test]
    fn tags_hang_on_walls_apart_from_each_other() {
        let plan = FloorPlan::plan_a();
        let tags = place_tags(&plan, &TagParams::default(), 3).unwrap();
        assert_eq!(tags.len(), 16);
        for (id, tag) in &tags {
            let on_wall = plan.wall_faces().map(|face| face.distance(*tag)).fold(1.0, f64::min);
            assert!(on_wall < 1e-9, "tag {id} is {on_wall} m off a wall");
            let others = tags.iter().filter(|(other, _)| other != id);
            assert!(others.into_iter().all(|(_, other)| (other - tag).norm() > 0.7));
        }
        assert_eq!(tags, place_tags(&plan, &TagParams::default(), 3).unwrap());
        assert_ne!(tags, place_tags(&plan, &TagParams::default(), 4).unwrap());
    }

    #[test]
    fn too_many_tags_are_an_error_and_not_a_loop() {
        let params = TagParams { count: 5_000, ..TagParams::default() };
        let placed = place_tags(&FloorPlan::plan_a(), &params, 0);
        assert!(matches!(placed, Err(SimError::NoPlaceForTags { wanted: 5_000, .. })));
    }

    #[test]
    fn ranges_are_gaussian_about_the_truth_up_to_the_limit() {
        let tag = Point2::new(30.0, 1.0);
        let path = straight(2000);
        let params = TagParams::default();
        let (mut sum, mut squares, mut count) = (0.0, 0.0, 0.0_f64);
        for seed in 0..20 {
            for reading in tag_readings(&path, &[(7, tag)], &params, seed).unwrap() {
                let truth = (reading.robot_position - tag).norm();
                assert!(reading.tag_id == 7.into() && truth <= 3.0 && reading.range <= 3.2);
                let error = reading.range - truth;
                sum += error;
                squares += error * error;
                count += 1.0;
            }
        }
        let in_reach = path.iter().filter(|p| (*p - tag).norm() <= 3.0).count();
        assert_eq!(count, 20.0 * in_reach as f64, "every point within reach is read");
        let (mean, sigma) = (sum / count, f64::sqrt(squares / count));
        assert!(mean.abs() < 5.0 * 0.05 / count.sqrt(), "mean {mean}");
        assert!((sigma - 0.05).abs() < 0.002, "sigma {sigma}");
    }

    #[test]
    fn bias_and_offset_shift_what_is_read() {
        let tags = [(0, Point2::new(1.0, 1.0))];
        let exact = TagParams { range_sigma: 0.0, ..TagParams::default() };
        let read = |params| tag_readings(&straight(60), &tags, &params, 1).unwrap();
        let biased = read(TagParams { range_bias: 0.2, ..exact });
        for (biased, exact) in biased.iter().zip(read(exact)) {
            assert!((biased.range - exact.range - 0.2).abs() < 1e-12);
        }
        let displaced = read(TagParams { tag_position_sigma: 0.1, ..exact });
        assert_ne!(displaced, read(exact));

        let echoes = read(TagParams { echo_share: 0.3, ..exact });
        let longer: Vec<f64> =
            echoes.iter().zip(read(exact)).map(|(echo, exact)| echo.range - exact.range).collect();
        assert!(longer.iter().all(|added| (0.0..1.5).contains(added)));
        let count = longer.iter().filter(|&&added| added > 0.0).count();
        assert!((10..30).contains(&count), "{count} of {} are echoes", longer.len());
        let kept = read(TagParams { lost_share: 0.5, ..exact });
        assert!((20..40).contains(&kept.len()) && kept.iter().all(|one| read(exact).contains(one)));

        let nan = TagParams { range_sigma: f64::NAN, ..exact };
        assert!(tag_readings(&straight(2), &tags, &nan, 1).is_err());
    }
}
