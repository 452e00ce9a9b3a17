//! `ogm merge`: one map of several; here of two.

use std::path::Path;

use anyhow::Context;
use ogm_core::{Progress, Stage};
use ogm_io::{WriteOptions, write_file, write_map};
use ogm_merge::{Component, FusionParams, Merged, PairReport, PoseDegrees, Verdict, fuse};
use serde::Serialize;

use crate::answer::{PairAnswer, SCHEMA};
use crate::args::MergeArgs;
use crate::ending::Ending;
use crate::input::{Input, MapFile};
use crate::progress::Bar;
use crate::search::{check, search};
use crate::tags::logs_of;
use crate::usage::UsageError;
use crate::{output, team, terminal, text};

/// What was found and done.
#[derive(Debug, Serialize)]
struct MergeAnswer {
    schema: u32,
    maps: Vec<MapFile>,
    pairs: Vec<PairAnswer>,
    components: Vec<Component>,
    output: Option<Output>,
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

pub(crate) fn run(args: &MergeArgs) -> anyhow::Result<Ending> {
    let maps = team::maps_in(&args.maps, &args.output)?;
    let [target, source] = &maps[..] else {
        return team::run(args, &maps);
    };
    if args.reference.is_some() {
        return Err(UsageError("--reference is for more than two maps".to_owned()).into());
    }
    let quiet = args.search.quiet;
    let logs = logs_of(&[target, source], &args.search.tags)?;
    check(&args.search, &logs)?;
    let inputs = [Input::read(target, quiet)?, Input::read(source, quiet)?];
    check_outputs(args, &inputs, logs.iter().flatten().map(AsRef::as_ref))?;

    let bar = Bar::start("merging", quiet);
    let part = Stage::new(&bar, 0.0, 0.8);
    let pair = search(inputs.each_ref(), &logs, &args.search, &part)?;
    let overlay = match &args.overlay {
        Some(path) => drawn(path, &inputs, &pair.report)?,
        None => None,
    };
    let components = pair.report.components();
    let fused = fused(&inputs, &components, args, &Stage::new(&bar, 0.8, 1.0))?;
    drop(bar);
    let merged = fused.as_ref().map(|(_, merged)| merged);

    if let Some(merged) = merged {
        let options = WriteOptions { overwrite: args.force, ..WriteOptions::default() };
        write_map(&args.output, &merged.map, &options)?;
    }
    match (&args.overlay, overlay) {
        (Some(path), Some(png)) => {
            write_file(path, &png, args.force)?;
            if pair.report.verdict() != Verdict::Merged && !quiet {
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
    let ending = pair.ending();
    let answer = MergeAnswer {
        schema: SCHEMA,
        maps: inputs.iter().map(Input::file).collect(),
        pairs: vec![pair],
        output: fused
            .as_ref()
            .map(|(component, merged)| Output::new(&args.output, component, merged)),
        components,
    };
    let json = serde_json::to_string_pretty(&answer)? + "\n";
    if let Some(path) = &args.report {
        write_file(path, json.as_bytes(), args.force)?;
    }
    terminal::result(&if args.search.json { json } else { said(&answer, merged, args) })?;
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
    pair: &PairReport,
) -> anyhow::Result<Option<Vec<u8>>> {
    let Some(target_from_source) = pair.target_from_source else {
        return Ok(None);
    };
    let png = ogm_view::overlay(target.map(), source.map(), target_from_source)
        .and_then(|picture| ogm_view::png(&picture));
    Ok(Some(png.with_context(|| format!("cannot draw {}", path.display()))?))
}

/// The component of the first map as one map, if it holds all maps or that is not asked for.
fn fused(
    inputs: &[Input; 2],
    components: &[Component],
    args: &MergeArgs,
    progress: &dyn Progress,
) -> anyhow::Result<Option<(Component, Merged)>> {
    let Some(first) = components.first().filter(|_| components.len() == 1 || args.allow_partial)
    else {
        return Ok(None);
    };
    let maps = inputs.each_ref().map(Input::map);
    let (fusion, resolution) = (args.fusion.rule(), args.resolution);
    let params = FusionParams { fusion, resolution, ..FusionParams::default() };
    let merged = fuse(&maps, first, &params, progress)
        .with_context(|| format!("cannot make {}", args.output.display()))?;
    Ok(Some((first.clone(), merged)))
}

impl Output {
    fn new(yaml: &Path, component: &Component, merged: &Merged) -> Self {
        let map = &merged.map;
        Self {
            file: yaml.display().to_string(),
            width: map.width(),
            height: map.height(),
            resolution_m: map.frame().resolution(),
            origin: map.frame().map_from_grid().into(),
            maps: component.members.iter().map(|member| member.map).collect(),
            compared_cells: merged.compared,
            conflict_cells: merged.conflict_count,
        }
    }
}

fn said(answer: &MergeAnswer, merged: Option<&Merged>, args: &MergeArgs) -> String {
    let mut said: String = answer.pairs.iter().map(text::pair).collect();
    let Some(merged) = merged else {
        return said;
    };
    said += &text::written(&args.output, &merged.map);
    match &answer.components[0].members[..] {
        [_, others @ ..] if !others.is_empty() => {
            said += &text::conflicts(merged);
            for member in others {
                said += &text::static_transform(&member.reference_from_map);
            }
        }
        _ => said += &format!("  it is {} alone\n", answer.maps[0].file),
    }
    said
}
