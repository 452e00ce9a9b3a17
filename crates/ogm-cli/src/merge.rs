//! `ogm merge`: one map of two.

use std::path::Path;

use anyhow::Context;
use grid_merge::{FusionParams, Merged, PlacedMap};
use ogm_core::Se2;
use ogm_io::{WriteOptions, write_file, write_map};
use serde::Serialize;

use crate::answer::{PairAnswer, SCHEMA, Verdict};
use crate::args::MergeArgs;
use crate::input::{Input, MapFile};
use crate::pose::Pose;
use crate::progress::Progress;
use crate::search::{Robot, check, search};
use crate::tags::logs_of;
use crate::usage::UsageError;
use crate::{Ending, output, terminal, text};

/// What was found and done.
#[derive(Debug, Serialize)]
struct MergeAnswer {
    schema: u32,
    maps: Vec<MapFile>,
    pairs: Vec<PairAnswer>,
    components: Vec<Component>,
    output: Option<Output>,
}

/// Maps that hang together, in the frame of the first of them.
#[derive(Debug, Serialize)]
struct Component {
    poses: Vec<MapPose>,
    /// Over (`x_m`, `y_m`, θ in radians), in the order of `poses`; `None` where the method has none.
    covariances: Vec<Option<[[f64; 3]; 3]>>,
}

/// Where a map lies.
#[derive(Debug, Serialize)]
struct MapPose {
    /// Which of `maps`, from 0.
    map: usize,
    #[serde(flatten)]
    pose: Pose,
}

/// The map that was written.
#[derive(Debug, Serialize)]
struct Output {
    file: String,
    width: usize,
    height: usize,
    resolution_m: f64,
    origin: Pose,
    /// Maps that are in it.
    maps: Vec<usize>,
    compared_cells: usize,
    conflict_cells: usize,
}

pub(crate) fn run(args: &MergeArgs) -> anyhow::Result<Ending> {
    let [target, source] = &args.maps[..] else {
        let count = args.maps.len();
        let message = format!("merge takes two maps for now, not {count}");
        return Err(UsageError(message).into());
    };
    let quiet = args.search.quiet;
    let logs = logs_of(&[target, source], &args.search.tags)?;
    check(&args.search, &logs)?;
    let inputs = [Input::read(target, quiet)?, Input::read(source, quiet)?];
    check_outputs(args, &inputs, logs.iter().flatten().map(AsRef::as_ref))?;

    let progress = Progress::start("merging", quiet);
    let [target, source] = &inputs;
    let target_robot = Robot { input: target, log: logs[0].as_ref() };
    let source_robot = Robot { input: source, log: logs[1].as_ref() };
    let pair = search(target_robot, source_robot, &args.search)?;
    let overlay = match &args.overlay {
        Some(path) => drawn(path, &inputs, &pair)?,
        None => None,
    };
    let merged = fused(&inputs, &pair, args)
        .with_context(|| format!("cannot make {}", args.output.display()))?;
    drop(progress);

    if let Some(merged) = &merged {
        let options = WriteOptions { overwrite: args.force, ..WriteOptions::default() };
        write_map(&args.output, &merged.map, &options)?;
    }
    match (&args.overlay, overlay) {
        (Some(path), Some(png)) => {
            write_file(path, &png, args.force)?;
            if pair.verdict != Verdict::Merged && !quiet {
                let path = path.display();
                terminal::warning(&format!("{path} shows the best transform, which was refused"));
            }
        }
        (Some(path), None) if !quiet => {
            let path = path.display();
            terminal::warning(&format!("{path} is not drawn: no transform was found"));
        }
        _ => {}
    }
    let ending = pair.verdict.ending();
    let answer = MergeAnswer {
        schema: SCHEMA,
        maps: inputs.iter().map(Input::file).collect(),
        components: components(&pair),
        output: merged.as_ref().map(|merged| Output::new(&args.output, merged, &pair)),
        pairs: vec![pair],
    };
    let json = serde_json::to_string_pretty(&answer)? + "\n";
    if let Some(path) = &args.report {
        write_file(path, json.as_bytes(), args.force)?;
    }
    terminal::result(&if args.search.json { json } else { said(&answer, merged.as_ref(), args) })?;
    Ok(ending)
}

fn check_outputs<'a>(
    args: &'a MergeArgs,
    inputs: &'a [Input],
    logs: impl Iterator<Item = &'a Path>,
) -> anyhow::Result<()> {
    let image = output::image_of(&args.output);
    let mut outputs = vec![args.output.as_path(), &image];
    outputs.extend([&args.report, &args.overlay].into_iter().flatten().map(AsRef::<Path>::as_ref));
    let inputs: Vec<&Path> = inputs.iter().flat_map(Input::paths).chain(logs).collect();
    output::check(&outputs, &inputs, args.force)
}

/// The maps on each other under the best transform, accepted or not, as a PNG.
fn drawn(
    path: &Path,
    [target, source]: &[Input; 2],
    pair: &PairAnswer,
) -> anyhow::Result<Option<Vec<u8>>> {
    let Some(target_from_source) = pair.target_from_source else {
        return Ok(None);
    };
    let png = ogm_view::overlay(target.map(), source.map(), target_from_source)
        .and_then(|picture| ogm_view::png(&picture));
    Ok(Some(png.with_context(|| format!("cannot draw {}", path.display()))?))
}

/// Both maps in the frame of the first if they match; the first alone if that is allowed.
fn fused(
    [target, source]: &[Input; 2],
    pair: &PairAnswer,
    args: &MergeArgs,
) -> anyhow::Result<Option<Merged>> {
    let mut placed = vec![PlacedMap { map: target.map(), reference_from_map: Se2::identity() }];
    match pair.target_from_source.filter(|_| pair.verdict == Verdict::Merged) {
        Some(target_from_source) => {
            placed.push(PlacedMap { map: source.map(), reference_from_map: target_from_source });
        }
        None if args.allow_partial => {}
        None => return Ok(None),
    }
    let fusion = args.fusion.rule();
    let params = FusionParams { fusion, resolution: args.resolution, ..FusionParams::default() };
    Ok(Some(grid_merge::merge(&placed, &params, &())?))
}

fn components(pair: &PairAnswer) -> Vec<Component> {
    let alone = |map| Component {
        poses: vec![MapPose { map, pose: Se2::identity().into() }],
        covariances: vec![Some([[0.0; 3]; 3])],
    };
    match pair.target_from_source.filter(|_| pair.verdict == Verdict::Merged) {
        Some(target_from_source) => {
            let mut both = alone(0);
            both.poses.push(MapPose { map: 1, pose: target_from_source.into() });
            both.covariances.push(pair.hypotheses.first().and_then(|best| best.covariance));
            vec![both]
        }
        None => vec![alone(0), alone(1)],
    }
}

impl Output {
    fn new(yaml: &Path, merged: &Merged, pair: &PairAnswer) -> Self {
        let map = &merged.map;
        Self {
            file: yaml.display().to_string(),
            width: map.width(),
            height: map.height(),
            resolution_m: map.frame().resolution(),
            origin: map.frame().map_from_grid().into(),
            maps: if pair.verdict == Verdict::Merged { vec![0, 1] } else { vec![0] },
            compared_cells: merged.compared,
            conflict_cells: merged.conflict_count,
        }
    }
}

fn said(answer: &MergeAnswer, merged: Option<&Merged>, args: &MergeArgs) -> String {
    let mut said = String::new();
    for pair in &answer.pairs {
        said += &text::pair(pair);
    }
    if let Some(merged) = merged {
        said += &text::written(&args.output, &merged.map);
        if let [pair] = &answer.pairs[..]
            && pair.verdict == Verdict::Merged
        {
            said += &text::conflicts(merged);
            said += &text::static_transform(pair);
        } else {
            said += &format!("  it is {} alone\n", answer.maps[0].file);
        }
    }
    said
}
