//! How two maps are bent against each other.

use nalgebra::{Rotation2, Vector2};
use ogm_core::{Se2, wrap_angle};

use crate::prepare::PreparedMap;
use crate::relax::MovedPatch;
use crate::report::{Bend, PatchMotion};

/// Fewest patches that say anything about a stretch.
const LEAST_PATCHES: usize = 4;
/// Least metres over which patches must lie to say anything about a stretch.
const LEAST_LENGTH_M: f64 = 6.0;

/// Motions of the patches of `source` on `target`, where they were `moved` to, beside the pose of
/// the whole map.
pub(crate) fn bend(
    target: &PreparedMap,
    source: &PreparedMap,
    target_local_from_source_local: &Se2,
    moved: &[MovedPatch],
) -> Bend {
    let pose = target_local_from_source_local;
    let patches: Vec<PatchMotion> = moved
        .iter()
        .filter(|patch| patch.hit_m >= 0.5 * patch.wall_m)
        .map(|patch| {
            let shift = patch.on_from_map * patch.centre - *pose * patch.centre;
            PatchMotion {
                at: source.map_from_local * patch.centre,
                shift: target.map_from_local * shift,
                turn: wrap_angle(patch.on_from_map.theta() - pose.theta()),
                hit_m: patch.hit_m,
            }
        })
        .collect();
    let weight: f64 = patches.iter().map(|patch| patch.hit_m).sum();
    let squares = patches.iter().map(|patch| patch.hit_m * patch.shift.norm_squared());
    let rms_m = (squares.sum::<f64>() / weight.max(1e-9)).sqrt();
    let target_from_source = target.map_from_local * *pose * source.map_from_local.inverse();
    let stretch = stretch(&patches, target_from_source.theta());
    Bend { rms_m, stretch, patches }
}

impl Bend {
    /// The same motions as parts of the target on the source.
    pub(crate) fn inverse(&self, target_from_source: &Se2) -> Self {
        let source_from_target = target_from_source.inverse();
        let inverse = |patch: &PatchMotion| PatchMotion {
            at: *target_from_source * patch.at + patch.shift,
            shift: -(source_from_target * patch.shift),
            turn: -patch.turn,
            hit_m: patch.hit_m,
        };
        let patches: Vec<PatchMotion> = self.patches.iter().map(inverse).collect();
        let stretch = stretch(&patches, source_from_target.theta());
        Self { rms_m: self.rms_m, stretch, patches }
    }
}

/// Slope of the shifts over the place along each axis of the source, by weighted least squares.
fn stretch(patches: &[PatchMotion], turn: f64) -> Vector2<f64> {
    let weight: f64 = patches.iter().map(|patch| patch.hit_m).sum();
    if patches.len() < LEAST_PATCHES || weight <= 0.0 {
        return Vector2::zeros();
    }
    let source_from_target = Rotation2::new(-turn);
    let shift = |patch: &PatchMotion| source_from_target * patch.shift;
    let mean = |value: &dyn Fn(&PatchMotion) -> Vector2<f64>| -> Vector2<f64> {
        patches.iter().map(|patch| value(patch) * patch.hit_m).sum::<Vector2<f64>>() / weight
    };
    let (middle, common) = (mean(&|patch| patch.at.coords), mean(&shift));
    let along = |axis: usize| {
        let place = |patch: &PatchMotion| patch.at[axis] - middle[axis];
        let spread: f64 =
            patches.iter().map(|patch| patch.hit_m * place(patch).powi(2)).sum::<f64>() / weight;
        let product: f64 = patches
            .iter()
            .map(|patch| patch.hit_m * place(patch) * (shift(patch)[axis] - common[axis]))
            .sum::<f64>()
            / weight;
        if spread.sqrt() * 2.0 < LEAST_LENGTH_M { 0.0 } else { product / spread }
    };
    Vector2::new(along(0), along(1))
}
