//! The Python module `ogm_maps._native`: what `ogm-merge` and the steps of the papers do, for
//! people who work in Python. It converts and decides nothing.

mod alignment;
mod background;
mod cells;
mod component;
mod error;
mod icp;
mod map;
mod merge;
mod message;
mod numbers;
mod outcome;
mod picture;
mod prepared;
mod search;
mod session;
mod tags;
mod team;
mod transform;
mod walk;
mod walls;

/// Aligns and merges occupancy grid maps.
#[pyo3::pymodule]
mod _native {
    #[pymodule_export]
    use crate::alignment::{Alignment, Hypothesis, align};
    #[pymodule_export]
    use crate::component::Component;
    #[pymodule_export]
    use crate::error::MapError;
    #[pymodule_export]
    use crate::icp::{Refinement, icp};
    #[pymodule_export]
    use crate::map::{Map, load, overlay};
    #[pymodule_export]
    use crate::merge::{fuse, merge};
    #[pymodule_export]
    use crate::outcome::{Join, Merge, Pair};
    #[pymodule_export]
    use crate::picture::Picture;
    #[pymodule_export]
    use crate::prepared::{MapSignature, PreparedMap, candidate_pairs};
    #[pymodule_export]
    use crate::session::{Change, Robot, Session};
    #[pymodule_export]
    use crate::tags::{Tag, localise_tags};
    #[pymodule_export]
    use crate::transform::Transform;
    #[pymodule_export]
    use crate::walk::{Walk, random_walk};
    #[pymodule_export]
    use crate::walls::{Segment, Walls, wall_segments};

    #[pymodule_export]
    #[expect(non_upper_case_globals, reason = "as Python calls it")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
