//! Benchmarks of the workspace live in `benches/`.
