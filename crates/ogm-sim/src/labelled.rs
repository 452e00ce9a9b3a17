//! Pairs of maps with the right answer, drawn at random.

use nalgebra::Vector2;
use ogm_core::{OccupancyGrid, RobotId};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::conditions::{Conditions, direction};
use crate::draw::{Stream, generator};
use crate::explore::{Part, explore, free_space};
use crate::navigate::FreeSpace;
use crate::pair_bend::PairBend;
use crate::run::{bend, frame_at_start, random_heading};
use crate::style::MapStyle;
use crate::truth::{PairTruth, pair_truth};
use crate::{
    DriftParams, FloorKind, FloorPlan, PairParams, RobotRun, SOURCE, SimError, TARGET,
    map_along_path,
};

/// Overlap of pairs that do.
const OVERLAP: [f64; 2] = [0.15, 1.0];
/// Share of them that show the same floor, as two mappers of one run do, or a visit and a later one.
const WHOLE_SHARE: f64 = 0.3;
/// Overlap of these, as planned.
const WHOLE: [f64; 2] = [0.85, 1.0];
/// How close a drawn overlap is met.
const NEAR: f64 = 0.06;
/// Overlap up to which maps have nothing in common: a glance through a door.
const TOUCH: f64 = 0.01;
/// Least range of a robot that had to see less, metres.
const SHORTEST_RANGE: f64 = 2.5;
/// Explorations before the best so far is taken.
const ATTEMPTS: usize = 6;

/// How two maps belong together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Relation {
    /// Parts of one floor that overlap by at least 15 %.
    Overlapping,
    /// Parts of one floor that have nothing in common.
    Apart,
    /// Two floors, of one kind or of two, under one set of conditions.
    Unrelated,
    /// Two floors of two kinds that two teams visited, each under conditions of its own.
    Strangers,
}

/// Two maps and the truth about them.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LabelledPair {
    /// The map whose frame is kept.
    pub target: OccupancyGrid,
    /// The map to be moved.
    pub source: OccupancyGrid,
    /// How the maps lie on each other; `None` if they must not be merged.
    pub truth: Option<PairTruth>,
    /// Where every place of the source lies in the target; `None` where `truth` is.
    pub bend: Option<PairBend>,
    /// Whether both robots knew their poses and nothing moved, so that the truth is exact.
    pub exact: bool,
    /// Who made each map.
    pub styles: [MapStyle; 2],
}

/// Draws a pair of maps: floor, parts explored, sensors, resolutions, drift and moved furniture
/// are all decided by `seed`.
///
/// # Errors
/// A floor that robots cannot explore as asked for: another seed may do.
pub fn labelled_pair(
    kind: FloorKind,
    relation: Relation,
    seed: u64,
) -> Result<LabelledPair, SimError> {
    let item = 3 * kind as u64 + relation as u64;
    let mut rng = generator(seed, Stream::Pair, item);
    let conditions = Conditions::draw(&mut rng);
    let plan = kind.draw(rng.random());
    let pair = match relation {
        Relation::Overlapping => overlapping(&plan, &conditions, &mut rng),
        Relation::Apart => apart(&plan, &conditions, &mut rng),
        Relation::Unrelated => {
            let other = FloorKind::ALL[rng.random_range(0..FloorKind::ALL.len())];
            let other = if rng.random_bool(0.5) { kind } else { other };
            unrelated([&plan, &other.draw(rng.random())], &conditions, &mut rng)
        }
        Relation::Strangers => return strangers(kind, seed),
    }?;
    Ok(restyled(pair, conditions.styles, seed))
}

/// Draws a pair of overlapping maps as [`labelled_pair`] does, bent by `bends` (target, source;
/// [`DriftParams::bend`](crate::DriftParams::bend)) and wrong by nothing else.
///
/// # Errors
/// A floor that robots cannot explore as asked for: another seed may do.
pub fn bent_pair(kind: FloorKind, bends: [f64; 2], seed: u64) -> Result<LabelledPair, SimError> {
    let mut rng = generator(seed, Stream::Pair, kind as u64);
    let mut conditions = Conditions::draw(&mut rng);
    let drift = |bend| DriftParams { bend, ..DriftParams::default() };
    [conditions.target.drift, conditions.source.drift] = bends.map(drift);
    let pair = overlapping(&kind.draw(rng.random()), &conditions, &mut rng)?;
    Ok(restyled(pair, conditions.styles, seed))
}

/// The maps as their mappers saved them.
fn restyled(pair: LabelledPair, styles: [MapStyle; 2], seed: u64) -> LabelledPair {
    let target = styles[0].apply(&pair.target, seed);
    let source = styles[1].apply(&pair.source, seed.wrapping_add(1));
    LabelledPair { target, source, styles, ..pair }
}

/// Two robots on one floor, before it is decided how far each goes.
struct Visit<'a> {
    plans: [&'a FloorPlan; 2],
    spaces: [&'a FreeSpace; 2],
    params: [PairParams; 2],
    /// Along which the parts lie.
    normal: Vector2<f64>,
    /// Area of the second part over that of the first.
    ratio: f64,
}

impl Visit<'_> {
    /// Maps of parts of which `planned` of the smaller is common; negative leaves a gap.
    fn maps(&self, planned: f64, rng: &mut ChaCha8Rng) -> Result<[RobotRun; 2], SimError> {
        let first = 1.0 / (1.0 + self.ratio * (1.0 - planned));
        let parts = [(first, self.normal), (self.ratio * first, -self.normal)];
        let run = |robot: RobotId, rng: &mut ChaCha8Rng| {
            let index = usize::from(robot == SOURCE);
            let (share, normal) = parts[index];
            let floor = (self.plans[index], self.spaces[index]);
            mapped(floor, &self.params[index], robot, share, normal, rng)
        };
        Ok([run(TARGET, rng)?, run(SOURCE, rng)?])
    }

    fn truth(&self, maps: &[RobotRun; 2]) -> Result<Option<PairTruth>, SimError> {
        let bends = [(TARGET, 0), (SOURCE, 1)].map(|(robot, map)| bend(robot, &self.params[map]));
        pair_truth(&maps[0], &maps[1], [&bends[0], &bends[1]])
    }
}

/// A map of the share of a floor that lies furthest against `normal`.
fn mapped(
    (plan, space): (&FloorPlan, &FreeSpace),
    params: &PairParams,
    robot: RobotId,
    share: f64,
    normal: Vector2<f64>,
    rng: &mut ChaCha8Rng,
) -> Result<RobotRun, SimError> {
    let part = Part::holding(share, space, normal);
    let middle = plan.size() / 2.0;
    let path = explore(space, &part, params.step, rng)
        .ok_or(SimError::BlockedRoute { x: middle.x, y: middle.y })?;
    let world_from_map = frame_at_start(&path, random_heading(params.seed, robot));
    map_along_path(plan, &path, &[], world_from_map, robot, params)
}

fn overlapping(
    plan: &FloorPlan,
    conditions: &Conditions,
    rng: &mut ChaCha8Rng,
) -> Result<LabelledPair, SimError> {
    let later = plan.with_furniture_moved(conditions.moved_share, rng);
    let spaces = [&free_space(plan)?, &free_space(&later)?];
    let mut params = [conditions.target, conditions.source];
    let is_whole = rng.random_bool(WHOLE_SHARE);
    let range = if is_whole { WHOLE } else { [OVERLAP[0], WHOLE[0]] };
    let (normal, ratio) = (direction(rng), rng.random_range(0.5..1.0));
    let ratio = if is_whole { 1.0 } else { ratio };
    let wanted = rng.random_range(range[0]..range[1]);
    let mut planned = wanted - if is_whole { 0.0 } else { 0.15 };
    let mut best: Option<(f64, LabelledPair)> = None;
    for _ in 0..ATTEMPTS {
        let visit = Visit { plans: [plan, &later], spaces, params, normal, ratio };
        let maps = visit.maps(planned, rng)?;
        let truth = visit.truth(&maps)?;
        let overlap = truth.map_or(0.0, |truth| truth.overlap);
        let off = (overlap - wanted).abs();
        if best.as_ref().is_none_or(|(least, _)| off < *least) {
            let bend = truth.map(|_| PairBend::between(&maps[0], &maps[1]));
            best = Some((off, LabelledPair { bend, ..labelled(maps, truth, conditions) }));
        }
        if off < NEAR {
            break;
        }
        planned = (planned + 1.3 * (wanted - overlap)).clamp(-2.0, 0.98);
        // Where no gap is wide enough, the robots see too far.
        if planned < -0.5 {
            params = params.map(short_sighted);
        }
    }
    best.map(|(_, pair)| pair)
        .filter(|pair| {
            let overlap = pair.truth.map_or(0.0, |truth| truth.overlap);
            (OVERLAP[0]..=OVERLAP[1] + NEAR).contains(&overlap)
        })
        .ok_or(SimError::NoSuchPair)
}

fn apart(
    plan: &FloorPlan,
    conditions: &Conditions,
    rng: &mut ChaCha8Rng,
) -> Result<LabelledPair, SimError> {
    let normal = direction(rng);
    let ratio = rng.random_range(0.5..1.0);
    let space = free_space(plan)?;
    let mut params = [conditions.target, conditions.source];
    let mut gap = 0.3;
    for _ in 0..ATTEMPTS {
        let visit = Visit { plans: [plan; 2], spaces: [&space; 2], params, normal, ratio };
        let maps = visit.maps(-gap, rng)?;
        if visit.truth(&maps)?.is_none_or(|truth| truth.overlap < TOUCH) {
            return Ok(labelled(maps, None, conditions));
        }
        gap *= 2.0;
        params = params.map(short_sighted);
    }
    Err(SimError::NoSuchPair)
}

/// The same robot with a shorter range.
fn short_sighted(mut params: PairParams) -> PairParams {
    params.lidar.max_range = (0.75 * params.lidar.max_range).max(SHORTEST_RANGE);
    params
}

fn strangers(kind: FloorKind, seed: u64) -> Result<LabelledPair, SimError> {
    let steps = usize::try_from(seed % (FloorKind::ALL.len() as u64 - 1)).unwrap_or(0) + 1;
    let mut from_kind = FloorKind::ALL.into_iter().cycle().skip_while(|&other| other != kind);
    let other = from_kind.nth(steps).unwrap_or(kind);
    let target = labelled_pair(kind, Relation::Unrelated, seed)?;
    let source = labelled_pair(other, Relation::Unrelated, seed)?;
    Ok(LabelledPair {
        source: source.target,
        exact: target.exact && source.exact,
        styles: [target.styles[0], source.styles[0]],
        ..target
    })
}

fn unrelated(
    [target, source]: [&FloorPlan; 2],
    conditions: &Conditions,
    rng: &mut ChaCha8Rng,
) -> Result<LabelledPair, SimError> {
    let mut run = |plan, params, robot| {
        let share = rng.random_range(0.4..1.0);
        let normal = direction(rng);
        mapped((plan, &free_space(plan)?), params, robot, share, normal, rng)
    };
    let target = run(target, &conditions.target, TARGET)?;
    let source = run(source, &conditions.source, SOURCE)?;
    Ok(labelled([target, source], None, conditions))
}

fn labelled(
    [target, source]: [RobotRun; 2],
    truth: Option<PairTruth>,
    conditions: &Conditions,
) -> LabelledPair {
    let drifts = [conditions.target.drift, conditions.source.drift] != [DriftParams::default(); 2];
    let exact = !drifts && conditions.moved_share == 0.0;
    let styles = [MapStyle::Plain; 2];
    LabelledPair { target: target.map, source: source.map, truth, bend: None, exact, styles }
}
