//! `ogm apply`: a map in another frame.

use anyhow::Context;
use grid_merge::{FusionParams, transform_grid};

use crate::args::ApplyArgs;
use crate::ending::Ending;
use crate::input::Input;
use crate::memory::Work;
use crate::output::Staged;
use crate::progress::Bar;
use crate::{output, terminal, text};

pub(crate) fn run(args: &ApplyArgs) -> anyhow::Result<Ending> {
    args.reading.check_memory(&[&args.map], Work::Moving)?;
    let input = Input::read(&args.map, &args.reading, args.quiet)?;
    let image = output::image_of(&args.output);
    output::check(&[&args.output, &image], &input.paths(), args.force)?;
    output::check_map(&args.output)?;
    let moved = {
        let bar = Bar::start("moving", args.quiet);
        transform_grid(input.map(), &args.output_from_map, &FusionParams::default(), &bar)
            .with_context(|| format!("cannot move {} by --transform", input.name()))?
    };
    Staged::write(&args.output, &moved, args.force, args.quiet)?.put_in_place()?;
    terminal::result(&text::written(&args.output, &moved))
        .with_context(|| format!("{} was written", args.output.display()))?;
    Ok(Ending::Done)
}
