//! `ogm view`: maps as pictures.

use std::path::{Path, PathBuf};

use anyhow::Context;
use ogm_core::Se2;
use ogm_view::{occupancy, png};

use crate::args::ViewArgs;
use crate::ending::Ending;
use crate::input::Input;
use crate::memory::Work;
use crate::progress::Wheel;
use crate::{drawn, output};

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
    let picture = match source.as_ref().zip(args.target_from_source) {
        Some((source, target_from_source)) => {
            let placed = [(&target, Se2::identity()), (source, target_from_source)];
            drawn::sheet(&args.output, &placed)?
        }
        None => png(&occupancy(target.map()))
            .with_context(|| format!("cannot draw {}", args.output.display()))?,
    };
    output::write(&args.output, &picture, args.force)?;
    Ok(Ending::Done)
}
