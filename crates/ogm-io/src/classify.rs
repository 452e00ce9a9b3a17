//! From brightness to occupancy, by the thresholds of the file.

use ogm_core::{Grid, Occupancy, OccupancyGrid};

use crate::decode::decode;
use crate::format::Format;
use crate::raster::Raster;
use crate::{MapHeader, MapImageError, MapMode, MapWarning};

/// The grey by which every `map_saver` means unknown.
pub(crate) const UNKNOWN_GREY: u8 = 205;
/// The grey by which every `map_saver` means free.
pub(crate) const FREE_GREY: u8 = 254;
/// The grey by which every `map_saver` means occupied.
pub(crate) const OCCUPIED_GREY: u8 = 0;

/// A trinary map has three levels and a hand-edited one a few more.
const TRINARY_LEVELS: usize = 16;

/// Pixels of grey 205 to one of another free shade in a map that was painted into; a map that means
/// free by shades has many of each.
const UNKNOWN_TO_SHADES: usize = 20;

/// Where the reading deviates from `map_server` unless told not to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ReadOptions {
    /// Classify grey 205 by the thresholds even where that makes every unknown cell free.
    pub literal_205: bool,
    /// In trinary mode average alpha in with the colours, as `map_server` does.
    pub averaged_alpha: bool,
}

impl MapHeader {
    /// The map in the bytes of this header's image, rows flipped so that row 0 is the lowest.
    ///
    /// PNM (P1 to P6), PNG, BMP, JPEG or TIFF, by content; colours count by their mean.
    /// Trinary: p = 0.90 occupied, 0.10 free, or unknown. Scale: p is 0 below `free_thresh`, 1
    /// above `occupied_thresh`, linear between. Raw: p = pixel / 100.
    ///
    /// # Errors
    /// Another format, a size over [`ogm_core::MAX_CELLS`], data that do not fill it, or no memory
    /// for them; sizes are checked before anything much larger than the file is allocated.
    pub fn read_image(
        &self,
        image: Vec<u8>,
        options: &ReadOptions,
    ) -> Result<(OccupancyGrid, Vec<MapWarning>), MapImageError> {
        let mut warnings = Vec::new();
        if Format::of(&image) == Some(Format::Jpeg) {
            warnings.push(MapWarning::Lossy);
        }
        let mut raster = decode(image)?;
        if self.mode == MapMode::Trinary && raster.channels.has_alpha() && options.averaged_alpha {
            warnings.push(MapWarning::AlphaAveraged);
            raster = raster.with_alpha_averaged_in()?;
        }
        let counts = raster.counts();
        let cells = match self.mode {
            MapMode::Trinary => self.trinary(&raster, &counts, options, &mut warnings),
            MapMode::Scale => of_levels(&counts, |level, white| self.scale(level, white)),
            MapMode::Raw => {
                if self.negate {
                    warnings.push(MapWarning::NegateIgnored);
                }
                of_levels(&counts, raw)
            }
        };
        let (width, height) = (raster.width, raster.height);
        let grid = Grid::new(width, height, raster.into_cells(&cells)?)?;
        Ok((OccupancyGrid::new(self.frame, grid), warnings))
    }

    /// What each level means.
    fn trinary(
        &self,
        raster: &Raster,
        counts: &[usize],
        options: &ReadOptions,
        warnings: &mut Vec<MapWarning>,
    ) -> Vec<Occupancy> {
        if raster.channels.has_alpha() {
            let opaque: usize = counts.iter().sum();
            let translucent = raster.width * raster.height - opaque;
            warnings.push(MapWarning::AlphaLeftOut { translucent });
        }
        let levels = counts.iter().filter(|&&count| count > 0).count();
        if levels > TRINARY_LEVELS {
            warnings.push(MapWarning::GreyLevels { levels });
        }
        let mut cells = of_levels(counts, |level, white| self.class(level, white));
        if let Some((level, count)) = self.saved_as_unknown(counts, &cells) {
            let free_thresh = self.free_thresh;
            warnings.push(if options.literal_205 {
                MapWarning::GreyReadAsFree { free_thresh, cells: count }
            } else {
                cells[level] = Occupancy::UNKNOWN;
                MapWarning::GreyReadAsUnknown { free_thresh, cells: count }
            });
        }
        cells
    }

    /// The level of grey 205, and how many pixels have it, where it was probably saved as unknown
    /// and the thresholds make it free: whoever means free by shades of grey has more than this one.
    /// Pixels that were painted afterwards, white, black or in a few greys, change nothing.
    fn saved_as_unknown(&self, counts: &[usize], cells: &[Occupancy]) -> Option<(usize, usize)> {
        let white = counts.len() - 1;
        if self.negate || !white.is_multiple_of(255) {
            return None;
        }
        let [level, saved_as_free] =
            [UNKNOWN_GREY, FREE_GREY].map(|grey| white / 255 * usize::from(grey));
        let count = counts[level];
        if count == 0 || cells[level] != Occupancy::FREE {
            return None;
        }
        let is_free_shade =
            |&(at, cell): &(usize, &Occupancy)| at < saved_as_free && *cell == Occupancy::FREE;
        let shades: usize =
            cells.iter().enumerate().filter(is_free_shade).map(|(at, _)| counts[at]).sum();
        (shades - count <= count / UNKNOWN_TO_SHADES).then_some((level, count))
    }

    fn class(&self, level: u32, white: u32) -> Occupancy {
        let occupied = self.occupied_fraction(level, white);
        if occupied > self.occupied_thresh {
            Occupancy::OCCUPIED
        } else if occupied < self.free_thresh {
            Occupancy::FREE
        } else {
            Occupancy::UNKNOWN
        }
    }

    fn scale(&self, level: u32, white: u32) -> Occupancy {
        let occupied = self.occupied_fraction(level, white);
        let span = self.occupied_thresh - self.free_thresh;
        Occupancy::from_probability((occupied - self.free_thresh) / span)
    }

    /// One division of integers, so that a level on a threshold compares as in `map_server`.
    fn occupied_fraction(&self, level: u32, white: u32) -> f64 {
        let dark = if self.negate { level } else { white - level };
        f64::from(dark) / f64::from(white)
    }
}

fn raw(level: u32, white: u32) -> Occupancy {
    let byte = (255.0 * f64::from(level) / f64::from(white)).round();
    if byte <= 100.0 { Occupancy::from_probability(byte / 100.0) } else { Occupancy::UNKNOWN }
}

/// What `cell` makes of each level that occurs.
fn of_levels(counts: &[usize], cell: impl Fn(u32, u32) -> Occupancy) -> Vec<Occupancy> {
    let white = u32::try_from(counts.len() - 1).unwrap_or(u32::MAX);
    (0..=white)
        .zip(counts)
        .map(|(level, &count)| if count > 0 { cell(level, white) } else { Occupancy::UNKNOWN })
        .collect()
}
