//! Maps that hang together.

use serde::{Serialize, Serializer};

use super::rows;
use crate::{Component, PoseDegrees};

#[derive(Serialize)]
struct ComponentJson {
    poses: Vec<MapPose>,
    /// Over (`x_m`, `y_m`, θ in radians), in the order of `poses`; `None` where the method has none.
    covariances: Vec<Option<[[f64; 3]; 3]>>,
}

#[derive(Serialize)]
struct MapPose {
    /// Which of the maps, from 0.
    map: usize,
    #[serde(flatten)]
    pose: PoseDegrees,
}

impl Serialize for Component {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let members = self.members.iter();
        let component = ComponentJson {
            poses: members
                .clone()
                .map(|member| MapPose { map: member.map, pose: member.reference_from_map.into() })
                .collect(),
            covariances: members.map(|member| member.covariance.as_ref().map(rows)).collect(),
        };
        component.serialize(serializer)
    }
}
