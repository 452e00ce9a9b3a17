//! Labelled pairs are what their labels say.

use ogm_core::{ClassThresholds, NearestWall, OccupancyGrid, Se2};
use ogm_sim::{FloorKind, LabelledPair, MapStyle, Relation, bent_pair, labelled_pair};

fn pairs(relation: Relation) -> impl Iterator<Item = (FloorKind, LabelledPair)> {
    FloorKind::ALL.into_iter().flat_map(move |kind| {
        let pair = (0..4).filter_map(move |seed| labelled_pair(kind, relation, seed).ok());
        pair.take(1).map(move |pair| (kind, pair))
    })
}

/// Share of the source walls in the known area of the target that lie within `reach` metres of a
/// target wall.
fn walls_agree(pair: &LabelledPair, target_from_source: &Se2, reach: f64) -> f64 {
    let thresholds = ClassThresholds::default();
    let target_walls = pair.target.occupied_points(&thresholds);
    let is_known = |map: &OccupancyGrid, point| thresholds.is_free(map.at(point));
    let (mut near, mut compared) = (0.0, 0.0);
    for wall in pair.source.occupied_points(&thresholds).iter().step_by(31) {
        let place = *target_from_source * *wall;
        let is_near = target_walls.iter().any(|other| (other - place).norm() < reach);
        if is_near || is_known(&pair.target, place) {
            compared += 1.0;
            near += f64::from(u8::from(is_near));
        }
    }
    near / compared
}

#[test]
fn walls_of_a_pair_lie_on_each_other_under_the_truth() {
    let mut kinds = 0;
    let plain = FloorKind::ALL.into_iter().filter_map(|kind| {
        let drawn =
            (0..60).filter_map(|seed| labelled_pair(kind, Relation::Overlapping, seed).ok());
        let is_plain = |pair: &LabelledPair| pair.styles == [MapStyle::Plain; 2];
        drawn.into_iter().find(is_plain).map(|pair| (kind, pair))
    });
    for (kind, pair) in plain {
        let truth = pair.truth.unwrap();
        assert!((0.15..=1.0).contains(&truth.overlap), "{}", truth.overlap);
        let resolution = pair.target.frame().resolution().max(pair.source.frame().resolution());
        // A wall seen from both sides is 0.12 m thick.
        let reach = 0.12 + resolution + 2.0 * truth.residual;
        let agreement = walls_agree(&pair, &truth.target_from_source, reach);
        let share = if pair.exact { 0.9 } else { 0.7 };
        assert!(agreement > share, "{}: {agreement} within {reach} m", kind.name());
        kinds += 1;
    }
    assert_eq!(kinds, FloorKind::ALL.len());
}

/// How far off the target's walls the source's lie where the truth puts them, nine in ten of those
/// that are not far from all, metres; pairs of one bend together.
fn walls_off(bend: f64) -> f64 {
    let kinds = FloorKind::ALL.into_iter().filter(|kind| !kind.repeats());
    let drawn = kinds.flat_map(|kind| (0..4).map(move |seed| bent_pair(kind, [0.0, bend], seed)));
    let thresholds = ClassThresholds::default();
    let mut off = Vec::new();
    for pair in drawn.flatten().filter(|pair| pair.styles == [MapStyle::Plain; 2]) {
        let target = NearestWall::new(&pair.target, &thresholds);
        let (Some(in_target), Some(target)) = (pair.bend, target) else { continue };
        let walls = pair.source.occupied_points(&thresholds);
        let places = walls.iter().step_by(7).filter_map(|wall| in_target.in_target(*wall));
        off.extend(places.map(|place| (target.nearest_to(place) - place).norm()));
    }
    off.retain(|off| *off < 0.6);
    off.sort_by(f64::total_cmp);
    assert!(off.len() > 500, "{} walls", off.len());
    off[off.len() * 9 / 10]
}

#[test]
fn the_truth_of_a_bent_map_is_as_good_as_that_of_a_straight_one() {
    let (straight, bent) = (walls_off(0.0), walls_off(0.5));
    assert!(bent < straight + 0.02, "{bent} m off where {straight} are off without a bend");
}

#[test]
fn displacement_is_zero_at_the_truth_and_grows_with_the_error() {
    let pair = labelled_pair(FloorKind::Offices, Relation::Overlapping, 1).unwrap();
    let truth = pair.truth.unwrap();
    assert!(truth.displacement(&truth.target_from_source) < 1e-9);
    let off = Se2::new(0.3, 0.4, 0.0) * truth.target_from_source;
    assert!((truth.displacement(&off) - 0.5).abs() < 1e-9);
    let turned =
        truth.target_from_source * Se2::about(truth.shared_centre, 0.1, nalgebra::Vector2::zeros());
    assert!((truth.turn(&turned) - 0.1).abs() < 1e-9);
    assert!((truth.displacement(&turned) - 0.1 * truth.shared_radius).abs() < 1e-3);
}

#[test]
fn there_are_pairs_to_refuse_of_most_kinds_of_floor() {
    let all = FloorKind::ALL.len();
    for (relation, least) in
        [(Relation::Apart, 5), (Relation::Unrelated, all), (Relation::Strangers, all)]
    {
        let found: Vec<_> = pairs(relation).collect();
        assert!(found.len() >= least, "{} kinds {relation:?}", found.len());
        assert!(found.iter().all(|(_, pair)| pair.truth.is_none()), "{relation:?}");
    }
}

#[test]
fn a_seed_is_a_pair() {
    let draw = |seed| labelled_pair(FloorKind::Flat, Relation::Overlapping, seed);
    assert_eq!(draw(2), draw(2));
    assert_ne!(draw(2), draw(3));
}
