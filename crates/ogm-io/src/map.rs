//! Reading a map: a YAML and the image that it names.

use std::path::{Path, PathBuf};

use ogm_core::{MAX_CELLS, OccupancyGrid};

use crate::disk::read_at_most;
use crate::{IoError, MapHeader, MapWarning, ReadOptions};

/// A map YAML has seven keys; 64 KiB of them are something else.
const MAX_YAML_BYTES: u64 = 1 << 16;
/// Four bytes a cell: the largest plain PGM of 8 bits.
const MAX_IMAGE_BYTES: u64 = 4 * MAX_CELLS as u64;

/// A map as it was read, and what was noticed on the way.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadedMap {
    /// The cells and where they lie.
    pub map: OccupancyGrid,
    /// What the YAML says: mode, thresholds, negation.
    pub header: MapHeader,
    /// The image, resolved against the folder of the YAML.
    pub image: PathBuf,
    /// What the author of the file may not have meant.
    pub warnings: Vec<MapWarning>,
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
    let text = read_at_most(yaml, MAX_YAML_BYTES).map_err(|cause| IoError::Access {
        path: yaml.to_owned(),
        action: "read",
        cause,
    })?;
    let (header, mut warnings) =
        MapHeader::parse(&text).map_err(|cause| IoError::Yaml { path: yaml.to_owned(), cause })?;
    let folder = yaml.parent().unwrap_or(Path::new(""));
    let image = folder.join(&header.image);
    let bytes = read_at_most(&image, MAX_IMAGE_BYTES).map_err(|cause| IoError::MissingImage {
        yaml: yaml.to_owned(),
        image: image.clone(),
        cause,
    })?;
    let (map, noticed) = header
        .read_image(&bytes, options)
        .map_err(|cause| IoError::Image { path: image.clone(), cause })?;
    warnings.extend(noticed);
    Ok(LoadedMap { map, header, image, warnings })
}
