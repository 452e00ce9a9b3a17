//! The weights of the matcher: drawn, fitted, and written into its source.

mod logit;
mod options;
mod pairs;
mod source;

use std::path::Path;

use anyhow::Context;
use grid_match::Weights;

pub use options::FitOptions;

/// A fitted matcher and what it was fitted on.
#[derive(Debug)]
pub struct Fit {
    /// Rust source of the weights.
    pub source: String,
    /// For the terminal.
    pub summary: String,
}

impl Fit {
    /// Writes the source.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self, path: &Path) -> anyhow::Result<()> {
        std::fs::write(path, &self.source)
            .with_context(|| format!("cannot write {}", path.display()))
    }
}

/// Draws labelled pairs, matches them, and fits the weights to which pose is right.
///
/// # Errors
/// A pair that cannot be drawn or matched.
pub fn fit(options: &FitOptions) -> anyhow::Result<Fit> {
    let drawn = pairs::draw(options)?;
    let (bias, terms, pose_loss) = logit::fit_poses(&drawn);
    let scored: Vec<pairs::Scored> = drawn.iter().map(|pair| pair.scored(bias, &terms)).collect();
    let ([any, score, lead, rival], any_loss) = logit::fit_any(&scored, &drawn);
    let plain = Weights { bias, terms, any, score, lead, rival, repeats: 0.0, repeats_odds: 1.0 };
    let [repeats, repeats_odds] = logit::fit_repeats(&scored, &drawn, &plain);
    let weights = Weights { repeats, repeats_odds, ..plain };
    let summary = format!(
        "{} pairs, {} with a right pose listed; loss a pair {pose_loss:.4} of the poses, \
         {any_loss:.4} of any of them",
        drawn.len(),
        drawn.iter().filter(|pair| pair.right.is_some()).count(),
    );
    Ok(Fit { source: source::write(&weights, options, &summary), summary })
}
