//! The files of a report.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use anyhow::{Context, ensure};

use super::{Image, Report, html, markdown, summary_json};

/// Writes `report.html`, `report.md`, `summary.json` and `figures/` into `out_dir`, which is
/// created; each file appears whole or not at all. Other files there stay.
///
/// # Errors
/// A file that cannot be written, or figures whose names are no file names or stand twice; nothing
/// is written then.
pub(crate) fn write_all(report: &Report, out_dir: &Path) -> anyhow::Result<()> {
    let figures = || report.sections.iter().flat_map(|section| &section.figures);
    let mut seen = BTreeSet::new();
    for figure in figures() {
        let name = &figure.name;
        let plain = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'-' || byte == b'_';
        ensure!(!name.is_empty() && name.bytes().all(plain), "{name:?} is no name for a figure");
        ensure!(seen.insert(name), "two figures are called {name:?}");
    }
    for figure in figures() {
        let bytes = match &figure.image {
            Image::Svg(text) => text.as_bytes(),
            Image::Png(bytes) => bytes,
        };
        write_file(&out_dir.join(figure.path()), bytes)?;
    }
    write_file(&out_dir.join("summary.json"), summary_json(report)?.as_bytes())?;
    write_file(&out_dir.join("report.md"), markdown(report).as_bytes())?;
    write_file(&out_dir.join("report.html"), html(report).as_bytes())
}

/// Writes `bytes` beside `path` and renames them into place; the folder is created.
///
/// # Errors
/// A folder or file that cannot be written.
pub(crate) fn write_file(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)
            .with_context(|| format!("cannot create {}", folder.display()))?;
    }
    let mut partial = path.as_os_str().to_owned();
    partial.push(".partial");
    let partial = Path::new(&partial);
    fs::write(partial, bytes)
        .and_then(|()| fs::rename(partial, path))
        .with_context(|| format!("cannot write {}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::{write_all, write_file};
    use crate::report::sample;
    use std::fs;

    #[test]
    fn every_file_is_there_and_no_partial_one() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("deep/compare");
        write_all(&sample::report(), &out).unwrap();
        let names = |folder: &std::path::Path| {
            let entries = fs::read_dir(folder).unwrap();
            let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name()).collect();
            names.sort();
            names
        };
        assert_eq!(names(&out), ["figures", "report.html", "report.md", "summary.json"]);
        assert_eq!(names(&out.join("figures")), ["x3a-map.png", "x3a-spread.svg"]);
        assert_eq!(fs::read(out.join("figures/x3a-map.png")).unwrap(), b"\x89PNG");
    }

    #[test]
    fn figures_cannot_leave_their_folder_or_replace_each_other() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["../escape", "", "x3a-map"] {
            let mut report = sample::report();
            report.sections[0].figures[0].name = name.to_owned();
            assert!(write_all(&report, folder.path()).is_err(), "{name:?}");
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "nothing was written");
    }

    #[test]
    fn a_file_that_cannot_be_written_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let blocker = folder.path().join("blocker");
        write_file(&blocker, b"x").unwrap();
        let error = write_file(&blocker.join("child"), b"y").unwrap_err();
        assert!(error.to_string().contains("blocker"), "{error}");
    }
}
