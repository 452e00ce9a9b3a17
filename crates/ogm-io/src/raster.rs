//! A decoded image: grey or colour, with or without alpha, top row first.

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

/// One pixel: the sum over its colour channels and, where there is one, its alpha.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Pixel {
    pub(crate) colour: u32,
    pub(crate) alpha: Option<u32>,
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

    /// Calls `f` with every pixel, lowest row first: the order of a grid.
    pub(crate) fn for_each_upwards(&self, f: impl FnMut(Pixel)) {
        match &self.samples {
            Samples::Narrow(samples) => self.walk(samples, f),
            Samples::Wide(samples) => self.walk(samples, f),
        }
    }

    fn walk<T: Copy + Into<u32>>(&self, samples: &[T], mut f: impl FnMut(Pixel)) {
        let channels = self.channels.count();
        for row in samples.chunks_exact(self.width * channels).rev() {
            for pixel in row.chunks_exact(channels) {
                let (colours, alpha) = if self.channels.has_alpha() {
                    pixel.split_at(channels - 1)
                } else {
                    (pixel, &[][..])
                };
                f(Pixel {
                    colour: colours.iter().map(|&sample| sample.into()).sum(),
                    alpha: alpha.first().map(|&sample| sample.into()),
                });
            }
        }
    }
}
