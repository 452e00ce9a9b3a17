//! Which tag log belongs to which map.

use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use ogm_core::TagEstimate;
use ogm_io::read_tags;
use ogm_merge::{FilterParams, localise};

use crate::named::is_same;
use crate::usage::UsageError;

/// The tag log of each of `maps`, from the values of `--tags`.
pub(crate) fn logs_of(
    maps: &[&Path],
    arguments: &[String],
) -> Result<Vec<Option<PathBuf>>, UsageError> {
    let mut logs = vec![None; maps.len()];
    for argument in arguments {
        let (named, log) = split(maps, argument)?;
        for (map, slot) in maps.iter().zip(&mut logs) {
            if is_same(map, named) && slot.replace(PathBuf::from(log)).is_some() {
                let name = map.display();
                return Err(UsageError(format!("--tags names {name} twice; one log for each map")));
            }
        }
    }
    Ok(logs)
}

/// The two halves of `MAP.yaml=TAGS.csv`; file names may hold an equals sign themselves.
fn split<'a>(maps: &[&Path], argument: &'a str) -> Result<(&'a Path, &'a str), UsageError> {
    let halves = argument.match_indices('=').map(|(at, _)| {
        let (map, log) = (&argument[..at], &argument[at + 1..]);
        (Path::new(map), log)
    });
    let mut halves = halves.filter(|(_, log)| !log.is_empty()).peekable();
    if halves.peek().is_none() {
        return Err(UsageError(format!("--tags {argument}: write MAP.yaml=TAGS.csv")));
    }
    halves.find(|(named, _)| maps.iter().any(|map| is_same(map, named))).ok_or_else(|| {
        let names: Vec<_> = maps.iter().map(|map| map.display().to_string()).collect();
        UsageError(format!("--tags {argument} names none of the maps: {}", names.join(", ")))
    })
}

/// Where the tags of a log are, by a reader of these parameters.
pub(crate) fn localised(log: &Path, reader: &FilterParams) -> anyhow::Result<Vec<TagEstimate>> {
    let name = || log.display().to_string();
    let readings = read_tags(log)?;
    let tags = localise(&readings, reader, &()).with_context(name)?;
    if tags.is_empty() && !readings.is_empty() {
        let range = reader.max_range;
        bail!("{}: no range is one that a reader of {range} m gives; see --tag-range", name());
    }
    Ok(tags)
}
