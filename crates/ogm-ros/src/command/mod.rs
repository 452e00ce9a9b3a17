//! The command: arguments, the clock, signals, the terminal.

mod args;
mod config;
mod intake;
mod live;
mod pose;
mod record;
mod replay;
mod state;
mod stop;
mod terminal;

use std::process::ExitCode;

use clap::Parser;

use self::args::{Args, Verb};

/// Runs the command line of this process.
pub(crate) fn run() -> ExitCode {
    let outcome = match Args::parse().verb {
        Verb::Live(args) => live::run(&args),
        Verb::Replay(args) => replay::run(&args),
        Verb::Record(args) => record::run(&args),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            terminal::error(&error);
            ExitCode::FAILURE
        }
    }
}
