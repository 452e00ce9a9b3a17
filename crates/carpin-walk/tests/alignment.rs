//! The search as a user meets it: forward, backward, in other frames, and where it must refuse.

use carpin_walk::{
    Acceptance, Alignment, Annealing, Around, DistanceParams, HillClimbing, Objective, Params,
    RandomWalk, Rules, WalkError, align,
};
use nalgebra::Point2;
use ogm_core::{GridFrame, OccupancyGrid, Outcome, Refusal, Se2};
use ogm_sim::{FloorPlan, PairParams, survey};

const RESOLUTION: f64 = 0.28;

/// Displacement of the floor's centre that an answer may have: a cell, a fifth of the start's.
const TOLERANCE: f64 = RESOLUTION;

/// Plan A as the robots of the paper map it, coarse enough for tests.
fn floor(seed: u64, heading: f64) -> (OccupancyGrid, Se2) {
    let mut robots = PairParams { seed, ..PairParams::cb() };
    robots.mapping.resolution = RESOLUTION;
    let run = survey(&FloorPlan::plan_a(), heading, &robots).expect("plan A can be surveyed");
    (run.map, run.world_from_map)
}

fn pair() -> (OccupancyGrid, OccupancyGrid, Se2) {
    let (target, world_from_target) = floor(1, 0.0);
    let (source, world_from_source) = floor(2, 0.3);
    (target, source, world_from_target.between(&world_from_source))
}

fn turned_by(target_from_source: Se2, cells: f64, degrees: f64) -> Se2 {
    let offset = nalgebra::Vector2::new(0.6, -0.8) * cells * RESOLUTION;
    Se2::about(Point2::new(7.0, 6.0), degrees.to_radians(), offset) * target_from_source
}

fn params() -> Params {
    Params { walks: 2, seed: 3, ..Params::default() }
}

fn found(outcome: Outcome<Alignment>) -> Alignment {
    outcome.found().expect("these maps match")
}

fn error_m(found: Se2, truth: Se2) -> f64 {
    let centre = truth.inverse() * Point2::new(7.0, 6.0);
    (found * centre - truth * centre).norm()
}

#[test]
fn a_rough_start_is_brought_home_forward_and_backward() {
    let (target, source, truth) = pair();
    let start = turned_by(truth, 5.0, 8.0);
    let rules = RandomWalk::default();
    let forward = found(align(&target, &source, start, &rules, &params(), &()).unwrap());
    let error = error_m(forward.target_from_source, truth);
    assert!(error <= TOLERANCE, "{error:.3} m, ψ {} from {}", forward.psi, forward.start_psi);
    let turn = forward.target_from_source.between(&truth).theta().to_degrees();
    assert!(turn.abs() < 1.6, "{turn}");

    let backward = align(&source, &target, start.inverse(), &rules, &params(), &()).unwrap();
    let error = error_m(found(backward).target_from_source.inverse(), truth);
    assert!(error <= TOLERANCE, "{error:.3} m backward");
}

#[test]
fn other_frames_of_the_same_cells_change_nothing_but_the_frame() {
    let (target, source, truth) = pair();
    let start = turned_by(truth, 4.0, -6.0);
    let rules = RandomWalk::default();
    let here = found(align(&target, &source, start, &rules, &params(), &()).unwrap());

    let moved_from_source = Se2::new(31.0, -7.0, 2.2);
    let frame = GridFrame::new(RESOLUTION, moved_from_source * source.frame().map_from_grid());
    let moved = OccupancyGrid::new(frame.unwrap(), source.cells().clone());
    let start_target_from_moved = start * moved_from_source.inverse();
    let there = align(&target, &moved, start_target_from_moved, &rules, &params(), &()).unwrap();
    let there = found(there).target_from_source * moved_from_source;
    assert!(error_m(there, here.target_from_source) < 1e-6);
}

#[test]
fn the_same_seed_gives_the_same_bits_and_more_walks_never_a_worse_answer() {
    let (target, source, truth) = pair();
    let start = turned_by(truth, 6.0, 5.0);
    let walks = |walks| {
        let params = Params { walks, samples: 60, ..params() };
        found(align(&target, &source, start, &RandomWalk::default(), &params, &()).unwrap())
    };
    assert_eq!(walks(3), walks(3));
    let (one, three) = (walks(1), walks(3));
    assert_eq!(one.walks[0], three.walks[0], "a walk does not depend on how many there are");
    assert_eq!(three.psi, three.walks.iter().copied().fold(f64::INFINITY, f64::min));
    assert_eq!(one.trace.len(), one.trace_target_from_source.len());
}

#[cfg(feature = "rayon")]
#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let (target, source, truth) = pair();
    let start = turned_by(truth, 6.0, 5.0);
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let params = Params { walks: 5, samples: 40, ..params() };
        pool.install(|| {
            align(&target, &source, start, &RandomWalk::default(), &params, &()).unwrap()
        })
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn the_special_cases_improve_on_their_start_too() {
    let (target, source, truth) = pair();
    let start = turned_by(truth, 5.0, 8.0);
    let rules: [&(dyn Rules + Sync); 2] = [&HillClimbing::default(), &Annealing::default()];
    for rules in rules {
        let found = found(align(&target, &source, start, rules, &params(), &()).unwrap());
        assert!(found.psi < 0.6 * found.start_psi, "{} from {}", found.psi, found.start_psi);
    }
    let printed = RandomWalk { acceptance: Acceptance::AsPrinted, ..RandomWalk::default() };
    let found = found(align(&target, &source, start, &printed, &params(), &()).unwrap());
    assert!(found.trace.iter().all(|sample| sample.current_psi == sample.best_psi), "descent");
}

fn small(picture: &str) -> OccupancyGrid {
    let frame = GridFrame::new(0.14, Se2::identity()).expect("a frame");
    OccupancyGrid::from_ascii(frame, picture).expect("a picture of a map")
}

#[test]
fn maps_with_nothing_in_common_are_refused() {
    let walk = |a: &str, b: &str| {
        let (a, b) = (small(a), small(b));
        align(&a, &b, Se2::identity(), &RandomWalk::default(), &Params::default(), &()).unwrap()
    };
    for (a, b) in [("??\n??", "??\n??"), ("??\n??", "#.\n##"), ("..\n..", "##\n##"), ("?", "?")] {
        let refusal = walk(a, b);
        let expected = Refusal::TooLittleStructure { have: 0, need: 1 };
        assert_eq!(refusal.refusal(), Some(&expected), "{a} against {b}");
    }
    let cell = found(walk("#", "#"));
    assert_eq!((cell.target_from_source, cell.psi), (Se2::identity(), 0.0), "one cell on itself");
    let missing = found(walk("####\n#..#\n####", "....\n....\n...."));
    assert!(missing.psi >= 20.0, "the obstacles that one map lacks cost their full price");
}

#[test]
fn maps_laid_side_by_side_are_refused_where_only_the_overlap_counts() {
    let room = small("####\n#..#\n####");
    let params = Params {
        distance: DistanceParams {
            objective: Objective::Overlap { min_share: 0.25 },
            ..DistanceParams::default()
        },
        around: Around::Start,
        reach: 0.2,
        samples: 20,
        ..Params::default()
    };
    let start = Se2::new(2.0, 0.0, 0.0);
    let outcome = align(&room, &room, start, &RandomWalk::default(), &params, &()).unwrap();
    assert_eq!(outcome.refusal(), Some(&Refusal::NothingCompared));
}

#[test]
fn what_cannot_be_meant_is_an_error() {
    let room = small("####\n#..#\n####");
    let walk =
        |start, params: &Params| align(&room, &room, start, &RandomWalk::default(), params, &());
    let params = Params::default();
    let far = walk(Se2::new(5.0, 0.0, 0.0), &params);
    assert!(matches!(far, Err(WalkError::StartOutside { .. })), "{far:?}");
    let nan = walk(Se2::new(f64::NAN, 0.0, 0.0), &params);
    assert!(matches!(nan, Err(WalkError::Grid(_))), "{nan:?}");
    for wrong in [
        Params { walks: 0, ..params },
        Params { reach: f64::NAN, ..params },
        Params { turn: -1.0, ..params },
        Params { distance: DistanceParams { padding: -0.1, ..params.distance }, ..params },
    ] {
        let error = walk(Se2::identity(), &wrong);
        assert!(matches!(error, Err(WalkError::Parameter(_))), "{error:?}");
    }
    let coarse = OccupancyGrid::from_ascii(GridFrame::new(0.2, Se2::identity()).unwrap(), "#.");
    let mixed =
        align(&room, &coarse.unwrap(), Se2::identity(), &RandomWalk::default(), &params, &());
    assert!(matches!(mixed, Err(WalkError::Grid(_))));
}
