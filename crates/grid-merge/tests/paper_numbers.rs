//! The numbers behind section 4.4 of Tsardoulias, Thallas, Petrou: *Metric Map Merging using RFID
//! Tags & Topological Information*.

use grid_merge::{
    ForwardRounding, FusionParams, GapTreatment, Mapping, PlacedMap, merge, transform_grid,
};
use nalgebra::{Point2, Vector2};
use ogm_core::{CellIndex, ClassThresholds, Grid, GridFrame, Occupancy, OccupancyGrid, Se2};

fn unit_map(
    width: usize,
    height: usize,
    cell: impl Fn(usize, usize) -> Occupancy,
) -> OccupancyGrid {
    let indices = (0..height).flat_map(|row| (0..width).map(move |column| (column, row)));
    let cells = indices.map(|(column, row)| cell(column, row)).collect();
    let frame = GridFrame::new(1.0, Se2::identity()).expect("a valid frame");
    OccupancyGrid::new(frame, Grid::new(width, height, cells).expect("a valid grid"))
}

fn forward(rounding: ForwardRounding, gaps: GapTreatment) -> FusionParams {
    FusionParams { mapping: Mapping::Forward { rounding, gaps }, ..FusionParams::default() }
}

fn is_known(map: &OccupancyGrid, column: i64, row: i64) -> bool {
    usize::try_from(column)
        .ok()
        .zip(usize::try_from(row).ok())
        .and_then(|(column, row)| map.cells().get(CellIndex { column, row }))
        .is_some_and(|cell| cell.is_known())
}

fn known_count(map: &OccupancyGrid) -> usize {
    map.cells().cells().iter().filter(|cell| cell.is_known()).count()
}

/// The paper's example: 30° about (200, 200), which lands on `centre_image`.
fn paper_motion(centre_image: f64) -> Se2 {
    let centre = Point2::new(200.0, 200.0);
    let shift = Vector2::repeat(centre_image - 200.0);
    Se2::about(centre, 30_f64.to_radians(), shift)
}

#[test]
fn t_f1_the_25_points_land_as_printed() {
    let target_from_source = paper_motion(300.0);
    for (x, expected) in [
        (98.0, [262.665_409, 160.665_409]),
        (100.0, [263.397_460, 163.397_460]),
        (102.0, [264.129_511, 166.129_511]),
    ] {
        let landed = target_from_source * Point2::new(x, x);
        assert!((landed - Point2::from(expected)).norm() < 1e-6, "{x}: {landed}");
    }

    let points = unit_map(103, 103, |column, row| {
        if column >= 98 && row >= 98 { Occupancy::OCCUPIED } else { Occupancy::UNKNOWN }
    });
    let printed = forward(ForwardRounding::FloorOfInteger, GapTreatment::None);
    let floor = transform_grid(&points, &target_from_source, &printed, &()).unwrap();
    assert_eq!((known_count(&floor), gap_count(&floor)), (23, 2));

    // Whole numbers as cell centres, and floor(x + ½), are rounding to the nearest whole number.
    let frame = GridFrame::new(1.0, Se2::new(-0.5, -0.5, 0.0)).unwrap();
    let points = OccupancyGrid::new(frame, points.cells().clone());
    let centre = forward(ForwardRounding::Centre, GapTreatment::None);
    let nearest = transform_grid(&points, &paper_motion(300.5), &centre, &()).unwrap();
    assert_eq!((known_count(&nearest), gap_count(&nearest)), (22, 2));
}

/// Unknown cells with at least three of four neighbours known.
fn gap_count(map: &OccupancyGrid) -> usize {
    let neighbours = |index: CellIndex| {
        let (column, row) = (index.column.cast_signed() as i64, index.row.cast_signed() as i64);
        [(1, 0), (-1, 0), (0, 1), (0, -1)]
            .into_iter()
            .filter(|(dx, dy)| is_known(map, column + dx, row + dy))
            .count()
    };
    let cells = map.cells().indexed();
    cells.filter(|&(index, cell)| !cell.is_known() && neighbours(index) >= 3).count()
}

#[test]
fn printed_rounding_pulls_a_map_by_half_a_cell_and_the_default_does_not() {
    let block = unit_map(120, 90, |_, _| Occupancy::OCCUPIED);
    let target_from_source = Se2::new(0.31, 0.77, 0.5);
    let truth = target_from_source * Point2::new(60.0, 45.0);
    let centroid_error = |rounding| {
        let params = forward(rounding, GapTreatment::None);
        let moved = transform_grid(&block, &target_from_source, &params, &()).unwrap();
        let points = moved.occupied_points(&ClassThresholds::default());
        let sum: Vector2<f64> = points.iter().map(|point| point.coords).sum();
        sum / points.len() as f64 - truth.coords
    };
    // The lower-left corners fall into the cells of their own images, half a diagonal short.
    let half_a_diagonal = target_from_source * Vector2::new(0.5, 0.5);
    let printed = centroid_error(ForwardRounding::FloorOfInteger);
    assert!((printed + half_a_diagonal).norm() < 0.1, "{printed}");
    let centre = centroid_error(ForwardRounding::Centre);
    assert!(centre.norm() < 0.1, "{centre}");
}

#[test]
fn t_f2_the_gap_share_of_forward_mapping_is_that_of_the_formula() {
    let field = unit_map(300, 300, |_, _| Occupancy::FREE);
    let params = forward(ForwardRounding::Centre, GapTreatment::None);
    for (degrees, expected) in [(10.0_f64, 0.0251), (30.0, 0.1340), (45.0, 0.1716)] {
        let angle = degrees.to_radians();
        let formula = (angle.cos().abs() + angle.sin().abs() - 1.0).powi(2);
        assert!((formula - expected).abs() < 5e-5);

        let target_from_source = Se2::new(0.3, 0.7, angle);
        let scattered = transform_grid(&field, &target_from_source, &params, &()).unwrap();
        let inverse = FusionParams::default();
        let footprint = transform_grid(&field, &target_from_source, &inverse, &()).unwrap();
        let is_gap = |index: CellIndex| {
            let (column, row) = (index.column.cast_signed() as i64, index.row.cast_signed() as i64);
            is_known(&footprint, column, row) && !is_known(&scattered, column, row)
        };
        let all_gaps = footprint.cells().indexed().map(|(index, _)| index);
        let gaps: Vec<_> = all_gaps.filter(|&index| is_gap(index)).collect();
        let share = gaps.len() as f64 / known_count(&footprint) as f64;
        assert!((share / expected - 1.0).abs() < 0.05, "{degrees}°: {share:.4}");

        let pairs = gaps.iter().filter(|&&index| {
            let right = CellIndex { column: index.column + 1, ..index };
            let above = CellIndex { row: index.row + 1, ..index };
            gap_is_inside(&footprint, index) && (is_gap(right) || is_gap(above))
        });
        assert_eq!(pairs.count(), 0, "{degrees}°: gaps must be single cells");
    }
}

/// Whether all cells up to two away are in the footprint.
fn gap_is_inside(footprint: &OccupancyGrid, index: CellIndex) -> bool {
    let (column, row) = (index.column.cast_signed() as i64, index.row.cast_signed() as i64);
    (-2..=2).all(|dy| (-2..=2).all(|dx| is_known(footprint, column + dx, row + dy)))
}

/// Shares inside the footprint of the rotated field, and occupied cells anywhere.
#[derive(Debug)]
struct Counts {
    unknown_share: f64,
    occupied: usize,
    free_share: f64,
    known_outside: usize,
}

fn count(map: &OccupancyGrid, footprint: &OccupancyGrid) -> Counts {
    let thresholds = ClassThresholds::default();
    let (mut inside, mut unknown, mut occupied, mut free, mut known_outside) = (0, 0, 0, 0, 0);
    for (&cell, of_footprint) in map.cells().cells().iter().zip(footprint.cells().cells()) {
        occupied += usize::from(thresholds.is_occupied(cell));
        if of_footprint.is_known() {
            inside += 1;
            unknown += usize::from(!cell.is_known());
            free += usize::from(thresholds.is_free(cell));
        } else {
            known_outside += usize::from(cell.is_known());
        }
    }
    Counts {
        unknown_share: unknown as f64 / inside as f64,
        occupied,
        free_share: free as f64 / inside as f64,
        known_outside,
    }
}

#[test]
fn t_f3_gap_treatments_of_a_rotated_field_with_a_wall() {
    let field = unit_map(200, 200, |column, row| {
        let wall = (98..102).contains(&row) && (2..198).contains(&column);
        if wall { Occupancy::OCCUPIED } else { Occupancy::FREE }
    });
    let centre = Point2::new(100.0, 100.0);
    let target_from_source = Se2::about(centre, 30_f64.to_radians(), Vector2::new(0.3, 0.7));
    let moved =
        |params: &FusionParams| transform_grid(&field, &target_from_source, params, &()).unwrap();
    let inverse = moved(&FusionParams::default());
    let treated = |gaps| moved(&forward(ForwardRounding::Centre, gaps));

    // One map that lies on the output's lattice is copied, so a merge of it is one more blur.
    let mut blurred = treated(GapTreatment::BlurEverywhere);
    let once = count(&blurred, &inverse);
    let again = forward(ForwardRounding::Centre, GapTreatment::BlurEverywhere);
    for _ in 1..6 {
        let placed = PlacedMap::new(&blurred, Se2::identity());
        blurred = merge(&[placed], &again, &()).unwrap().map;
    }
    let forward_only = count(&treated(GapTreatment::None), &inverse);
    let filled = count(&treated(GapTreatment::HoleFill), &inverse);
    assert_eq!(filled.known_outside, forward_only.known_outside, "nothing is filled outside");
    let cases = [
        ("forward", forward_only, 0.133, 682.0, 0.849),
        ("printed", count(&treated(GapTreatment::PrintedCondition), &inverse), 0.133, 682.0, 0.844),
        ("blur", once, 0.002, 564.0, 0.974),
        ("blur x 6", count(&blurred, &inverse), 0.003, 0.0, 0.968),
        ("hole fill", filled, 0.0014, 755.0, 0.979),
        ("inverse", count(&inverse, &inverse), 0.0, 784.0, 0.980),
    ];
    for (name, counts, unknown_share, occupied, free_share) in cases {
        let within_5_percent =
            |value: f64, expected: f64| (value - expected).abs() <= 0.05 * expected;
        // Shares of a few cells in a thousand depend on what falls on the rim of the field.
        let unknown_fits = (counts.unknown_share - unknown_share).abs() <= 0.004
            || within_5_percent(counts.unknown_share, unknown_share);
        assert!(unknown_fits, "{name}: {counts:?}");
        assert!(within_5_percent(counts.occupied as f64, occupied), "{name}: {counts:?}");
        assert!(within_5_percent(counts.free_share, free_share), "{name}: {counts:?}");
    }
}
