//! The real pairs as method #3 laid them over each other.

use ogm_core::Se2;
use ogm_view::{overlay, png};

use crate::map_pair::MapPair;
use crate::report::{Figure, Image};

/// One overlay for each pair that was merged.
pub(super) fn draw(answers: &[(&MapPair, Option<Se2>)]) -> anyhow::Result<Vec<Figure>> {
    let mut figures = Vec::new();
    for (pair, target_from_source) in answers {
        if let Some(target_from_source) = target_from_source {
            figures.push(Figure {
                name: format!("pair-{}", pair.name),
                caption: format!("{}: target blue, source orange, both black.", pair.name),
                image: Image::Png(png(&overlay(&pair.target, &pair.source, *target_from_source)?)?),
            });
        }
    }
    Ok(figures)
}
