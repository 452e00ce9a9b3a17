//! Maps that an argument names.

use std::path::Path;

use ogm_core::Se2;

use crate::pose::transform;
use crate::usage::UsageError;

/// Whether two names are one file.
pub(crate) fn is_same(a: &Path, b: &Path) -> bool {
    a == b || matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

/// The known pose of each of `maps`, from the values of `--transform`; the first map is the frame
/// unless it is named too. `None` where there are none.
pub(crate) fn transforms_of(
    maps: &[&Path],
    arguments: &[String],
) -> Result<Option<Vec<Se2>>, UsageError> {
    if arguments.is_empty() {
        return Ok(None);
    }
    let mut poses: Vec<Option<Se2>> = vec![None; maps.len()];
    for argument in arguments {
        let wrong = |what: String| UsageError(format!("--transform {argument}: {what}"));
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
    poses[0].get_or_insert_with(Se2::identity);
    let lacking: Vec<&Path> =
        maps.iter().zip(&poses).filter(|(_, pose)| pose.is_none()).map(|(map, _)| *map).collect();
    if !lacking.is_empty() {
        let lacking = listed(&lacking);
        let message = format!("--transform MAP.yaml=X,Y,DEG is needed for each of: {lacking}");
        return Err(UsageError(message));
    }
    Ok(Some(poses.into_iter().flatten().collect()))
}

fn listed(maps: &[&Path]) -> String {
    maps.iter().map(|map| map.display().to_string()).collect::<Vec<_>>().join(", ")
}
