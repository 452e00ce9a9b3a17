//! The ROS 2 messages of the node, besides the map that [`ogm_io::ros`] has.

mod diagnostic;
mod prior;
mod text;
mod transform;
mod update;

pub use diagnostic::{DiagnosticArray, DiagnosticStatus, KeyValue, Level};
pub use prior::PoseWithCovarianceStamped;
pub use text::Text;
pub use transform::{TfMessage, TransformStamped};
pub use update::OccupancyGridUpdate;
