//! The command `ogm`: aligns and merges occupancy grid maps.

#![expect(clippy::disallowed_methods, reason = "a tool reads files and the clock")]

mod align;
mod answer;
mod apply;
mod args;
mod found;
mod info;
mod input;
mod merge;
mod output;
mod pose;
mod progress;
mod search;
mod tags;
mod terminal;
mod text;
mod untagged;
mod usage;
mod view;

use std::process::ExitCode;

use clap::Parser;

use crate::args::{Cli, Command};
use crate::usage::UsageError;

/// How a command ended that could do its work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ending {
    Done,
    Refused,
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    let ended = match &cli.command {
        Command::Align(args) => align::run(args),
        Command::Merge(args) => merge::run(args),
        Command::Info(args) => info::run(args),
        Command::Apply(args) => apply::run(args),
        Command::View(args) => view::run(args),
    };
    match ended {
        Ok(Ending::Done) => ExitCode::SUCCESS,
        Ok(Ending::Refused) => ExitCode::from(3),
        Err(error) if error.is::<UsageError>() => {
            terminal::error(&format!("{error}\n\nFor more information, try '--help'."));
            ExitCode::from(2)
        }
        Err(error) => {
            terminal::error(&format!("{error:#}"));
            ExitCode::FAILURE
        }
    }
}
