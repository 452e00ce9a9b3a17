//! `ogm apply`: a map in another frame.

use anyhow::Context;
use grid_merge::{FusionParams, transform_grid};
use ogm_io::{WriteOptions, write_map};

use crate::args::ApplyArgs;
use crate::ending::Ending;
use crate::input::Input;
use crate::progress::Bar;
use crate::{output, terminal, text};

pub(crate) fn run(args: &ApplyArgs) -> anyhow::Result<Ending> {
    let input = Input::read(&args.map, args.quiet)?;
    let image = output::image_of(&args.output);
    output::check(&[&args.output, &image], &input.paths(), args.force)?;
    let moved = {
        let bar = Bar::start("moving", args.quiet);
        transform_grid(input.map(), &args.output_from_map, &FusionParams::default(), &bar)
            .with_context(|| format!("cannot move {} by --transform", input.name()))?
    };
    let options = WriteOptions { overwrite: args.force, ..WriteOptions::default() };
    write_map(&args.output, &moved, &options)?;
    terminal::result(&text::written(&args.output, &moved))?;
    Ok(Ending::Done)
}
