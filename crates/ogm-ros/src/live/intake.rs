//! What one robot sends, until its turn comes.

use std::collections::VecDeque;

use ogm_core::OccupancyGrid;
use ogm_io::ros::{MessageError, OccupancyGridMessage, Time, from_cdr};

use crate::message::OccupancyGridUpdate;

/// Changed rectangles that wait: more than that, and the next whole map is waited for.
const MOST_UPDATES: usize = 64;

/// One robot at the door.
#[derive(Debug, Default)]
pub(super) struct Intake {
    /// What it calls the frame of its map.
    pub(super) frame: String,
    /// Its last good map, which updates are written into.
    grid: Option<OccupancyGridMessage>,
    waiting: Option<Vec<u8>>,
    updates: VecDeque<Vec<u8>>,
    /// When it last sent something.
    pub(super) heard: Time,
    pub(super) received: u64,
    pub(super) refused: u64,
    /// Why its last message was refused; empty if it was not.
    pub(super) trouble: String,
    /// When it last had its turn.
    pub(super) turn: u64,
}

impl Intake {
    /// A robot whose map frame is known from before.
    pub(super) fn known(frame: String) -> Self {
        Self { frame, ..Self::default() }
    }

    /// Puts a map aside, in place of what waits.
    pub(super) fn put_map(&mut self, message: Vec<u8>, now: Time) {
        self.heard = now;
        self.received += 1;
        self.waiting = Some(message);
        self.updates.clear();
    }

    /// Puts a changed rectangle aside.
    pub(super) fn put_update(&mut self, message: Vec<u8>, now: Time) {
        self.heard = now;
        self.received += 1;
        if self.updates.len() == MOST_UPDATES {
            // What is lost of them, the next whole map has.
            self.updates.pop_front();
        }
        self.updates.push_back(message);
    }

    pub(super) fn is_waiting(&self) -> bool {
        self.waiting.is_some() || !self.updates.is_empty()
    }

    /// The map as it is by now; what waited is gone, good or not.
    pub(super) fn take(&mut self, most_cells: usize) -> Option<OccupancyGrid> {
        let waiting = self.waiting.take();
        let updates = std::mem::take(&mut self.updates);
        let mut outcome = Ok(());
        if let Some(message) = waiting {
            outcome = read(&message, most_cells).map(|grid| self.grid = Some(grid));
        }
        for message in &updates {
            let Some(grid) = &mut self.grid else {
                break;
            };
            outcome = outcome.and(
                from_cdr(message)
                    .map_err(Refused::from)
                    .and_then(|update: OccupancyGridUpdate| write_into(grid, &update)),
            );
        }
        let grid = self.grid.as_ref();
        match outcome.and_then(|()| Ok(grid.map(OccupancyGridMessage::to_map).transpose()?)) {
            Ok(map) => {
                if let Some(grid) = grid {
                    self.frame.clone_from(&grid.header.frame_id);
                }
                self.trouble.clear();
                map
            }
            Err(refused) => {
                self.refuse(&refused);
                None
            }
        }
    }

    /// Notes that what it sent is not used.
    pub(super) fn refuse(&mut self, why: &dyn std::fmt::Display) {
        self.refused += 1;
        self.trouble = why.to_string();
    }
}

#[derive(Debug, thiserror::Error)]
enum Refused {
    #[error(transparent)]
    Message(#[from] MessageError),
    #[error("the map has {cells} cells; at most {most} are taken, see max_cells")]
    TooLarge { cells: u64, most: usize },
    #[error("an update of {width} × {height} at {x}, {y} is not inside the map")]
    Outside { x: i32, y: i32, width: u32, height: u32 },
}

fn read(message: &[u8], most: usize) -> Result<OccupancyGridMessage, Refused> {
    let grid: OccupancyGridMessage = from_cdr(message)?;
    let cells = u64::from(grid.info.width) * u64::from(grid.info.height);
    if usize::try_from(cells).map_or(true, |cells| cells > most) {
        return Err(Refused::TooLarge { cells, most });
    }
    // What is no map must not take the place of one.
    grid.to_map()?;
    Ok(grid)
}

/// Copies the cells of an update to where they belong.
fn write_into(
    grid: &mut OccupancyGridMessage,
    update: &OccupancyGridUpdate,
) -> Result<(), Refused> {
    let OccupancyGridUpdate { x, y, width, height, .. } = *update;
    let need = u64::from(width) * u64::from(height);
    if u64::try_from(update.data.len()) != Ok(need) {
        let found = update.data.len();
        return Err(MessageError::WrongLength { width, height, need, found }.into());
    }
    let outside = || Refused::Outside { x, y, width, height };
    let whole = |cells: u32| usize::try_from(cells).map_err(|_too_many| outside());
    let [columns, rows] = [whole(grid.info.width)?, whole(grid.info.height)?];
    let [width, height] = [whole(width)?, whole(height)?];
    let [left, low] = [x, y].map(usize::try_from);
    let (left, low) = (left.map_err(|_below| outside())?, low.map_err(|_below| outside())?);
    let fits = |from: usize, length: usize, most: usize| {
        from.checked_add(length).is_some_and(|end| end <= most)
    };
    if !fits(left, width, columns) || !fits(low, height, rows) {
        return Err(outside());
    }
    for (row, cells) in update.data.chunks_exact(width.max(1)).enumerate() {
        let from = (low + row) * columns + left;
        grid.data[from..from + width].copy_from_slice(cells);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{Intake, OccupancyGridUpdate, Time};
    use ogm_core::{GridFrame, OccupancyGrid, Se2};
    use ogm_io::ros::{Header, OccupancyGridMessage, to_cdr};

    fn map(ascii: &str) -> Vec<u8> {
        let frame = GridFrame::new(0.05, Se2::identity()).unwrap();
        let map = OccupancyGrid::from_ascii(frame, ascii).unwrap();
        to_cdr(&OccupancyGridMessage::from_map(Header::default(), &map).unwrap()).unwrap()
    }

    fn update(x: i32, y: i32, width: u32, height: u32, data: &[u8]) -> Vec<u8> {
        let data = data.to_vec();
        to_cdr(&OccupancyGridUpdate { x, y, width, height, data, ..Default::default() }).unwrap()
    }

    #[test]
    fn the_latest_map_waits_and_an_update_changes_it_where_it_says() {
        let mut intake = Intake::default();
        intake.put_map(map("###\n...\n"), Time::default());
        intake.put_map(map("...\n...\n"), Time::default());
        intake.put_update(update(1, 0, 2, 1, &[100, 255]), Time::default());
        let taken = intake.take(100).unwrap();
        assert_eq!(taken.to_ascii(), "...\n.#?\n");
        assert!(!intake.is_waiting());
        intake.put_update(update(0, 1, 1, 1, &[100]), Time::default());
        assert_eq!(intake.take(100).unwrap().to_ascii(), "#..\n.#?\n");
    }

    #[test]
    fn what_is_no_map_is_refused_with_its_reason_and_the_good_one_stays() {
        let mut intake = Intake::default();
        intake.put_map(map("###\n...\n"), Time::default());
        assert!(intake.take(100).is_some());
        let bad = [
            (map("#####\n"), "at most 4"),
            (update(2, 0, 2, 1, &[0, 0]), "not inside"),
            (update(-1, 0, 1, 1, &[0]), "not inside"),
            (update(0, 0, 2, 2, &[0]), "4 cells, but has 1"),
            (vec![1, 2, 3], "3 bytes"),
        ];
        for (count, (message, words)) in (1..).zip(bad) {
            if words == "at most 4" {
                intake.put_map(message, Time::default());
            } else {
                intake.put_update(message, Time::default());
            }
            assert!(intake.take(4).is_none());
            assert!(intake.trouble.contains(words), "{}", intake.trouble);
            assert_eq!(intake.refused, count);
        }
        intake.put_update(update(0, 0, 1, 1, &[100]), Time::default());
        assert_eq!(intake.take(100).unwrap().to_ascii(), "###\n#..\n");
    }

    #[test]
    fn an_update_before_any_map_is_nothing() {
        let mut intake = Intake::default();
        intake.put_update(update(0, 0, 1, 1, &[100]), Time::default());
        assert!(intake.take(100).is_none());
        assert!(!intake.is_waiting());
    }
}
