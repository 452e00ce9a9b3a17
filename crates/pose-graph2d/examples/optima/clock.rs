//! What a call costs.

/// The least processor seconds of `rounds` calls of `f` on this thread, and what the last gave.
pub(crate) fn least_seconds<T>(rounds: usize, f: impl Fn() -> T) -> (f64, T) {
    let timed = || {
        let start = processor_s();
        let found = f();
        (processor_s() - start, found)
    };
    let (mut least, mut found) = timed();
    for _ in 1..rounds {
        let (seconds, again) = timed();
        if seconds < least {
            least = seconds;
        }
        found = again;
    }
    (least, found)
}

/// Seconds that this thread has been on a processor. Linux counts them in nanoseconds.
#[expect(clippy::disallowed_methods, reason = "it measures time")]
fn processor_s() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds =
        text.split_ascii_whitespace().next().and_then(|word| word.parse::<f64>().ok());
    nanoseconds.unwrap_or(f64::NAN) / 1e9
}
