//! What somebody on the network sees of the live merging.
#![expect(clippy::unwrap_used, reason = "a test")]

use ogm_core::{OccupancyGrid, Se2};
use ogm_io::ros::{Header, OccupancyGridMessage, Pose, TfMessage, Time, from_cdr, to_cdr};
use ogm_ros::live::{Limits, Live, LiveParams, Output, SavedLive, Step};
use ogm_ros::message::{DiagnosticArray, PoseWithCovarianceStamped, Text};
use ogm_sim::{FloorPlan, LidarParams, MappingParams, PairParams, SimulatedPair, simulate_pair};

fn pair(seed: u64) -> SimulatedPair {
    let sparse = LidarParams { beams: 181, ..LidarParams::rf() };
    let mapping = MappingParams { resolution: 0.05, ..MappingParams::default() };
    let world = PairParams { seed, lidar: sparse, mapping, ..PairParams::default() };
    simulate_pair(&FloorPlan::plan_a(), &world).unwrap()
}

fn message(map: &OccupancyGrid) -> OccupancyGridMessage {
    let header = Header { frame_id: "map".to_owned(), ..Header::default() };
    OccupancyGridMessage::from_map(header, map).unwrap()
}

fn bytes(map: &OccupancyGrid) -> Vec<u8> {
    to_cdr(&message(map)).unwrap()
}

/// A run of the node, with its last messages.
struct Run {
    live: Live,
    seconds: i32,
    last: Vec<(Output, Vec<u8>)>,
}

impl Run {
    fn new(params: LiveParams) -> Self {
        Self { live: Live::new(params).unwrap(), seconds: 0, last: Vec::new() }
    }

    fn now(&self) -> Time {
        Time { sec: self.seconds, nanosec: 0 }
    }

    fn send(&mut self, robot: &str, message: Vec<u8>) {
        self.live.put_map(robot, message, self.now());
    }

    fn order(&mut self, line: &str) {
        let text = to_cdr(&Text { data: line.to_owned() }).unwrap();
        self.live.put_command(&text).unwrap();
        self.step();
    }

    fn step(&mut self) -> Step {
        self.seconds += 1;
        let step = self.live.step(self.now(), &()).unwrap();
        for message in &step.messages {
            self.last.retain(|(output, _)| *output != message.output);
            self.last.push((message.output, message.bytes.clone()));
        }
        step
    }

    fn last(&self, output: Output) -> &[u8] {
        &self.last.iter().find(|(of, _)| *of == output).expect("it was published").1
    }

    fn map(&self) -> OccupancyGridMessage {
        from_cdr(self.last(Output::Map)).unwrap()
    }

    /// The pose of a robot's frame in the world.
    fn placed(&self, frame: &str) -> Option<Se2> {
        let message: TfMessage = from_cdr(self.last(Output::Transforms)).unwrap();
        assert!(message.transforms.iter().all(|it| it.header.frame_id == "world"));
        let found = message.transforms.iter().find(|it| it.child_frame_id == frame)?;
        Some(found.transform.flat().unwrap())
    }

    /// What is said of a robot: how bad, and why.
    fn said(&self, of: &str) -> (u8, String) {
        let message: DiagnosticArray = from_cdr(self.last(Output::Status)).unwrap();
        let name = format!("ogm: {of}");
        let found = message.status.into_iter().find(|status| status.name == name);
        found.map(|status| (status.level, status.message)).expect("it is in the status")
    }
}

#[test]
fn two_robots_become_one_map_with_their_frames_in_the_world() {
    let pair = pair(1);
    let mut run = Run::new(LiveParams::default());
    run.send("red", bytes(&pair.target.map));
    run.step();
    assert_eq!(run.placed("red/map"), Some(Se2::identity()));
    let alone = run.map();
    run.send("blue", bytes(&pair.source.map));
    run.step();
    let world_from_blue = run.placed("blue/map").expect("they are on one floor");
    let error = world_from_blue.between(&pair.target_from_source);
    assert!(error.translation().norm() < 0.02 && error.theta().abs() < 0.005, "{error}");
    let both = run.map();
    assert_eq!(both.header.frame_id, "world");
    let known = |map: &OccupancyGridMessage| map.data.iter().filter(|&&cell| cell != 0xff).count();
    assert!(known(&both) > known(&alone));
    let moved = (both.info.origin.position.x - alone.info.origin.position.x) / 0.05;
    assert!((moved - moved.round()).abs() < 1e-6, "the lattice moved by {moved} cells");
    assert_eq!(run.said("blue").0, 0);
    assert!(run.said("team").1.starts_with("2 of 2"));
    assert!(run.step().messages.iter().all(|message| message.output == Output::Status));
}

#[test]
fn of_each_robot_the_latest_map_is_taken_and_they_take_turns() {
    let pair = pair(1);
    let mut run = Run::new(LiveParams::default());
    for _ in 0..50 {
        run.send("red", bytes(&pair.source.map));
    }
    run.send("red", bytes(&pair.target.map));
    run.send("blue", bytes(&pair.source.map));
    run.step();
    assert!(run.live.is_waiting());
    run.send("red", bytes(&pair.target.map));
    run.step();
    assert!(run.placed("blue/map").is_some(), "the eager robot took the other's turn");
    run.step();
    assert!(!run.live.is_waiting());
    assert_eq!((run.map().info.resolution * 100.0).round(), 5.0);
}

#[test]
fn a_robot_that_lies_is_refused_by_name_and_changes_nothing() {
    let pair = pair(1);
    let mut run = Run::new(LiveParams::default());
    for (robot, map) in [("red", &pair.target.map), ("blue", &pair.source.map)] {
        run.send(robot, bytes(map));
        run.step();
    }
    let (map, place) = (run.map(), run.placed("blue/map"));
    let good = message(&pair.source.map);
    let mut huge = good.clone();
    (huge.info.width, huge.info.height) = (20_000, 20_000);
    let mut nan = good.clone();
    nan.info.resolution = f32::NAN;
    let mut short = good.clone();
    short.data.pop();
    let lies = [(huge, "at most"), (nan, "resolution"), (short, "cells, but has")];
    for (lie, words) in lies {
        for robot in ["liar", "blue"] {
            run.send(robot, to_cdr(&lie).unwrap());
            run.step();
            run.step();
            let (level, why) = run.said(robot);
            assert!(level == 2 && why.contains(words), "{why}");
        }
        assert_eq!((&run.map().data, run.placed("blue/map")), (&map.data, place));
        assert_eq!(run.placed("liar/map"), None);
    }
    run.send("blue", vec![0, 1]);
    run.step();
    assert!(run.said("blue").1.contains("2 bytes"));
    run.send("blue", bytes(&pair.source.map));
    run.step();
    run.step();
    assert_eq!(run.said("blue").0, 0, "a good map after a bad one is taken");
}

#[test]
fn robots_beyond_the_limit_are_turned_away_and_the_status_says_so() {
    let pair = pair(1);
    let limits = Limits { robots: 1, ..Limits::default() };
    let mut run = Run::new(LiveParams { limits, ..LiveParams::default() });
    run.send("red", bytes(&pair.target.map));
    run.send("blue", bytes(&pair.source.map));
    run.step();
    run.step();
    assert_eq!(run.placed("blue/map"), None);
    let (level, why) = run.said("team");
    assert!(level == 2 && why.contains("max_robots"), "{why}");
}

#[test]
fn a_merge_is_undone_by_order_and_taken_up_again_by_order() {
    let pair = pair(1);
    let mut run = Run::new(LiveParams::default());
    for (robot, map) in [("red", &pair.target.map), ("blue", &pair.source.map)] {
        run.send(robot, bytes(map));
        run.step();
    }
    let (merged, place) = (run.map(), run.placed("blue/map"));
    run.order("separate blue");
    assert_eq!(run.placed("blue/map"), None);
    assert!(run.map().data != merged.data);
    assert!(run.said("blue").1.contains("separated"));
    run.order("release /blue");
    let error = run.placed("blue/map").unwrap().between(&place.unwrap());
    assert!(error.log().norm() < 0.01);
    run.order("separate nobody");
    run.step();
    assert!(run.said("team").1.contains("nobody"), "{}", run.said("team").1);
    run.order("rm -rf blue");
    run.step();
    assert!(run.said("team").1.contains("no order"));
    run.order("remove blue");
    assert_eq!(run.placed("blue/map"), None);
}

#[test]
fn a_pose_without_a_covariance_pins_a_map_where_walls_would_not_put_it() {
    let pair = pair(1);
    let mut run = Run::new(LiveParams::default());
    let pinned = Se2::new(40.0, -3.0, 1.0);
    let prior = PoseWithCovarianceStamped {
        header: Header::default(),
        pose: Pose::from(pinned),
        covariance: [0.0; 36],
    };
    run.live.put_prior("blue", &to_cdr(&prior).unwrap()).unwrap();
    for (robot, map) in [("red", &pair.target.map), ("blue", &pair.source.map)] {
        run.send(robot, bytes(map));
        run.step();
    }
    let error = run.placed("blue/map").unwrap().between(&pinned);
    assert!(error.log().norm() < 1e-9, "{error}");
}

#[test]
fn after_a_restart_it_goes_on_in_the_same_world() {
    let pair = pair(1);
    let mut run = Run::new(LiveParams::default());
    for (robot, map) in [("red", &pair.target.map), ("blue", &pair.source.map)] {
        run.send(robot, bytes(map));
        run.step();
    }
    let saved = serde_json::to_vec(&run.live.save()).unwrap();
    let saved: SavedLive = serde_json::from_slice(&saved).unwrap();
    let live = Live::resume(saved, LiveParams::default(), &()).unwrap();
    let mut again = Run { live, seconds: 100, last: Vec::new() };
    again.step();
    let error = again.placed("blue/map").unwrap().between(&run.placed("blue/map").unwrap());
    assert!(error.log().norm() < 1e-9);
    assert_eq!(again.map().data, run.map().data);
    again.send("blue", bytes(&pair.source.map));
    again.step();
    assert!(again.placed("red/map").is_some() && again.placed("blue/map").is_some());
}
