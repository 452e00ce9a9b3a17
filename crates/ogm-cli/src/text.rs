//! Answers for people.

use std::fmt::Write;
use std::path::Path;

use grid_merge::Merged;
use ogm_core::OccupancyGrid;

use crate::answer::{PairAnswer, Verdict};
use crate::pose::Pose;
use crate::terminal::highlight;

/// The answer on a pair of maps, several lines.
pub(crate) fn pair(answer: &PairAnswer) -> String {
    let (target, source) = (&answer.target.file, &answer.source.file);
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = match (answer.verdict, &answer.reason) {
        (Verdict::Merged, _) => {
            writeln!(text, "{}: {source} lies on {target}", highlight("merged", "32"))
        }
        (Verdict::Ambiguous, reason) => {
            let reason = reason.as_deref().unwrap_or_default();
            writeln!(text, "{}", reason.replacen("ambiguous", &highlight("ambiguous", "33"), 1))
        }
        (Verdict::NoMatch, reason) => {
            let reason = reason.as_deref().unwrap_or_default();
            writeln!(text, "{}: {reason}", highlight("no-match", "31"))
        }
    };
    if answer.copies {
        let _ = writeln!(text, "  both files hold the same map, which is laid on itself");
    }
    let Some(best) = answer.hypotheses.first() else {
        return text;
    };
    let _ = writeln!(text, "  target_from_source: {}{}", best.pose, identity(&best.pose));
    if let Some(covariance) = best.covariance {
        let sigma = |axis: usize| covariance[axis][axis].sqrt();
        let (x, y, theta) = (sigma(0), sigma(1), sigma(2).to_degrees());
        let _ =
            writeln!(text, "  standard deviations: x {x:.3} m, y {y:.3} m, theta {theta:.2} deg");
    }
    if let Some(probability) = best.probability {
        let _ = write!(text, "  probability: {probability:.3}");
        let _ = match answer.hypotheses.get(1) {
            Some(next) => {
                let probability = next.probability.unwrap_or_default();
                writeln!(text, "; runner-up {probability:.3} at {}", next.pose)
            }
            None => writeln!(text, "; no runner-up"),
        };
    }
    if let (Some(overlap), Some(agreement)) = (answer.overlap, answer.agreement) {
        let (overlap, agreement) = (100.0 * overlap, 100.0 * agreement);
        let _ = writeln!(text, "  overlap: {overlap:.0} %, walls agree: {agreement:.0} %");
    }
    let _ = writeln!(text, "  method: {}, {} ms", answer.method, answer.elapsed_ms);
    text
}

/// Said of a transform that would be taken for a failure otherwise.
fn identity(pose: &Pose) -> &'static str {
    let is_identity = pose.x_m.abs() < 5e-4 && pose.y_m.abs() < 5e-4 && pose.theta_deg.abs() < 5e-3;
    if is_identity { " (identity)" } else { "" }
}

/// That a map was written.
pub(crate) fn written(yaml: &Path, map: &OccupancyGrid) -> String {
    let origin = Pose::from(map.frame().map_from_grid());
    format!(
        "wrote {}: {} x {} cells of {} m, origin {origin}\n",
        yaml.display(),
        map.width(),
        map.height(),
        map.frame().resolution(),
    )
}

/// How far the maps agree where both know.
pub(crate) fn conflicts(merged: &Merged) -> String {
    let (conflicts, compared) = (merged.conflict_count, merged.compared);
    format!("  {conflicts} of {compared} cells that both maps know are in conflict\n")
}

/// The command that tells ROS where the second map lies.
pub(crate) fn static_transform(pair: &PairAnswer) -> String {
    let Some(target_from_source) = pair.target_from_source else {
        return String::new();
    };
    let Pose { x_m, y_m, .. } = target_from_source.into();
    let yaw = target_from_source.theta() + 0.0;
    format!(
        "ros2 run tf2_ros static_transform_publisher --x {x_m:.6} --y {y_m:.6} --yaw {yaw:.6} \
         --frame-id robot1/map --child-frame-id robot2/map\n"
    )
}
