//! How far a walk has come, and its end before the end.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::sync::Mutex;

use carpin_walk::{Budget, Params, RandomWalk, SearchBox, WalkError, align, random_walk};
use ogm_core::{GridFrame, OccupancyGrid, Progress, Se2};

/// Notes what it hears and cancels from a share on.
struct Listener {
    heard: Mutex<Vec<f64>>,
    cancel_from: f64,
}

impl Progress for Listener {
    fn report(&self, share: f64) {
        self.heard.lock().unwrap().push(share);
    }

    fn is_cancelled(&self) -> bool {
        self.heard.lock().unwrap().last().is_some_and(|&share| share >= self.cancel_from)
    }
}

fn listener(cancel_from: f64) -> Listener {
    Listener { heard: Mutex::default(), cancel_from }
}

fn walked(walks: usize, progress: &dyn Progress) -> Result<String, WalkError> {
    let frame = GridFrame::new(0.1, Se2::new(3.0, -1.0, 0.2))?;
    let room = "#########\n#.......#\n#.......#\n#...#####\n#...#????\n#####????";
    let map = OccupancyGrid::from_ascii(frame, room)?;
    // No transform makes these equal, so no walk ends early.
    let other = OccupancyGrid::from_ascii(frame, &room.replace("#...#####", "#..######"))?;
    let params = Params { walks, ..Params::default() };
    let start_target_from_source = Se2::new(0.1, -0.2, 0.02);
    align(&map, &other, start_target_from_source, &RandomWalk::default(), &params, progress)
        .map(|outcome| format!("{outcome:?}"))
}

#[test]
fn shares_end_at_one_and_change_nothing() {
    let all = listener(f64::INFINITY);
    assert_eq!(walked(1, &all), walked(1, &()));
    let heard = all.heard.into_inner().unwrap();
    assert!(heard.is_sorted() && heard[0] >= 0.0 && heard.len() > 100, "{heard:?}");
    assert_eq!(heard.last(), Some(&1.0));
}

#[test]
fn several_walks_are_one_work_and_end_when_cancelled() {
    let all = listener(f64::INFINITY);
    walked(4, &all).unwrap();
    let heard = all.heard.into_inner().unwrap();
    assert!(heard.iter().all(|share| (0.0..=1.0).contains(share)));
    assert_eq!(heard.last(), Some(&1.0));
    for share in [0.0, 0.3, 0.9] {
        let end = walked(4, &listener(share)).unwrap_err();
        assert!(matches!(end, WalkError::Cancelled(_)), "{share}: {end}");
    }
}

#[test]
fn a_walk_without_end_takes_no_memory_for_what_it_does_not_reach() {
    let space = SearchBox { centre: [0.0; 3], reach: [1.0; 3] };
    let budget = Budget { samples: usize::MAX, seed: 1, stream: 0 };
    let rules = RandomWalk::default();
    let progress = listener(f64::MIN_POSITIVE);
    let end = random_walk(|_| 1.0, [0.0; 3], &space, &rules, &budget, &progress).unwrap_err();
    assert!(matches!(end, WalkError::Cancelled(_)), "{end}");
}
