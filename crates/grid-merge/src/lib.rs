//! Fuses occupancy grids that lie in known poses: mapping, evidence fusion, gap treatment, coverage.
