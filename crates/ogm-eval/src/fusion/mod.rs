//! `cargo xtask fusion`: what a merged map does to the walls of its inputs, on real pairs.

mod record;
mod tables;

use std::path::{Path, PathBuf};

use anyhow::Context;
use grid_merge::fusion_quality;
use ogm_core::{ClassThresholds, Outcome};
use ogm_merge::{
    AlignParams, Component, FusionParams, FusionRule, Member, Method, RobotMap, align_pair, fuse,
    placed,
};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

use crate::cases::map_pair::{MapPair, folders_of_pairs, read_pair};
use crate::judge::Truth;
use crate::report::{self, Table};
use record::{Fused, Pose};

/// The rules that are compared, the default first.
const RULES: [FusionRule; 3] =
    [FusionRule::KeepWalls, FusionRule::LogOdds, FusionRule::MaxConfidence];

/// Fuses every pair below `folders` that matches, in the pose that is found where that is right,
/// else in the true one, and gives the tables as text.
///
/// # Errors
/// Pairs that cannot be read.
pub fn run(folders: &[PathBuf]) -> anyhow::Result<String> {
    let mut pairs = Vec::new();
    for folder in folders {
        pairs.extend(folders_of_pairs(folder)?);
    }
    let fused = pairs.par_iter().map(|folder| {
        let pair = read_pair(folder)?;
        match &pair.truth {
            Some(truth) => fused(&pair, truth).map(Some),
            None => Ok(None),
        }
    });
    let fused: Vec<Option<Fused>> = fused.collect::<anyhow::Result<_>>()?;
    let fused: Vec<Fused> = fused.into_iter().flatten().collect();
    let text = |table: &Table| format!("\n{}\n{}\n", report::markdown_table(table), table.caption);
    Ok(tables::all(&fused).iter().map(text).collect())
}

fn fused(pair: &MapPair, truth: &Truth) -> anyhow::Result<Fused> {
    let maps = [&pair.target, &pair.source];
    let [target, source] = maps.map(RobotMap::from);
    let report = align_pair(Method::Match, &target, &source, &AlignParams::default(), &())?;
    let right = match &report.outcome {
        Outcome::Found(found) => truth.admits(truth.error(found)),
        Outcome::Refused(_) => false,
    };
    let pose = if right { Pose::Found } else { Pose::True };
    let component = report.components().into_iter().next().filter(|_| right);
    let component = component.unwrap_or_else(|| in_the_true_pose(truth));
    let placed = placed(&maps, &component)?;
    let thresholds = ClassThresholds::default();
    let qualities = RULES.map(|fusion| {
        let params = FusionParams { fusion, ..FusionParams::default() };
        let merged = fuse(&maps, &component, &params, &())?;
        let quality = fusion_quality(&placed, &merged, &thresholds)?;
        anyhow::Ok((fusion, quality))
    });
    Ok(Fused {
        name: pair.name.clone(),
        pose,
        one_session: truth.exact,
        resolution: pair.target.frame().resolution(),
        qualities: qualities.into_iter().collect::<anyhow::Result<_>>()?,
    })
}

fn in_the_true_pose(truth: &Truth) -> Component {
    let member =
        |map, reference_from_map| Member { map, reference_from_map, covariance: None, bend_m: 0.0 };
    Component {
        members: vec![member(0, ogm_core::Se2::identity()), member(1, truth.target_from_source)],
    }
}

/// Puts the tables into a document, under the command that made them.
///
/// # Errors
/// A document that cannot be read or written, or has no markers.
pub fn splice_into(document: &Path, text: &str, command: &str) -> anyhow::Result<()> {
    let before = std::fs::read_to_string(document)
        .with_context(|| format!("cannot read {}", document.display()))?;
    let after = report::splice(&before, "fusion", text, command)
        .with_context(|| format!("in {}", document.display()))?;
    report::write_file(document, after.as_bytes())
}
