//! The state of a run on disk.

use std::path::Path;

use anyhow::Context;
use ogm_core::Progress;
use ogm_ros::live::{Live, LiveParams, SavedLive};

/// Goes on where the file says, or begins if there is none.
pub(crate) fn resume(
    path: Option<&Path>,
    params: LiveParams,
    progress: &dyn Progress,
) -> anyhow::Result<Live> {
    let Some(path) = path.filter(|path| path.exists()) else {
        return Ok(Live::new(params)?);
    };
    let name = || format!("{}; move it away to begin anew", path.display());
    let bytes = std::fs::read(path).with_context(name)?;
    let saved: SavedLive = serde_json::from_slice(&bytes).with_context(name)?;
    Live::resume(saved, params, progress).with_context(name)
}

/// Writes the state, at once or not at all.
pub(crate) fn save(path: &Path, live: &Live) -> anyhow::Result<()> {
    let bytes = serde_json::to_vec(&live.save())?;
    Ok(ogm_io::write_file(path, &bytes, true)?)
}
