//! A team for as long as it runs: four robots, fifty updates of maps that grow.

use ogm_core::{GridFrame, Occupancy, OccupancyGrid, Se2};
use ogm_merge::{
    AlignParams, Change, ChangeKind, MatchParams, MergeSession, RobotMap, SavedSession,
    SessionParams, TeamParams, merge_team,
};
use ogm_sim::{FloorKind, LabelledTeam, labelled_team};

use super::{NAMES, assert_at, grown, place, session};

const ROBOTS: usize = 4;
const UPDATES: usize = 50;
/// After so many, the session is killed.
const KILLED: usize = 23;

fn floor() -> LabelledTeam {
    labelled_team(FloorKind::Flat, ROBOTS, false, 41).unwrap()
}

/// Who says what in update `index`: in turns, the last four with all of what they saw.
fn update(team: &LabelledTeam, index: usize) -> (&'static str, OccupancyGrid) {
    let robot = index % ROBOTS;
    let share = 0.2 + 0.8 * (index + ROBOTS - robot) as f64 / UPDATES as f64;
    (NAMES[robot], grown(&team.maps[robot], share.min(1.0)))
}

/// Whether a robot took back an answer, and what it was.
fn taken_back(change: &Change) -> Option<(&str, Se2)> {
    match change.kind {
        ChangeKind::Moved { old_world_from_map, .. }
        | ChangeKind::Undone { old_world_from_map, .. } => {
            Some((&change.robot, old_world_from_map))
        }
        _ => None,
    }
}

fn is_near(a_from_map: &Se2, b_from_map: &Se2) -> bool {
    let off = a_from_map.between(b_from_map);
    off.translation().norm() < 0.75 && off.theta().abs() < 0.1
}

#[test]
fn fifty_updates_of_four_robots_end_where_all_maps_at_once_do() {
    let team = floor();
    let mut whole = session();
    let mut resumed: Option<MergeSession> = None;
    let mut left: Vec<(String, Se2)> = Vec::new();
    for index in 0..UPDATES {
        if index == KILLED {
            let text = serde_json::to_string(&whole.save()).unwrap();
            let saved: SavedSession = serde_json::from_str(&text).unwrap();
            resumed = Some(MergeSession::resume(saved, SessionParams::default(), &()).unwrap());
        }
        let (robot, map) = update(&team, index);
        for change in whole.update(robot, &map, &()).unwrap() {
            left.extend(taken_back(&change).map(|(robot, pose)| (robot.to_owned(), pose)));
        }
        if let Some(resumed) = &mut resumed {
            resumed.update(robot, &map, &()).unwrap();
        }
        assert_eq!(place(&whole, NAMES[0]), Some(Se2::identity()), "the frame moved at {index}");
        for (robot, pose) in &left {
            let back = place(&whole, robot).is_some_and(|found| is_near(&found, pose));
            assert!(!back, "{robot} is back where it was said not to be at {index}");
        }
    }
    let mut resumed = resumed.unwrap();
    assert!(whole.save() == resumed.save(), "the same to the last bit");

    whole.reconsider(&()).unwrap();
    resumed.reconsider(&()).unwrap();
    assert!(whole.save() == resumed.save(), "the same to the last bit");
    assert_eq!(place(&whole, NAMES[0]), Some(Se2::identity()));
    let maps: Vec<RobotMap<'_>> = team.maps.iter().map(RobotMap::from).collect();
    let batch = merge_team(&maps, &TeamParams::default(), &()).unwrap();
    assert!(batch.components[0].members.len() >= 3, "little hangs together");
    let finest = team.maps.iter().map(|map| map.frame().resolution()).fold(1.0, f64::min);
    for (map, name) in NAMES.iter().enumerate().take(ROBOTS) {
        let together = batch.components[0].pose(map);
        assert_eq!(place(&whole, name).is_some(), together.is_some(), "{name}");
        if let Some((found, together)) = place(&whole, name).zip(together) {
            assert_at(found, &together, 0.1 * finest);
        }
    }
}

/// A room of 12 by 8 metres, its middle at the origin, that half a turn puts on itself but for blocks
/// of so many metres at these places.
fn room(blocks: &[(f64, f64, f64)]) -> OccupancyGrid {
    let walls = [
        (-6.0, -4.0, 6.0, -3.9),
        (-6.0, 3.9, 6.0, 4.0),
        (-6.0, -4.0, -5.9, 4.0),
        (5.9, -4.0, 6.0, 4.0),
        (-2.0, -3.9, -1.9, 0.4),
        (1.9, -0.4, 2.0, 3.9),
        (-4.5, 1.5, -1.9, 1.6),
        (1.9, -1.6, 4.5, -1.5),
    ];
    let frame = GridFrame::new(0.05, Se2::new(-6.0, -4.0, 0.0)).unwrap();
    let cells = ogm_core::Grid::filled(240, 160, Occupancy::FREE).unwrap();
    let mut map = OccupancyGrid::new(frame, cells);
    for index in map.clone().cells().indexed().map(|(index, _)| index) {
        let at = frame.cell_centre(index);
        let is_in = |&(x0, y0, x1, y1): &(f64, f64, f64, f64)| {
            (x0..x1).contains(&at.x) && (y0..y1).contains(&at.y)
        };
        let is_block = |&(x, y, size): &(f64, f64, f64)| {
            is_in(&(x - size / 2.0, y - size / 2.0, x + size / 2.0, y + size / 2.0))
        };
        if walls.iter().any(is_in) || blocks.iter().any(is_block) {
            *map.cells_mut().get_mut(index).unwrap() = Occupancy::OCCUPIED;
        }
    }
    map
}

/// How often a robot changes its place in a room that half a turn puts on itself, once what told the
/// two answers apart is gone and a small thing speaks now for one and now for the other.
fn changes_of_mind(lead: f64) -> usize {
    // Both answers would do by themselves.
    let matching = MatchParams { accept: 0.3, ..MatchParams::default() };
    let align = AlignParams { matching, ..AlignParams::default() };
    let params = SessionParams { align, lead, changed_share: 0.0 };
    let mut session = MergeSession::new(params).unwrap();
    let stove = (-4.0, -2.5, 1.2);
    session.update("ann", &room(&[stove]), &()).unwrap();
    session.update("bob", &room(&[stove]), &()).unwrap();
    assert_at(place(&session, "bob").unwrap(), &Se2::identity(), 0.1);
    let chair = (4.2, 1.0, 0.2);
    session.update("ann", &room(&[chair]), &()).unwrap();
    let mut moves = 0;
    for index in 0..12 {
        let (x, y, size) = chair;
        let chair = if index % 2 == 0 { (-x, -y, size) } else { chair };
        let changes = session.update("bob", &room(&[chair]), &()).unwrap();
        moves += changes.iter().filter(|change| taken_back(change).is_some()).count();
        assert_eq!(place(&session, "ann"), Some(Se2::identity()));
    }
    moves
}

#[test]
fn answers_of_equal_evidence_do_not_take_turns() {
    assert_eq!(changes_of_mind(SessionParams::default().lead), 0);
    assert!(changes_of_mind(0.0) > 3, "nothing tempted it");
}
