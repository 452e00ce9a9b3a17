//! Reads and writes occupancy grid maps as robots store them: ROS map_server YAML with PGM or PNG, and tag readings as CSV.
