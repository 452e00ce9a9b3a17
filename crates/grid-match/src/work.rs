//! A budget in units of work, so that it ends a search at the same place on any machine.

/// Work done and allowed, in units of about a microsecond of one core.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Work {
    limit: Option<u64>,
    spent: u64,
    exhausted: bool,
}

impl Work {
    pub(crate) fn new(limit: Option<u64>) -> Self {
        Self { limit, spent: 0, exhausted: false }
    }

    /// Units spent so far.
    pub(crate) fn spent(&self) -> u64 {
        self.spent
    }

    /// Whether something was left out for lack of budget.
    pub(crate) fn exhausted(&self) -> bool {
        self.exhausted
    }

    /// Takes the work of correlating two maps on `cells` coarse cells, if there is enough left.
    pub(crate) fn spend_transform(&mut self, cells: usize) -> bool {
        let levels = u64::from(cells.max(2).ilog2());
        self.spend(cells as u64 * levels / 500 + 1)
    }

    /// Takes the work of one pass over `points` wall points, if there is enough left.
    pub(crate) fn spend_points(&mut self, points: usize) -> bool {
        self.spend(points as u64 / 25 + 1)
    }

    /// The first thing asked for is always allowed: no search ends without a look.
    fn spend(&mut self, units: u64) -> bool {
        let fits = self.spent == 0 || self.limit.is_none_or(|limit| self.spent + units <= limit);
        if fits {
            self.spent += units;
        } else {
            self.exhausted = true;
        }
        fits
    }
}
