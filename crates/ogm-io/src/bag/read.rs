//! Reads a bag, whatever its format.

use std::fs::File;
use std::io::Read;
use std::ops::ControlFlow;
use std::path::Path;

use super::error::BagError;
use super::folder::files_of;
use super::mcap::read as read_mcap;
use super::message::BagMessage;
use super::sqlite::read as read_sqlite;
use crate::IoError;

/// Calls `take` with the messages of a bag, an `.mcap` or `.db3` file or the folder of one, whose
/// topic and type are `wanted`, until it breaks off.
///
/// Messages come in the order of the files, which is that of their times as far as the recorder kept
/// it. One message at a time is in memory.
///
/// # Errors
/// A bag that cannot be read, to its end where `take` does not break off.
pub fn read_bag(
    bag: &Path,
    wanted: &dyn Fn(&str, &str) -> bool,
    take: &mut dyn FnMut(BagMessage) -> ControlFlow<()>,
) -> Result<(), IoError> {
    for file in files_of(bag)? {
        let failed = |cause| IoError::Bag { path: file.clone(), cause };
        let flow = match kind_of(&file)? {
            Some(Kind::Mcap) => read_mcap(&file, wanted, take).map_err(failed)?,
            Some(Kind::Sqlite) => read_sqlite(&file, wanted, take).map_err(failed)?,
            None => return Err(failed(BagError::NotABag)),
        };
        if flow.is_break() {
            break;
        }
    }
    Ok(())
}

enum Kind {
    Mcap,
    Sqlite,
}

fn kind_of(file: &Path) -> Result<Option<Kind>, IoError> {
    const LENGTH: u64 = 16;
    let access = |cause| IoError::Access { path: file.to_owned(), action: "read", cause };
    let mut head = Vec::new();
    File::open(file).and_then(|file| file.take(LENGTH).read_to_end(&mut head)).map_err(access)?;
    Ok(if head.starts_with(b"\x89MCAP0\r\n") {
        Some(Kind::Mcap)
    } else if head.starts_with(b"SQLite format 3\0") {
        Some(Kind::Sqlite)
    } else {
        None
    })
}
