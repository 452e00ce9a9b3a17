//! Reads the SQLite bags that `ros2 bag` wrote by default before ROS 2 Iron.

use std::ops::ControlFlow;
use std::path::Path;

use rusqlite::{Connection, OpenFlags};

use super::error::BagError;
use super::message::BagMessage;

const MESSAGES: &str = "SELECT topics.name, topics.type, topics.serialization_format, \
     messages.timestamp, messages.rowid \
     FROM messages JOIN topics ON messages.topic_id = topics.id ORDER BY messages.timestamp";
const DATA: &str = "SELECT data FROM messages WHERE rowid = ?1";

pub(super) fn read(
    file: &Path,
    wanted: &dyn Fn(&str, &str) -> bool,
    take: &mut dyn FnMut(BagMessage) -> ControlFlow<()>,
) -> Result<ControlFlow<()>, BagError> {
    let damaged =
        |error: rusqlite::Error| BagError::Damaged { format: "SQLite", message: error.to_string() };
    let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let bag = Connection::open_with_flags(file, flags).map_err(damaged)?;
    let mut messages = bag.prepare(MESSAGES).map_err(damaged)?;
    let mut data = bag.prepare(DATA).map_err(damaged)?;
    let mut rows = messages.query([]).map_err(damaged)?;
    while let Some(row) = rows.next().map_err(damaged)? {
        let text = |column: usize| row.get::<_, String>(column).map_err(damaged);
        let (topic, kind, encoding) = (text(0)?, text(1)?, text(2)?);
        if !wanted(&topic, &kind) {
            continue;
        }
        if encoding != "cdr" {
            return Err(BagError::Encoding { topic, encoding });
        }
        let number = |column: usize| row.get::<_, i64>(column).map_err(damaged);
        let log_time_ns = u64::try_from(number(3)?).unwrap_or(0);
        let data = data.query_row([number(4)?], |row| row.get(0)).map_err(damaged)?;
        if take(BagMessage { topic, kind, log_time_ns, data }).is_break() {
            return Ok(ControlFlow::Break(()));
        }
    }
    Ok(ControlFlow::Continue(()))
}
