//! Merges the occupancy grid maps of robot teams: the methods of three papers as short recipes over small crates.
