//! The real pairs as method #3 laid them over each other.

use ogm_view::{overlay, png};

use super::record::Answered;
use crate::report::{Figure, Image};

/// One overlay for each pair that was merged.
pub(super) fn draw(answered: &[Answered]) -> anyhow::Result<Vec<Figure>> {
    let mut figures = Vec::new();
    for Answered { pair, answers } in answered {
        if let Some(target_from_source) = answers.target_from_source {
            figures.push(Figure {
                name: format!("pair-{}", pair.name),
                caption: format!("{}: target blue, source orange, both black.", pair.name),
                image: Image::Png(png(&overlay(&pair.target, &pair.source, target_from_source)?)?),
            });
        }
    }
    Ok(figures)
}
