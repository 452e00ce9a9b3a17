//! An overlay that explains itself: legend, scale bar, and where the frames of the maps are.

use font8x8::UnicodeFonts;
use image::{Rgb, RgbImage};
use nalgebra::{Point2, Vector2};
use ogm_core::{OccupancyGrid, Se2};

use crate::ViewError;
use crate::overlay::placed_overlay;
use crate::palette::{BLANK, COMMON_WALL, wall_colour};
use crate::raster::enlarge;

/// Smaller overlays are enlarged to about this many pixels on their longer side.
const SMALLEST: u32 = 480;
/// Pixels of a letter, and of a line of letters.
const LETTER: u32 = 8;
const LINE: u32 = 14;
const MARGIN: u32 = 8;
/// Pixels of a frame's axes.
const AXIS: f64 = 28.0;
/// Metres on the picture of the longest motion, about, and how much longer than it is at most.
const LONGEST_M: f64 = 1.5;
const MOST_LONGER: f64 = 50.0;
const INK: Rgb<u8> = COMMON_WALL;
/// As in ROS: x red, y green.
const X_AXIS: Rgb<u8> = Rgb([204, 0, 44]);
const Y_AXIS: Rgb<u8> = Rgb([0, 140, 60]);

/// A map, where it lies, and what it is called.
#[derive(Debug, Clone, Copy)]
pub struct Named<'a> {
    /// The map.
    pub map: &'a OccupancyGrid,
    /// Maps its points into the frame of the first map.
    pub first_from_map: Se2,
    /// For the legend.
    pub name: &'a str,
}

/// A, B … Z, A again.
fn letter(place: usize) -> String {
    char::from(b'A' + u8::try_from(place % 26).unwrap_or(0)).to_string()
}

/// The end of a name, at most `letters` of it: paths differ there.
fn tail(name: &str, letters: usize) -> String {
    let count = name.chars().count();
    if count <= letters {
        return name.to_owned();
    }
    let kept = letters.saturating_sub(3);
    "...".chars().chain(name.chars().skip(count - kept)).collect()
}

/// [`overlay_all`](crate::overlay_all()) with what a reader needs: whose wall is which, by name, a
/// scale bar, and the axes of the map frames, A, B and so on, where they lie inside.
///
/// Letters outside ASCII are left blank, and of names that are too long the end is shown.
///
/// # Errors
/// Those of [`overlay_all`](crate::overlay_all()).
pub fn overlay_sheet(maps: &[Named<'_>]) -> Result<RgbImage, ViewError> {
    motion_sheet(maps, &[])
}

/// [`overlay_sheet`] with motions of places, each a place in the frame of the first map and how far
/// it was moved, metres: lines that end with a dot where the place went, so much longer than they
/// are that the longest has about a metre and a half, at most fifty times; the legend says how much.
///
/// # Errors
/// Those of [`overlay_all`](crate::overlay_all()).
pub fn motion_sheet(
    maps: &[Named<'_>],
    motions: &[(Point2<f64>, Vector2<f64>)],
) -> Result<RgbImage, ViewError> {
    let placed: Vec<_> = maps.iter().map(|map| (map.map, map.first_from_map)).collect();
    let overlay = placed_overlay(&placed)?;
    let longer = overlay.image.width().max(overlay.image.height());
    let enlarged = (SMALLEST / longer).max(1);
    let picture = enlarge(&overlay.image, enlarged);
    let width = picture.width().max(SMALLEST / 2);
    let extra = if motions.is_empty() { 2 } else { 3 };
    let lines = u32::try_from(maps.len()).unwrap_or(u32::MAX - extra).saturating_add(extra);
    let height = picture.height() + 2 * MARGIN + lines * LINE;
    let mut sheet = RgbImage::from_pixel(width, height, BLANK);
    image::imageops::replace(&mut sheet, &picture, 0, 0);

    for (place, map) in maps.iter().enumerate() {
        let pose = map.first_from_map;
        let pixel = |point: Point2<f64>| overlay.pixel_of(point).map(|at| at * f64::from(enlarged));
        let length = AXIS * overlay.metres_a_pixel() / f64::from(enlarged);
        let at = pixel(pose * Point2::origin());
        let inside = [(at[0], picture.width()), (at[1], picture.height())];
        if !inside.iter().all(|&(at, end)| (0.0..f64::from(end)).contains(&at)) {
            continue;
        }
        line(&mut sheet, at, pixel(pose * Point2::new(length, 0.0)), X_AXIS);
        line(&mut sheet, at, pixel(pose * Point2::new(0.0, length)), Y_AXIS);
        write(&mut sheet, [at[0] + 3.0, at[1] + 3.0].map(whole), &letter(place), INK);
    }

    let longest = motions.iter().map(|(_, motion)| motion.norm()).fold(0.0, f64::max);
    let longer =
        if longest > 0.0 { (LONGEST_M / longest).floor().clamp(1.0, MOST_LONGER) } else { 1.0 };
    for (place, motion) in motions {
        let pixel = |point: Point2<f64>| overlay.pixel_of(point).map(|at| at * f64::from(enlarged));
        let end = pixel(place + motion * longer);
        line(&mut sheet, pixel(*place), end, X_AXIS);
        fill(&mut sheet, end.map(|at| whole(at).saturating_sub(1)), [4, 4], X_AXIS);
    }

    let top = picture.height() + MARGIN;
    let letters = usize::try_from(width.saturating_sub(2 * MARGIN) / LETTER).unwrap_or(0);
    let named = |(place, map): (usize, &Named<'_>)| {
        let name = tail(map.name, letters.saturating_sub(4));
        (wall_colour(place), format!("{} {name}", letter(place)))
    };
    let mut legend: Vec<_> = maps.iter().enumerate().map(named).collect();
    legend.push((COMMON_WALL, "walls of several".to_owned()));
    if !motions.is_empty() {
        legend.push((X_AXIS, format!("motions, {longer:.0} x; most {longest:.2} m")));
    }
    for (row, (colour, text)) in (0..).zip(legend) {
        let y = top + row * LINE;
        fill(&mut sheet, [MARGIN, y], [LETTER, LETTER], colour);
        write(&mut sheet, [MARGIN + 2 * LETTER, y], &text, INK);
    }
    let metres_a_pixel = overlay.metres_a_pixel() / f64::from(enlarged);
    let (metres, label) = scale(0.3 * f64::from(width) * metres_a_pixel);
    let [bar, y] = [whole(metres / metres_a_pixel), top + (lines - 1) * LINE];
    fill(&mut sheet, [MARGIN, y + 3], [bar, 2], INK);
    for end in [MARGIN, MARGIN + bar.saturating_sub(1)] {
        fill(&mut sheet, [end, y], [1, LETTER], INK);
    }
    write(&mut sheet, [2 * MARGIN + bar, y], &label, INK);
    Ok(sheet)
}

/// The largest of 1, 2 and 5 times a power of ten that is not above `most` metres, and its name.
fn scale(most: f64) -> (f64, String) {
    let power = 10.0_f64.powf(most.log10().floor());
    let steps = [5.0, 2.0, 1.0].map(|step| step * power);
    let metres = steps.into_iter().find(|&metres| metres <= most).unwrap_or(power);
    let label = if metres >= 1.0 { format!("{metres:.0} m") } else { format!("{metres} m") };
    (metres, label)
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it saturates")]
fn whole(pixels: f64) -> u32 {
    pixels.round() as u32
}

fn put(image: &mut RgbImage, x: u32, y: u32, colour: Rgb<u8>) {
    if let Some(pixel) = image.get_pixel_mut_checked(x, y) {
        *pixel = colour;
    }
}

fn fill(image: &mut RgbImage, [left, top]: [u32; 2], [width, height]: [u32; 2], colour: Rgb<u8>) {
    for y in top..top + height {
        for x in left..left + width {
            put(image, x, y, colour);
        }
    }
}

/// Two pixels wide.
fn line(image: &mut RgbImage, from: [f64; 2], to: [f64; 2], colour: Rgb<u8>) {
    let steps = 2 * whole(AXIS);
    for step in 0..=steps {
        let share = f64::from(step) / f64::from(steps);
        let [x, y] = [0, 1].map(|axis| whole(from[axis] + share * (to[axis] - from[axis])));
        fill(image, [x, y], [2, 2], colour);
    }
}

fn write(image: &mut RgbImage, [left, top]: [u32; 2], text: &str, colour: Rgb<u8>) {
    for (place, letter) in (0..).zip(text.chars()) {
        let Some(rows) = font8x8::BASIC_FONTS.get(letter) else { continue };
        for (y, row) in (0..).zip(rows) {
            for x in (0..LETTER).filter(|x| row >> x & 1 == 1) {
                put(image, left + place * LETTER + x, top + y, colour);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Named, X_AXIS, Y_AXIS, overlay_sheet, scale, tail, whole};
    use crate::overlay::overlay;
    use ogm_core::{GridFrame, OccupancyGrid, Se2};

    #[test]
    fn a_sheet_is_the_overlay_enlarged_with_axes_at_the_origins_of_the_frames() {
        let frame = GridFrame::new(0.5, Se2::new(-10.0, -5.0, 0.0)).unwrap();
        let row = format!("#{}#\n", ".".repeat(38));
        let map = OccupancyGrid::from_ascii(frame, &row.repeat(20)).unwrap();
        let target_from_source = Se2::new(4.0, 2.0, 0.0);
        let bare = overlay(&map, &map, target_from_source).unwrap();
        let named = |first_from_map, name| Named { map: &map, first_from_map, name };
        let sheet =
            overlay_sheet(&[named(Se2::identity(), "a.yaml"), named(target_from_source, "b.yaml")])
                .unwrap();
        let enlarged = 480 / bare.width();
        assert_eq!(sheet.width(), enlarged * bare.width());
        assert!(sheet.height() > enlarged * bare.height());
        assert_eq!(sheet.get_pixel(2 * enlarged, 470 / 2), bare.get_pixel(2, 470 / 2 / enlarged));
        // The corner of the picture lies two cells beyond the corner of the target map.
        let pixel = |x: f64, y: f64| {
            let pixels = f64::from(enlarged) / 0.5;
            let from_left = whole((x + 11.0) * pixels);
            let from_top = f64::from(enlarged * bare.height()) - (y + 6.0) * pixels;
            *sheet.get_pixel(from_left, whole(from_top))
        };
        for (x, y) in [(0.0, 0.0), (4.0, 2.0)] {
            assert_eq!(pixel(x + 1.0, y), X_AXIS);
            assert_eq!(pixel(x, y + 1.0), Y_AXIS);
        }
    }

    #[test]
    fn of_a_long_name_the_end_is_shown() {
        assert_eq!(tail("maps/a.yaml", 11), "maps/a.yaml");
        assert_eq!(tail("a/long/way/to/map.yaml", 11), "...map.yaml");
        assert_eq!(tail("räume/grundriss.yaml", 9), "...s.yaml");
    }

    #[test]
    fn scale_bars_are_round_numbers_that_fit() {
        for (most, metres, label) in
            [(7.3, 5.0, "5 m"), (4.9, 2.0, "2 m"), (130.0, 100.0, "100 m"), (0.7, 0.5, "0.5 m")]
        {
            let (bar, name) = scale(most);
            assert!((bar - metres).abs() < 1e-9 && name == label, "{most}: {bar}, {name}");
        }
    }
}
