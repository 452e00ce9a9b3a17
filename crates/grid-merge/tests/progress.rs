//! How far a merge has come, and its end before the end.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::sync::Mutex;

use grid_merge::{
    FusionError, FusionParams, Interpolation, Mapping, PlacedMap, merge, transform_grid,
};
use ogm_core::{Grid, GridFrame, Occupancy, OccupancyGrid, Progress, Se2};

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

fn room(resolution: f64) -> OccupancyGrid {
    let frame = GridFrame::new(resolution, Se2::new(1.0, 2.0, 0.4)).unwrap();
    let cells =
        (0..60 * 50).map(|at| if at % 7 == 0 { Occupancy::OCCUPIED } else { Occupancy::FREE });
    OccupancyGrid::new(frame, Grid::new(60, 50, cells.collect()).unwrap())
}

fn mappings() -> [FusionParams; 3] {
    let bilinear = Mapping::Inverse(Interpolation::Bilinear);
    [
        FusionParams::default(),
        FusionParams { mapping: bilinear, ..FusionParams::default() },
        FusionParams::paper(),
    ]
}

fn merged(params: &FusionParams, progress: &dyn Progress) -> Result<(), FusionError> {
    let maps = [room(0.1), room(0.05), room(0.1)];
    let placed: Vec<_> = maps
        .iter()
        .zip([0.0, 0.3, -0.2])
        .map(|(map, turn)| PlacedMap::new(map, Se2::new(turn, 1.0, turn)))
        .collect();
    let heard = merge(&placed, params, progress)?;
    assert_eq!(heard, merge(&placed, params, &())?);
    Ok(())
}

fn moved(params: &FusionParams, progress: &dyn Progress) -> Result<(), FusionError> {
    transform_grid(&room(0.1), &Se2::new(0.3, 0.0, 1.0), params, progress).map(|_| ())
}

type Call = fn(&FusionParams, &dyn Progress) -> Result<(), FusionError>;

#[test]
fn shares_rise_to_one() {
    for call in [merged as Call, moved] {
        for params in mappings() {
            let all = listener(f64::INFINITY);
            call(&params, &all).unwrap();
            let heard = all.heard.into_inner().unwrap();
            assert!(heard.is_sorted() && heard[0] >= 0.0 && heard.len() > 50, "{heard:?}");
            assert_eq!(heard.last(), Some(&1.0));
        }
    }
}

#[test]
fn a_merge_ends_where_it_is_cancelled() {
    for call in [merged as Call, moved] {
        for share in [0.0, 0.25, 0.6] {
            let end = call(&FusionParams::default(), &listener(share)).unwrap_err();
            assert!(matches!(end, FusionError::Cancelled(_)), "{share}: {end}");
        }
    }
}
