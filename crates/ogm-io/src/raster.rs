//! A decoded image: grey or colour, with or without alpha, top row first.

use ogm_core::Occupancy;

use crate::MapImageError;
use crate::allocate::room;

/// Pixels top row first, channels interleaved: grey, grey + alpha, RGB or RGBA.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Raster {
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// The sample that means full brightness.
    pub(crate) max: u16,
    pub(crate) channels: Channels,
    pub(crate) samples: Samples,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Channels {
    Grey,
    GreyAlpha,
    Rgb,
    RgbAlpha,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Samples {
    Narrow(Vec<u8>),
    Wide(Vec<u16>),
}

/// One pixel: the sum over its colour channels, and its alpha, full where there is none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Pixel {
    colour: u32,
    alpha: u32,
}

impl Channels {
    pub(crate) fn colours(self) -> u32 {
        match self {
            Self::Grey | Self::GreyAlpha => 1,
            Self::Rgb | Self::RgbAlpha => 3,
        }
    }

    pub(crate) fn has_alpha(self) -> bool {
        matches!(self, Self::GreyAlpha | Self::RgbAlpha)
    }

    pub(crate) fn count(self) -> usize {
        match self {
            Self::Grey => 1,
            Self::GreyAlpha => 2,
            Self::Rgb => 3,
            Self::RgbAlpha => 4,
        }
    }
}

impl Raster {
    /// The sum over the colour channels that means white.
    pub(crate) fn white(&self) -> u32 {
        self.channels.colours() * u32::from(self.max)
    }

    /// How many opaque pixels have each sum of colours, from 0 to white.
    pub(crate) fn counts(&self) -> Vec<usize> {
        if let (Channels::Grey, Samples::Narrow(samples)) = (self.channels, &self.samples) {
            return histogram(samples)[..=usize::from(self.max)].to_vec();
        }
        let mut counts = vec![0; self.white() as usize + 1];
        let opaque = u32::from(self.max);
        self.for_each_upwards(|pixel| {
            if pixel.alpha == opaque {
                counts[pixel.colour as usize] += 1;
            }
        });
        counts
    }

    /// The cell that `cells` holds for each pixel's sum of colours, lowest row first, as in a grid;
    /// unknown where a pixel is not opaque. An 8-bit grey image becomes its cells where it lies.
    pub(crate) fn into_cells(self, cells: &[Occupancy]) -> Result<Vec<Occupancy>, MapImageError> {
        match (self.channels, self.samples) {
            (Channels::Grey, Samples::Narrow(mut samples)) => {
                let mut cell_of = [Occupancy::UNKNOWN; 256];
                cell_of[..cells.len()].copy_from_slice(cells);
                flip(&mut samples, self.width);
                Ok(samples.into_iter().map(|level| cell_of[usize::from(level)]).collect())
            }
            (channels, samples) => {
                let mut grid = room(self.width * self.height)?;
                let opaque = u32::from(self.max);
                Self { channels, samples, ..self }.for_each_upwards(|pixel| {
                    let is_opaque = pixel.alpha == opaque;
                    grid.push(if is_opaque {
                        cells[pixel.colour as usize]
                    } else {
                        Occupancy::UNKNOWN
                    });
                });
                Ok(grid)
            }
        }
    }

    /// The grey image in which alpha counts as a fourth colour.
    pub(crate) fn with_alpha_averaged_in(&self) -> Result<Self, MapImageError> {
        let colours = 3 / self.channels.colours();
        // Four times 16 bits do not fit into 16.
        let (max, divisor) = if self.max > 255 { (self.max, 4) } else { (4 * self.max, 1) };
        let mut samples = room(self.width * self.height)?;
        self.for_each_upwards(|pixel| {
            let level = (colours * pixel.colour + pixel.alpha) / divisor;
            samples.push(u16::try_from(level).unwrap_or(max));
        });
        flip(&mut samples, self.width);
        Ok(Self { max, channels: Channels::Grey, samples: Samples::Wide(samples), ..*self })
    }

    /// Calls `f` with every pixel, lowest row first: the order of a grid.
    fn for_each_upwards(&self, f: impl FnMut(Pixel)) {
        match &self.samples {
            Samples::Narrow(samples) => self.walk(samples, f),
            Samples::Wide(samples) => self.walk(samples, f),
        }
    }

    fn walk<T: Copy + Into<u32>>(&self, samples: &[T], mut f: impl FnMut(Pixel)) {
        let channels = self.channels.count();
        let opaque = u32::from(self.max);
        for row in samples.chunks_exact(self.width * channels).rev() {
            match self.channels {
                Channels::Grey => {
                    row.iter().for_each(|&grey| f(Pixel { colour: grey.into(), alpha: opaque }));
                }
                Channels::GreyAlpha => row.as_chunks::<2>().0.iter().for_each(|&[grey, alpha]| {
                    f(Pixel { colour: grey.into(), alpha: alpha.into() });
                }),
                Channels::Rgb => row.as_chunks::<3>().0.iter().for_each(|&[r, g, b]| {
                    f(Pixel { colour: r.into() + g.into() + b.into(), alpha: opaque });
                }),
                Channels::RgbAlpha => row.as_chunks::<4>().0.iter().for_each(|&[r, g, b, a]| {
                    f(Pixel { colour: r.into() + g.into() + b.into(), alpha: a.into() });
                }),
            }
        }
    }
}

/// Turns rows upside down where they lie.
fn flip<T>(samples: &mut [T], width: usize) {
    let mut rows = samples.chunks_exact_mut(width);
    while let (Some(top), Some(bottom)) = (rows.next(), rows.next_back()) {
        top.swap_with_slice(bottom);
    }
}

/// How many samples have each value. Four counters in turn: a run of one value, of which maps are
/// made, would wait for its own counter.
fn histogram(samples: &[u8]) -> [usize; 256] {
    let mut counts = [[0_usize; 256]; 4];
    let (fours, rest) = samples.as_chunks::<4>();
    for four in fours {
        for (counts, &sample) in counts.iter_mut().zip(four) {
            counts[usize::from(sample)] += 1;
        }
    }
    let mut total = [0; 256];
    for (value, total) in total.iter_mut().enumerate() {
        *total = counts.iter().map(|counts| counts[value]).sum();
    }
    for &sample in rest {
        total[usize::from(sample)] += 1;
    }
    total
}
