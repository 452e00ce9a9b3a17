//! What `ogm align --json` found elsewhere.

use std::path::{Path, PathBuf};

use anyhow::Context;
use ogm_merge::{Hypothesis, PairAlignment};
use serde::Deserialize;

use crate::answer::SCHEMA;
use crate::input::{Input, MapFile};
use crate::usage::UsageError;

#[derive(Deserialize)]
struct Found {
    schema: u32,
    target: MapFile,
    source: MapFile,
    hypotheses: Vec<Hypothesis>,
}

/// The alignments in a folder that are of pairs of `inputs`, in the order of their names. Those of
/// other maps are left out; one of another version of a map is an error.
pub(crate) fn read(folder: &Path, inputs: &[Input]) -> anyhow::Result<Vec<PairAlignment>> {
    let cannot_read = || format!("cannot read the folder {}", folder.display());
    let entries = std::fs::read_dir(folder).with_context(cannot_read)?;
    let mut files: Vec<PathBuf> = Vec::new();
    for entry in entries {
        let path = entry.with_context(cannot_read)?.path();
        if path.extension().is_some_and(|end| end == "json") {
            files.push(path);
        }
    }
    files.sort();
    if files.is_empty() {
        let message = format!("--alignments {}: no .json file in it", folder.display());
        return Err(UsageError(message).into());
    }
    let mut alignments = Vec::new();
    for file in files {
        alignments.extend(one(&file, inputs)?);
    }
    Ok(alignments)
}

fn one(path: &Path, inputs: &[Input]) -> anyhow::Result<Option<PairAlignment>> {
    let name = path.display();
    let text = std::fs::read(path).with_context(|| format!("cannot read {name}"))?;
    let found: Found = serde_json::from_slice(&text)
        .with_context(|| format!("{name} is not what ogm align --json writes"))?;
    if found.schema != SCHEMA {
        let schema = found.schema;
        anyhow::bail!("{name} has schema {schema}, not {SCHEMA}; align the two maps again");
    }
    let [target, source] = [&found.target, &found.source].map(|map| place(map, inputs, path));
    let (Some(target), Some(source)) = (target?, source?) else { return Ok(None) };
    let hypotheses = found.hypotheses;
    Ok((target != source).then_some(PairAlignment { target, source, hypotheses }))
}

/// Which of `inputs` a map is.
fn place(map: &MapFile, inputs: &[Input], path: &Path) -> anyhow::Result<Option<usize>> {
    if let Some(place) = inputs.iter().position(|input| input.sha256 == map.sha256) {
        return Ok(Some(place));
    }
    let is_named = |input: &&Input| input.yaml == Path::new(&map.file);
    match inputs.iter().find(is_named) {
        Some(input) => anyhow::bail!(
            "{} was made of another version of {}: its image had SHA-256 {}, and now has {}; \
             align the two maps again",
            path.display(),
            map.file,
            map.sha256,
            input.sha256
        ),
        None => Ok(None),
    }
}
