//! The command `ogm-ros`.

#![expect(clippy::disallowed_methods, reason = "files and the clock are a command's")]

mod command;

fn main() -> std::process::ExitCode {
    command::run()
}
