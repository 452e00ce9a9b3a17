//! From brightness to occupancy, by the thresholds of the file.

use ogm_core::{Grid, Occupancy, OccupancyGrid};

use crate::decode::decode;
use crate::raster::{Pixel, Raster};
use crate::{MapHeader, MapImageError, MapMode, MapWarning};

/// The grey by which every `map_saver` means unknown.
pub(crate) const UNKNOWN_GREY: u8 = 205;
/// The grey by which every `map_saver` means free.
pub(crate) const FREE_GREY: u8 = 254;
/// The grey by which every `map_saver` means occupied.
pub(crate) const OCCUPIED_GREY: u8 = 0;

/// A trinary map has three levels and a hand-edited one a few more.
const TRINARY_LEVELS: usize = 16;

/// Where the reading deviates from `map_server` unless told not to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ReadOptions {
    /// Classify grey 205 by the thresholds even where that makes every unknown cell free.
    pub literal_205: bool,
    /// In trinary mode average alpha in with the colours, as `map_server` does.
    pub averaged_alpha: bool,
}

impl MapHeader {
    /// The map in the bytes of this header's image, PGM (P2, P5) or PNG, rows flipped so that
    /// row 0 is the lowest.
    ///
    /// Trinary: p = 0.90 occupied, 0.10 free, or unknown. Scale: p is 0 below `free_thresh`, 1
    /// above `occupied_thresh`, linear between. Raw: p = pixel / 100.
    ///
    /// # Errors
    /// Another format, a size over [`ogm_core::MAX_CELLS`], or data that do not fill it; found
    /// before anything larger than the file is allocated, but for a PNG's own pixels.
    pub fn read_image(
        &self,
        image: &[u8],
        options: &ReadOptions,
    ) -> Result<(OccupancyGrid, Vec<MapWarning>), MapImageError> {
        let raster = decode(image)?;
        let mut warnings = Vec::new();
        let mut cells = Vec::with_capacity(raster.width * raster.height);
        match self.mode {
            MapMode::Trinary => self.trinary(&raster, options, &mut cells, &mut warnings),
            MapMode::Scale => {
                raster.for_each_upwards(|pixel| cells.push(self.scale(&raster, pixel)))
            }
            MapMode::Raw => {
                if self.negate {
                    warnings.push(MapWarning::NegateIgnored);
                }
                raster.for_each_upwards(|pixel| cells.push(raw(&raster, pixel)));
            }
        }
        let grid = Grid::new(raster.width, raster.height, cells)?;
        Ok((OccupancyGrid::new(self.frame, grid), warnings))
    }

    fn trinary(
        &self,
        raster: &Raster,
        options: &ReadOptions,
        cells: &mut Vec<Occupancy>,
        warnings: &mut Vec<MapWarning>,
    ) {
        if raster.channels.has_alpha() && options.averaged_alpha {
            warnings.push(MapWarning::AlphaAveraged);
            let white = raster.white() + u32::from(raster.max);
            raster.for_each_upwards(|pixel| {
                cells.push(self.class(pixel.colour + pixel.alpha.unwrap_or(0), white));
            });
            return;
        }
        let survey = Survey::of(raster);
        if raster.channels.has_alpha() {
            warnings.push(MapWarning::AlphaLeftOut { translucent: survey.translucent });
        }
        if survey.levels > TRINARY_LEVELS {
            warnings.push(MapWarning::GreyLevels { levels: survey.levels });
        }
        let free_thresh = self.free_thresh;
        let unknown_level = raster.channels.colours() * u32::from(UNKNOWN_GREY);
        let suspicious = survey.only_saver_levels
            && survey.unknown_greys > 0
            && !self.negate
            && self.class(unknown_level, raster.white()) == Occupancy::FREE;
        let rescued = suspicious && !options.literal_205;
        if suspicious {
            let cells = survey.unknown_greys;
            warnings.push(if rescued {
                MapWarning::GreyReadAsUnknown { free_thresh, cells }
            } else {
                MapWarning::GreyReadAsFree { free_thresh, cells }
            });
        }
        raster.for_each_upwards(|pixel| {
            let unknown = !is_opaque(raster, pixel) || rescued && pixel.colour == unknown_level;
            cells.push(if unknown {
                Occupancy::UNKNOWN
            } else {
                self.class(pixel.colour, raster.white())
            });
        });
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

    fn scale(&self, raster: &Raster, pixel: Pixel) -> Occupancy {
        if !is_opaque(raster, pixel) {
            return Occupancy::UNKNOWN;
        }
        let occupied = self.occupied_fraction(pixel.colour, raster.white());
        let span = self.occupied_thresh - self.free_thresh;
        Occupancy::from_probability((occupied - self.free_thresh) / span)
    }

    /// One division of integers, so that a level on a threshold compares as in `map_server`.
    fn occupied_fraction(&self, level: u32, white: u32) -> f64 {
        let dark = if self.negate { level } else { white - level };
        f64::from(dark) / f64::from(white)
    }
}

fn raw(raster: &Raster, pixel: Pixel) -> Occupancy {
    let byte = (255.0 * f64::from(pixel.colour) / f64::from(raster.white())).round();
    if byte <= 100.0 { Occupancy::from_probability(byte / 100.0) } else { Occupancy::UNKNOWN }
}

fn is_opaque(raster: &Raster, pixel: Pixel) -> bool {
    pixel.alpha.is_none_or(|alpha| alpha == u32::from(raster.max))
}

/// Which levels the opaque pixels of an image have.
struct Survey {
    levels: usize,
    only_saver_levels: bool,
    unknown_greys: usize,
    translucent: usize,
}

impl Survey {
    fn of(raster: &Raster) -> Self {
        let mut counts = vec![0_usize; raster.white() as usize + 1];
        let mut translucent = 0;
        raster.for_each_upwards(|pixel| {
            if !is_opaque(raster, pixel) {
                translucent += 1;
            } else if let Some(count) = counts.get_mut(pixel.colour as usize) {
                *count += 1;
            }
        });
        let levels = counts.iter().filter(|&&count| count > 0).count();
        let of_grey = |grey: u8| {
            let level = raster.channels.colours() as usize * usize::from(grey);
            counts.get(level).copied().unwrap_or(0)
        };
        let greys = [OCCUPIED_GREY, UNKNOWN_GREY, FREE_GREY].map(of_grey);
        let saver_levels = greys.iter().filter(|&&count| count > 0).count();
        Self {
            levels,
            only_saver_levels: raster.max == 255 && levels == saver_levels,
            unknown_greys: greys[1],
            translucent,
        }
    }
}
