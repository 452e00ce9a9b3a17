//! Nothing that can be passed in makes the simulator panic or leave free space.

use nalgebra::Point2;
use ogm_core::{ClassThresholds, Grid, GridFrame, Occupancy, OccupancyGrid, Outcome, Se2};
use ogm_sim::{DriveParams, FloorPlan, PairParams, SOURCE, TARGET, drive, map_along_path};
use proptest::prelude::{Strategy, any, prop, prop_assert, proptest};

fn line() -> impl Strategy<Value = String> {
    let word =
        prop::sample::select(vec!["size", "wall", "door", "box", "route", "target", "#", "x"]);
    let number = -3.0_f64..20.0;
    let numbers = prop::collection::vec(number, 0..7);
    (word, prop::option::of(prop::sample::select(vec!["target", "source"])), numbers).prop_map(
        |(word, robot, numbers)| {
            let numbers: Vec<String> = numbers.iter().map(|x| format!("{x:.1}")).collect();
            format!("{word} {} {}", robot.unwrap_or_default(), numbers.join(" "))
        },
    )
}

proptest! {
    #[test]
    fn any_text_is_a_plan_or_an_error(lines in prop::collection::vec(line(), 0..12)) {
        let text = format!("size 6 6\nroute target 1 1 2 2\nroute source 2 2 3 1\n{}", lines.join("\n"));
        if let Ok(plan) = FloorPlan::parse(&text) {
            for robot in [TARGET, SOURCE] {
                prop_assert!(plan.route(robot).is_some_and(|route| route.len() >= 2));
                if let Ok(path) = plan.path(robot, 0.1) {
                    prop_assert!(path.iter().all(|&p| !plan.is_solid(p)));
                }
            }
        }
    }

    #[test]
    fn a_drive_through_any_map_stays_in_its_free_cells(
        seed in any::<u64>(), density in 0.0_f64..0.1, clearance in 0.01_f64..1.0,
        noise in prop::collection::vec(0.0_f64..1.0, 40 * 30),
    ) {
        let cells = noise.iter().map(|&u| if u < density { Occupancy::OCCUPIED } else { Occupancy::FREE });
        let frame = GridFrame::new(0.1, Se2::new(-1.0, 4.0, 2.0)).unwrap();
        let map = OccupancyGrid::new(frame, Grid::new(40, 30, cells.collect()).unwrap());
        let params = DriveParams { seed, clearance, length: 10.0, ..DriveParams::default() };
        if let Outcome::Found(path) = drive(&map, &params).unwrap() {
            let thresholds = ClassThresholds::default();
            prop_assert!(path.len() > 300);
            prop_assert!(path.iter().all(|&p| thresholds.is_free(map.at(p))));
        }
    }
}

#[test]
fn paths_that_are_none_are_errors() {
    let plan = FloorPlan::plan_a();
    let send = |path: &[Point2<f64>], world_from_map| {
        map_along_path(&plan, path, &[], world_from_map, TARGET, &PairParams::default())
    };
    assert!(send(&[], Se2::identity()).is_err());
    assert!(send(&[Point2::new(f64::NAN, 1.0)], Se2::identity()).is_err());
    assert!(send(&[Point2::new(f64::INFINITY, 1.0)], Se2::identity()).is_err());
    assert!(send(&[Point2::new(1e12, 1.0)], Se2::new(0.0, 0.0, f64::NAN)).is_err());
    assert!(send(&[Point2::new(2.0, 3.0), Point2::new(1e12, 1.0)], Se2::identity()).is_err());
}
