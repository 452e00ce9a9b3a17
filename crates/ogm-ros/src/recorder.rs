//! What the node publishes, into a bag.

use std::fs::{self, File};
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use ogm_io::{BagError, BagTopic, BagWriter, IoError, TopicId, write_file};

use crate::live::{Message, Output};

/// A bag that is being written: an MCAP file if its name ends so, else a folder that `ros2 bag`
/// plays.
#[derive(Debug)]
pub struct Recorder {
    bag: BagWriter<BufWriter<File>>,
    topics: Vec<(Output, TopicId)>,
    path: PathBuf,
    /// For the `metadata.yaml`, where there is one.
    folder: Option<PathBuf>,
}

impl Recorder {
    /// Begins a bag for all outputs; `merged_map` is the topic of the merged map.
    ///
    /// # Errors
    /// A bag that exists, a folder that cannot be written.
    pub fn create(path: &Path, merged_map: &str) -> Result<Self, IoError> {
        let access = |cause| IoError::Access { path: path.to_owned(), action: "write", cause };
        let (file, folder) = if path.extension().is_some_and(|end| end == "mcap") {
            (path.to_owned(), None)
        } else {
            fs::create_dir(path).map_err(access)?;
            (path.join(file_name(path)), Some(path.to_owned()))
        };
        let opened = File::create_new(&file).map_err(access)?;
        let failed = |cause| IoError::Bag { path: file.clone(), cause };
        let mut bag = BagWriter::new(BufWriter::new(opened)).map_err(failed)?;
        let mut topics = Vec::new();
        for output in Output::ALL {
            let (name, kind) = (output.topic(merged_map), output.kind());
            let topic = BagTopic { name, kind, definition: output.definition() };
            topics.push((output, bag.add(&topic).map_err(failed)?));
        }
        Ok(Self { bag, topics, path: file, folder })
    }

    /// Adds a message.
    ///
    /// # Errors
    /// A disk that is full.
    pub fn write(&mut self, message: &Message, time_ns: u64) -> Result<(), IoError> {
        let topic = self.topics.iter().find(|(output, _)| *output == message.output);
        let Some((_, topic)) = topic else {
            return Ok(());
        };
        let written = self.bag.write(*topic, time_ns, &message.bytes);
        written.map_err(|cause| IoError::Bag { path: self.path.clone(), cause })
    }

    /// Ends the bag; one that is not ended can be recovered up to what the disk holds of it.
    ///
    /// # Errors
    /// A disk that is full.
    pub fn finish(self) -> Result<(), IoError> {
        let Self { bag, path, folder, .. } = self;
        let failed = |cause: BagError| IoError::Bag { path: path.clone(), cause };
        let (file, metadata) =
            bag.finish(&file_name(folder.as_deref().unwrap_or(&path))).map_err(failed)?;
        let access = |cause| IoError::Access { path: path.clone(), action: "write", cause };
        file.into_inner()
            .map_err(|error| access(error.into_error()))?
            .sync_all()
            .map_err(access)?;
        match folder {
            Some(folder) => write_file(&folder.join("metadata.yaml"), metadata.as_bytes(), false),
            None => Ok(()),
        }
    }
}

/// As `ros2 bag` names the first file in the folder of a bag.
fn file_name(folder: &Path) -> String {
    let name = folder.file_name().map_or_else(|| "bag".into(), |name| name.to_string_lossy());
    format!("{name}_0.mcap")
}
