//! `ogm merge` of any number of maps.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::Context;
use ogm_core::{Progress, Stage, TagEstimate};
use ogm_io::{WriteOptions, write_file, write_map};
use ogm_merge::{
    AlignParams, Component, FusionParams, Join, MatchParams, Merged, Method, PoseDegrees, RobotMap,
    TeamPair, TeamParams, TeamReport, fuse, merge_team,
};
use serde::Serialize;

use crate::answer::SCHEMA;
use crate::args::MergeArgs;
use crate::ending::Ending;
use crate::input::{Input, MapFile};
use crate::progress::Bar;
use crate::tags::{localised, logs_of};
use crate::usage::UsageError;
use crate::{output, terminal, text};

/// What was found and done.
#[derive(Debug, Serialize)]
struct TeamAnswer<'a> {
    schema: u32,
    maps: Vec<MapFile>,
    pairs: Vec<PairInTeam<'a>>,
    components: &'a [Component],
    joins: &'a [Join],
    /// (copy, original), places in `maps`.
    copies: &'a [(usize, usize)],
    output: Option<Output>,
    elapsed_ms: u64,
}

#[derive(Debug, Serialize)]
struct PairInTeam<'a> {
    target: MapFile,
    source: MapFile,
    #[serde(flatten)]
    pair: &'a TeamPair,
}

/// The map that was written.
#[derive(Debug, Serialize)]
struct Output {
    file: String,
    width: usize,
    height: usize,
    resolution_m: f64,
    origin: PoseDegrees,
    /// Maps that are in it.
    maps: Vec<usize>,
    compared_cells: usize,
    conflict_cells: usize,
}

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

pub(crate) fn run(args: &MergeArgs, paths: &[PathBuf]) -> anyhow::Result<Ending> {
    let start = Instant::now();
    let quiet = args.search.quiet;
    let names: Vec<&Path> = paths.iter().map(PathBuf::as_path).collect();
    let logs = logs_of(&names, &args.search.tags)?;
    let reference = reference(args, paths)?;
    check(args)?;
    let inputs: Vec<Input> =
        paths.iter().map(|path| Input::read(path, quiet)).collect::<Result<_, _>>()?;
    let image = output::image_of(&args.output);
    let mut outputs = vec![args.output.as_path(), &image];
    outputs.extend([&args.report, &args.overlay].into_iter().flatten().map(AsRef::<Path>::as_ref));
    let logs_read = logs.iter().flatten().map(PathBuf::as_path);
    let read: Vec<&Path> = inputs.iter().flat_map(Input::paths).chain(logs_read).collect();
    output::check(&outputs, &read, args.force)?;

    let tags_of = |log: &Option<PathBuf>| log.as_deref().map_or(Ok(Vec::new()), localised);
    let tags: Vec<Vec<TagEstimate>> = logs.iter().map(tags_of).collect::<Result<_, _>>()?;
    let robots = inputs.iter().zip(&tags);
    let robots: Vec<RobotMap<'_>> =
        robots.map(|(input, tags)| RobotMap { map: input.map(), tags }).collect();
    let matching = MatchParams {
        accept: args.search.accept,
        repeats: args.search.repeats,
        ..MatchParams::default()
    };
    let align = AlignParams { seed: args.search.seed, matching, ..AlignParams::default() };
    let params = TeamParams { align, reference, ..TeamParams::default() };
    let bar = Bar::start("merging", quiet);
    let report = merge_team(&robots, &params, &Stage::new(&bar, 0.0, 0.9))?;
    let fused = fused(&inputs, &report, args, &Stage::new(&bar, 0.9, 1.0))?;
    let overlay = args.overlay.as_deref().map(|path| drawn(path, &inputs, &report)).transpose()?;
    drop(bar);

    if let Some(merged) = &fused {
        let options = WriteOptions { overwrite: args.force, ..WriteOptions::default() };
        write_map(&args.output, &merged.map, &options)?;
    }
    if let (Some(path), Some(png)) = (&args.overlay, overlay) {
        write_file(path, &png, args.force)?;
    }
    let pairs = report.pairs.iter();
    let answer = TeamAnswer {
        schema: SCHEMA,
        maps: inputs.iter().map(Input::file).collect(),
        pairs: pairs
            .map(|pair| PairInTeam {
                target: inputs[pair.target].file(),
                source: inputs[pair.source].file(),
                pair,
            })
            .collect(),
        components: &report.components,
        joins: &report.joins,
        copies: &report.copies,
        output: fused.as_ref().map(|merged| Output::of(&args.output, &report, merged)),
        elapsed_ms: u64::try_from(start.elapsed().as_millis()).unwrap_or(u64::MAX),
    };
    let json = serde_json::to_string_pretty(&answer)? + "\n";
    if let Some(path) = &args.report {
        write_file(path, json.as_bytes(), args.force)?;
    }
    let said = if args.search.json { json } else { said(&inputs, &report, fused.as_ref(), args) };
    terminal::result(&said)?;
    Ok(if report.is_whole() { Ending::Done } else { Ending::Refused })
}

/// Which map gives the frame.
fn reference(args: &MergeArgs, paths: &[PathBuf]) -> Result<usize, UsageError> {
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

fn check(args: &MergeArgs) -> Result<(), UsageError> {
    let method = Method::from(args.search.method);
    if !matches!(method, Method::Auto | Method::Match) {
        let message = format!("--method {} is for two maps; use auto or match", method.name());
        return Err(UsageError(message));
    }
    if args.search.prior_target_from_source.is_some() {
        return Err(UsageError("--prior is for two maps".to_owned()));
    }
    Ok(())
}

/// The component of the reference as one map, if it holds all maps or that is not asked for.
fn fused(
    inputs: &[Input],
    report: &TeamReport,
    args: &MergeArgs,
    progress: &dyn Progress,
) -> anyhow::Result<Option<Merged>> {
    if !report.is_whole() && !args.allow_partial {
        return Ok(None);
    }
    let maps: Vec<_> = inputs.iter().map(Input::map).collect();
    let (fusion, resolution) = (args.fusion.rule(), args.resolution);
    let params = FusionParams { fusion, resolution, ..FusionParams::default() };
    let merged = fuse(&maps, &report.components[0], &params, progress)
        .with_context(|| format!("cannot make {}", args.output.display()))?;
    Ok(Some(merged))
}

/// The maps of the component of the reference on each other, as a PNG.
fn drawn(path: &Path, inputs: &[Input], report: &TeamReport) -> anyhow::Result<Vec<u8>> {
    let members = report.components[0].members.iter();
    let placed: Vec<_> =
        members.map(|member| (inputs[member.map].map(), member.reference_from_map)).collect();
    ogm_view::overlay_all(&placed)
        .and_then(|picture| ogm_view::png(&picture))
        .with_context(|| format!("cannot draw {}", path.display()))
}

impl Output {
    fn of(yaml: &Path, report: &TeamReport, merged: &Merged) -> Self {
        let map = &merged.map;
        Self {
            file: yaml.display().to_string(),
            width: map.width(),
            height: map.height(),
            resolution_m: map.frame().resolution(),
            origin: map.frame().map_from_grid().into(),
            maps: report.components[0].members.iter().map(|member| member.map).collect(),
            compared_cells: merged.compared,
            conflict_cells: merged.conflict_count,
        }
    }
}

/// The answer for people: every map, then why those apart are apart.
fn said(
    inputs: &[Input],
    report: &TeamReport,
    merged: Option<&Merged>,
    args: &MergeArgs,
) -> String {
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
        if args.overlay.is_some() {
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
    if let Some(merged) = merged {
        said += &text::written(&args.output, &merged.map);
        let (conflicts, compared) = (merged.conflict_count, merged.compared);
        let _ = writeln!(
            said,
            "  {conflicts} of {compared} cells that several maps know are in conflict"
        );
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
            None => "the two match, and the others contradict it".to_owned(),
        };
        Some((found.probability().unwrap_or(0.0), other, why))
    });
    across.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, other, why)| (other, why))
}
