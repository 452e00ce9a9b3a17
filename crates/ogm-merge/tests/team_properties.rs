//! What the answer about a team does not depend on, and what it adds nothing to.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use nalgebra::Point2;
use ogm_core::{Grid, GridFrame, Occupancy, OccupancyGrid, Se2};
use ogm_merge::{
    Component, FusionParams, FusionRule, RobotMap, TeamParams, TeamReport, fuse, merge_team,
};
use ogm_sim::{FloorKind, labelled_team};

/// Maps of small floors of three kinds, and one of another floor among each.
fn teams() -> impl Iterator<Item = Vec<OccupancyGrid>> {
    drawn([(FloorKind::Flat, 31), (FloorKind::Flat, 32), (FloorKind::Clutter, 33)])
}

/// Teams with a join that barely comes about, so that the least change of a number undoes it.
fn teams_on_the_edge() -> impl Iterator<Item = Vec<OccupancyGrid>> {
    drawn([(FloorKind::Flat, 707), (FloorKind::Clutter, 706), (FloorKind::Hall, 708)])
}

fn drawn(teams: [(FloorKind, u64); 3]) -> impl Iterator<Item = Vec<OccupancyGrid>> {
    teams.into_iter().map(|(kind, seed)| labelled_team(kind, 4, true, seed).unwrap().maps)
}

fn merged(maps: &[OccupancyGrid], params: &TeamParams) -> TeamReport {
    let maps: Vec<RobotMap<'_>> = maps.iter().map(RobotMap::from).collect();
    merge_team(&maps, params, &()).unwrap()
}

fn plain(maps: &[OccupancyGrid]) -> TeamReport {
    merged(maps, &TeamParams::default())
}

/// What a report says about two maps: where one lies in the other, and how surely.
fn said(report: &TeamReport, target: usize, source: usize) -> Option<(Se2, f64)> {
    let together = report
        .components
        .iter()
        .find_map(|component| Some(component.pose(target)?.between(&component.pose(source)?)));
    Some((together?, report.probability(target, source).unwrap()))
}

/// `report`, in which map `m` of `maps` is number `place(m)`, says what `wanted` does: the same maps
/// hang together, as surely, no corner of one further than `metres` from where it lay.
#[track_caller]
fn assert_same(
    wanted: &TeamReport,
    report: &TeamReport,
    maps: &[OccupancyGrid],
    metres: f64,
    place: impl Fn(usize) -> usize,
) {
    let mut together = 0;
    for source in 0..maps.len() {
        for target in (0..maps.len()).filter(|&target| target != source) {
            let found = said(report, place(target), place(source));
            let wanted = said(wanted, target, source);
            assert_eq!(found.is_some(), wanted.is_some(), "{target} and {source}");
            let Some(((found, probability), (wanted, surely))) = found.zip(wanted) else {
                continue;
            };
            together += 1;
            let off = corners(&maps[source]).map(|at| (found * at - wanted * at).norm());
            let off = off.into_iter().fold(0.0, f64::max);
            assert!(off < metres, "{source} in {target} is off by {off} m");
            assert!((probability - surely).abs() < 1e-3, "{probability} instead of {surely}");
        }
    }
    assert!(together > 0, "no two maps hang together, so nothing was compared");
}

fn is_identity(doubled_from_copy: &Se2) -> bool {
    doubled_from_copy.translation().norm() < 1e-9 && doubled_from_copy.theta().abs() < 1e-9
}

fn corners(map: &OccupancyGrid) -> [Point2<f64>; 2] {
    let (low, high) = map.cells().bounds_of(|cell| cell.is_known()).unwrap();
    [low, high].map(|index| map.frame().cell_centre(index))
}

/// The same map on a larger sheet: so many cells of unknown at the left and the bottom, and twice as
/// many at the right and the top.
fn on_a_larger_sheet(map: &OccupancyGrid, more: usize) -> OccupancyGrid {
    let (width, height) = (map.width() + 3 * more, map.height() + 3 * more);
    let mut cells = Grid::filled(width, height, Occupancy::UNKNOWN).unwrap();
    for (row, known) in map.cells().rows().enumerate() {
        let start = (row + more) * width + more;
        cells.cells_mut()[start..start + known.len()].copy_from_slice(known);
    }
    let shift = -(more as f64) * map.frame().resolution();
    let map_from_grid = map.frame().map_from_grid() * Se2::new(shift, shift, 0.0);
    OccupancyGrid::new(GridFrame::new(map.frame().resolution(), map_from_grid).unwrap(), cells)
}

/// Metres of a tenth of the finest cell.
fn tenth_of_a_cell(maps: &[OccupancyGrid]) -> f64 {
    0.1 * maps.iter().map(|map| map.frame().resolution()).fold(f64::INFINITY, f64::min)
}

#[test]
fn the_order_of_the_maps_moves_nothing() {
    for maps in teams().chain(teams_on_the_edge()) {
        let wanted = plain(&maps);
        for order in [[4, 3, 2, 1, 0], [2, 0, 4, 1, 3]] {
            let shuffled: Vec<OccupancyGrid> = order.iter().map(|&map| maps[map].clone()).collect();
            let place = |map: usize| order.iter().position(|&other| other == map).unwrap();
            let params = TeamParams { reference: place(0), ..TeamParams::default() };
            let report = merged(&shuffled, &params);
            assert_same(&wanted, &report, &maps, tenth_of_a_cell(&maps), place);
        }
    }
}

#[test]
fn a_duplicate_adds_no_evidence_and_moves_nothing() {
    for maps in teams() {
        let wanted = plain(&maps);
        for doubled in [1, 3] {
            let mut more = maps.clone();
            more.extend([maps[doubled].clone(), maps[doubled].clone()]);
            let report = plain(&more);
            assert_same(&wanted, &report, &maps, tenth_of_a_cell(&maps), |map| map);
            for copy in maps.len()..more.len() {
                let (doubled_from_copy, probability) = said(&report, doubled, copy).unwrap();
                assert!(is_identity(&doubled_from_copy), "{doubled_from_copy}");
                assert_eq!(probability, 1.0);
            }
        }
    }
}

#[test]
fn a_duplicate_on_a_larger_sheet_is_a_duplicate() {
    for maps in teams() {
        let wanted = plain(&maps);
        for doubled in [0, 2] {
            let mut more = maps.clone();
            more.push(on_a_larger_sheet(&maps[doubled], 7));
            let report = plain(&more);
            assert_same(&wanted, &report, &maps, tenth_of_a_cell(&maps), |map| map);
            let (doubled_from_copy, _) = said(&report, doubled, maps.len()).unwrap();
            assert!(is_identity(&doubled_from_copy), "{doubled_from_copy}");
        }
    }
}

#[test]
fn sheets_of_unknown_say_nothing() {
    for maps in teams() {
        let wanted = plain(&maps);
        let larger: Vec<OccupancyGrid> =
            maps.iter().zip(1..).map(|(map, more)| on_a_larger_sheet(map, 3 * more)).collect();
        assert_same(&wanted, &plain(&larger), &maps, tenth_of_a_cell(&maps), |map| map);

        let mut more = maps.clone();
        let blank = Grid::filled(90, 70, Occupancy::UNKNOWN).unwrap();
        more.insert(1, OccupancyGrid::new(*maps[0].frame(), blank));
        let report = plain(&more);
        assert_same(&wanted, &report, &maps, tenth_of_a_cell(&maps), |map| {
            if map == 0 { 0 } else { map + 1 }
        });
        assert!((0..more.len()).all(|map| map == 1 || said(&report, map, 1).is_none()));
    }
}

#[test]
fn what_no_map_knows_stays_unknown() {
    for maps in teams() {
        let report = plain(&maps);
        let all: Vec<&OccupancyGrid> = maps.iter().collect();
        for fusion in [FusionRule::KeepWalls, FusionRule::LogOdds] {
            let by_size = |found: &&Component| found.members.len();
            let component = report.components.iter().max_by_key(by_size).unwrap();
            assert!(component.members.len() > 1, "nothing was merged");
            let params = FusionParams { fusion, ..FusionParams::default() };
            let map = fuse(&all, component, &params, &()).unwrap().map;
            for (index, cell) in map.cells().indexed() {
                let at = map.frame().cell_centre(index);
                let is_known = component.members.iter().any(|member| {
                    let seen = &maps[member.map];
                    let cell = seen.frame().resolution().max(map.frame().resolution());
                    let at = member.reference_from_map.inverse() * at;
                    // Nearest cell: what a map knows reaches half a cell further.
                    [-0.5, 0.0, 0.5].into_iter().any(|dx| {
                        [-0.5, 0.0, 0.5].into_iter().any(|dy| {
                            seen.at(at + nalgebra::Vector2::new(dx, dy) * cell).is_known()
                        })
                    })
                });
                assert!(is_known || !cell.is_known(), "{at} is known and nobody saw it");
            }
        }
    }
}
