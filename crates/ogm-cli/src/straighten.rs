//! `ogm straighten`: a map turned along its walls.

use anyhow::Context;
use grid_merge::{FusionParams, transform_grid};
use ogm_core::Outcome;
use ogm_merge::{RfidParams, straighten};

use crate::args::StraightenArgs;
use crate::ending::Ending;
use crate::input::Input;
use crate::memory::Work;
use crate::output::Staged;
use crate::progress::Bar;
use crate::{output, terminal, text};

pub(crate) fn run(args: &StraightenArgs) -> anyhow::Result<Ending> {
    args.reading.check_memory(&[&args.map], Work::Moving)?;
    let input = Input::read(&args.map, &args.reading, args.quiet)?;
    let image = output::image_of(&args.output);
    output::check(&[&args.output, &image], &input.paths(), args.force)?;
    output::check_map(&args.output)?;
    let bar = Bar::start("turning", args.quiet);
    let found = match straighten(input.map(), &RfidParams::default()) {
        Outcome::Found(found) => found,
        Outcome::Refused(refusal) => {
            drop(bar);
            terminal::result(&format!("refused: {}: {refusal}\n", input.name()))?;
            return Ok(Ending::Refused);
        }
    };
    let turned =
        transform_grid(input.map(), &found.straight_from_map, &FusionParams::default(), &bar)
            .with_context(|| format!("cannot turn {}", input.name()))?;
    drop(bar);
    if found.walls.vector.weak && !args.quiet {
        terminal::warning(&format!("{}: its walls are hardly rectangular", input.name()));
    }
    Staged::write(&args.output, &turned, args.force, args.quiet)?.put_in_place()?;
    let said = text::written(&args.output, &turned) + &text::turned(&found.straight_from_map);
    terminal::result(&said)?;
    Ok(Ending::Done)
}
