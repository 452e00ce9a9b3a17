//! How far a search has come, and its end before the end.

use std::sync::Mutex;

use grid_match::{Effort, MatchError, MatchParams, match_maps};
use ogm_core::{Progress, Se2};

use crate::world::{OFFICE, left_part, right_part};

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

/// What is never accepted goes through every tier.
fn searched(accept: f64, progress: &dyn Progress) -> Result<String, MatchError> {
    let target = left_part(OFFICE, Se2::new(1.0, 2.0, 0.3));
    let source = right_part(OFFICE, Se2::new(-1.0, 0.5, -0.4));
    let params = MatchParams { accept, effort: Effort::Thorough, ..MatchParams::default() };
    match_maps(&target, &source, &params, progress).map(|report| format!("{report:?}"))
}

#[test]
fn shares_come_to_one_and_change_nothing() {
    for accept in [0.9, 1.0] {
        let all = listener(f64::INFINITY);
        assert_eq!(searched(accept, &all), searched(accept, &()));
        let heard = all.heard.into_inner().unwrap();
        assert!(heard.iter().all(|share| (0.0..=1.0).contains(share)), "{heard:?}");
        assert!(heard.len() > 50, "{heard:?}");
        assert_eq!(heard.last(), Some(&1.0));
    }
}

#[test]
fn a_search_ends_where_it_is_cancelled() {
    for share in [0.0, 0.3, 0.5, 0.8, 0.95] {
        let end = searched(1.0, &listener(share)).unwrap_err();
        assert!(matches!(end, MatchError::Cancelled(_)), "{share}: {end}");
    }
}
