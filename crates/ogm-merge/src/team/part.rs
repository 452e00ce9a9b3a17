//! Maps that already hang together, as one map.

use grid_match::PreparedMap;
use nalgebra::Point2;
use ogm_core::{ClassThresholds, Se2};

use crate::merge::{Component, Member, fuse};
use crate::{FusionParams, FusionRule, MergeError};

/// Maps that hang together.
#[derive(Debug)]
pub(crate) struct Part {
    /// Every map and its pose, in the order of what the maps hold: what they say together does not
    /// depend on how they are numbered. The frame is that of the first.
    pub(crate) members: Vec<(usize, Se2)>,
    /// All of them laid together; `None` for a map alone, which is as it is.
    composite: Option<PreparedMap>,
}

impl Part {
    pub(crate) fn alone(map: usize) -> Self {
        Self { members: vec![(map, Se2::identity())], composite: None }
    }

    /// Maps in their poses, laid together.
    pub(crate) fn of(
        mut members: Vec<(usize, Se2)>,
        prepared: &[PreparedMap],
        thresholds: &ClassThresholds,
    ) -> Result<Self, MergeError> {
        members.sort_by(|(a, _), (b, _)| prepared[*a].order(&prepared[*b]));
        let first_from_part = members[0].1.inverse();
        for (_, part_from_map) in &mut members {
            *part_from_map = first_from_part * *part_from_map;
        }
        let seen: Vec<_> = members
            .iter()
            .map(|(map, _)| prepared[*map].seen())
            .collect::<Result<_, ogm_core::GridError>>()?;
        let place = |(index, (_, part_from_map)): (usize, &(usize, Se2))| Member {
            map: index,
            reference_from_map: *part_from_map,
            covariance: None,
            bend_m: 0.0,
        };
        let component = Component { members: members.iter().enumerate().map(place).collect() };
        let coarsest = seen.iter().map(|map| map.frame().resolution()).fold(0.0, f64::max);
        // What maps contradict each other about says nothing for or against another.
        let (fusion, resolution) = (FusionRule::LogOdds, Some(coarsest));
        let params = FusionParams { fusion, resolution, ..FusionParams::default() };
        let maps: Vec<_> = seen.iter().collect();
        let merged = fuse(&maps, &component, &params, &())?;
        let composite = PreparedMap::new(&merged.map, thresholds, &())?;
        Ok(Self { members, composite: Some(composite) })
    }

    /// The maps laid together.
    pub(crate) fn whole<'a>(&'a self, prepared: &'a [PreparedMap]) -> &'a PreparedMap {
        self.composite.as_ref().unwrap_or(&prepared[self.members[0].0])
    }

    pub(crate) fn is_alone(&self) -> bool {
        self.members.len() == 1
    }

    /// Which maps, ascending.
    pub(crate) fn maps(&self) -> Vec<usize> {
        let mut maps: Vec<usize> = self.members.iter().map(|(map, _)| *map).collect();
        maps.sort_unstable();
        maps
    }

    pub(crate) fn pose(&self, map: usize) -> Option<Se2> {
        self.members.iter().find(|(member, _)| *member == map).map(|(_, pose)| *pose)
    }

    /// The middle of what is known, in the frame of the part.
    pub(crate) fn centre(&self, prepared: &[PreparedMap]) -> Point2<f64> {
        self.whole(prepared).centre()
    }
}
