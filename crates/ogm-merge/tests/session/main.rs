//! What those who follow a running team rely on.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod fifty_updates;

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use nalgebra::Point2;
use ogm_core::{ClassThresholds, GridFrame, Occupancy, OccupancyGrid, Progress, Se2};
use ogm_merge::{
    Because, Change, ChangeKind, FusionParams, MergeSession, RobotMap, RobotPrior, SavedSession,
    SessionParams, TeamParams, merge_team,
};
use ogm_sim::{FloorKind, LabelledTeam, labelled_team};

const NAMES: [&str; 5] = ["ann", "bob", "cid", "dot", "eve"];

fn team() -> &'static LabelledTeam {
    static TEAM: OnceLock<LabelledTeam> = OnceLock::new();
    TEAM.get_or_init(|| labelled_team(FloorKind::Offices, 4, true, 22).unwrap())
}

fn session() -> MergeSession {
    MergeSession::new(SessionParams::default()).unwrap()
}

/// What a robot that started at the origin of its frame has seen by a `share` of its way.
fn grown(map: &OccupancyGrid, share: f64) -> OccupancyGrid {
    let known = map.cells().indexed().filter(|(_, cell)| cell.is_known());
    let away = |index| map.frame().cell_centre(index).coords.norm();
    let farthest = known.map(|(index, _)| away(index)).fold(0.0, f64::max);
    let mut grown = map.clone();
    for (index, _) in map.cells().indexed() {
        if away(index) > share * farthest {
            *grown.cells_mut().get_mut(index).unwrap() = Occupancy::UNKNOWN;
        }
    }
    grown
}

/// `map` in a frame that lies at `old_from_new` in its own.
fn in_another_frame(map: &OccupancyGrid, old_from_new: &Se2) -> OccupancyGrid {
    let map_from_grid = old_from_new.inverse() * map.frame().map_from_grid();
    let frame = GridFrame::new(map.frame().resolution(), map_from_grid).unwrap();
    OccupancyGrid::new(frame, map.cells().clone())
}

fn place(session: &MergeSession, robot: &str) -> Option<Se2> {
    session.robot(robot)?.placement.map(|placement| placement.world_from_map)
}

fn assert_at(found: Se2, wanted: &Se2, metres: f64) {
    let off = wanted.between(&found);
    assert!(off.translation().norm() < metres && off.theta().abs() < metres / 5.0, "off by {off}");
}

/// All of a team's maps, grown to the end.
fn fed(maps: &[OccupancyGrid]) -> MergeSession {
    let mut session = session();
    for (name, map) in NAMES.iter().zip(maps) {
        session.update(name, map, &()).unwrap();
    }
    session
}

fn undone<'a>(changes: &'a [Change], robot: &str) -> Option<&'a Because> {
    changes.iter().filter(|change| change.robot == robot).find_map(|change| match &change.kind {
        ChangeKind::Undone { because, .. } => Some(because),
        _ => None,
    })
}

#[test]
fn growing_maps_find_their_places_in_a_frame_that_never_moves() {
    let team = team();
    let mut session = session();
    let mut moves = 0;
    for step in 1..=6 {
        for (name, map) in NAMES.iter().zip(&team.maps) {
            let changes = session.update(name, &grown(map, f64::from(step) / 6.0), &()).unwrap();
            assert_eq!(place(&session, "ann"), Some(Se2::identity()));
            moves += changes.iter().filter(|c| matches!(c.kind, ChangeKind::Moved { .. })).count();
            assert_eq!(place(&session, "eve"), None, "the stranger belongs nowhere");
        }
    }
    assert!(moves <= 1, "{moves} answers were taken back");
    let world_from_first = team.world_from_map[0].unwrap();
    for (map, name) in NAMES.iter().enumerate().take(4) {
        if let Some(found) = place(&session, name) {
            assert_at(found, &world_from_first.between(&team.world_from_map[map].unwrap()), 1.0);
        }
    }
    assert!(NAMES.iter().filter(|name| place(&session, name).is_some()).count() >= 3);

    session.reconsider(&()).unwrap();
    let maps: Vec<RobotMap<'_>> = team.maps.iter().map(RobotMap::from).collect();
    let batch = merge_team(&maps, &TeamParams::default(), &()).unwrap();
    for (map, name) in NAMES.iter().enumerate() {
        let together = batch.components[0].pose(map);
        assert_eq!(place(&session, name).is_some(), together.is_some());
        if let Some((found, together)) = place(&session, name).zip(together) {
            assert_at(found, &together, 0.005);
        }
    }
}

#[test]
fn a_session_taken_up_again_ends_where_it_would_have() {
    let team = team();
    let feed = |session: &mut MergeSession, step: u32| {
        for (name, map) in NAMES.iter().zip(&team.maps) {
            session.update(name, &grown(map, f64::from(step) / 4.0), &()).unwrap();
        }
    };
    let mut whole = session();
    (1..=2).for_each(|step| feed(&mut whole, step));
    let saved = whole.save();
    let mut resumed = MergeSession::resume(saved, SessionParams::default(), &()).unwrap();
    assert_eq!(whole.save(), resumed.save());
    for step in 3..=4 {
        feed(&mut whole, step);
        feed(&mut resumed, step);
    }
    assert_eq!(whole.save(), resumed.save(), "to the last bit");
    assert!(place(&whole, "bob").is_some());
}

#[test]
fn the_same_map_again_changes_nothing() {
    let team = team();
    let mut session = fed(&team.maps);
    let before = session.save();
    assert!(session.update("bob", &team.maps[1], &()).unwrap().is_empty());
    assert_eq!(session.save(), before);
}

/// A session of `ann`'s map and what `bob` has seen by a `share` of his way, in which only what lacks
/// little is searched again.
fn begun(share: f64, accept: f64) -> MergeSession {
    let mut params = SessionParams { changed_share: 2.0, ..SessionParams::default() };
    params.align.matching.accept = accept;
    let mut session = MergeSession::new(params).unwrap();
    session.update("ann", &team().maps[0], &()).unwrap();
    session.update("bob", &grown(&team().maps[1], share), &()).unwrap();
    session
}

#[test]
fn a_pair_that_lacks_little_is_searched_again_at_any_change() {
    let said = |share| begun(share, 1.0).robot("bob").unwrap().best_match.map_or(0.0, |it| it.1);
    let whole = said(1.0);
    let mut shares = (1..100).map(|hundredths| 0.01 * f64::from(hundredths));
    let share = shares.find(|&share| (0.5..0.95 * whole).contains(&said(share))).unwrap();
    let mut session = begun(share, 0.5 * (said(share) + whole));
    assert_eq!(place(&session, "bob"), None);
    session.update("bob", &team().maps[1], &()).unwrap();
    assert!(place(&session, "bob").is_some());
}

#[test]
fn a_call_that_was_cancelled_is_made_up_for_by_the_next() {
    struct At(f64, AtomicBool);
    impl Progress for At {
        fn report(&self, share: f64) {
            self.1.fetch_or(share >= self.0, Ordering::Relaxed);
        }

        fn is_cancelled(&self) -> bool {
            self.1.load(Ordering::Relaxed)
        }
    }
    let team = team();
    let plain = fed(&team.maps[..2]);
    for share in [0.0, 0.15, 0.4] {
        let mut session = fed(&team.maps[..1]);
        let early = At(share, AtomicBool::new(false));
        let outcome = session.update("bob", &team.maps[1], &early);
        assert!(outcome.unwrap_err().is_cancelled());
        session.update("bob", &team.maps[1], &()).unwrap();
        assert_eq!(place(&session, "bob"), place(&plain, "bob"));
    }
}

#[test]
fn a_robot_that_starts_anew_in_another_frame_is_carried_over() {
    let team = team();
    let mut session = fed(&team.maps[..4]);
    let robot = NAMES.iter().skip(1).find(|name| place(&session, name).is_some()).unwrap();
    let map = session.map(robot).unwrap().clone();
    let before = place(&session, robot).unwrap();
    let old_from_new = Se2::new(3.0, -7.0, 1.0);
    let changes = session.update(robot, &in_another_frame(&map, &old_from_new), &()).unwrap();
    assert_eq!(changes[0].kind, ChangeKind::NewFrame);
    assert_at(place(&session, robot).unwrap(), &(before * old_from_new), 0.02);
    assert_eq!(place(&session, "ann"), Some(Se2::identity()));
}

#[test]
fn the_world_stays_when_the_robot_that_held_its_frame_starts_anew_or_leaves() {
    let team = team();
    let mut session = fed(&team.maps[..4]);
    let others: Vec<_> =
        NAMES[1..4].iter().filter_map(|name| Some((*name, place(&session, name)?))).collect();
    assert!(!others.is_empty());
    let changes = session.update("ann", &team.maps[4], &()).unwrap();
    assert_eq!(undone(&changes, "ann"), Some(&Because::NewFrame));
    assert!(session.remove("ann") && !session.remove("ann"));
    for (name, before) in others {
        assert_at(place(&session, name).unwrap(), &before, 0.05);
    }
}

#[test]
fn walls_that_contradict_a_merge_undo_it() {
    let team = team();
    let mut session = session();
    session.update("ann", &team.maps[0], &()).unwrap();
    // The same rooms, which match; then walls, half a metre apart, where the other map saw a way.
    let rooms = grown(&team.maps[0], 0.2);
    session.update("bob", &rooms, &()).unwrap();
    assert!(place(&session, "bob").is_some());
    let mut liar = rooms.clone();
    let thresholds = ClassThresholds::default();
    for (index, &cell) in team.maps[0].cells().indexed() {
        let at = rooms.frame().cell_centre(index);
        if !rooms.at(at).is_known() && thresholds.is_free(cell) {
            let is_wall = at.x.rem_euclid(0.6) < 0.1;
            let cell = if is_wall { Occupancy::OCCUPIED } else { Occupancy::FREE };
            *liar.cells_mut().get_mut(index).unwrap() = cell;
        }
    }
    let changes = session.update("bob", &liar, &()).unwrap();
    let because = undone(&changes, "bob").unwrap();
    assert!(matches!(because, Because::Contradicted { .. } | Because::Outweighed { .. }));
    assert_eq!(place(&session, "ann"), Some(Se2::identity()));
}

#[test]
fn what_somebody_asks_for_holds_until_it_is_released() {
    let team = team();
    let mut session = fed(&team.maps[..4]);
    let robot = NAMES.iter().skip(1).find(|name| place(&session, name).is_some()).unwrap();
    let found = place(&session, robot).unwrap();
    let changes = session.separate(robot, &()).unwrap();
    assert_eq!(undone(&changes, robot), Some(&Because::Asked));
    session.reconsider(&()).unwrap();
    assert_eq!(place(&session, robot), None);
    session.release(robot, &()).unwrap();
    assert_at(place(&session, robot).unwrap(), &found, 0.02);

    let world_from_map = Se2::new(40.0, -3.0, 1.0);
    let pinned = RobotPrior { world_from_map, sigma_m: 0.0, sigma_rad: 0.0 };
    session.set_prior(robot, pinned, &()).unwrap();
    assert_at(place(&session, robot).unwrap(), &world_from_map, 1e-9);
    assert!(session.set_prior("nobody", pinned, &()).is_err());
}

#[test]
fn the_merged_map_lies_in_the_world() {
    let team = team();
    assert!(session().fuse(&FusionParams::default(), &()).unwrap().is_none());
    let session = fed(&team.maps[..2]);
    let merged = session.fuse(&FusionParams::default(), &()).unwrap().unwrap();
    let walls = |map: &OccupancyGrid| map.occupied_points(&ClassThresholds::default());
    let kept_walls = walls(&merged.map);
    let is_wall = |at: &Point2<f64>| kept_walls.iter().any(|wall| (wall - at).norm() < 0.1);
    let of_first = walls(&team.maps[0]);
    let kept = of_first.iter().step_by(97).filter(|wall| is_wall(wall)).count();
    assert!(kept * 100 >= of_first.iter().step_by(97).count() * 95);
}

#[test]
fn saved_data_that_is_no_session_is_an_error() {
    let team = team();
    let good = serde_json::to_value(fed(&team.maps[..2]).save()).unwrap();
    let resume = |value: serde_json::Value| {
        let saved: SavedSession = serde_json::from_value(value).unwrap();
        MergeSession::resume(saved, SessionParams::default(), &()).map(|_| ())
    };
    assert!(resume(good.clone()).is_ok());
    for (path, value) in [
        ("/version", 7.into()),
        ("/robots/0/width", 100_000_000.into()),
        ("/robots/0/resolution", 0.0.into()),
        ("/groups/0/0/map", 9.into()),
        ("/groups/0/0/group_from_map/2", 7.0.into()),
        ("/pairs/0/source", 0.into()),
    ] {
        let mut bad = good.clone();
        *bad.pointer_mut(path).unwrap() = value;
        let read = serde_json::from_value::<SavedSession>(bad.clone());
        assert!(read.is_err() || resume(bad).is_err(), "{path}");
    }
}
