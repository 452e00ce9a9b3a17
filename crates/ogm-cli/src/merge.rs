//! `ogm merge`: one map of several.

use std::path::Path;

use anyhow::Context;
use ogm_core::{Progress, Stage};
use ogm_merge::{Component, FusionParams, Merged, Verdict, fuse};

use crate::answer::SCHEMA;
use crate::args::{BendArg, MergeArgs};
use crate::bent::{self, Straightened};
use crate::ending::Ending;
use crate::given::Given;
use crate::input::Input;
use crate::memory::Work;
use crate::merged::{MergeAnswer, MergedMap};
use crate::output::Staged;
use crate::placing::{Placing, Team};
use crate::progress::Bar;
use crate::search::check;
use crate::tags::logs_of;
use crate::team_answer::TeamAnswer;
use crate::usage::UsageError;
use crate::{alignments, drawn, html, output, team, terminal, text};

pub(crate) fn run(args: &MergeArgs) -> anyhow::Result<Ending> {
    let maps = team::maps_in(&args.maps, &args.output)?;
    let names: Vec<&Path> = maps.iter().map(AsRef::as_ref).collect();
    let quiet = args.search.quiet;
    let reference = team::reference(args, &maps)?;
    let given = Given::new(&names, reference, &args.transforms, &args.search)?;
    let known = given.all();
    let logs = logs_of(&names, &args.search.tags)?;
    let is_team = maps.len() > 2 || reference > 0 || given.is_exact() || args.alignments.is_some();
    if known.is_some() {
        check_known(args)?;
    } else if is_team {
        team::check(args)?;
    }
    check(&args.search, &logs)?;
    let refined = args.reading.refinement(names[0], args.resolution);
    let bend = bent::when(args, &args.reading.cells(&names));
    let bends = bend != BendArg::Off;
    args.reading.check_memory(&names, Work::Merging { refined, bends })?;
    let mut inputs = Input::read_all(&names, &args.reading, quiet)?;
    check_outputs(args, &inputs, logs.iter().flatten().map(AsRef::as_ref))?;
    check_names(args)?;

    let bar = Bar::start("merging", quiet);
    let part = Stage::new(&bar, 0.0, 0.7);
    let placing = match &known {
        Some(poses) => Placing::known(&inputs, poses, &args.search, &part)?,
        None => match &inputs[..] {
            [target, source] if !is_team => {
                Placing::searched([target, source], &logs, &args.search, given.prior(), &part)?
            }
            _ => {
                let folder = args.alignments.as_deref();
                let alignments =
                    folder.map_or_else(|| Ok(Vec::new()), |at| alignments::read(at, &inputs))?;
                let team = Team { reference, poses: given.poses(), alignments };
                Placing::team(&inputs, &logs, team, &args.search, &part)?
            }
        },
    };
    let overlay = overlay(&inputs, &placing, args)?;
    let making = Stage::new(&bar, 0.7, 1.0);
    let made = made(&mut inputs, &placing.components, bend, args, &making)?;
    let pictures = pictures(&inputs, made.as_ref(), args)?;
    drop(bar);

    // The map lies ready before anything is in place, and is put there last.
    let staged = made.as_ref().map(|made| staged(made, args)).transpose()?;
    for picture in overlay.into_iter().chain(pictures) {
        let path = picture.path.display();
        if let Some(png) = picture.png {
            output::write(picture.path, &png, args.force)?;
        }
        if let Some(remark) = picture.remark.filter(|_| !quiet) {
            terminal::warning(&format!("{path} {remark}"));
        }
    }
    let ending = placing.ending();
    let answer = MergeAnswer {
        schema: SCHEMA,
        maps: inputs.iter().map(Input::file).collect(),
        output: made.as_ref().map(|made| {
            let fusion = args.fusion.name();
            MergedMap::new(&args.output, made.component, &made.merged, fusion)
        }),
        pairs: placing.pairs,
        components: placing.components.clone(),
        team: placing.team.as_ref().map(TeamAnswer::from),
        bend: made.as_ref().map(|made| made.straightened.answers.clone()).unwrap_or_default(),
    };
    let json = serde_json::to_string_pretty(&answer)? + "\n";
    if let Some(path) = &args.report {
        output::write(path, json.as_bytes(), args.force)?;
    }
    if let Some(path) = &args.html {
        let page = page(path, &inputs, &answer, made.as_ref())?;
        output::write(path, page.as_bytes(), args.force)?;
    }
    let is_written = staged.map(Staged::put_in_place).transpose()?.is_some();
    let found = placing.team.as_ref().map_or_else(
        || answer.pairs.iter().map(text::pair).collect(),
        |report| team::said(&inputs, report, args.overlay.is_some()),
    );
    let bent = bent::said(&answer.bend, &inputs, args);
    let said =
        || found + &bent + &text::merge(&answer, made.as_ref().map(|made| &made.merged), args);
    let text = if args.search.json { json } else { said() };
    if side_outputs(args).any(output::is_standard) {
        terminal::note(&text);
    } else if let Err(error) = terminal::result(&text) {
        let output = args.output.display();
        return Err(if is_written {
            error.context(format!("{output} was written"))
        } else {
            error
        });
    }
    Ok(ending)
}

fn pictures_asked(args: &MergeArgs) -> impl Iterator<Item = &Path> {
    let pictures = [&args.overlay, &args.conflicts, &args.provenance, &args.bend_picture];
    pictures.into_iter().flatten().map(AsRef::as_ref)
}

/// The outputs beside the map.
fn side_outputs(args: &MergeArgs) -> impl Iterator<Item = &Path> {
    let texts = [&args.report, &args.html].into_iter().flatten().map(AsRef::as_ref);
    texts.chain(pictures_asked(args))
}

/// Makes sure that nothing is asked for of a search where none is made.
fn check_known(args: &MergeArgs) -> Result<(), UsageError> {
    let search = &args.search;
    let unused = [
        ("--tags", !search.tags.is_empty()),
        ("--repeats", search.repeats),
        ("--alignments", args.alignments.is_some()),
    ];
    match unused.iter().find(|(_, is_given)| *is_given) {
        Some((name, _)) => {
            let message = format!("{name} has no use: every map has its --transform");
            Err(UsageError(message))
        }
        None => Ok(()),
    }
}

/// Makes sure that the outputs are named as what they are.
fn check_names(args: &MergeArgs) -> Result<(), UsageError> {
    output::check_merged(&args.output)?;
    pictures_asked(args).try_for_each(output::check_picture)?;
    if args.search.json && side_outputs(args).any(output::is_standard) {
        let message = "--json takes standard output; name a file for the other output";
        return Err(UsageError(message.to_owned()));
    }
    Ok(())
}

/// What was made of the maps.
struct Made<'a> {
    component: &'a Component,
    straightened: Straightened,
    params: FusionParams,
    merged: Merged,
}

/// A picture that was asked for.
struct Picture<'a> {
    path: &'a Path,
    /// `None` where there is nothing to draw.
    png: Option<Vec<u8>>,
    remark: Option<&'static str>,
}

fn staged(made: &Made<'_>, args: &MergeArgs) -> anyhow::Result<Staged> {
    let (map, force, quiet) = (&made.merged.map, args.force, args.search.quiet);
    #[cfg(feature = "bags")]
    if output::is_bag(&args.output) {
        let bytes = crate::bag::bytes_of(map, made.component, &args.frames)
            .with_context(|| format!("cannot make {}", args.output.display()))?;
        return Ok(Staged::bag(&args.output, bytes, force, quiet));
    }
    Staged::write(&args.output, map, force, quiet)
}

fn page(
    path: &Path,
    inputs: &[Input],
    answer: &MergeAnswer,
    made: Option<&Made<'_>>,
) -> anyhow::Result<String> {
    let overlay = match (made, answer.pairs.first(), inputs) {
        (None, Some(pair), [target, source]) => {
            drawn::overlay(path, [target, source], &pair.report)?
        }
        _ => None,
    };
    let made = made.map(|made| (made.component, &made.merged));
    html::report(answer, inputs, &html::Shown { made, overlay })
        .with_context(|| format!("cannot make {}", path.display()))
}

fn check_outputs<'a>(
    args: &'a MergeArgs,
    inputs: &'a [Input],
    logs: impl Iterator<Item = &'a Path>,
) -> anyhow::Result<()> {
    let image = output::image_of(&args.output);
    let mut outputs = vec![args.output.as_path()];
    if !output::is_bag(&args.output) {
        outputs.push(&image);
    }
    outputs.extend(side_outputs(args));
    let inputs: Vec<&Path> = inputs.iter().flat_map(Input::paths).chain(logs).collect();
    output::check(&outputs, &inputs, args.force)
}

/// The component of the first map as one map, if it holds all maps or that is not asked for.
fn made<'a>(
    inputs: &mut [Input],
    components: &'a [Component],
    bend: BendArg,
    args: &MergeArgs,
    progress: &dyn Progress,
) -> anyhow::Result<Option<Made<'a>>> {
    let all = components.len() == 1;
    let Some(component) = components.first().filter(|_| all || args.allow_partial) else {
        return Ok(None);
    };
    let (fusion, resolution) = (args.fusion.into(), args.resolution);
    let params = FusionParams { fusion, resolution, ..FusionParams::default() };
    let cannot_make = || format!("cannot make {}", args.output.display());
    let straightening = Stage::new(progress, 0.0, 0.6);
    let picture = args.bend_picture.as_deref();
    let straightened = Straightened::of(inputs, component, bend, picture, &straightening)
        .with_context(cannot_make)?;
    let maps: Vec<_> = inputs.iter().map(Input::map).collect();
    let fusing = Stage::new(progress, 0.6, 1.0);
    let merged =
        fuse(&maps, &straightened.component, &params, &fusing).with_context(cannot_make)?;
    Ok(Some(Made { component, straightened, params, merged }))
}

/// The maps on each other as they are.
fn overlay<'a>(
    inputs: &[Input],
    placing: &Placing,
    args: &'a MergeArgs,
) -> anyhow::Result<Option<Picture<'a>>> {
    let Some(path) = &args.overlay else { return Ok(None) };
    if placing.team.is_some() {
        let component = placing.components.first();
        let png = component.map(|component| drawn::team(path, inputs, component)).transpose()?;
        return Ok(Some(Picture { path, png, remark: None }));
    }
    let pair = placing.pairs.first().zip(placing.of_pairs.first());
    let drawn = pair.map(|(pair, &[target, source])| {
        let png = drawn::overlay(path, [&inputs[target], &inputs[source]], &pair.report)?;
        let refused = pair.report.verdict() != Verdict::Merged;
        let remark = match &png {
            Some(_) => refused.then_some("shows the best transform, which was refused"),
            None => Some("is not drawn: no transform was found"),
        };
        Ok(Picture { path, png, remark })
    });
    drawn.transpose()
}

/// The other pictures, of what was made.
fn pictures<'a>(
    inputs: &[Input],
    made: Option<&Made<'_>>,
    args: &'a MergeArgs,
) -> anyhow::Result<Vec<Picture<'a>>> {
    let mut pictures = Vec::new();
    let mut draw = |path: &'a Path, png: Option<anyhow::Result<Vec<u8>>>| {
        let remark = if png.is_none() { Some("is not drawn: no map was made") } else { None };
        let png = png.transpose()?;
        pictures.push(Picture { path, png, remark });
        anyhow::Ok(())
    };
    if let Some(path) = &args.conflicts {
        draw(path, made.map(|made| drawn::conflicts(path, &made.merged)))?;
    }
    if let Some(path) = &args.provenance {
        let maps: Vec<_> = inputs.iter().map(Input::map).collect();
        let drawn = made
            .map(|made| drawn::provenance(path, &maps, &made.straightened.component, &made.params));
        draw(path, drawn)?;
    }
    if let Some(path) = &args.bend_picture {
        draw(path, made.and_then(|made| made.straightened.picture.clone()).map(Ok))?;
    }
    Ok(pictures)
}
