//! The command `ogm`: aligns and merges occupancy grid maps.

#![expect(clippy::disallowed_methods, reason = "a tool reads files and the clock")]

mod align;
mod alignments;
mod answer;
mod apply;
mod args;
#[cfg(feature = "bags")]
mod bag;
mod bent;
mod drawn;
mod ending;
mod given;
mod html;
mod info;
mod input;
mod interrupt;
mod memory;
mod merge;
mod merged;
mod named;
mod output;
mod placing;
mod pose;
mod progress;
mod reading;
mod search;
mod straighten;
mod tags;
mod team;
mod team_answer;
mod terminal;
mod text;
mod usage;
mod view;

use std::process::ExitCode;

use clap::Parser;
use grid_merge::FusionError;
use ogm_core::Cancelled;
use ogm_io::IoError;
use ogm_merge::MergeError;

use crate::args::{Cli, Command};
use crate::ending::Ending;
use crate::usage::UsageError;

fn main() -> ExitCode {
    let cli = Cli::parse_from(reading::with_pictures_as_maps(std::env::args_os()));
    let ended = interrupt::install().and_then(|()| match &cli.command {
        Command::Align(args) => align::run(args),
        Command::Merge(args) => merge::run(args),
        Command::Info(args) => info::run(args),
        Command::Apply(args) => apply::run(args),
        Command::Straighten(args) => straighten::run(args),
        Command::View(args) => view::run(args),
    });
    match ended {
        Ok(Ending::Done) => ExitCode::SUCCESS,
        Ok(Ending::Refused) => ExitCode::from(3),
        Err(error) if error.is::<UsageError>() => {
            terminal::error(&format!("{error}\n\nFor more information, try '--help'."));
            ExitCode::from(2)
        }
        Err(error) if is_cancelled(&error) => {
            terminal::error("ended by Ctrl-C; nothing was written");
            ExitCode::from(interrupt::EXIT_CODE)
        }
        Err(error) => {
            terminal::error(&format!("{error:#}"));
            ExitCode::FAILURE
        }
    }
}

fn is_cancelled(error: &anyhow::Error) -> bool {
    error.chain().any(|cause| {
        cause.is::<Cancelled>()
            || cause.downcast_ref::<MergeError>().is_some_and(MergeError::is_cancelled)
            || matches!(cause.downcast_ref(), Some(FusionError::Cancelled(_)))
            || matches!(cause.downcast_ref(), Some(IoError::Cancelled(_)))
    })
}
