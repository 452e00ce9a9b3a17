//! The motion of the map as one piece, whatever some of its patches say.

use nalgebra::{Cholesky, Matrix3, Vector3};
use ogm_core::Se2;

use crate::kernel::Kernel;
use crate::motion::Motion;

/// Far more than Gauss-Newton takes from a start among the motions.
const ITERATIONS: usize = 50;

/// How much a motion counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Belief {
    /// By its covariance.
    Full,
    /// The less, the worse it fits: the weights of Cauchy's loss.
    Doubting,
}

/// `straight_from_map` of the map as one piece, from the patch whose own motion fits all best.
/// Drift counts as noise of each patch.
pub(crate) fn rigid_motion(motions: &[Motion], kernel: &Kernel, belief: Belief) -> Se2 {
    let own = motions.iter().map(Motion::straight_from_map);
    let start = own
        .map(|straight_from_map| (cost(motions, kernel, &straight_from_map), straight_from_map))
        .reduce(|best, other| if other.0 < best.0 { other } else { best });
    let Some((_, start_straight_from_map)) = start else { return Se2::identity() };
    let mut straight_from_map = start_straight_from_map;
    let centre = motions.iter().map(|motion| motion.at.coords).sum::<nalgebra::Vector2<f64>>()
        / motions.len() as f64;
    for _ in 0..ITERATIONS {
        let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
        for motion in motions {
            let left = motion.left_by(&straight_from_map);
            let Some(precision) = precision(motion, kernel, &straight_from_map) else { continue };
            let weight = match belief {
                Belief::Full => 1.0,
                Belief::Doubting => 1.0 / (1.0 + left.dot(&(precision * left))),
            };
            let arm = motion.at.coords - centre;
            let slope = Matrix3::new(1.0, 0.0, -arm.y, 0.0, 1.0, arm.x, 0.0, 0.0, 1.0);
            let weighted = slope.transpose() * precision * weight;
            normal += weighted * slope;
            right += weighted * left;
        }
        let Some(factor) = Cholesky::new(normal) else { break };
        let step = factor.solve(&right);
        straight_from_map = straight_from_map * Se2::about(centre.into(), step.z, step.xy());
        if step.amax() < 1e-14 {
            break;
        }
    }
    straight_from_map
}

fn cost(motions: &[Motion], kernel: &Kernel, straight_from_map: &Se2) -> f64 {
    let misfit = |motion: &Motion| {
        let left = motion.left_by(straight_from_map);
        precision(motion, kernel, straight_from_map)
            .map_or(0.0, |precision| left.dot(&(precision * left)).ln_1p())
    };
    motions.iter().map(misfit).sum()
}

fn precision(motion: &Motion, kernel: &Kernel, straight_from_map: &Se2) -> Option<Matrix3<f64>> {
    (kernel.motion(motion.at, motion.at) + motion.noise(straight_from_map)).try_inverse()
}
