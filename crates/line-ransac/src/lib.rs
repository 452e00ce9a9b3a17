//! Straight walls of an occupancy grid by RANSAC: detect, break at gaps, join, rate, filter.
