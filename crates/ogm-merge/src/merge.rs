//! From what was found about maps to one map.

use grid_merge::{FusionParams, Merged, PlacedMap};
use nalgebra::Matrix3;
use ogm_core::{OccupancyGrid, Outcome, Progress, Se2};

use crate::{MergeError, PairReport};

/// Maps that hang together, in the frame of the first of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Component {
    /// The maps, by their place in what was handed in; the first is the reference.
    pub members: Vec<Member>,
}

/// A map in its component.
#[derive(Debug, Clone, PartialEq)]
pub struct Member {
    /// Which map, from 0.
    pub map: usize,
    /// Maps its points into the frame of the component.
    pub reference_from_map: Se2,
    /// Covariance of (x, y, θ) in the axes of the component, m², m·rad, rad²; zero for the
    /// reference, `None` where the method has none.
    pub covariance: Option<Matrix3<f64>>,
    /// How far its parts lie from where the pose puts them, root mean square, metres; zero where
    /// the method does not say.
    pub bend_m: f64,
}

impl Component {
    fn alone(map: usize) -> Self {
        let covariance = Some(Matrix3::zeros());
        let reference_from_map = Se2::identity();
        Self { members: vec![Member { map, reference_from_map, covariance, bend_m: 0.0 }] }
    }
}

impl PairReport {
    /// How far parts of the maps lie from where the best transform puts them, root mean square,
    /// metres; `None` for a method that does not look.
    #[must_use]
    pub fn bend_m(&self) -> Option<f64> {
        self.hypotheses.first()?.bend_m
    }

    /// Target (map 0) and source (map 1) together where the outcome is a transform, else each
    /// alone.
    #[must_use]
    pub fn components(&self) -> Vec<Component> {
        let Outcome::Found(target_from_source) = &self.outcome else {
            return vec![Component::alone(0), Component::alone(1)];
        };
        let mut both = Component::alone(0);
        both.members.push(Member {
            map: 1,
            reference_from_map: *target_from_source,
            covariance: self.hypotheses.first().and_then(|best| best.covariance),
            bend_m: self.bend_m().unwrap_or(0.0),
        });
        vec![both]
    }
}

/// The maps of a component as one map, in its frame, at the resolution of its reference unless
/// `params` say otherwise.
///
/// # Errors
/// A component that names a map which is not in `maps`, maps that cannot be fused, or a call that
/// was cancelled.
pub fn fuse(
    maps: &[&OccupancyGrid],
    component: &Component,
    params: &FusionParams,
    progress: &dyn Progress,
) -> Result<Merged, MergeError> {
    Ok(grid_merge::merge(&placed(maps, component)?, params, progress)?)
}

/// The maps of a component, each with its pose and how sure that is.
///
/// # Errors
/// A component that names a map which is not in `maps`.
pub fn placed<'a>(
    maps: &[&'a OccupancyGrid],
    component: &Component,
) -> Result<Vec<PlacedMap<'a>>, MergeError> {
    let place = |member: &Member| {
        let map = maps.get(member.map).copied();
        let map = map.ok_or(MergeError::NoSuchMap { map: member.map, maps: maps.len() })?;
        Ok(PlacedMap {
            map,
            reference_from_map: member.reference_from_map,
            covariance: member.covariance,
            bend_m: member.bend_m,
        })
    };
    component.members.iter().map(place).collect()
}
