//! What is kept of a pair whose source may be bent.

use ogm_sim::MapStyle;

/// A simulated pair and what became of it.
#[derive(Debug, Clone)]
pub(super) struct Judged {
    /// Standard deviation of the bend an axis, metres.
    pub(super) bend: f64,
    pub(super) overlap: f64,
    pub(super) styles: [MapStyle; 2],
    /// Of the coarser map, metres.
    pub(super) cell: f64,
    /// `None` where the matcher did not merge the maps, or wrongly.
    pub(super) bent: Option<Bent>,
}

/// A pair before and after.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bent {
    pub(super) is_applied: bool,
    /// Residuals, metres.
    pub(super) before_m: f64,
    pub(super) after_m: f64,
    /// By a deformation that is told where walls belong.
    pub(super) known_m: f64,
    /// Shares of doubled wall.
    pub(super) doubled_before: f64,
    pub(super) doubled_after: f64,
    /// How far the walls moved, root mean square, metres; 0 where nothing is applied.
    pub(super) moved_m: f64,
}

/// A real pair before and after.
#[derive(Debug, Clone)]
pub(super) struct Real {
    pub(super) name: String,
    pub(super) is_applied: bool,
    pub(super) score: f64,
    pub(super) moved_m: f64,
    pub(super) max_m: f64,
    /// Cells of doubled wall.
    pub(super) doubled_before: usize,
    pub(super) doubled_after: usize,
    /// Largest shares of an input's wall that the fusion loses.
    pub(super) lost_before: f64,
    pub(super) lost_after: f64,
}

impl Judged {
    /// Whether either map was made in this style.
    pub(super) fn of_style(&self, style: MapStyle) -> bool {
        self.styles.contains(&style)
    }
}

/// The pairs that were merged rightly.
pub(super) fn merged(judged: &[Judged], holds: impl Fn(&Judged) -> bool) -> Vec<(&Judged, Bent)> {
    let holding = judged.iter().filter(|one| holds(one));
    holding.filter_map(|one| Some((one, one.bent?))).collect()
}
