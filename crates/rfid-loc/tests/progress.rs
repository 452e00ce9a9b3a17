//! How far a log has come, and its end before the end.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::sync::Mutex;

use nalgebra::Point2;
use ogm_core::{Progress, TagReading};
use rfid_loc::{FilterParams, TagError, localise};

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

fn log() -> Vec<TagReading> {
    let at = |step: u32| Point2::new(0.05 * f64::from(step), 0.2);
    let tag = Point2::new(0.7, 0.9);
    let reading = |step: u32| TagReading {
        tag_id: (step % 2).into(),
        robot_position: at(step),
        range: (tag - at(step)).norm(),
    };
    (0..40).map(reading).collect()
}

#[test]
fn shares_rise_to_one_reading_by_reading_and_change_nothing() {
    let all = listener(f64::INFINITY);
    let params = FilterParams::default();
    assert_eq!(localise(&log(), &params, &all), localise(&log(), &params, &()));
    let heard = all.heard.into_inner().unwrap();
    assert!(heard.is_sorted() && heard[0] > 0.0 && heard.len() >= 40, "{heard:?}");
    assert_eq!(heard.last(), Some(&1.0));
}

#[test]
fn a_log_ends_where_it_is_cancelled() {
    for share in [0.0, 0.5, 0.95] {
        let end = localise(&log(), &FilterParams::default(), &listener(share)).unwrap_err();
        assert_eq!(end, TagError::Cancelled(ogm_core::Cancelled), "{share}");
    }
}
