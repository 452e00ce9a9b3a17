//! What each stage saw, in numbers; the rest of it is for those who hold the report itself.

use grid_match::MatchReport;
use radon_merge::RadonMatch;
use serde::Serialize;

use crate::{CarpinReport, PoseDegrees, Stages, TagEvidence};

/// What did not run is absent.
#[derive(Serialize)]
pub(super) struct StagesJson {
    #[serde(skip_serializing_if = "Option::is_none")]
    tags: Option<TagsJson>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    walks: Vec<WalkJson>,
    #[serde(skip_serializing_if = "Option::is_none")]
    radon: Option<RadonJson>,
    #[serde(rename = "match", skip_serializing_if = "Option::is_none")]
    matching: Option<MatchJson>,
}

impl From<&Stages> for StagesJson {
    fn from(stages: &Stages) -> Self {
        Self {
            tags: stages.tags.as_ref().map(TagsJson::from),
            walks: stages.walks.iter().map(WalkJson::from).collect(),
            radon: stages.radon.as_ref().map(RadonJson::from),
            matching: stages.matching.as_ref().map(MatchJson::from),
        }
    }
}

#[derive(Serialize)]
struct TagsJson {
    common_tags: usize,
    tag_fit_residual_m: Option<f64>,
    tag_residual_m: Option<f64>,
    rotation_by_tags_deg: Option<f64>,
    /// Straight walls of the target, then of the source.
    wall_segments: Option<[usize; 2]>,
    wall_direction_deg: Option<[f64; 2]>,
    quarter_turns: Option<u8>,
    quadrant_residual_deg: Option<f64>,
    unrefined_target_from_source: Option<PoseDegrees>,
    start_target_from_source: Option<PoseDegrees>,
    refinement_iterations: Option<usize>,
    refinement_rmse_m: Option<f64>,
    wall_agreement: Option<f64>,
}

impl From<&TagEvidence> for TagsJson {
    fn from(seen: &TagEvidence) -> Self {
        let walls = seen.walls.as_ref();
        Self {
            common_tags: seen.common_tags.len(),
            tag_fit_residual_m: seen.tag_fit_residual,
            tag_residual_m: seen.tag_residual,
            rotation_by_tags_deg: seen.tag_rotation.map(|tags| tags.angle.to_degrees()),
            wall_segments: walls
                .map(|walls| walls.each_ref().map(|map| map.extraction.segments.len())),
            wall_direction_deg: walls
                .map(|walls| walls.each_ref().map(|map| map.vector.direction.to_degrees())),
            quarter_turns: seen.quadrant.map(|quadrant| quadrant.kappa),
            quadrant_residual_deg: seen.quadrant.map(|quadrant| quadrant.residual.to_degrees()),
            unrefined_target_from_source: seen.unrefined_target_from_source.map(Into::into),
            start_target_from_source: seen.start_target_from_source.map(Into::into),
            refinement_iterations: seen.refinement.map(|refinement| refinement.iterations),
            refinement_rmse_m: seen.refinement.map(|refinement| refinement.rmse),
            wall_agreement: seen.wall_agreement.and_then(|walls| walls.share()),
        }
    }
}

#[derive(Serialize)]
struct WalkJson {
    resolution_m: f64,
    start_target_from_source: PoseDegrees,
    end_target_from_source: Option<PoseDegrees>,
    /// Picture distance at the end, cells.
    psi: Option<f64>,
    evaluations: Option<usize>,
}

impl From<&CarpinReport> for WalkJson {
    fn from(walk: &CarpinReport) -> Self {
        let found = walk.outcome.clone().found();
        Self {
            resolution_m: walk.resolution,
            start_target_from_source: walk.start_target_from_source.into(),
            end_target_from_source: found.as_ref().map(|found| found.target_from_source.into()),
            psi: found.as_ref().map(|found| found.psi),
            evaluations: found.as_ref().map(|found| found.evaluations),
        }
    }
}

#[derive(Serialize)]
struct RadonJson {
    /// Distinctive segments of the target, then of the source.
    segments: Option<[usize; 2]>,
    compared: usize,
    hypotheses: usize,
    candidates: usize,
    verified: usize,
}

impl From<&RadonMatch> for RadonJson {
    fn from(found: &RadonMatch) -> Self {
        Self {
            segments: found.maps.as_ref().map(|maps| maps.each_ref().map(|map| map.segments.len())),
            compared: found.compared,
            hypotheses: found.hypotheses,
            candidates: found.candidates.len(),
            verified: found.candidates.iter().filter(|candidate| candidate.verified).count(),
        }
    }
}

#[derive(Serialize)]
struct MatchJson {
    work: u64,
    exhausted: bool,
    /// Of the best pose, metres of wall that fits, nearly fits, and contradicts.
    hit_m: Option<f64>,
    near_miss_m: Option<f64>,
    conflict_m: Option<f64>,
    /// Unit vector in target axes along which the walls hold it badly.
    weak_direction: Option<[f64; 2]>,
    /// Root mean square by which its parts lie elsewhere than its pose says, metres.
    bend_rms_m: Option<f64>,
    bend: Vec<PatchJson>,
}

/// A part of the source, about the size of a room.
#[derive(Serialize)]
struct PatchJson {
    /// In the source map.
    at_m: [f64; 2],
    /// In target axes.
    shift_m: [f64; 2],
    turn_deg: f64,
}

impl From<&MatchReport> for MatchJson {
    fn from(found: &MatchReport) -> Self {
        let best = found.hypotheses.first();
        let metres = |of: fn(&grid_match::Evidence) -> f64| best.map(|best| of(&best.evidence));
        Self {
            work: found.work,
            exhausted: found.exhausted,
            hit_m: metres(|evidence| evidence.hit_m),
            near_miss_m: metres(|evidence| evidence.near_miss_m),
            conflict_m: metres(|evidence| evidence.conflict_m),
            weak_direction: best
                .and_then(|best| best.weak_direction)
                .map(|weak| [weak.direction.x, weak.direction.y]),
            bend_rms_m: best.map(|best| best.bend.rms_m),
            bend: best
                .iter()
                .flat_map(|best| &best.bend.patches)
                .map(|patch| PatchJson {
                    at_m: [patch.at.x, patch.at.y],
                    shift_m: [patch.shift.x, patch.shift.y],
                    turn_deg: patch.turn.to_degrees(),
                })
                .collect(),
        }
    }
}
