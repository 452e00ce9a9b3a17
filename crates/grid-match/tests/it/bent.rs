//! Maps that drift has bent.

use grid_match::{PreparedMap, score_pose};
use ogm_core::{ClassThresholds, Se2};

use crate::world::{OFFICE, WORKSHOP, Wall, draw};

const VIEW: [f64; 4] = [-0.2, -0.2, 12.2, 9.2];

/// The office with its right half moved up by 0.25 m.
fn bent() -> Vec<Wall> {
    let lift = |x: f64| if x > 6.0 { 0.25 } else { 0.0 };
    OFFICE.iter().map(|&[x0, y0, x1, y1]| [x0, y0 + lift(x0), x1, y1 + lift(x1)]).collect()
}

fn prepared(walls: &[Wall]) -> PreparedMap {
    PreparedMap::new(&draw(walls, VIEW, 0.05, Se2::identity()), &ClassThresholds::default(), &())
        .unwrap()
}

#[test]
fn a_bent_map_fits_once_its_parts_give_way() {
    let evidence = score_pose(&prepared(OFFICE), &prepared(&bent()), &Se2::identity()).unwrap();
    let relaxed = evidence.relaxed;
    let wall = evidence.hit_m + evidence.near_miss_m + evidence.conflict_m;
    assert!(evidence.hit_m < 0.9 * wall, "{evidence:?}");
    assert!(relaxed.hit_m > 0.98 * wall, "{evidence:?}");
    assert!((0.03..0.25).contains(&relaxed.moved_m), "{evidence:?}");
}

#[test]
fn giving_way_does_not_turn_one_building_into_another() {
    let evidence = score_pose(&prepared(OFFICE), &prepared(WORKSHOP), &Se2::identity()).unwrap();
    let relaxed = evidence.relaxed;
    assert!(relaxed.near_miss_m + relaxed.conflict_m > 8.0, "{evidence:?}");
}
