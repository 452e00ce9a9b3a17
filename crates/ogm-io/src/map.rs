//! Reading a map: a YAML and the image that it names.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::time::Duration;

use ogm_core::{GridFrame, MAX_CELLS, OccupancyGrid};

use crate::bounded::read_at_most;
use crate::lock::is_locked;
use crate::yaml_file::{HeldYaml, access, read_yaml};
#[cfg(feature = "bags")]
use crate::{
    BagError, BagMap, MapMode,
    bag::read_message,
    ros::{MessageError, OccupancyGridMessage, from_cdr},
};
use crate::{IoError, MapHeader, MapSize, MapWarning, ReadOptions};

/// Four bytes a cell: the largest plain PGM of 8 bits.
const MAX_IMAGE_BYTES: u64 = 4 * MAX_CELLS as u64;

/// How often, and how long apart, a map that is just being replaced is looked at again.
const ATTEMPTS: usize = 400;
const PAUSE: Duration = Duration::from_millis(5);
/// How often in a row neither a YAML nor its writer is there where there is none.
const ABSENCES: usize = 3;

/// A map as it was read, and what was noticed on the way.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadedMap {
    /// The cells and where they lie.
    pub map: OccupancyGrid,
    /// What the YAML says: mode, thresholds, negation.
    pub header: MapHeader,
    /// The image that was read.
    pub image: PathBuf,
    /// What the author of the file may not have meant.
    pub warnings: Vec<MapWarning>,
}

/// The files of a map, in memory and not yet decoded.
#[derive(Debug, Clone, PartialEq)]
pub struct MapFiles {
    header: MapHeader,
    image: PathBuf,
    image_bytes: Vec<u8>,
    warnings: Vec<MapWarning>,
    /// The bytes are those of a message.
    #[cfg(feature = "bags")]
    is_message: bool,
}

impl MapFiles {
    /// The YAML file `yaml` and its image, of the same moment: a pair that is replaced in between
    /// is read again.
    ///
    /// An image that is not where the YAML says is looked for beside it, by its name. With the feature
    /// `bags`, `yaml` may name a map of a bag, as in `team.mcap:/robot1/map@12.5`.
    ///
    /// # Errors
    /// A file that cannot be opened, a YAML that [`MapHeader::parse`] refuses, a bag without that map.
    pub fn read(yaml: &Path) -> Result<Self, IoError> {
        #[cfg(feature = "bags")]
        if let Some(map) = BagMap::parse(yaml).filter(|_| !yaml.exists()) {
            return Self::in_bag(&map);
        }
        let (mut before, mut absences) = (None, 0);
        for _ in 0..ATTEMPTS {
            let read = before.as_ref().map(|held: &HeldYaml| Self::behind(yaml, &held.text));
            match (read, HeldYaml::read(yaml)) {
                (Some(read), Ok(now)) if before.as_ref().is_some_and(|held| held.is(&now)) => {
                    return read;
                }
                (_, Ok(now)) => (before, absences) = (Some(now), 0),
                // Our own writer takes the YAML away while it replaces the image.
                (_, Err(IoError::Access { cause, .. }))
                    if cause.kind() == ErrorKind::NotFound && absences < ABSENCES =>
                {
                    before = None;
                    if is_locked(yaml) {
                        std::thread::sleep(PAUSE);
                    } else {
                        absences += 1;
                    }
                }
                (_, Err(error)) => return Err(error),
            }
        }
        let cause = io::Error::new(ErrorKind::ResourceBusy, "it is being replaced again and again");
        Err(access(yaml, cause))
    }

    /// The image `image`, which has no YAML, as a trinary map of the usual thresholds.
    ///
    /// # Errors
    /// A file that cannot be opened.
    pub fn read_picture(image: &Path, frame: GridFrame) -> Result<Self, IoError> {
        let header = MapHeader::without_yaml(image.to_owned(), frame);
        let (occupied_thresh, free_thresh) = (header.occupied_thresh, header.free_thresh);
        Ok(Self {
            header,
            image: image.to_owned(),
            image_bytes: read_at_most(image, MAX_IMAGE_BYTES)
                .map_err(|cause| access(image, cause))?,
            warnings: vec![MapWarning::NoYaml { occupied_thresh, free_thresh }],
            #[cfg(feature = "bags")]
            is_message: false,
        })
    }

    #[cfg(feature = "bags")]
    fn in_bag(map: &BagMap) -> Result<Self, IoError> {
        let image_bytes = read_message(map)?;
        let frame = *of_message(&map.bag, &image_bytes)?.frame();
        let mut header = MapHeader::without_yaml(map.bag.clone(), frame);
        header.mode = MapMode::Raw;
        Ok(Self {
            header,
            image: map.bag.clone(),
            image_bytes,
            warnings: Vec::new(),
            is_message: true,
        })
    }

    /// The size of the map that the YAML file `yaml` describes and where it lies, without reading
    /// its image.
    ///
    /// # Errors
    /// As [`read`](Self::read), and an image that has no size.
    pub fn size(yaml: &Path) -> Result<(MapSize, GridFrame), IoError> {
        #[cfg(feature = "bags")]
        if let Some(map) = BagMap::parse(yaml).filter(|_| !yaml.exists()) {
            let map = of_message(&map.bag, &read_message(&map)?)?;
            let (width, height) = (map.width(), map.height());
            let reading_bytes = 2 * (width as u64 * height as u64);
            return Ok((MapSize { width, height, reading_bytes }, *map.frame()));
        }
        let (header, _) = MapHeader::parse(&read_yaml(yaml)?)
            .map_err(|cause| IoError::Yaml { path: yaml.to_owned(), cause })?;
        let mut places = places(yaml, &header.image);
        let found = places.iter().position(|place| place.is_file());
        let size = MapSize::of_image(&places.swap_remove(found.unwrap_or(0)))?;
        Ok((size, header.frame))
    }

    /// The image file, byte for byte.
    #[must_use]
    pub fn image_bytes(&self) -> &[u8] {
        &self.image_bytes
    }

    /// The map in the files.
    ///
    /// # Errors
    /// An image that [`MapHeader::read_image`] refuses.
    pub fn decode(self, options: &ReadOptions) -> Result<LoadedMap, IoError> {
        #[cfg(feature = "bags")]
        if self.is_message {
            let Self { header, image, image_bytes, warnings, .. } = self;
            return Ok(LoadedMap {
                map: of_message(&image, &image_bytes)?,
                header,
                image,
                warnings,
            });
        }
        let Self { header, image, image_bytes, mut warnings, .. } = self;
        let (map, noticed) = header
            .read_image(image_bytes, options)
            .map_err(|cause| IoError::Image { path: image.clone(), cause })?;
        warnings.extend(noticed);
        Ok(LoadedMap { map, header, image, warnings })
    }

    /// What the text of a YAML leads to.
    fn behind(yaml: &Path, text: &[u8]) -> Result<Self, IoError> {
        let (header, mut warnings) = MapHeader::parse(text)
            .map_err(|cause| IoError::Yaml { path: yaml.to_owned(), cause })?;
        let places = places(yaml, &header.image);
        let mut failures = Vec::new();
        for image in &places {
            match read_at_most(image, MAX_IMAGE_BYTES) {
                Ok(image_bytes) => {
                    if *image != places[0] {
                        let (named, read) = (header.image.clone(), image.clone());
                        warnings.push(MapWarning::ImageElsewhere { named, read });
                    }
                    return Ok(Self {
                        header,
                        image: image.clone(),
                        image_bytes,
                        warnings,
                        #[cfg(feature = "bags")]
                        is_message: false,
                    });
                }
                Err(cause) => failures.push(cause),
            }
        }
        // What is wrong with the image that is named tells more than that there is no other.
        let cause = failures.swap_remove(0);
        Err(IoError::MissingImage { yaml: yaml.to_owned(), places, cause })
    }
}

/// The map in the bytes of a message.
#[cfg(feature = "bags")]
fn of_message(bag: &Path, bytes: &[u8]) -> Result<OccupancyGrid, IoError> {
    let message: Result<OccupancyGridMessage, MessageError> = from_cdr(bytes);
    message
        .and_then(|message| message.to_map())
        .map_err(|cause| IoError::Bag { path: bag.to_owned(), cause: BagError::Message(cause) })
}

/// Where the image of a YAML may lie, first where the YAML says.
fn places(yaml: &Path, named: &Path) -> Vec<PathBuf> {
    let folder = yaml.parent().unwrap_or(Path::new(""));
    let mut places = vec![folder.join(named)];
    let mut add = |place: PathBuf| {
        if !places.contains(&place) {
            places.push(place);
        }
    };
    let text = named.to_string_lossy();
    if let Some(name) = text.rsplit(['/', '\\']).next().filter(|name| !name.is_empty()) {
        add(folder.join(name));
    }
    if let Some(name) = named.file_name() {
        add(folder.join(name));
        // The YAML is in Latin-1, and the name of the file is not.
        #[cfg(unix)]
        if name.to_str().is_none() {
            use std::os::unix::ffi::OsStrExt;
            let name: String = name.as_bytes().iter().copied().map(char::from).collect();
            add(folder.join(name));
        }
    }
    places
}

/// Reads the map that the YAML file `yaml` describes.
///
/// # Errors
/// See [`read_map_with`].
pub fn read_map(yaml: &Path) -> Result<LoadedMap, IoError> {
    read_map_with(yaml, &ReadOptions::default())
}

/// Reads the map that the YAML file `yaml` describes, as `options` say.
///
/// ```no_run
/// use ogm_io::{ReadOptions, read_map_with};
///
/// // As nav2 reads it: what it saves as unknown comes back as free.
/// let options = ReadOptions { literal_205: true, ..ReadOptions::default() };
/// let map = read_map_with("map.yaml".as_ref(), &options)?.map;
/// # Ok::<(), ogm_io::IoError>(())
/// ```
///
/// # Errors
/// A file that cannot be opened, a YAML that [`MapHeader::parse`] refuses, an image that
/// [`MapHeader::read_image`] refuses.
pub fn read_map_with(yaml: &Path, options: &ReadOptions) -> Result<LoadedMap, IoError> {
    MapFiles::read(yaml)?.decode(options)
}
