//! How the maps of a command line are read.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::Args;
use ogm_core::{GridFrame, Se2};
use ogm_io::{IoError, MapFiles, MapSize};
use ogm_merge::PoseDegrees;

use crate::memory::{self, Bytes, Work};

/// How maps are read.
#[derive(Debug, Args)]
pub(crate) struct ReadingArgs {
    /// An image that has no YAML, repeatable: RES metres a cell, the lower left corner at X,Y,DEG
    /// [default: 0,0,0]; it stands for the map of its name, or is one more
    #[arg(long = "input", value_name = "IMAGE=RES[,X,Y,DEG]")]
    pictures: Vec<Picture>,
    /// Most memory to take, such as 800M or 2G; more is refused before the work [default: what the
    /// machine, its control group or ulimit leaves]
    #[arg(long, value_name = "BYTES")]
    max_memory: Option<Bytes>,
}

/// An image and where it lies.
#[derive(Debug, Clone, PartialEq)]
struct Picture {
    image: PathBuf,
    frame: GridFrame,
}

impl ReadingArgs {
    /// The files of a map.
    pub(crate) fn files(&self, map: &Path) -> Result<MapFiles, IoError> {
        match self.frame_of(map) {
            Some(frame) => MapFiles::read_picture(map, frame),
            None => MapFiles::read(map),
        }
    }

    /// Refuses maps for which there is not enough memory.
    ///
    /// Maps that cannot be read are left to their reading.
    pub(crate) fn check_memory(&self, maps: &[&Path], work: Work) -> anyhow::Result<()> {
        let sizes: Vec<MapSize> =
            maps.iter().filter_map(|map| Some(self.size(map).ok()?.0)).collect();
        memory::check(&sizes, work, self.max_memory)
    }

    /// The numbers of cells of maps, where they can be read.
    pub(crate) fn cells(&self, maps: &[&Path]) -> Vec<u64> {
        maps.iter().filter_map(|map| Some(self.size(map).ok()?.0.cells())).collect()
    }

    /// How many cells of `resolution`, if given, a cell of `map` becomes.
    pub(crate) fn refinement(&self, map: &Path, resolution: Option<f64>) -> f64 {
        match (resolution, self.size(map)) {
            (Some(resolution), Ok((_, frame))) => (frame.resolution() / resolution).powi(2),
            _ => 1.0,
        }
    }

    fn size(&self, map: &Path) -> Result<(MapSize, GridFrame), IoError> {
        match self.frame_of(map) {
            Some(frame) => Ok((MapSize::of_image(map)?, frame)),
            None => MapFiles::size(map),
        }
    }

    fn frame_of(&self, map: &Path) -> Option<GridFrame> {
        self.pictures.iter().find(|picture| picture.image == map).map(|picture| picture.frame)
    }
}

impl FromStr for Picture {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let form =
            || "write IMAGE=RES or IMAGE=RES,X,Y,DEG: metres a cell, metres, degrees".to_owned();
        let (image, numbers) =
            text.rsplit_once('=').filter(|(image, _)| !image.is_empty()).ok_or_else(form)?;
        let numbers: Option<Vec<f64>> =
            numbers.split(',').map(|number| number.trim().parse().ok()).collect();
        let (resolution, [x_m, y_m, theta_deg]) = match numbers.as_deref() {
            Some(&[resolution]) => (resolution, [0.0; 3]),
            Some(&[resolution, x, y, theta]) => (resolution, [x, y, theta]),
            _ => return Err(form()),
        };
        let map_from_grid: Se2 = PoseDegrees { x_m, y_m, theta_deg }.into();
        let frame = GridFrame::new(resolution, map_from_grid).map_err(|error| error.to_string())?;
        Ok(Self { image: PathBuf::from(image), frame })
    }
}

/// The words of a command line, in which an image that only `--input` names is also named as a map,
/// right behind.
pub(crate) fn with_pictures_as_maps(words: impl Iterator<Item = OsString>) -> Vec<OsString> {
    let words: Vec<OsString> = words.collect();
    let mut all = Vec::with_capacity(words.len());
    let mut value_follows = false;
    for word in &words {
        all.push(word.clone());
        let text = word.to_str().unwrap_or("");
        let value = if value_follows { Some(text) } else { text.strip_prefix("--input=") };
        value_follows = !value_follows && text == "--input";
        let image = value.and_then(|value| value.rsplit_once('=')).map(|(image, _)| image);
        if let Some(image) = image.filter(|image| !image.is_empty() && !image.starts_with('-'))
            && !all.iter().chain(&words).any(|word| word == image)
        {
            all.push(image.into());
        }
    }
    all
}
