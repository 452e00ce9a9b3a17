//! The experiments, one folder each: what it keeps, how it runs, what it shows, what it must show.

pub(crate) mod bends;
pub(crate) mod labelled;
pub(crate) mod methods;
pub(crate) mod random_walk;
pub(crate) mod real_pairs;
pub(crate) mod robots;
pub(crate) mod segments;
pub(crate) mod teams;
pub(crate) mod wall_direction;
pub(crate) mod worked_tables;
