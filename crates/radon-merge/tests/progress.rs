//! How far a search has come, and its end before the end.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::sync::Mutex;

use ogm_core::{Grid, GridFrame, Occupancy, OccupancyGrid, Progress, Se2};
use radon_merge::{RadonError, RadonParams, find_transform};

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

/// A room with two niches, 0.05 m a cell.
fn room() -> OccupancyGrid {
    let frame = GridFrame::new(0.05, Se2::identity()).unwrap();
    let (width, height) = (150, 120);
    let inside = |x: usize, y: usize| {
        let hall = (10..100).contains(&x) && (10..80).contains(&y);
        let niches = (60..140).contains(&x) && (30..55).contains(&y)
            || (25..50).contains(&x) && (60..110).contains(&y);
        hall || niches
    };
    let cells = (0..height).flat_map(|y| {
        (0..width).map(move |x| {
            let near = || (x - 2..=x + 2).flat_map(|x| (y - 2..=y + 2).map(move |y| (x, y)));
            match (inside(x, y), x >= 2 && y >= 2 && near().any(|(x, y)| inside(x, y))) {
                (true, _) => Occupancy::FREE,
                (false, true) => Occupancy::OCCUPIED,
                (false, false) => Occupancy::UNKNOWN,
            }
        })
    });
    OccupancyGrid::new(frame, Grid::new(width, height, cells.collect()).unwrap())
}

fn searched(progress: &dyn Progress) -> Result<String, RadonError> {
    let mut params = RadonParams::default();
    params.segments.max_segments = 100;
    params.hypotheses.max_hypotheses = 2000;
    find_transform(&room(), &room(), &params, progress).map(|found| format!("{:?}", found.outcome))
}

#[test]
fn shares_end_at_one_and_change_nothing() {
    let all = listener(f64::INFINITY);
    assert_eq!(searched(&all), searched(&()));
    let heard = all.heard.into_inner().unwrap();
    assert!(heard.iter().all(|share| (0.0..=1.0).contains(share)), "{heard:?}");
    assert!(heard.len() > 20, "{heard:?}");
    assert_eq!(heard.last(), Some(&1.0));
}

#[test]
fn a_search_ends_where_it_is_cancelled() {
    for share in [0.0, 0.1, 0.4, 0.8] {
        let end = searched(&listener(share)).unwrap_err();
        assert!(matches!(end, RadonError::Cancelled(_)), "{share}: {end}");
    }
}
