//! The direction of a rectangular building from the segments of its walls.
