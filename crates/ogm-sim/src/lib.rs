//! A small world to measure map merging in: floor plans, exploring robots, lidar, radio tags, and the exact truth.
