//! Alignments that were found elsewhere, as the JSON of `ogm align` holds them, in a team.

#![no_main]

use libfuzzer_sys::fuzz_target;
use ogm_core::{GridFrame, OccupancyGrid, Se2};
use ogm_merge::{Hypothesis, PairAlignment, RobotMap, TeamParams, merge_team};

fuzz_target!(|bytes: &[u8]| {
    let Ok(pairs) = serde_json::from_slice::<Vec<(usize, usize, Vec<Hypothesis>)>>(bytes) else {
        return;
    };
    if pairs.len() > 8 {
        return;
    }
    let frame = GridFrame::new(0.05, Se2::identity()).expect("a frame");
    let map = OccupancyGrid::from_ascii(frame, "####\n#..#\n####").expect("a map");
    let maps = [RobotMap::from(&map), RobotMap::from(&map), RobotMap::from(&map)];
    let alignment = |(target, source, hypotheses)| PairAlignment { target, source, hypotheses };
    let alignments = pairs.into_iter().map(alignment).collect();
    let params = TeamParams { alignments, ..TeamParams::default() };
    if let Ok(report) = merge_team(&maps, &params, &()) {
        let members: usize = report.components.iter().map(|part| part.members.len()).sum();
        assert_eq!(members, maps.len());
    }
});
