//! What the pairs of a session proposed when they were last searched.

use crate::team::Matched;

/// How far a robot's map had come when something was done with it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Progressed {
    /// Maps that it has sent.
    pub(crate) revision: u64,
    /// Shares of what it knew that changed, summed up.
    pub(crate) changed: f64,
}

/// Pairs in the order of their targets, then of their sources; target before source.
#[derive(Debug, Clone, Default)]
pub(crate) struct Pairs {
    pub(crate) found: Vec<Matched>,
    /// How far target and source had come.
    pub(crate) at: Vec<[Progressed; 2]>,
}

impl Pairs {
    fn place(&self, target: usize, source: usize) -> Result<usize, usize> {
        self.found.binary_search_by_key(&(target, source), Matched::maps)
    }

    /// What a pair proposed.
    pub(crate) fn found(&self, target: usize, source: usize) -> Option<&Matched> {
        self.place(target, source).ok().map(|place| &self.found[place])
    }

    /// When a pair was searched.
    pub(crate) fn searched(&self, target: usize, source: usize) -> Option<[Progressed; 2]> {
        self.place(target, source).ok().map(|place| self.at[place])
    }

    pub(crate) fn all(&self) -> Vec<(usize, usize)> {
        self.found.iter().map(Matched::maps).collect()
    }

    pub(crate) fn put(&mut self, pair: Matched, at: [Progressed; 2]) {
        match self.place(pair.target, pair.source) {
            Ok(place) => {
                self.found[place] = pair;
                self.at[place] = at;
            }
            Err(place) => {
                self.found.insert(place, pair);
                self.at.insert(place, at);
            }
        }
    }

    /// Forgets what was found about a map.
    pub(crate) fn forget(&mut self, map: usize) {
        let is_other = |pair: &Matched| ![pair.target, pair.source].contains(&map);
        let kept: Vec<bool> = self.found.iter().map(is_other).collect();
        let mut keep = kept.iter();
        self.found.retain(|_| keep.next() == Some(&true));
        let mut keep = kept.iter();
        self.at.retain(|_| keep.next() == Some(&true));
    }

    /// As [`forget`](Self::forget), and the maps after it move up.
    pub(crate) fn remove(&mut self, map: usize) {
        self.forget(map);
        for pair in &mut self.found {
            for index in [&mut pair.target, &mut pair.source] {
                *index -= usize::from(*index > map);
            }
        }
    }
}
