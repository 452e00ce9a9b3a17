//! Maps that an argument names.

use std::path::Path;

use ogm_core::Se2;

use crate::pose::transform;
use crate::usage::UsageError;

/// Whether two names are one file.
pub(crate) fn is_same(a: &Path, b: &Path) -> bool {
    a == b || matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

/// The pose of each of `maps` that the values of an option, `MAP.yaml=X,Y,DEG`, name.
pub(crate) fn poses_of(
    option: &str,
    maps: &[&Path],
    arguments: &[String],
) -> Result<Vec<Option<Se2>>, UsageError> {
    let mut poses: Vec<Option<Se2>> = vec![None; maps.len()];
    for argument in arguments {
        let wrong = |what: String| UsageError(format!("{option} {argument}: {what}"));
        let (name, pose) =
            argument.rsplit_once('=').ok_or_else(|| wrong("write MAP.yaml=X,Y,DEG".to_owned()))?;
        let pose = transform(pose).map_err(wrong)?;
        let named = maps.iter().position(|map| is_same(map, Path::new(name)));
        let named =
            named.ok_or_else(|| wrong(format!("names none of the maps: {}", listed(maps))))?;
        if poses[named].replace(pose).is_some() {
            return Err(wrong("this map has a pose already".to_owned()));
        }
    }
    Ok(poses)
}

/// The name of the frame of `map`, by its place on the command line, where `--frames` gives some.
pub(crate) fn frame_of(map: usize, frames: &[String]) -> String {
    match frames.get(map) {
        Some(frame) => frame.clone(),
        None => format!("robot{}/map", map + 1),
    }
}

fn listed(maps: &[&Path]) -> String {
    maps.iter().map(|map| map.display().to_string()).collect::<Vec<_>>().join(", ")
}
