//! A pose that someone gives, with how sure it is.

use ogm_io::ros::{Header, Pose};
use serde::{Deserialize, Serialize};

/// `geometry_msgs/msg/PoseWithCovarianceStamped`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PoseWithCovarianceStamped {
    /// When, and in which frame.
    pub header: Header,
    /// The pose.
    pub pose: Pose,
    /// Row by row of (x, y, z, about x, about y, about z), m², m·rad, rad².
    #[serde(with = "covariance")]
    pub covariance: [f64; 36],
}

impl PoseWithCovarianceStamped {
    /// How ROS 2 names the type.
    pub const TYPE: &'static str = "geometry_msgs/msg/PoseWithCovarianceStamped";
}

/// An array of 36, which is four more than `serde` knows.
mod covariance {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    type Rows = ([f64; 18], [f64; 18]);

    pub(super) fn serialize<S: Serializer>(
        numbers: &[f64; 36],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        let half = |from: usize| -> [f64; 18] { std::array::from_fn(|at| numbers[from + at]) };
        (half(0), half(18)).serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<[f64; 36], D::Error> {
        let (first, second) = Rows::deserialize(deserializer)?;
        Ok(std::array::from_fn(|at| if at < 18 { first[at] } else { second[at - 18] }))
    }
}
