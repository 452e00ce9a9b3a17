//! `ogm view`: maps as pictures.

use anyhow::Context;
use ogm_view::{occupancy, overlay, png};

use crate::args::ViewArgs;
use crate::ending::Ending;
use crate::input::Input;
use crate::output;
use crate::progress::Wheel;

pub(crate) fn run(args: &ViewArgs) -> anyhow::Result<Ending> {
    let target = Input::read(&args.target, args.quiet)?;
    let source = args.source.as_ref().map(|path| Input::read(path, args.quiet)).transpose()?;
    let inputs: Vec<_> = [Some(&target), source.as_ref()].into_iter().flatten().collect();
    let paths: Vec<_> = inputs.iter().flat_map(|input| input.paths()).collect();
    output::check(&[&args.output], &paths, args.force)?;
    output::check_picture(&args.output)?;
    let _progress = Wheel::start("drawing", args.quiet);
    let cannot_draw = || format!("cannot draw {}", args.output.display());
    let picture = match source.as_ref().zip(args.target_from_source) {
        Some((source, target_from_source)) => {
            overlay(target.map(), source.map(), target_from_source).with_context(cannot_draw)?
        }
        None => occupancy(target.map()),
    };
    output::write(&args.output, &png(&picture).with_context(cannot_draw)?, args.force)?;
    Ok(Ending::Done)
}
