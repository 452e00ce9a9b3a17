//! Colours of maps that stay apart for colour-blind readers.

use image::Rgb;

/// Never observed: mid grey with a hint of blue, which no probability has.
pub const UNKNOWN: Rgb<u8> = Rgb([140, 148, 162]);
/// Seen free by either of two maps.
pub const FREE: Rgb<u8> = Rgb([238, 238, 238]);
/// A wall of the target map only.
pub const TARGET_WALL: Rgb<u8> = Rgb([0, 114, 178]);
/// A wall of the source map only.
pub const SOURCE_WALL: Rgb<u8> = Rgb([213, 94, 0]);
/// A wall of both maps.
pub const COMMON_WALL: Rgb<u8> = Rgb([20, 20, 20]);
/// Neither map has seen it.
pub const BLANK: Rgb<u8> = Rgb([255, 255, 255]);

/// Walls of the maps of a team, with a name for each: the colours of Okabe and Ito.
const WALLS: [(Rgb<u8>, &str); 7] = [
    (TARGET_WALL, "blue"),
    (SOURCE_WALL, "orange"),
    (Rgb([0, 158, 115]), "green"),
    (Rgb([204, 121, 167]), "pink"),
    (Rgb([86, 180, 233]), "sky blue"),
    (Rgb([230, 159, 0]), "amber"),
    (Rgb([120, 94, 40]), "brown"),
];

/// The colour of the walls of the map at `place`, from 0; after seven they come again.
#[must_use]
pub fn wall_colour(place: usize) -> Rgb<u8> {
    WALLS[place % WALLS.len()].0
}

/// A word for [`wall_colour`].
#[must_use]
pub fn wall_colour_name(place: usize) -> &'static str {
    WALLS[place % WALLS.len()].1
}
