//! The ROS 2 messages of the node, besides those that [`ogm_io::ros`] has.

mod diagnostic;
mod prior;
mod text;
mod update;

pub use diagnostic::{DiagnosticArray, DiagnosticStatus, KeyValue, Level};
pub use prior::PoseWithCovarianceStamped;
pub use text::Text;
pub use update::OccupancyGridUpdate;
