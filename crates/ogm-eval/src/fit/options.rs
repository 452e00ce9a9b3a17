//! What is drawn for a fit.

use std::sync::Arc;

use crate::watch::Watch;

/// What a fit draws.
#[derive(Debug, Clone)]
pub struct FitOptions {
    /// First seed; the experiments draw theirs from 3 000 000 on.
    pub seed: u64,
    /// Seeds of each kind of floor and relation.
    pub count: u64,
    /// Hears of the pairs.
    pub watch: Arc<dyn Watch>,
}
