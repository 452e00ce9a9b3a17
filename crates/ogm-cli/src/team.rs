//! `ogm merge` of any number of maps.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;
use ogm_merge::{Method, TeamReport};

use crate::args::MergeArgs;
use crate::input::Input;
use crate::text;
use crate::usage::UsageError;

/// The maps that arguments name: a folder stands for the maps in it, but for the output.
pub(crate) fn maps_in(arguments: &[PathBuf], output: &Path) -> anyhow::Result<Vec<PathBuf>> {
    let mut maps = Vec::new();
    for argument in arguments {
        if !argument.is_dir() {
            maps.push(argument.clone());
            continue;
        }
        let cannot_read = || format!("cannot read the folder {}", argument.display());
        let entries = std::fs::read_dir(argument).with_context(cannot_read)?;
        let mut inside = Vec::new();
        for entry in entries {
            let path = entry.with_context(cannot_read)?.path();
            let is_output = path.file_name() == output.file_name()
                && path.canonicalize().ok() == output.canonicalize().ok();
            if is_map(&path) && !is_output {
                inside.push(path);
            }
        }
        if inside.is_empty() {
            let message = format!("the folder {} holds no map", argument.display());
            return Err(UsageError(message).into());
        }
        inside.sort();
        maps.append(&mut inside);
    }
    if maps.len() < 2 {
        let message = format!("merge takes at least two maps, not {}", maps.len());
        return Err(UsageError(message).into());
    }
    Ok(maps)
}

/// Whether a file is the YAML of a map: other YAML lies beside maps, of parameters and launches.
fn is_map(path: &Path) -> bool {
    let is_yaml = path.extension().is_some_and(|end| end == "yaml" || end == "yml");
    let names_image = |text: String| text.lines().any(|line| line.starts_with("image:"));
    is_yaml && std::fs::read_to_string(path).is_ok_and(names_image)
}

/// Which map gives the frame.
pub(crate) fn reference(args: &MergeArgs, paths: &[PathBuf]) -> Result<usize, UsageError> {
    let Some(name) = &args.reference else { return Ok(0) };
    let is_named = |path: &PathBuf| {
        path == name || path.file_name() == Some(name.as_os_str()) || {
            let places = (path.canonicalize(), name.canonicalize());
            matches!(places, (Ok(a), Ok(b)) if a == b)
        }
    };
    paths
        .iter()
        .position(is_named)
        .ok_or_else(|| UsageError(format!("--reference {} names none of the maps", name.display())))
}

pub(crate) fn check(args: &MergeArgs) -> Result<(), UsageError> {
    let method = Method::from(args.search.method);
    if !matches!(method, Method::Auto | Method::Match) {
        let message = format!("--method {} is for two maps; use auto or match", method.name());
        return Err(UsageError(message));
    }
    Ok(())
}

/// The answer for people: every map, then why those apart are apart.
pub(crate) fn said(inputs: &[Input], report: &TeamReport, is_drawn: bool) -> String {
    let mut said = text::team_verdict(report, inputs.len());
    let placed = &report.components[0].members;
    // Writing to a string cannot fail.
    for (place, member) in placed.iter().enumerate() {
        let (name, pose) = (inputs[member.map].name(), member.reference_from_map);
        let _ = write!(said, "  {name}: {pose}");
        if let Some(covariance) = member.covariance.filter(|_| place > 0) {
            let sigma = |axis: usize| covariance[(axis, axis)].sqrt();
            let metres = sigma(0).hypot(sigma(1));
            let _ = write!(said, ", sigma {metres:.3} m {:.2} deg", sigma(2).to_degrees());
        }
        let joined = report.probability(placed[0].map, member.map).filter(|_| place > 0);
        if let Some(probability) = joined {
            let _ = write!(said, ", probability {probability:.3}");
        }
        if is_drawn {
            let _ = write!(said, ", {} in the overlay", ogm_view::wall_colour_name(place));
        }
        said.push('\n');
    }
    for (copy, original) in &report.copies {
        let [copy, original] = [copy, original].map(|&map| inputs[map].name());
        let _ = writeln!(said, "  {copy} is a copy of {original}");
    }
    for apart in &report.components[1..] {
        let names: Vec<String> =
            apart.members.iter().map(|member| inputs[member.map].name()).collect();
        let _ = writeln!(said, "  apart: {}", names.join(", "));
        let maps: Vec<usize> = apart.members.iter().map(|member| member.map).collect();
        if let Some((other, why)) = nearest(report, &maps) {
            let _ = writeln!(said, "    best with {}: {why}", inputs[other].name());
        }
    }
    said
}

/// The map outside of `maps` that came nearest to holding one of them, and why it does not.
fn nearest(report: &TeamReport, maps: &[usize]) -> Option<(usize, String)> {
    let across = report.pairs.iter().filter_map(|pair| {
        let inside = [pair.target, pair.source].map(|map| maps.contains(&map));
        let other = match inside {
            [true, false] => pair.source,
            [false, true] => pair.target,
            _ => return None,
        };
        let found = pair.report.as_ref()?;
        let why = match found.outcome.refusal() {
            Some(refusal) => refusal.detail(),
            None => "the two match, and all maps together do not bear it out".to_owned(),
        };
        Some((found.probability().unwrap_or(0.0), other, why))
    });
    across.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, other, why)| (other, why))
}
