//! The report as Markdown, for a repository that shows it.

use super::{Report, Section, Table, interval, number};

/// The whole report; pictures are links into `figures/`.
pub(crate) fn markdown(report: &Report) -> String {
    let mut text = format!("# {}\n\n", inline(&report.title));
    for (name, value) in &report.info {
        text.push_str(&format!("- {}: {}\n", inline(name), inline(value)));
    }
    if report.criteria().next().is_some() {
        text.push_str(&format!("\n## Criteria\n\n{}.\n\n", report.verdict()));
        text.push_str(&markdown_table(&criteria_table(report)));
    }
    for section in &report.sections {
        text.push('\n');
        text.push_str(&section_text(section));
    }
    text
}

fn section_text(section: &Section) -> String {
    let mut text = format!("## {} {}\n", inline(&section.id), inline(&section.title));
    for paragraph in section.paragraphs() {
        text.push_str(&format!("\n{}\n", escape_tags(paragraph)));
    }
    for one in &section.tables {
        text.push_str(&format!("\n{}\n\n{}", inline(&one.caption), markdown_table(one)));
    }
    for figure in &section.figures {
        let caption = inline(&figure.caption).replace('[', "\\[").replace(']', "\\]");
        text.push_str(&format!("\n![{caption}]({})\n", figure.path()));
    }
    text
}

/// The criteria of all sections as one table.
fn criteria_table(report: &Report) -> Table {
    let header = ["", "id", "criterion", "paper", "ours", "95 % interval"];
    let rows = report.criteria().map(|(_, one)| {
        vec![
            if one.pass { "pass" } else { "**FAIL**" }.to_owned(),
            one.id.clone(),
            one.statement.clone(),
            one.paper.clone().unwrap_or_default(),
            number(one.ours),
            interval(one.interval),
        ]
    });
    Table {
        caption: String::new(),
        header: header.map(str::to_owned).to_vec(),
        rows: rows.collect(),
    }
}

/// The table without its caption.
pub(crate) fn markdown_table(table: &Table) -> String {
    let row = |cells: &[String]| -> String {
        let cells: Vec<String> = cells.iter().map(|cell| inline(cell)).collect();
        format!("| {} |\n", cells.join(" | "))
    };
    let numeric = table.numeric_columns();
    let rules = numeric.iter().map(|&numeric| if numeric { "--:" } else { "---" });
    let rule = format!("| {} |\n", rules.collect::<Vec<_>>().join(" | "));
    let rows: String = table.rows.iter().map(|cells| row(cells)).collect();
    row(&table.header) + &rule + &rows
}

/// Text that stays on its line and in its cell.
fn inline(text: &str) -> String {
    let words: Vec<&str> = text.split_whitespace().collect();
    escape_tags(&words.join(" ")).replace('|', "\\|")
}

/// Text in which nothing is an HTML tag; `<` at a space or a digit never is.
fn escape_tags(text: &str) -> String {
    text.replace('<', "&lt;")
}

#[cfg(test)]
mod tests {
    use super::markdown;
    use crate::report::sample;

    #[test]
    fn cells_stay_in_their_table() {
        let text = markdown(&sample::report());
        assert!(text.contains("| #1 &lt;tags> | −0.5 ± 0.1 | a \\| b |\n"), "{text}");
        assert!(text.contains("| #2 | – | two lines |\n"), "{text}");
        assert!(text.contains("| --- | --: | --- |\n"), "numbers to the right: {text}");
    }

    #[test]
    fn pictures_are_linked_and_failures_stand_out() {
        let text = markdown(&sample::report());
        let link = "![Spread \\[all\\] &lt;seeds>](figures/x3a-spread.svg)";
        assert!(text.contains(link), "{text}");
        assert!(text.contains("![Map](figures/x3a-map.png)"));
        assert!(text.contains("1 of 2 criteria hold."));
        assert!(
            text.contains("| **FAIL** | X3a.found | all found |  | – | [-inf, 1.000] |"),
            "{text}"
        );
    }
}
