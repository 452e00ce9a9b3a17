//! The result tables and the pictures inside a document that quotes them.

use std::path::Path;

use anyhow::{Context, ensure};

use super::markdown::markdown_table;
use super::splice::splice;
use super::write::write_file;
use super::{Image, Report, Section};

/// What a document shows between the markers of one name.
struct Quote {
    marker: &'static str,
    sections: &'static [&'static str],
    /// Only the first table of a section, its result, without those that explain it.
    first_table: bool,
    /// A figure that the document shows, and where that is, beside the document.
    picture: Option<(&'static str, &'static str)>,
}

const QUOTES: [Quote; 4] = [
    Quote {
        marker: "results",
        sections: &["X3", "X4", "X8a", "pairs"],
        first_table: true,
        picture: Some(("merge", "docs/merge.png")),
    },
    Quote {
        marker: "reliability",
        sections: &["X7"],
        first_table: false,
        picture: Some(("reliability", "reliability.svg")),
    },
    Quote { marker: "teams", sections: &["X9"], first_table: false, picture: None },
    Quote {
        marker: "bend",
        sections: &["X10", "X10 pairs"],
        first_table: false,
        picture: Some(("bend", "bend.png")),
    },
];

/// Replaces what the document says between its markers, and its pictures.
pub(crate) fn quote_in(document: &Path, report: &Report) -> anyhow::Result<()> {
    let mut text = std::fs::read_to_string(document)
        .with_context(|| format!("cannot read {}", document.display()))?;
    let command = report.info.first().map_or("", |(_, command)| command.as_str());
    let quotes = || QUOTES.iter().filter(|quote| text.contains(&marker(quote)));
    ensure!(
        quotes().next().is_some(),
        "{} has none of the markers {}",
        document.display(),
        QUOTES.each_ref().map(marker).join(", ")
    );
    for quote in quotes().collect::<Vec<_>>() {
        text = splice(&text, quote.marker, &content(quote, report), command)
            .with_context(|| format!("in {}", document.display()))?;
        let Some((name, path)) = quote.picture else { continue };
        let figures = report.sections.iter().flat_map(|section| &section.figures);
        for figure in figures.filter(|figure| figure.name == name) {
            let bytes = match &figure.image {
                Image::Png(bytes) => bytes,
                Image::Svg(text) => text.as_bytes(),
            };
            write_file(&document.with_file_name(path), bytes)?;
        }
    }
    write_file(document, text.as_bytes())
}

fn marker(quote: &Quote) -> String {
    format!("<!-- BEGIN: {} -->", quote.marker)
}

fn content(quote: &Quote, report: &Report) -> String {
    let mut content = String::new();
    let quoted = |section: &&Section| quote.sections.contains(&section.id.as_str());
    for section in report.sections.iter().filter(quoted) {
        content.push_str(&format!("### {}\n\n", section.title));
        let shown = if quote.first_table { 1 } else { section.tables.len() };
        for table in section.tables.iter().take(shown) {
            content.push_str(&markdown_table(table));
            content.push_str(&format!("\n{}\n\n", table.caption));
        }
    }
    content
}
