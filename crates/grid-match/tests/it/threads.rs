//! The number of threads changes nothing.

use grid_match::{Effort, MatchParams, match_maps};
use ogm_core::Se2;

use crate::world::{OFFICE, left_part, right_part};

#[test]
fn one_thread_and_many_find_the_same_poses_to_the_last_bit() {
    let target = left_part(OFFICE, Se2::new(1.0, 2.0, 0.3));
    let source = right_part(OFFICE, Se2::new(-1.0, 0.5, -0.4));
    let params = MatchParams { accept: 1.0, effort: Effort::Standard, ..MatchParams::default() };
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| format!("{:?}", match_maps(&target, &source, &params, &()).unwrap()))
    };
    let [one, many] = [on(1), on(5)];
    assert!(one == many && one.contains("Hypothesis"));
}
