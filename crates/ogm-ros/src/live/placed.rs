//! Where robots' frames lie, as it was last published.

use ogm_core::Se2;
use ogm_io::ros::{Header, TfMessage, Time, TransformStamped};

/// A frame in the world.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PlacedFrame {
    /// The frame.
    pub(super) name: String,
    /// Maps its points into the world.
    pub(super) world_from_frame: Se2,
}

/// What was published last, so that only news is.
#[derive(Debug, Default)]
pub(super) struct Known {
    pub(super) frames: Vec<PlacedFrame>,
    /// When the status was.
    pub(super) status: Option<Time>,
    /// Something changed since the map was.
    pub(super) is_stale: bool,
}

/// The message that says where `frames` lie.
pub(super) fn transforms(frames: &[PlacedFrame], world: &str, stamp: Time) -> TfMessage {
    let transform = |frame: &PlacedFrame| TransformStamped {
        header: Header { stamp, frame_id: world.to_owned() },
        child_frame_id: frame.name.clone(),
        transform: frame.world_from_frame.into(),
    };
    TfMessage { transforms: frames.iter().map(transform).collect() }
}
