//! How much wall runs in which direction.

use std::f64::consts::{FRAC_PI_2, PI};

use ogm_core::{Segment, wrap_period};

use crate::vector::is_usable;

/// Metres of wall by direction: `bins` equal parts of [−π/2, π/2), the first from −π/2 up.
///
/// Segments that [`ogm_vector`](crate::ogm_vector) leaves out are left out here too.
#[must_use]
pub fn angle_histogram(segments: &[Segment], bins: usize) -> Vec<f64> {
    let mut metres = vec![0.0; bins];
    for segment in segments.iter().filter(|segment| is_usable(segment)) {
        let share = (wrap_period(segment.direction, PI) + FRAC_PI_2) / PI;
        if let Some(bin) = metres.get_mut(bin_at(share, bins)) {
            *bin += segment.length();
        }
    }
    metres
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "share lies in [0, 1]")]
fn bin_at(share: f64, bins: usize) -> usize {
    ((share * bins as f64) as usize).min(bins.saturating_sub(1))
}
