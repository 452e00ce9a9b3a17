//! Messages left as bytes: one codec decodes them, whether a bag or the network brought them.

use std::convert::Infallible;

use rustdds::RepresentationIdentifier;
use rustdds::bytes::Bytes;
use rustdds::no_key::{Decode, DefaultDecoder, DeserializerAdapter, SerializerAdapter};

/// Bytes of the header that says how the others are laid out.
const HEADER_BYTES: usize = 4;

/// A message with its header of four bytes.
#[derive(Debug, Clone)]
pub(super) struct Raw(pub(super) Bytes);

/// Takes the bytes as they are.
#[derive(Debug, Clone)]
pub(super) struct AsIs;

const READ: [RepresentationIdentifier; 2] =
    [RepresentationIdentifier::CDR_LE, RepresentationIdentifier::CDR_BE];

impl DeserializerAdapter<Raw> for AsIs {
    type Error = Infallible;
    type Decoded = Raw;

    fn supported_encodings() -> &'static [RepresentationIdentifier] {
        &READ
    }

    fn transform_decoded(decoded: Raw) -> Raw {
        decoded
    }
}

impl DefaultDecoder<Raw> for AsIs {
    type Decoder = Self;
    const DECODER: Self = Self;
}

impl Decode<'_, Raw> for AsIs {
    type Error = Infallible;

    fn decode_bytes(
        self,
        bytes: &[u8],
        encoding: RepresentationIdentifier,
    ) -> Result<Raw, Infallible> {
        let identifier = u8::from(encoding != RepresentationIdentifier::CDR_BE);
        let mut message = Vec::with_capacity(HEADER_BYTES + bytes.len());
        message.extend([0, identifier, 0, 0]);
        message.extend_from_slice(bytes);
        Ok(Raw(message.into()))
    }
}

impl SerializerAdapter<Raw> for AsIs {
    type Error = Infallible;

    fn output_encoding() -> RepresentationIdentifier {
        RepresentationIdentifier::CDR_LE
    }

    fn to_bytes(message: &Raw) -> Result<Bytes, Infallible> {
        Ok(message.0.slice(HEADER_BYTES.min(message.0.len())..))
    }
}
