//! Maps that hang together in a session.

use nalgebra::{Matrix3, Rotation2};
use ogm_core::Se2;

use crate::team::Place;

/// Maps that hang together, the one that holds the frame first.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Group {
    pub(crate) members: Vec<Standing>,
}

/// Where a map stands in its group, and why that is believed.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Standing {
    /// Which map.
    pub(crate) map: usize,
    /// Its pose in the frame of the group: that of its first map, or the world.
    pub(crate) group_from_map: Se2,
    /// Over (x, y, θ) in the axes of the group.
    pub(crate) covariance: Option<Matrix3<f64>>,
    pub(crate) bend_m: f64,
    pub(crate) probability: f64,
}

impl Group {
    pub(crate) fn alone(map: usize, group_from_map: Se2) -> Self {
        let covariance = Some(Matrix3::zeros());
        let standing = Standing { map, group_from_map, covariance, bend_m: 0.0, probability: 1.0 };
        Self { members: vec![standing] }
    }

    pub(crate) fn of(&self, map: usize) -> Option<&Standing> {
        self.members.iter().find(|member| member.map == map)
    }

    pub(crate) fn poses(&self) -> Vec<(usize, Se2)> {
        self.members.iter().map(|member| (member.map, member.group_from_map)).collect()
    }
}

impl Standing {
    /// A place in the frame of a map that itself lies at `group_from_reference`.
    pub(crate) fn new(place: &Place, group_from_reference: &Se2, probability: f64) -> Self {
        let mut turn = Matrix3::identity();
        let axes = Rotation2::new(group_from_reference.theta());
        turn.fixed_view_mut::<2, 2>(0, 0).copy_from(axes.matrix());
        Self {
            map: place.map,
            group_from_map: *group_from_reference * place.reference_from_map,
            covariance: place.covariance.map(|found| turn * found * turn.transpose()),
            bend_m: place.bend_m,
            probability,
        }
    }
}
