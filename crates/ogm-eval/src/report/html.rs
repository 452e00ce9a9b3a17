//! The report as one HTML file that needs no other.

use super::{Criterion, Figure, Image, Report, Section, Table, interval, number};
use crate::draw::{escape, png_data_uri};

const STYLE: &str = include_str!("style.css");

/// A picture of more pixels across has a row to itself.
const WIDE: u32 = 640;

/// The whole report with style and pictures inside.
pub(crate) fn html(report: &Report) -> String {
    let title = escape(&report.title);
    let sections: String = report.sections.iter().map(section_html).collect();
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
         <header>\n<h1>{title}</h1>\n{}</header>\n{}{}<main>\n{sections}</main>\n</body>\n</html>\n",
        info(&report.info),
        contents(&report.sections),
        criteria(report),
    )
}

fn info(info: &[(String, String)]) -> String {
    let items = info.iter().map(|(name, value)| {
        format!("<div><dt>{}</dt><dd>{}</dd></div>\n", escape(name), escape(value))
    });
    format!("<dl>\n{}</dl>\n", items.collect::<String>())
}

fn contents(sections: &[Section]) -> String {
    let items = sections.iter().map(|section| {
        let failed = section.criteria.iter().any(|criterion| !criterion.pass);
        let note = if failed { " <strong class=\"fail\">✗ fails</strong>" } else { "" };
        format!(
            "<li><a href=\"#{}\"><span class=\"id\">{}</span> {}</a>{note}</li>\n",
            anchor(&section.id),
            escape(&section.id),
            escape(&section.title),
        )
    });
    format!("<nav>\n<h2>Contents</h2>\n<ol>\n{}</ol>\n</nav>\n", items.collect::<String>())
}

fn criteria(report: &Report) -> String {
    let row = |(section, one): (&Section, &Criterion)| {
        let (class, word) = verdict(one.pass);
        format!(
            "<tr class=\"{class}\"><td><span class=\"verdict\">{word}</span></td>\
             <td><a href=\"#{}\">{}</a></td><td>{}</td><td class=\"n\">{}</td>\
             <td class=\"n\">{}</td><td class=\"n\">{}</td></tr>\n",
            anchor(&section.id),
            escape(&one.id),
            escape(&one.statement),
            escape(one.paper.as_deref().unwrap_or("")),
            number(one.ours),
            interval(one.interval),
        )
    };
    let rows: String = report.criteria().map(row).collect();
    if rows.is_empty() {
        return rows;
    }
    format!(
        "<section id=\"criteria\">\n<h2>Criteria</h2>\n<p>{}.</p>\n<div class=\"scroll\"><table>\n\
         <thead><tr><th></th><th>id</th><th>criterion</th><th class=\"n\">paper</th>\
         <th class=\"n\">ours</th><th class=\"n\">95 % interval</th></tr></thead>\n\
         <tbody>\n{rows}</tbody>\n</table></div>\n</section>\n",
        report.verdict(),
    )
}

/// Class and words of an outcome: told by sign and word, not by colour alone.
fn verdict(pass: bool) -> (&'static str, &'static str) {
    if pass { ("pass", "✓ pass") } else { ("fail", "✗ FAIL") }
}

fn section_html(section: &Section) -> String {
    let mut text = format!(
        "<section id=\"{}\">\n<h2><span class=\"id\">{}</span> {}</h2>\n",
        anchor(&section.id),
        escape(&section.id),
        escape(&section.title),
    );
    for one in &section.criteria {
        let (class, word) = verdict(one.pass);
        text.push_str(&format!(
            "<p class=\"outcome {class}\"><span class=\"verdict\">{word}</span> {}: {} {}</p>\n",
            escape(&one.statement),
            number(one.ours),
            interval(one.interval),
        ));
    }
    for paragraph in section.paragraphs() {
        text.push_str(&format!("<p>{}</p>\n", escape(paragraph)));
    }
    text.extend(section.tables.iter().map(table));
    if !section.figures.is_empty() {
        let figures: String = section.figures.iter().map(figure).collect();
        text.push_str(&format!("<div class=\"figures\">\n{figures}</div>\n"));
    }
    text + "</section>\n"
}

fn table(table: &Table) -> String {
    let numeric = table.numeric_columns();
    let row = |tag: &str, cells: &[String]| -> String {
        let cells = cells.iter().enumerate().map(|(index, cell)| {
            let class = if numeric.get(index) == Some(&true) { " class=\"n\"" } else { "" };
            format!("<{tag}{class}>{}</{tag}>", escape(cell))
        });
        format!("<tr>{}</tr>\n", cells.collect::<String>())
    };
    let rows: String = table.rows.iter().map(|cells| row("td", cells)).collect();
    format!(
        "<div class=\"scroll\"><table>\n<caption>{}</caption>\n<thead>{}</thead>\n\
         <tbody>\n{rows}</tbody>\n</table></div>\n",
        escape(&table.caption),
        row("th", &table.header).trim_end(),
    )
}

fn figure(figure: &Figure) -> String {
    let caption = escape(&figure.caption);
    let image = match &figure.image {
        Image::Svg(svg) => svg.trim_end().to_owned(),
        Image::Png(bytes) => format!("<img src=\"{}\" alt=\"{caption}\">", png_data_uri(bytes)),
    };
    let name = anchor(&figure.name);
    let wide = matches!(&figure.image, Image::Png(bytes) if png_width(bytes) > Some(WIDE));
    let class = if wide { " class=\"wide\"" } else { "" };
    format!(
        "<figure{class} id=\"{name}\">\n{image}\n<figcaption>{caption}</figcaption>\n</figure>\n"
    )
}

/// The width that the header of a PNG file states, pixels.
fn png_width(bytes: &[u8]) -> Option<u32> {
    let field = bytes.get(16..20)?.try_into().ok()?;
    Some(u32::from_be_bytes(field))
}

/// `id` as the name of a place in the document.
fn anchor(id: &str) -> String {
    let keep = |character: char| {
        if character.is_alphanumeric() { character } else { '-' }
    };
    id.chars().map(keep).collect()
}

#[cfg(test)]
mod tests {
    use super::{html, png_width};
    use crate::report::{Report, sample};
    use ogm_view::png;

    #[test]
    fn every_text_is_escaped() {
        let text = html(&sample::report());
        for raw in ["<b>bold", "<log>", "First <p>", "<tags>", "<seeds>", "\"quoted\""] {
            assert!(!text.contains(raw), "{raw} stands as it came");
        }
        assert!(text.contains("A &lt;b&gt;bold&lt;/b&gt; &amp; &quot;quoted&quot; report"));
    }

    #[test]
    fn the_document_needs_no_other_file() {
        let text = html(&sample::report());
        assert!(text.contains("<svg viewBox=\"0 0 1 1\"></svg>"));
        assert!(text.contains("src=\"data:image/png;base64,iVBORw==\""));
        assert!(!text.contains("src=\"figures") && !text.contains("<link"));
        assert!(text.contains("prefers-color-scheme: dark"));
    }

    #[test]
    fn outcomes_are_told_in_words_and_numbers_align() {
        let text = html(&sample::report());
        assert!(text.contains("✓ pass") && text.contains("✗ FAIL"));
        assert!(text.contains("<a href=\"#X3a\">") && text.contains("<section id=\"X3a\">"));
        assert!(text.contains("<td class=\"n\">−0.5 ± 0.1</td>"));
        assert!(text.contains("<td>#1 &lt;tags&gt;</td>"));
        let opened = text.matches("<section").count();
        assert_eq!(opened, text.matches("</section>").count());
    }

    #[test]
    fn the_width_of_a_picture_is_read_from_its_file() {
        let file = png(&image::RgbImage::new(700, 2)).unwrap();
        assert_eq!(png_width(&file), Some(700));
        assert_eq!(png_width(b"\x89PNG"), None);
    }

    #[test]
    fn a_report_without_criteria_has_no_table_of_them() {
        assert!(!html(&Report::default()).contains("id=\"criteria\""));
    }
}
