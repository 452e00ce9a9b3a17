//! Files that are about to be written.

use std::path::{Path, PathBuf};

use anyhow::{Context, bail};

/// Makes sure before the work that `outputs` can be meant: their folders exist, none is an input,
/// and none exists unless `force`.
pub(crate) fn check(outputs: &[&Path], inputs: &[&Path], force: bool) -> anyhow::Result<()> {
    let inputs: Vec<PathBuf> =
        inputs.iter().filter_map(|input| input.canonicalize().ok()).collect();
    let mut places: Vec<PathBuf> = Vec::new();
    for output in outputs {
        let name = output.display();
        let place = place(output)?;
        let target = output.canonicalize().unwrap_or_else(|_| place.clone());
        if inputs.contains(&place) || inputs.contains(&target) {
            bail!("{name} is an input and is never overwritten; name another output");
        }
        if places.contains(&place) {
            bail!("{name} is named for two outputs; name another");
        }
        if !force && output.symlink_metadata().is_ok() {
            bail!("{name} exists; name another output or overwrite it with --force");
        }
        places.push(place);
    }
    Ok(())
}

/// The file name in its folder, links of the folder resolved.
fn place(output: &Path) -> anyhow::Result<PathBuf> {
    let name = output.display();
    let file = output.file_name().with_context(|| format!("{name} is not a file name"))?;
    let folder = match output.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let folder = folder.canonicalize().with_context(|| {
        format!("cannot write {name}: the folder {} cannot be used", folder.display())
    })?;
    Ok(folder.join(file))
}

/// The image that goes beside the map `yaml`.
pub(crate) fn image_of(yaml: &Path) -> PathBuf {
    yaml.with_extension("pgm")
}
