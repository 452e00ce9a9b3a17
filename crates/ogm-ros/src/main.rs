//! The command `ogm-ros`.

mod command;

fn main() -> std::process::ExitCode {
    command::run()
}
