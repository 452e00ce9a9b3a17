//! The datagrams of a large sample: RTPS 2.3, sections 8.3.7.3 (DataFrag) and 9.4.5.4.

use rustdds::SampleIdentity;

/// Bytes of a fragment. A writer may not vary it (RTPS 8.4.14.1.1), and this is RustDDS's, private
/// to it.
const FRAGMENT_BYTES: usize = 256;
/// What RustDDS 0.15 says of itself.
const PROTOCOL_VERSION: [u8; 2] = [2, 4];
const VENDOR: [u8; 2] = [0x01, 0x12];
const DATA_FRAG: u8 = 0x16;
const LITTLE_ENDIAN: u8 = 0x01;
/// Bytes of the message's header and the submessage's.
const RTPS_BYTES: usize = 20 + 4;
/// Bytes of a DataFrag between its length and its data, and of them before the inline QoS.
const FIELDS_BYTES: usize = 32;
const TO_INLINE_QOS: u16 = 28;

/// The datagrams that carry `sample`, header included, each of at most `most_bytes` of data.
pub(super) fn datagrams(
    identity: SampleIdentity,
    sample: &[u8],
    most_bytes: usize,
) -> impl Iterator<Item = Vec<u8>> {
    let fragments = (most_bytes / FRAGMENT_BYTES).max(1);
    let runs = sample.chunks(fragments * FRAGMENT_BYTES).enumerate();
    runs.filter_map(move |(index, run)| datagram(identity, sample.len(), index * fragments, run))
}

/// `None` where a number does not fit its field.
fn datagram(
    identity: SampleIdentity,
    sample_bytes: usize,
    before: usize,
    run: &[u8],
) -> Option<Vec<u8>> {
    let writer = identity.writer_guid.to_bytes();
    let (prefix, entity) = writer.split_at(12);
    let padded = run.len().next_multiple_of(4);
    let length = u16::try_from(FIELDS_BYTES + padded).ok()?;
    let first = u32::try_from(before + 1).ok()?;
    let fragments = u16::try_from(run.len().div_ceil(FRAGMENT_BYTES)).ok()?;
    let fragment_bytes = u16::try_from(FRAGMENT_BYTES).ok()?;
    let sample_bytes = u32::try_from(sample_bytes).ok()?;

    let mut bytes = Vec::with_capacity(RTPS_BYTES + FIELDS_BYTES + padded);
    bytes.extend(b"RTPS");
    bytes.extend(PROTOCOL_VERSION);
    bytes.extend(VENDOR);
    bytes.extend(prefix);
    bytes.extend([DATA_FRAG, LITTLE_ENDIAN]);
    bytes.extend(length.to_le_bytes());
    bytes.extend([0; 2]);
    bytes.extend(TO_INLINE_QOS.to_le_bytes());
    // Of whichever reader.
    bytes.extend([0; 4]);
    bytes.extend(entity);
    bytes.extend(identity.sequence_number.high().to_le_bytes());
    bytes.extend(identity.sequence_number.low().to_le_bytes());
    bytes.extend(first.to_le_bytes());
    bytes.extend(fragments.to_le_bytes());
    bytes.extend(fragment_bytes.to_le_bytes());
    bytes.extend(sample_bytes.to_le_bytes());
    bytes.extend(run);
    bytes.resize(RTPS_BYTES + FIELDS_BYTES + padded, 0);
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::{RTPS_BYTES, datagrams};
    use rustdds::SampleIdentity;

    #[test]
    fn the_datagrams_hold_every_byte_of_the_sample_at_its_place() {
        let sample: Vec<u8> = (0..100_001_u32).map(|byte| byte.to_le_bytes()[0]).collect();
        for most_bytes in [1, 256, 1_280, 60_000] {
            let mut received = vec![0; sample.len()];
            let mut next = 1;
            for datagram in datagrams(SampleIdentity::default(), &sample, most_bytes) {
                assert!(datagram.len() <= 65_507 && datagram.len().is_multiple_of(4));
                let fields = &datagram[RTPS_BYTES..];
                let number = |at: usize| u32::from_le_bytes(fields[at..at + 4].try_into().unwrap());
                let fragments = number(24) & 0xffff;
                assert_eq!((number(20), number(24) >> 16, number(28)), (next, 256, 100_001));
                let from = 256 * (next as usize - 1);
                let length = (256 * fragments as usize).min(sample.len() - from);
                received[from..from + length].copy_from_slice(&fields[32..32 + length]);
                next += fragments;
            }
            assert!(received == sample, "{most_bytes}");
        }
    }
}
