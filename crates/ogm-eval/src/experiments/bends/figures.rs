//! A pair before and after, and how far each place was moved.

use anyhow::Context;
use ogm_core::Se2;
use ogm_merge::{BendParams, unbend};
use ogm_sim::{FloorKind, bent_pair};
use ogm_view::{Named, motion_sheet, overlay_sheet, png, side_by_side};

use crate::report::{Figure, Image};

/// Of the seeds that served to develop the method: both maps see all of the floor.
const SEED: u64 = 722;
/// Standard deviation of its bend an axis, metres.
const BEND_M: f64 = 0.25;
/// Metres between the places whose motions are drawn.
const EVERY_M: f64 = 1.5;

pub(super) fn draw() -> anyhow::Result<Vec<Figure>> {
    let pair = bent_pair(FloorKind::Offices, [0.0, BEND_M], SEED)?;
    let pose = pair.truth.context("a pair that overlaps")?.target_from_source;
    let report = unbend(&pair.target, &pair.source, &pose, &BendParams::default(), &())?;
    let straight = report.straightened(&pair.source, &())?;
    let named = |source| {
        [
            Named { map: &pair.target, first_from_map: Se2::identity(), name: "target" },
            Named { map: source, first_from_map: pose, name: "source" },
        ]
    };
    let motions = report.motions(&pair.source, EVERY_M);
    let motions: Vec<_> =
        motions.into_iter().map(|(place, motion)| (pose * place, pose * motion)).collect();
    let before = overlay_sheet(&named(&pair.source))?;
    let after = overlay_sheet(&named(&straight))?;
    let field = motion_sheet(&named(&straight), &motions)?;
    let picture = png(&side_by_side(&[before, after, field], 12))?;
    Ok(vec![Figure {
        name: "bend".to_owned(),
        caption: format!(
            "Offices of seed {SEED}, the source bent by {BEND_M} m: as the true pose lays it on \
             the target, made straight, and how far each place was moved."
        ),
        image: Image::Png(picture),
    }])
}
