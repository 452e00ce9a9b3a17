//! The proof: everything of the workspace that measures.
//!
//! One `judge` says what is right; *cases* are what is measured on, simulated or on
//! disk; each *experiment* has a folder of its own; [`race`] times other tools on the same pairs;
//! [`record`] keeps dated results and compares two of them.
//!
//! # Layout
//!
//! | module | idea |
//! |---|---|
//! | `judge` | error at a point and over walls, tolerances, truth, verdict |
//! | `stats` | what a sample says, and how surely |
//! | `cases` | simulated worlds, pairs of maps on disk: the one reader of pairs |
//! | `experiments` | one folder each: `record`, `run`, `tables`, `figures`, `criteria` |
//! | [`compare`] | runs the experiments and writes the report |
//! | [`race`] | our command beside other tools, in turns |
//! | [`fusion`] | what a merged map does to the walls of real pairs |
//! | [`record`] | dated results, and what changed between two |
//! | [`fit`] | the weights of the matcher, from labelled pairs |
//! | [`fixtures`] | the example maps |
//! | `report`, `draw` | the report's files; charts, plans, heat maps |

#![expect(clippy::disallowed_methods, reason = "results are written and what is measured is timed")]

mod cases;
pub mod compare;
mod draw;
mod experiments;
pub mod fit;
pub mod fixtures;
pub mod fleet;
pub mod fusion;
mod judge;
mod measured;
mod options;
mod output;
pub mod race;
pub mod record;
mod report;
mod stats;
mod watch;

pub use watch::Watch;
