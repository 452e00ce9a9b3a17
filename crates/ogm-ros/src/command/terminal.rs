//! Lines for whoever watches: all of them on standard error, for nothing is asked for.

#![expect(clippy::print_stderr, reason = "this is where it is done")]

/// Something happened.
pub(crate) fn news(line: &str) {
    eprintln!("{line}");
}

/// Something is not as the user may think.
pub(crate) fn warning(line: &str) {
    eprintln!("warning: {line}");
}

/// It is over.
pub(crate) fn error(error: &anyhow::Error) {
    eprintln!("error: {error:#}");
}
