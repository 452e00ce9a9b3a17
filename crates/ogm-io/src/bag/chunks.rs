//! Whether the records of the chunks of an MCAP file end where their chunk does.
//!
//! The reader of the format takes that for granted where a chunk is not compressed.

use std::io::{BufReader, ErrorKind, Read, Result, Seek, SeekFrom};

/// Of the file, in front of its first record.
const MAGIC_BYTES: u64 = 8;
/// What tells a chunk from other records.
const CHUNK: u8 = 6;
/// What stands in front of a record: its kind and its length.
const HEAD_BYTES: u64 = 9;
/// Times, size and checksum of a chunk, in front of the name of its compression.
const CHUNK_BYTES: i64 = 28;

/// The first place in the file, bytes, at which a record is longer than what is left of its chunk.
///
/// A file that ends in between is left to its reader.
pub(super) fn overlong_record(file: impl Read + Seek) -> Result<Option<u64>> {
    let mut file = BufReader::new(file);
    file.seek(SeekFrom::Start(MAGIC_BYTES))?;
    let found = walk(&mut file);
    match found {
        Err(error) if error.kind() == ErrorKind::UnexpectedEof => Ok(None),
        found => found,
    }
}

fn walk(file: &mut BufReader<impl Read + Seek>) -> Result<Option<u64>> {
    let mut place = MAGIC_BYTES;
    loop {
        let (kind, length) = head(file)?;
        let start = place.saturating_add(HEAD_BYTES);
        if kind == CHUNK
            && let Some(overlong) = walk_chunk(file, start)?
        {
            return Ok(Some(overlong));
        }
        let Some(next) = start.checked_add(length) else { return Ok(None) };
        place = file.seek(SeekFrom::Start(next))?;
    }
}

/// The same of one chunk, whose content starts at `start`, where `file` is.
fn walk_chunk(file: &mut BufReader<impl Read + Seek>, start: u64) -> Result<Option<u64>> {
    file.seek_relative(CHUNK_BYTES)?;
    let mut compression = [0; 4];
    file.read_exact(&mut compression)?;
    if compression != [0; 4] {
        return Ok(None);
    }
    let mut left = number(file)?;
    let mut place = start.saturating_add_signed(CHUNK_BYTES) + 4 + 8;
    while left > 0 {
        let (_, length) = head(file)?;
        let record = HEAD_BYTES.saturating_add(length);
        if record > left {
            return Ok(Some(place));
        }
        left -= record;
        place = place.saturating_add(record);
        file.seek_relative(i64::try_from(length).unwrap_or(i64::MAX))?;
    }
    Ok(None)
}

/// The kind of a record and its length.
fn head(file: &mut impl Read) -> Result<(u8, u64)> {
    let mut kind = [0];
    file.read_exact(&mut kind)?;
    Ok((kind[0], number(file)?))
}

fn number(file: &mut impl Read) -> Result<u64> {
    let mut bytes = [0; 8];
    file.read_exact(&mut bytes)?;
    Ok(u64::from_le_bytes(bytes))
}
