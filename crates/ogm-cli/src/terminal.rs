//! What is said where: results on standard output, everything else on standard error.

use std::io::{self, ErrorKind, IsTerminal, Write};

use anyhow::Context;

/// Writes a result to standard output. A reader that left early, as `head` does, is no failure.
pub(crate) fn result(text: &str) -> anyhow::Result<()> {
    let mut output = io::stdout().lock();
    match output.write_all(text.as_bytes()).and_then(|()| output.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written.context("cannot write to standard output"),
    }
}

/// Writes a result to standard error, where standard output is a file's.
pub(crate) fn note(text: &str) {
    // Nobody is left to tell if standard error is closed.
    let _ = io::stderr().write_all(text.as_bytes());
}

/// Writes an error to standard error.
pub(crate) fn error(text: &str) {
    say("error", "31", text);
}

/// Writes a warning to standard error.
pub(crate) fn warning(text: &str) {
    say("warning", "33", text);
}

fn say(kind: &str, colour: &str, text: &str) {
    let kind = if is_colourful(&io::stderr()) { painted(kind, colour) } else { kind.to_owned() };
    // Nobody is left to tell if standard error is closed.
    let _ = writeln!(io::stderr(), "{kind}: {text}");
}

/// `word` for standard output: in a colour, by its ANSI code, where that is a terminal.
pub(crate) fn highlight(word: &str, colour: &str) -> String {
    if is_colourful(&io::stdout()) { painted(word, colour) } else { word.to_owned() }
}

fn painted(word: &str, colour: &str) -> String {
    format!("\x1b[1;{colour}m{word}\x1b[0m")
}

/// On a terminal, unless the user said otherwise by the convention of no-color.org.
fn is_colourful(stream: &impl IsTerminal) -> bool {
    stream.is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}
