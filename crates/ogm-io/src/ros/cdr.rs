//! Messages as bytes: the common data representation behind its header of four bytes.

use byteorder::{BigEndian, LittleEndian};
use serde::{Deserialize, Serialize};

use super::error::MessageError;

const BIG_ENDIAN: u16 = 0x0000;
const LITTLE_ENDIAN: u16 = 0x0001;
const HEADER_BYTES: usize = 4;

/// The message in `bytes`, as a bag or the network holds it.
///
/// Nothing is allocated that is larger than `bytes`. Bytes that are left over are ignored, as
/// padding and later versions of a message have them.
///
/// # Errors
/// Another encoding than plain CDR, or bytes that are not this message.
pub fn from_cdr<'de, T: Deserialize<'de>>(bytes: &'de [u8]) -> Result<T, MessageError> {
    let Some((header, body)) = bytes.split_first_chunk::<HEADER_BYTES>() else {
        return Err(MessageError::TooShort { bytes: bytes.len() });
    };
    let [high, low, ..] = *header;
    let decoded = match u16::from_be_bytes([high, low]) {
        LITTLE_ENDIAN => cdr_encoding::from_bytes::<T, LittleEndian>(body),
        BIG_ENDIAN => cdr_encoding::from_bytes::<T, BigEndian>(body),
        identifier => return Err(MessageError::Encoding { identifier }),
    };
    decoded.map(|(message, _)| message).map_err(malformed::<T>)
}

/// The bytes of `message`, little-endian.
///
/// # Errors
/// A sequence that is longer than its length field can say.
pub fn to_cdr<T: Serialize>(message: &T) -> Result<Vec<u8>, MessageError> {
    let mut bytes = vec![0, 1, 0, 0];
    cdr_encoding::to_writer::<T, LittleEndian, _>(&mut bytes, message).map_err(malformed::<T>)?;
    Ok(bytes)
}

fn malformed<T>(error: cdr_encoding::Error) -> MessageError {
    let name = std::any::type_name::<T>();
    let name = name.rsplit("::").next().unwrap_or(name);
    MessageError::Malformed { name, message: error.to_string() }
}
