//! Answers for people.

use std::fmt::Write;
use std::path::Path;

use grid_merge::Merged;
use ogm_core::{OccupancyGrid, Outcome, Refusal, Se2};
use ogm_merge::TeamReport;

use crate::answer::PairAnswer;
use crate::args::MergeArgs;
use crate::merged::{Conflict, MergeAnswer};
use crate::named::frame_of;
use crate::terminal::highlight;

/// Standing for "merged", "ambiguous" and "no-match".
const GREEN: &str = "32";
const YELLOW: &str = "33";
const RED: &str = "31";

/// The answer on a pair of maps, several lines.
pub(crate) fn pair(answer: &PairAnswer) -> String {
    let report = &answer.report;
    let (target, source) = (&answer.target.file, &answer.source.file);
    let verdict = report.verdict().name();
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = match &report.outcome {
        Outcome::Found(_) => {
            writeln!(text, "{}: {source} lies on {target}", highlight(verdict, GREEN))
        }
        Outcome::Refused(refusal) if refusal.is_ambiguous() => {
            writeln!(text, "{}: {}", highlight(verdict, YELLOW), refusal.detail())
        }
        Outcome::Refused(refusal) => writeln!(text, "{}: {refusal}", highlight(verdict, RED)),
    };
    if let Outcome::Refused(Refusal::Unlikely { probability, .. }) = &report.outcome {
        // Rounded down, so that it is accepted.
        let enough = (100.0 * probability).floor() / 100.0;
        if enough > 0.0 {
            let _ = writeln!(text, "  to accept it all the same: --accept {enough:.2}");
        }
    }
    for warning in &report.warnings {
        let _ = writeln!(text, "  {}: {warning}", highlight("warning", YELLOW));
    }
    let Some(best) = report.hypotheses.first() else {
        return text;
    };
    let pose = best.target_from_source;
    let _ = writeln!(text, "  target_from_source: {pose}{}", identity(&pose));
    if let Some(covariance) = best.covariance {
        let sigma = |axis: usize| covariance[(axis, axis)].sqrt();
        let (x, y, theta) = (sigma(0), sigma(1), sigma(2).to_degrees());
        let _ =
            writeln!(text, "  standard deviations: x {x:.3} m, y {y:.3} m, theta {theta:.2} deg");
    }
    if let Some(probability) = best.probability {
        let _ = write!(text, "  probability: {probability:.3}");
        let runner_up = report.hypotheses.get(1);
        let _ = match runner_up.and_then(|next| Some((next, next.probability?))) {
            Some((next, probability)) => {
                writeln!(text, "; runner-up {probability:.3} at {}", next.target_from_source)
            }
            None => writeln!(text, "; no runner-up"),
        };
    }
    if let (Some(overlap), Some(agreement)) = (report.overlap, report.agreement) {
        let (overlap, agreement) = (100.0 * overlap, 100.0 * agreement);
        let _ = writeln!(text, "  overlap: {overlap:.0} %, walls agree: {agreement:.0} %");
    }
    let _ = writeln!(text, "  method: {}, {} ms", report.method.name(), answer.elapsed_ms);
    text
}

/// Said of a transform that would be taken for a failure otherwise.
fn identity(target_from_source: &Se2) -> &'static str {
    let pose = target_from_source;
    let is_identity =
        pose.x().abs() < 5e-4 && pose.y().abs() < 5e-4 && pose.theta().to_degrees().abs() < 5e-3;
    if is_identity { " (identity)" } else { "" }
}

/// How many maps hang together, of how many.
pub(crate) fn team_verdict(report: &TeamReport, maps: usize) -> String {
    let (together, apart) = (report.components[0].members.len(), report.components.len() - 1);
    if apart == 0 {
        format!("{}: all {maps} maps hang together\n", highlight("merged", GREEN))
    } else {
        let (verdict, colour) =
            if together > 1 { ("partly merged", YELLOW) } else { ("no-match", RED) };
        let verdict = highlight(verdict, colour);
        format!("{verdict}: {together} of {maps} maps hang together with the reference\n")
    }
}

/// That a map was written.
pub(crate) fn written(yaml: &Path, map: &OccupancyGrid) -> String {
    let origin = map.frame().map_from_grid();
    format!(
        "wrote {}: {} x {} cells of {} m, origin {origin}\n",
        yaml.display(),
        map.width(),
        map.height(),
        map.frame().resolution(),
    )
}

/// What was done by a merge.
pub(crate) fn merge(answer: &MergeAnswer, merged: Option<&Merged>, args: &MergeArgs) -> String {
    let mut said = String::new();
    let (Some(merged), Some(output)) = (merged, &answer.output) else {
        return said;
    };
    said += &written(&args.output, &merged.map);
    let Some([first, others @ ..]) = answer.components.first().map(|all| &all.members[..]) else {
        return said;
    };
    if others.is_empty() {
        said += &format!("  it is {} alone\n", answer.maps[0].file);
        return said;
    }
    said += &conflicts(merged, &output.conflicts, answer);
    let first_from_reference = first.reference_from_map.inverse();
    let frame = |map| frame_of(map, &args.frames);
    for other in others {
        let first_from_other = first_from_reference * other.reference_from_map;
        said += &static_transform(&first_from_other, [&frame(first.map), &frame(other.map)]);
    }
    said
}

/// How far the maps agree where several know, and the largest place where they do not.
fn conflicts(merged: &Merged, conflicts: &[Conflict], answer: &MergeAnswer) -> String {
    let (cells, compared) = (merged.conflict_count, merged.compared);
    let Some(largest) = conflicts.first() else {
        return format!("  no conflicts in {compared} cells that several maps know\n");
    };
    let files = |maps: &[usize]| {
        maps.iter().map(|&map| answer.maps[map].file.as_str()).collect::<Vec<_>>().join(", ")
    };
    let [width, height] = largest.size_m;
    format!(
        "  conflicts: {cells} of {compared} cells that several maps know, in {} places; the largest, \
         {width:.2} x {height:.2} m at ({:.2}, {:.2}), is occupied in {} and free in {}\n",
        merged.region_count,
        largest.x_m,
        largest.y_m,
        files(&largest.occupied),
        files(&largest.free),
    )
}

/// How a map was turned along its walls.
pub(crate) fn turned(straight_from_map: &Se2) -> String {
    let degrees = straight_from_map.theta().to_degrees() + 0.0;
    format!("  turned by {degrees:.2} deg about the origin of its frame\n")
}

/// The command that tells ROS where the second map lies.
fn static_transform(target_from_source: &Se2, [parent, child]: [&str; 2]) -> String {
    // Adding zero turns -0.0 into 0.0.
    let [x, y] = [target_from_source.x(), target_from_source.y()].map(|metres| metres + 0.0);
    let yaw = target_from_source.theta() + 0.0;
    format!(
        "ros2 run tf2_ros static_transform_publisher --x {x:.6} --y {y:.6} --yaw {yaw:.6} \
         --frame-id {parent} --child-frame-id {child}\n"
    )
}
