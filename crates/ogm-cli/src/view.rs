//! `ogm view`: maps as pictures.

use std::path::{Path, PathBuf};

use anyhow::Context;
use ogm_view::{occupancy, overlay_sheet, png};

use crate::args::ViewArgs;
use crate::ending::Ending;
use crate::input::Input;
use crate::memory::Work;
use crate::output;
use crate::progress::Wheel;

pub(crate) fn run(args: &ViewArgs) -> anyhow::Result<Ending> {
    let maps: Vec<&Path> = [Some(&args.target), args.source.as_ref()]
        .into_iter()
        .flatten()
        .map(AsRef::as_ref)
        .collect();
    args.reading.check_memory(&maps, Work::Drawing)?;
    let read = |map: &PathBuf| Input::read(map, &args.reading, args.quiet);
    let target = read(&args.target)?;
    let source = args.source.as_ref().map(read).transpose()?;
    let inputs: Vec<_> = [Some(&target), source.as_ref()].into_iter().flatten().collect();
    let paths: Vec<_> = inputs.iter().flat_map(|input| input.paths()).collect();
    output::check(&[&args.output], &paths, args.force)?;
    output::check_picture(&args.output)?;
    let _progress = Wheel::start("drawing", args.quiet);
    let cannot_draw = || format!("cannot draw {}", args.output.display());
    let picture = match source.as_ref().zip(args.target_from_source) {
        Some((source, target_from_source)) => {
            let names = [&target, source].map(Input::name);
            let names = names.each_ref().map(String::as_str);
            overlay_sheet(target.map(), source.map(), target_from_source, names)
                .with_context(cannot_draw)?
        }
        None => occupancy(target.map()),
    };
    output::write(&args.output, &png(&picture).with_context(cannot_draw)?, args.force)?;
    Ok(Ending::Done)
}
