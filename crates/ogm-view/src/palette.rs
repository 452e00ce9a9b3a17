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
/// Maps contradict each other here.
pub const CONFLICT: Rgb<u8> = Rgb([204, 0, 44]);
/// Of the first map, the second and so on, from the start again after eight (Okabe and Ito).
pub const MAPS: [Rgb<u8>; 8] = [
    TARGET_WALL,
    SOURCE_WALL,
    Rgb([0, 158, 115]),
    Rgb([204, 121, 167]),
    Rgb([86, 180, 233]),
    Rgb([230, 159, 0]),
    Rgb([120, 94, 240]),
    Rgb([150, 130, 20]),
];
