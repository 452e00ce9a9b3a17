//! Which rooms each of two robots visits, and how it gets there.

use nalgebra::Point2;
use rand_chacha::ChaCha8Rng;

use crate::draft::Room;
use crate::navigate::{FreeSpace, Node};
use crate::wander::wander;
use crate::{FloorPlan, SimError};

/// Distance that way points keep from everything, metres.
const CLEARANCE: f64 = 0.3;
/// What two robots should have in common of the area that one of them visits. Each also sees
/// through doors, which adds to it.
const SHARE: f64 = 0.44;
/// Places that a robot visits in a room.
const PLACES: usize = 3;

/// The way points of two robots: one visits the rooms from one end of the corridor on, the other
/// those from the other end, as many as give about the wanted overlap.
pub(crate) fn rounds(
    plan: &FloorPlan,
    corridor: Room,
    mut rooms: Vec<Room>,
    rng: &mut ChaCha8Rng,
) -> Result<[Vec<Point2<f64>>; 2], SimError> {
    let middle = nalgebra::center(&corridor.low, &corridor.high);
    let blocked = |at: Point2<f64>| SimError::BlockedRoute { x: at.x, y: at.y };
    let (frame, solid) = plan.raster(0.05)?;
    let space =
        FreeSpace::around(&solid, &frame, CLEARANCE, middle).ok_or_else(|| blocked(middle))?;

    let axis = usize::from(corridor.high.y - corridor.low.y > corridor.high.x - corridor.low.x);
    rooms.sort_by(|a, b| (a.low[axis] + a.high[axis]).total_cmp(&(b.low[axis] + b.high[axis])));
    let [ahead, behind] = rooms_each(&rooms, corridor.area());
    let forth: Vec<Room> = rooms.iter().take(ahead).copied().collect();
    let back: Vec<Room> = rooms.iter().rev().take(behind).copied().collect();
    let mut route = |rooms: &[Room]| {
        let mut goals = Vec::new();
        for room in rooms {
            let inside = places_in(room, &space, rng);
            if inside.is_empty() {
                return Err(blocked(nalgebra::center(&room.low, &room.high)));
            }
            goals.extend(inside);
        }
        wander(&space, &goals, rng).ok_or_else(|| blocked(middle))
    };
    Ok([route(&forth)?, route(&back)?])
}

/// How many rooms each robot visits from its own end, with at least one in common, so that the
/// shared area comes closest to the wanted share.
fn rooms_each(rooms: &[Room], corridor: f64) -> [usize; 2] {
    let count = rooms.len();
    let area = |rooms: &[Room]| corridor + rooms.iter().map(Room::area).sum::<f64>();
    let error = |&[ahead, behind]: &[usize; 2]| {
        let (forth, back) = (&rooms[..ahead], &rooms[count - behind..]);
        let shared = &rooms[count - behind..ahead];
        (2.0 * area(shared) / (area(forth) + area(back)) - SHARE).abs()
    };
    (1..=count)
        .flat_map(|ahead| (count - ahead + 1..=count).map(move |behind| [ahead, behind]))
        // Neither drives much more than the other.
        .filter(|&[ahead, behind]| ahead.abs_diff(behind) <= 1)
        .min_by(|a, b| error(a).total_cmp(&error(b)))
        .unwrap_or([count, count])
}

/// Reachable places of a room that lie apart.
fn places_in(room: &Room, space: &FreeSpace, rng: &mut ChaCha8Rng) -> Vec<Node> {
    let candidates: Vec<Node> =
        (0..40).filter_map(|_| space.node_near(room.point(0.6, rng))).collect();
    let mut places: Vec<Node> = candidates.first().copied().into_iter().collect();
    while places.len() < PLACES && places.len() < candidates.len() {
        let apart = |&node: &Node| {
            let distances =
                places.iter().map(|&other| (space.point(node) - space.point(other)).norm());
            distances.fold(f64::INFINITY, f64::min)
        };
        places.extend(candidates.iter().copied().max_by(|a, b| apart(a).total_cmp(&apart(b))));
    }
    places
}
