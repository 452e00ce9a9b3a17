//! What is decided about a pair of maps, whatever the method.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::sync::Mutex;

use nalgebra::Point2;
use ogm_core::{Progress, Se2, TagEstimate};
use ogm_merge::{
    AlignParams, FilterParams, FusionParams, MergeError, Method, Prior, RobotMap, TagMethod,
    Verdict, Warning, align_pair, fuse, known_poses, localise,
};
use ogm_sim::{FloorPlan, LidarParams, MappingParams, PairParams, SimulatedPair, simulate_pair};

/// Metres a cell: coarse, so that the maps are made quickly.
const RESOLUTION: f64 = 0.1;

fn world(plan: u64) -> SimulatedPair {
    let params = PairParams {
        seed: plan,
        step: 0.06,
        lidar: LidarParams { beams: 181, ..LidarParams::rf() },
        mapping: MappingParams { resolution: RESOLUTION, ..MappingParams::default() },
        ..PairParams::default()
    };
    simulate_pair(&FloorPlan::random(plan).unwrap(), &params).unwrap()
}

fn tags(readings: &[ogm_core::TagReading]) -> Vec<TagEstimate> {
    localise(readings, &FilterParams::default(), &()).unwrap()
}

fn error_m(pair: &SimulatedPair, target_from_source: Se2) -> f64 {
    let probe = Point2::new(4.0, 3.0);
    (target_from_source * probe - pair.target_from_source * probe).norm()
}

#[test]
fn maps_of_one_floor_are_one_component_and_fuse_and_those_of_two_are_not() {
    let (here, there) = (world(3), world(4));
    let target = RobotMap::from(&here.target.map);
    let params = AlignParams::default();
    let align =
        |source| align_pair(Method::Match, &target, &RobotMap::from(source), &params, &()).unwrap();
    let report = align(&here.source.map);
    assert!(error_m(&here, report.target_from_source.unwrap()) < RESOLUTION);
    let [component] = &report.components()[..] else { panic!("one component") };
    let maps = [&here.target.map, &here.source.map];
    let merged = fuse(&maps, component, &FusionParams::default(), &()).unwrap();
    assert!(merged.compared > 0);

    let report = align(&there.source.map);
    assert_ne!(report.verdict(), Verdict::Merged);
    assert_eq!(report.components().len(), 2, "each alone");
    let outside = fuse(&maps[..1], component, &FusionParams::default(), &());
    assert!(matches!(outside, Err(MergeError::NoSuchMap { map: 1, maps: 1 })));
}

/// Three sure tags that stand in each other's places: the walls contradict what the tags say.
#[test]
fn where_the_tags_mislead_auto_falls_back_to_the_maps_and_says_so() {
    let pair = world(3);
    let target_tags = tags(&pair.target.readings);
    let mut source_tags = tags(&pair.source.readings);
    let middle = Point2::new(0.0, 0.0);
    for tag in &mut source_tags {
        let turned = Se2::about(middle, 2.4, nalgebra::Vector2::new(3.0, -2.0));
        (tag.position, tag.mode) = (turned * tag.position, turned * tag.mode);
    }
    let target = RobotMap { map: &pair.target.map, tags: &target_tags };
    let source = RobotMap { map: &pair.source.map, tags: &source_tags };
    let params = AlignParams::default();
    let by_tags = Method::Tags(TagMethod::Rfid3);
    let refused = align_pair(by_tags, &target, &source, &params, &()).unwrap();
    assert_ne!(refused.verdict(), Verdict::Merged, "the walls contradict the tags");

    let report = align_pair(Method::Auto, &target, &source, &params, &()).unwrap();
    assert_eq!((report.method, report.verdict()), (Method::Match, Verdict::Merged));
    assert!(error_m(&pair, report.target_from_source.unwrap()) < RESOLUTION);
    let refusal = refused.outcome.refusal().unwrap().clone();
    assert_eq!(report.warnings, [Warning::WithoutTags(refusal)]);
    assert!(report.stages.tags.is_some() && report.stages.matching.is_some());
}

#[test]
fn sure_tags_make_auto_the_third_method_and_leave_a_prior_unused() {
    let pair = world(3);
    let (target_tags, source_tags) = (tags(&pair.target.readings), tags(&pair.source.readings));
    let target = RobotMap { map: &pair.target.map, tags: &target_tags };
    let source = RobotMap { map: &pair.source.map, tags: &source_tags };
    let prior = Prior { target_from_source: Se2::identity(), sigma_m: 1.0, sigma_rad: 1.0 };
    let params = AlignParams { prior: Some(prior), ..AlignParams::default() };
    let report = align_pair(Method::Auto, &target, &source, &params, &()).unwrap();
    assert_eq!(report.method, Method::Tags(TagMethod::Rfid3));
    assert!(report.warnings.contains(&Warning::PriorUnused), "{:?}", report.warnings);
}

#[test]
fn copies_lie_on_each_other_and_are_called_so() {
    let map = world(3).target.map;
    let robot = RobotMap::from(&map);
    let report = align_pair(Method::Match, &robot, &robot, &AlignParams::default(), &()).unwrap();
    let found = report.target_from_source.unwrap();
    assert!(found.translation().norm() < 0.05 * RESOLUTION && found.theta().abs() < 1e-3);
    assert_eq!(report.warnings, [Warning::Copies]);
}

/// Hears the shares and ends the call at one of them.
struct Ends {
    at: f64,
    heard: Mutex<Vec<f64>>,
}

impl Progress for Ends {
    fn report(&self, share: f64) {
        self.heard.lock().unwrap().push(share);
    }

    fn is_cancelled(&self) -> bool {
        self.heard.lock().unwrap().last().is_some_and(|&share| share >= self.at)
    }
}

#[test]
fn every_method_reports_its_progress_and_can_be_cancelled() {
    let pair = world(3);
    let (target_tags, source_tags) = (tags(&pair.target.readings), tags(&pair.source.readings));
    let target = RobotMap { map: &pair.target.map, tags: &target_tags };
    let source = RobotMap { map: &pair.source.map, tags: &source_tags };
    for method in Method::ALL {
        let run = |at| {
            let ends = Ends { at, heard: Mutex::default() };
            let done = align_pair(method, &target, &source, &AlignParams::default(), &ends);
            (done, ends.heard.into_inner().unwrap())
        };
        let (done, heard) = run(2.0);
        assert!(done.is_ok(), "{method:?}");
        assert!(heard.iter().all(|share| (0.0..=1.0).contains(share)), "{method:?}: {heard:?}");
        assert_eq!(heard.last(), Some(&1.0), "{method:?}");
        if heard.len() > 2 {
            let (ended, heard) = run(0.0);
            let is_cancelled = ended.as_ref().is_err_and(MergeError::is_cancelled);
            assert!(is_cancelled && heard.len() < 20, "{method:?}: {ended:?}");
        }
    }
}

#[cfg(feature = "serde")]
#[test]
fn a_report_is_json_with_the_fields_of_schema_1_and_what_was_seen() {
    let pair = world(3);
    let (target_tags, source_tags) = (tags(&pair.target.readings), tags(&pair.source.readings));
    let target = RobotMap { map: &pair.target.map, tags: &target_tags };
    let source = RobotMap { map: &pair.source.map, tags: &source_tags };
    for (method, stage) in [
        (Method::Match, "match"),
        (Method::Tags(TagMethod::Rfid3), "tags"),
        (Method::Carpin, "walks"),
        (Method::Radon, "radon"),
    ] {
        let report = align_pair(method, &target, &source, &AlignParams::default(), &()).unwrap();
        let json = serde_json::to_value(&report).unwrap();
        let fields = json.as_object().unwrap();
        for field in ["verdict", "reason", "target_from_source", "probability", "overlap"] {
            assert!(fields.contains_key(field), "{field}");
        }
        for field in ["agreement", "hypotheses", "method", "seed", "warnings", "stages"] {
            assert!(fields.contains_key(field), "{field}");
        }
        assert_eq!(fields.len(), 11);
        assert_eq!(json["method"], method.name());
        let stages = json["stages"].as_object().unwrap();
        assert_eq!(stages.keys().collect::<Vec<_>>(), [stage]);
        if let Some(best) = &report.target_from_source {
            assert_eq!(json["target_from_source"]["x_m"].as_f64(), Some(best.x()));
        }
    }
}

#[test]
fn a_pose_that_is_known_is_the_answer_and_what_the_maps_say_of_it_is_reported() {
    let pair = world(3);
    let robots = [&pair.target.map, &pair.source.map].map(RobotMap::from);
    let given = |target_from_source| {
        let prior = Some(Prior { target_from_source, sigma_m: 0.0, sigma_rad: 0.0 });
        let params = AlignParams { prior, ..AlignParams::default() };
        let report = align_pair(Method::Match, &robots[0], &robots[1], &params, &()).unwrap();
        assert_eq!((report.method, report.verdict()), (Method::Known, Verdict::Merged));
        assert_eq!(report.target_from_source, Some(target_from_source));
        report
    };
    let right = given(pair.target_from_source);
    assert!(right.warnings.is_empty() && right.agreement > Some(0.8), "{:?}", right.warnings);
    let apart = given(Se2::new(500.0, 0.0, 0.0));
    assert_eq!(
        (apart.overlap, &apart.warnings[..]),
        (Some(0.0), &[Warning::GivenPoseUnchecked][..])
    );
    let wrong = given(pair.target_from_source * Se2::new(1.0, 0.7, 0.3));
    let [Warning::GivenPoseDoubtful { agreement }] = wrong.warnings[..] else {
        panic!("{:?}", wrong.warnings)
    };
    assert_eq!(wrong.agreement, Some(agreement));

    let poses = [Se2::new(5.0, 1.0, 0.3), Se2::new(5.0, 1.0, 0.3) * pair.target_from_source];
    let known = known_poses(&robots, &poses, &AlignParams::default(), &()).unwrap();
    assert_eq!(known.pairs[0].report.overlap, right.overlap);
    assert_eq!(known.component.members[1].reference_from_map, poses[1]);
    let lacking = known_poses(&robots, &poses[..1], &AlignParams::default(), &());
    assert!(matches!(lacking, Err(MergeError::PosesOfMaps { poses: 1, maps: 2 })));
    let nan = [Se2::identity(), Se2::new(f64::NAN, 0.0, 0.0)];
    assert!(known_poses(&robots, &nan, &AlignParams::default(), &()).is_err());
}
