//! Where random numbers come from: one stream for each thing that is drawn.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// What a stream of random numbers is for.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Stream {
    Plan,
    Heading,
    Ranges,
    Drift,
    Compass,
    TagPlaces,
    TagOffsets,
    TagRanges,
    Drive,
    Floor,
    Bend,
    Pair,
    Route,
    Style,
    Team,
    Wheels,
    Gyroscope,
    TagEchoes,
}

/// The generator of `stream` for the work item `item`.
pub(crate) fn generator(seed: u64, stream: Stream, item: u64) -> ChaCha8Rng {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream((item << 8) | stream as u64);
    rng
}
