//! What ROS 2 tools expect of topics: reliable, the last one kept, latched or not.

use rustdds::policy::{self, History, Reliability, ResourceLimits};
use rustdds::{Duration, QosPolicies, QosPolicyBuilder};

/// Whether who comes late gets the last message.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Durability {
    /// No.
    Volatile,
    /// Yes, as `/map` and `/tf_static` are.
    TransientLocal,
}

/// Samples that a writer holds beyond its history for readers that lack them. Without a limit,
/// RustDDS holds 8192; whoever comes late gets all that are held, oldest first.
const UNACKNOWLEDGED: i32 = 1;

/// What a reader asks for: no more than the writers offer, or nothing would come.
pub(super) fn requested(durability: Durability, is_reliable: bool, depth: i32) -> QosPolicies {
    let policies = policies(durability, depth);
    if is_reliable { policies.build() } else { policies.best_effort().build() }
}

/// What a writer offers.
pub(super) fn offered(durability: Durability, depth: i32) -> QosPolicies {
    let samples = depth + UNACKNOWLEDGED;
    let limits = ResourceLimits {
        max_samples: samples,
        max_instances: 1,
        max_samples_per_instance: samples,
    };
    policies(durability, depth).resource_limits(limits).build()
}

fn policies(durability: Durability, depth: i32) -> QosPolicyBuilder {
    let durability = match durability {
        Durability::Volatile => policy::Durability::Volatile,
        Durability::TransientLocal => policy::Durability::TransientLocal,
    };
    QosPolicyBuilder::new()
        .reliability(Reliability::Reliable { max_blocking_time: Duration::from_millis(100) })
        .durability(durability)
        .history(History::KeepLast { depth })
}
