//! A report: what was measured, against what, and the files that say so.

mod csv;
pub(crate) mod format;
mod html;
mod json;
mod markdown;
mod quote;
mod splice;
mod write;

pub(crate) use csv::csv;
pub(crate) use html::html;
pub(crate) use json::summary_json;
pub(crate) use markdown::{markdown, markdown_table};
pub(crate) use quote::quote_in;
pub(crate) use splice::splice;
pub(crate) use write::{write_all, write_file};

/// All experiments of one run.
#[derive(Debug, Clone, Default)]
pub(crate) struct Report {
    /// Heading of the document.
    pub(crate) title: String,
    /// What a reader needs to repeat the run, as name and value: command, seeds, version, machine.
    pub(crate) info: Vec<(String, String)>,
    /// One experiment each, in the order of the report.
    pub(crate) sections: Vec<Section>,
}

/// One experiment.
#[derive(Debug, Clone, Default)]
pub(crate) struct Section {
    /// Its short name, such as `X3a`; unique in the report.
    pub(crate) id: String,
    /// Its heading.
    pub(crate) title: String,
    /// What it asks and what the numbers mean: paragraphs separated by blank lines.
    pub(crate) analysis: String,
    /// Numbers.
    pub(crate) tables: Vec<Table>,
    /// Pictures.
    pub(crate) figures: Vec<Figure>,
    /// What decides whether it succeeded.
    pub(crate) criteria: Vec<Criterion>,
}

impl Section {
    /// The texts of the analysis between its blank lines.
    fn paragraphs(&self) -> impl Iterator<Item = &str> {
        let texts = self.analysis.split("\n\n").map(str::trim);
        texts.filter(|paragraph| !paragraph.is_empty())
    }
}

/// Rows under a header.
#[derive(Debug, Clone, Default)]
pub(crate) struct Table {
    /// What the rows are.
    pub(crate) caption: String,
    /// One name a column, with the unit.
    pub(crate) header: Vec<String>,
    /// Cells, as many a row as the header has.
    pub(crate) rows: Vec<Vec<String>>,
}

impl Table {
    /// For each column whether it holds numbers: those align to the right.
    fn numeric_columns(&self) -> Vec<bool> {
        let column = |index: usize| self.rows.iter().filter_map(move |row| row.get(index));
        (0..self.header.len())
            .map(|index| {
                let mut cells = column(index).filter(|cell| !is_placeholder(cell)).peekable();
                cells.peek().is_some() && cells.all(|cell| is_number(cell))
            })
            .collect()
    }
}

/// A picture with its name.
#[derive(Debug, Clone)]
pub(crate) struct Figure {
    /// Name of its file without the ending: letters, digits, `-`, `_`; unique in the report.
    pub(crate) name: String,
    /// What it shows.
    pub(crate) caption: String,
    /// The picture.
    pub(crate) image: Image,
}

impl Figure {
    /// Its place relative to the report.
    fn path(&self) -> String {
        let ending = match self.image {
            Image::Svg(_) => "svg",
            Image::Png(_) => "png",
        };
        format!("figures/{}.{ending}", self.name)
    }
}

/// A picture in the bytes of its file.
#[derive(Debug, Clone)]
pub(crate) enum Image {
    /// An `<svg>` element without an XML declaration.
    Svg(String),
    /// A PNG file.
    Png(Vec<u8>),
}

/// A statement that a measurement decides.
#[derive(Debug, Clone)]
pub(crate) struct Criterion {
    /// Its short name, unique in the report.
    pub(crate) id: String,
    /// What must hold, such as "σ ≤ 0.5598°".
    pub(crate) statement: String,
    /// What the paper reports.
    pub(crate) paper: Option<String>,
    /// What was measured; NaN if nothing could be.
    pub(crate) ours: f64,
    /// 95 % interval of the measurement.
    pub(crate) interval: Option<(f64, f64)>,
    /// Whether it holds.
    pub(crate) pass: bool,
}

impl Report {
    /// Every criterion with the section that it belongs to.
    pub(crate) fn criteria(&self) -> impl Iterator<Item = (&Section, &Criterion)> {
        let sections = self.sections.iter();
        sections.flat_map(|section| section.criteria.iter().map(move |one| (section, one)))
    }

    /// "14 of 15 criteria hold".
    pub(crate) fn verdict(&self) -> String {
        let held = self.criteria().filter(|(_, criterion)| criterion.pass).count();
        format!("{held} of {} criteria hold", self.criteria().count())
    }
}

/// `value` with four significant digits; a dash for what is not a number.
pub(crate) fn number(value: f64) -> String {
    if value.is_nan() {
        return "–".to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    if value.is_infinite() {
        return value.to_string();
    }
    // Rounding first, so that 9.9999 counts as 10.
    let scientific = format!("{value:.3e}");
    let exponent = scientific.rsplit('e').next().and_then(|power| power.parse::<i32>().ok());
    match exponent.unwrap_or(0) {
        power @ -3..=3 => {
            let decimals = usize::try_from(3 - power).unwrap_or(0);
            format!("{value:.decimals$}")
        }
        4 | 5 => format!("{value:.0}"),
        _ => scientific,
    }
}

/// "[low, high]", or nothing.
fn interval(interval: Option<(f64, f64)>) -> String {
    interval.map_or_else(String::new, |(low, high)| format!("[{}, {}]", number(low), number(high)))
}

fn is_placeholder(cell: &str) -> bool {
    matches!(cell.trim(), "" | "-" | "–" | "—" | "NaN" | "n/a")
}

/// Whether the cell reads as a number, perhaps with a unit or a spread: "−3.2 ± 0.1 px", "97 %".
fn is_number(cell: &str) -> bool {
    let digits =
        cell.trim().trim_start_matches(['+', '-', '−', '<', '>', '≤', '≥', '~', ' ', '[', '(']);
    digits.starts_with(|character: char| character.is_ascii_digit()) || digits == "inf"
}

#[cfg(test)]
mod sample {
    use super::{Criterion, Figure, Image, Report, Section, Table};

    /// A report whose every text tries to leave its place.
    pub(super) fn report() -> Report {
        let text = |text: &str| text.to_owned();
        Report {
            title: text("A <b>bold</b> & \"quoted\" report"),
            info: vec![(text("command"), text("cargo xtask compare --seed 1 | tee <log>"))],
            sections: vec![Section {
                id: text("X3a"),
                title: text("Turns | angles"),
                analysis: text("First <p> paragraph.\nStill first.\n\nSecond."),
                tables: vec![Table {
                    caption: text("Turn & spread"),
                    header: vec![text("method"), text("σ [°]"), text("note")],
                    rows: vec![
                        vec![text("#1 <tags>"), text("−0.5 ± 0.1"), text("a | b")],
                        vec![text("#2"), text("–"), text("two\nlines")],
                    ],
                }],
                figures: vec![
                    Figure {
                        name: text("x3a-spread"),
                        caption: text("Spread [all] <seeds>"),
                        image: Image::Svg(text("<svg viewBox=\"0 0 1 1\"></svg>\n")),
                    },
                    Figure {
                        name: text("x3a-map"),
                        caption: text("Map"),
                        image: Image::Png(vec![0x89, b'P', b'N', b'G']),
                    },
                ],
                criteria: vec![
                    Criterion {
                        id: text("X3a.sigma"),
                        statement: text("σ < 0.56°"),
                        paper: Some(text("0.5598")),
                        ours: 0.434,
                        interval: Some((0.4, 0.47)),
                        pass: true,
                    },
                    Criterion {
                        id: text("X3a.found"),
                        statement: text("all found"),
                        paper: None,
                        ours: f64::NAN,
                        interval: Some((f64::NEG_INFINITY, 1.0)),
                        pass: false,
                    },
                ],
            }],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Section, Table, number, sample};

    #[test]
    fn numbers_have_four_digits_at_any_size() {
        for (value, expected) in [
            (0.5598, "0.5598"),
            (0.002_345_6, "0.002346"),
            (938.67, "938.7"),
            (9.999_96, "10.00"),
            (18_497.6, "18498"),
            (-7178.27, "-7178"),
            (1.25e-7, "1.250e-7"),
            (2.5e9, "2.500e9"),
            (-0.0, "0"),
            (f64::NAN, "–"),
            (f64::NEG_INFINITY, "-inf"),
        ] {
            assert_eq!(number(value), expected);
        }
    }

    #[test]
    fn a_column_of_numbers_is_recognised_past_its_gaps() {
        let mut table =
            Table { header: ["a", "b", "c"].map(str::to_owned).to_vec(), ..Table::default() };
        for row in [["plan A", "−0.5 ± 0.1", ""], ["plan B", "–", ""], ["2 plans", "97 %", "-"]]
        {
            table.rows.push(row.map(str::to_owned).to_vec());
        }
        assert_eq!(table.numeric_columns(), [false, true, false]);
    }

    #[test]
    fn blank_lines_separate_paragraphs() {
        let section =
            Section { analysis: "\none\nstill\n\n\n two \n\n".to_owned(), ..Section::default() };
        assert_eq!(section.paragraphs().collect::<Vec<_>>(), ["one\nstill", "two"]);
    }

    #[test]
    fn the_verdict_counts_what_holds() {
        assert_eq!(sample::report().verdict(), "1 of 2 criteria hold");
    }
}
