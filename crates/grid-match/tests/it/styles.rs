//! One building as different tools save it: what a map says does not depend on how it is painted.

use grid_match::MatchParams;
use ogm_core::{CellIndex, Grid, GridFrame, Occupancy, OccupancyGrid, Se2};
use ogm_sim::MapStyle;

use crate::world::{OFFICE, WORKSHOP, apart, draw, matched};

const LEFT: [f64; 4] = [-0.2, -0.2, 8.8, 9.2];
/// What is painted outside is outside.
const WHOLE: [f64; 4] = [-0.2, -0.2, 12.2, 9.2];
const RIGHT: [f64; 4] = [3.2, -0.2, 12.2, 9.2];

fn target_pose() -> Se2 {
    Se2::new(2.0, 3.0, 0.35)
}

fn source_pose() -> Se2 {
    Se2::new(9.0, 1.0, -2.1)
}

fn recoloured(
    map: &OccupancyGrid,
    ink: impl Fn(CellIndex, Occupancy) -> Occupancy,
) -> OccupancyGrid {
    let cells = map.cells().indexed().map(|(index, &cell)| ink(index, cell)).collect();
    OccupancyGrid::new(*map.frame(), Grid::new(map.width(), map.height(), cells).unwrap())
}

/// A pseudo-random number from 0 to 99 for a cell.
fn lot(index: CellIndex) -> usize {
    (index.column * 7919 + index.row * 104_729 + index.column * index.row * 31) % 100
}

fn black_outside(map: &OccupancyGrid) -> OccupancyGrid {
    recoloured(map, |_, cell| if cell.is_known() { cell } else { Occupancy::OCCUPIED })
}

fn white_outside(map: &OccupancyGrid) -> OccupancyGrid {
    recoloured(map, |_, cell| if cell.is_known() { cell } else { Occupancy::FREE })
}

fn grey(map: &OccupancyGrid) -> OccupancyGrid {
    recoloured(map, |index, cell| match cell.probability() {
        Some(p) => Occupancy::from_probability(p + (lot(index) as f64 - 50.0) / 600.0),
        None => cell,
    })
}

fn salted(map: &OccupancyGrid) -> OccupancyGrid {
    recoloured(map, |index, cell| match lot(index) {
        0 if cell.is_known() => Occupancy::OCCUPIED,
        1 if cell.is_known() => Occupancy::FREE,
        _ => cell,
    })
}

/// Every cell as `times` × `times` cells.
fn finer(map: &OccupancyGrid, times: usize) -> OccupancyGrid {
    let (width, height) = (map.width() * times, map.height() * times);
    let cells = (0..width * height)
        .map(|at| map.cells().row(at / width / times)[at % width / times])
        .collect();
    let frame =
        GridFrame::new(map.frame().resolution() / times as f64, map.frame().map_from_grid());
    OccupancyGrid::new(frame.unwrap(), Grid::new(width, height, cells).unwrap())
}

/// Every style that `map` can be had in, with a name.
fn styles(map: &OccupancyGrid) -> Vec<(String, OccupancyGrid)> {
    let own = [
        ("black outside", black_outside(map)),
        ("white outside", white_outside(map)),
        ("grey levels", grey(map)),
        ("salt and pepper", salted(map)),
        ("cells a half", finer(map, 2)),
        ("cells a fifth", finer(map, 5)),
    ];
    let own = own.into_iter().map(|(name, map)| (name.to_owned(), map));
    let tools =
        MapStyle::ALL[1..].iter().map(|style| (style.name().to_owned(), style.apply(map, 5)));
    own.chain(tools).collect()
}

#[test]
fn the_answer_stays_within_a_cell_in_every_style_and_none_turns_wrong() {
    let truth = target_pose().between(&source_pose());
    let (mut tried, mut refused) = (0, Vec::new());
    for walls in [OFFICE, WORKSHOP] {
        let target = draw(walls, LEFT, 0.05, target_pose());
        let source = draw(walls, WHOLE, 0.05, source_pose());
        assert!(matched(&target, &source).outcome.refusal().is_none(), "as it is");
        for (name, source) in styles(&source) {
            tried += 1;
            let report = matched(&target, &source);
            let found = report.hypotheses[0].pose.target_from_source;
            let (shift, turn) = apart(found, truth, source_pose());
            assert!(shift < 0.05 && turn < 0.01, "{name}: {shift} m, {turn} rad");
            if let Some(refusal) = report.outcome.refusal() {
                refused.push(format!("{name}: {refusal}"));
            }
        }
    }
    assert!(20 * refused.len() <= tried, "of {tried} {refused:?}");
}

#[test]
fn a_map_matches_itself_in_every_style() {
    let map = draw(OFFICE, LEFT, 0.05, target_pose());
    for (name, map) in styles(&map) {
        let report = matched(&map, &map);
        assert!(report.outcome.refusal().is_none(), "{name}: {:?}", report.outcome);
        let found = report.hypotheses[0].pose.target_from_source;
        let (shift, turn) = apart(found, Se2::identity(), target_pose());
        assert!(shift < 0.01 && turn < 0.002, "{name}: {shift} m, {turn} rad");
    }
}

/// Walls of one cell with free space on both sides, and nothing unknown.
#[test]
fn lines_on_white_are_walls() {
    let drawn = |walls, view, pose| MapStyle::HandDrawn.apply(&draw(walls, view, 0.05, pose), 1);
    let source = drawn(OFFICE, RIGHT, source_pose());
    let truth = target_pose().between(&source_pose());
    for view in [LEFT, WHOLE] {
        let target = drawn(OFFICE, view, target_pose());
        let report = matched(&target, &source);
        let found = report.hypotheses[0].pose.target_from_source;
        let (shift, turn) = apart(found, truth, source_pose());
        assert!(shift < 0.05 && turn < 0.01, "{shift} m, {turn} rad");
        let is_found = report.outcome.refusal().is_none();
        assert!(is_found || view == LEFT, "{:?}", report.outcome);
    }
    let target = drawn(OFFICE, WHOLE, target_pose());
    let other = drawn(WORKSHOP, RIGHT, source_pose());
    assert!(matched(&target, &other).outcome.refusal().is_some());
}

/// From a hundredth of a metre a cell to a fifth.
#[test]
fn the_verdict_does_not_depend_on_the_size_of_the_cells() {
    let truth = target_pose().between(&source_pose());
    for cell in [0.0125, 0.025, 0.05, 0.1, 0.2] {
        let target = draw(OFFICE, LEFT, cell, target_pose());
        let source = draw(OFFICE, RIGHT, cell, source_pose());
        let report = matched(&target, &source);
        assert!(report.outcome.refusal().is_none(), "{cell} m: {:?}", report.outcome);
        let found = report.hypotheses[0].pose.target_from_source;
        let (shift, _) = apart(found, truth, source_pose());
        assert!(shift < 0.3 * cell, "{shift} m at cells of {cell} m");
    }
}

/// The right prior is evidence: it rules out places where maps fit by chance.
#[test]
fn a_prior_that_is_right_makes_a_doubtful_match_believed() {
    let target = draw(OFFICE, [-0.2, -0.2, 5.6, 5.0], 0.05, target_pose());
    let source = draw(OFFICE, [3.0, -0.2, 9.6, 5.0], 0.05, source_pose());
    let alone = matched(&target, &source);
    let truth = target_pose().between(&source_pose());
    let prior = grid_match::Prior { target_from_source: truth, sigma_m: 0.3, sigma_rad: 0.05 };
    let params = MatchParams { prior: Some(prior), ..MatchParams::default() };
    let helped = grid_match::match_maps(&target, &source, &params, &()).unwrap();
    let probability = |report: &grid_match::MatchReport| report.hypotheses[0].pose.probability;
    let odds = |p: f64| p / (1.0 - p);
    assert!(odds(probability(&helped)) > 5.0 * odds(probability(&alone)));
}
