//! The map message, and the grid in it.

use ogm_core::{Grid, GridFrame, Occupancy, OccupancyGrid};
use serde::{Deserialize, Serialize};

use super::basic::{Header, Pose, Time};
use super::error::MessageError;

/// `nav_msgs/msg/MapMetaData`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct MapMetaData {
    /// When the map was loaded, if it was.
    pub map_load_time: Time,
    /// Metres a cell.
    pub resolution: f32,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Pose of the lower left corner of cell (0, 0) in the frame of the header.
    pub origin: Pose,
}

/// `nav_msgs/msg/OccupancyGrid`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct OccupancyGridMessage {
    /// When, and in which frame.
    pub header: Header,
    /// Size and place.
    pub info: MapMetaData,
    /// An `int8` a cell, from the lowest row on: 100 times the probability of being occupied, or
    /// −1 for unknown.
    #[serde(with = "serde_bytes")]
    pub data: Vec<u8>,
}

/// What unknown is on the wire: −1.
const UNKNOWN: u8 = 0xff;

impl OccupancyGridMessage {
    /// How ROS 2 names the type.
    pub const TYPE: &'static str = "nav_msgs/msg/OccupancyGrid";

    /// The message of `map`; frame and time are the caller's.
    ///
    /// # Errors
    /// More rows or columns than 32 bits count.
    pub fn from_map(header: Header, map: &OccupancyGrid) -> Result<Self, MessageError> {
        let side = |cells: usize| {
            u32::try_from(cells)
                .map_err(|_too_many| MessageError::TooLarge { what: "a side of the map" })
        };
        let frame = map.frame();
        let info = MapMetaData {
            map_load_time: Time::default(),
            resolution: single(frame.resolution()),
            width: side(map.width())?,
            height: side(map.height())?,
            origin: frame.map_from_grid().into(),
        };
        Ok(Self { header, info, data: cells_to_bytes(map.cells().cells()) })
    }

    /// The map in the message.
    ///
    /// Values outside −1 to 100 mean nothing in ROS and are unknown here, as in `map_server`. A
    /// resolution is the shortest decimal number that its 32 bits stand for: 0.05, not
    /// 0.05000000074505806.
    ///
    /// # Errors
    /// Cells that do not fill the size; a size, resolution or origin that a grid cannot have; a
    /// tilted origin.
    pub fn to_map(&self) -> Result<OccupancyGrid, MessageError> {
        let MapMetaData { width, height, resolution, .. } = self.info;
        let (need, found) = (u64::from(width) * u64::from(height), self.data.len());
        if u64::try_from(found) != Ok(need) {
            return Err(MessageError::WrongLength { width, height, need, found });
        }
        let frame = GridFrame::new(shortest(resolution), self.info.origin.flat()?)?;
        let side = |cells: u32| {
            usize::try_from(cells)
                .map_err(|_too_many| MessageError::TooLarge { what: "a side of the map" })
        };
        let cells = bytes_to_cells(&self.data);
        Ok(OccupancyGrid::new(frame, Grid::new(side(width)?, side(height)?, cells)?))
    }
}

/// The cells of `int8` values.
pub(crate) fn bytes_to_cells(bytes: &[u8]) -> Vec<Occupancy> {
    let meaning: [Occupancy; 256] = std::array::from_fn(|byte| match u8::try_from(byte) {
        Ok(byte @ 0..=100) => Occupancy::from_probability(f64::from(byte) / 100.0),
        _ => Occupancy::UNKNOWN,
    });
    bytes.iter().map(|&byte| meaning[usize::from(byte)]).collect()
}

/// The `int8` values of cells.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 100")]
pub(crate) fn cells_to_bytes(cells: &[Occupancy]) -> Vec<u8> {
    let byte: [u8; 256] = std::array::from_fn(|stored| {
        let cell = u8::try_from(stored).map_or(Occupancy::UNKNOWN, Occupancy::from_byte);
        cell.probability().map_or(UNKNOWN, |p| (p * 100.0).round() as u8)
    });
    cells.iter().map(|cell| byte[usize::from(cell.byte())]).collect()
}

#[expect(clippy::cast_possible_truncation, reason = "the message has 32 bits for it")]
fn single(resolution: f64) -> f32 {
    resolution as f32
}

fn shortest(resolution: f32) -> f64 {
    resolution.to_string().parse().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::{Header, MessageError, OccupancyGridMessage, Pose, bytes_to_cells, cells_to_bytes};
    use crate::ros::{from_cdr, to_cdr};
    use ogm_core::{GridFrame, OccupancyGrid, Se2};

    fn message() -> OccupancyGridMessage {
        let frame = GridFrame::new(0.05, Se2::new(-1.0, 2.0, 0.3)).unwrap();
        let map = OccupancyGrid::from_ascii(frame, "###\n#.#\n#?#").unwrap();
        let header = Header { frame_id: "robot1/map".to_owned(), ..Header::default() };
        OccupancyGridMessage::from_map(header, &map).unwrap()
    }

    #[test]
    fn every_value_that_has_a_meaning_comes_back() {
        let bytes: Vec<u8> = (0..=100).chain([0xff]).collect();
        assert_eq!(cells_to_bytes(&bytes_to_cells(&bytes)), bytes);
    }

    #[test]
    fn a_map_comes_back_through_the_wire_with_its_decimal_resolution() {
        let message = message();
        let bytes = to_cdr(&message).unwrap();
        let back: OccupancyGridMessage = from_cdr(&bytes).unwrap();
        assert_eq!(back, message);
        let map = back.to_map().unwrap();
        assert_eq!(map.frame().resolution(), 0.05);
        assert_eq!(map.to_ascii(), "###\n#.#\n#?#\n");
        assert!((map.frame().map_from_grid().theta() - 0.3).abs() < 1e-12);
    }

    #[test]
    fn a_message_cut_anywhere_is_an_error_and_so_is_one_that_lies_about_its_length() {
        let bytes = to_cdr(&message()).unwrap();
        for length in 0..bytes.len() {
            assert!(from_cdr::<OccupancyGridMessage>(&bytes[..length]).is_err(), "{length} bytes");
        }
        let mut longer = bytes.clone();
        let length_at = bytes.len() - 9 - 4;
        longer[length_at..length_at + 4].copy_from_slice(&u32::MAX.to_le_bytes());
        assert!(from_cdr::<OccupancyGridMessage>(&longer).is_err());
    }

    #[test]
    fn a_header_that_promises_another_size_is_refused_without_room_for_it() {
        let mut message = message();
        (message.info.width, message.info.height) = (20_000, 20_000);
        let expected = MessageError::WrongLength {
            width: 20_000,
            height: 20_000,
            need: 400_000_000,
            found: 9,
        };
        assert_eq!(message.to_map().unwrap_err(), expected);
    }

    #[test]
    fn no_size_and_a_resolution_of_nan_or_zero_are_errors() {
        for resolution in [f32::NAN, 0.0, -0.05, f32::INFINITY] {
            let mut message = message();
            message.info.resolution = resolution;
            assert!(matches!(message.to_map(), Err(MessageError::Grid(_))), "{resolution}");
        }
        let mut message = message();
        (message.info.width, message.info.height, message.data) = (0, 0, Vec::new());
        assert!(matches!(message.to_map(), Err(MessageError::Grid(_))));
        let mut message = self::message();
        message.info.origin = Pose::from(Se2::new(f64::INFINITY, 0.0, 0.0));
        assert!(message.to_map().is_err());
    }
}
