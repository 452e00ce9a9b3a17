//! The result tables and the picture inside a document that quotes them.

use std::path::Path;

use anyhow::Context;

use crate::report::{self, Image, Report};

/// Sections whose result the document quotes; the others are worked examples.
const QUOTED: [&str; 3] = ["X3", "X4", "pairs"];

/// Figure that the document shows, as `docs/<name>.png` beside it.
const PICTURE: &str = "merge";

/// Replaces what the document says between its result markers, and its picture.
pub(super) fn into_document(document: &Path, report: &Report) -> anyhow::Result<()> {
    let text = std::fs::read_to_string(document)
        .with_context(|| format!("cannot read {}", document.display()))?;
    let mut content = String::new();
    for section in report.sections.iter().filter(|section| QUOTED.contains(&section.id.as_str())) {
        // The first table of a section is its result; the others explain it.
        if let Some(table) = section.tables.first() {
            content.push_str(&format!("### {}\n\n", section.title));
            content.push_str(&report::markdown_table(table));
            content.push_str(&format!("\n{}\n", table.caption));
            content.push('\n');
        }
    }
    let command = report.info.first().map_or("", |(_, command)| command.as_str());
    let spliced = report::splice(&text, "results", &content, command)
        .with_context(|| format!("in {}", document.display()))?;
    let figures = report.sections.iter().flat_map(|section| &section.figures);
    for figure in figures.filter(|figure| figure.name == PICTURE) {
        if let Image::Png(bytes) = &figure.image {
            let path = document.with_file_name("docs").join(format!("{PICTURE}.png"));
            report::write_file(&path, bytes)?;
        }
    }
    report::write_file(document, spliced.as_bytes())
}
