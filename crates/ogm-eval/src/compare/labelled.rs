//! X7: how often the matcher is right, and whether it knows, on labelled pairs of maps.

use grid_match::{MatchParams, match_maps};
use ogm_core::Refusal;
use ogm_sim::{FloorKind, LabelledPair, PairTruth, Relation, SimError, labelled_pair};
use rayon::prelude::*;

use super::record::{Run, RunResult, TransformError};
use super::{Args, Measured, labelled_curve, labelled_tables, progress};

/// Where the seeds of this experiment begin: the weights of the matcher were fitted on smaller
/// ones.
const FIRST_SEED: u64 = 3_000_000;
/// Relations of the pairs of one floor kind and seed.
const RELATIONS: [Relation; 4] =
    [Relation::Overlapping, Relation::Overlapping, Relation::Unrelated, Relation::Apart];
/// A pose further than this from the truth is wrong, metres, besides what the truth is unsure of.
const RIGHT_M: f64 = 0.4;
/// A pose turned further than this is wrong, radians: 3°.
const RIGHT_RAD: f64 = 3.0 * std::f64::consts::PI / 180.0;

/// One pair and what was said about it.
#[derive(Debug, Clone)]
pub(super) struct Judged {
    pub(super) kind: FloorKind,
    pub(super) relation: Relation,
    pub(super) seed: u64,
    /// Metres a cell, of the coarser map.
    pub(super) cell: f64,
    pub(super) exact: bool,
    pub(super) truth: Option<PairTruth>,
    pub(super) best: Option<Best>,
    pub(super) refusal: Option<Refusal>,
    /// Whether the right pose is among the hypotheses.
    pub(super) is_listed: bool,
}

/// The best hypothesis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Best {
    pub(super) probability: f64,
    pub(super) is_right: bool,
    /// Root mean square over the shared area, metres; infinite if there is none.
    pub(super) displacement: f64,
    /// Radians.
    pub(super) turn: f64,
}

impl Judged {
    pub(super) fn is_merged(&self) -> bool {
        self.refusal.is_none()
    }

    pub(super) fn is_right(&self) -> bool {
        self.best.is_some_and(|best| best.is_right)
    }

    /// Parts of a floor that repeats itself look like one part seen twice: nothing in the maps
    /// says that they must not be merged.
    pub(super) fn is_decidable(&self) -> bool {
        !(self.kind.repeats() && self.relation == Relation::Apart)
    }
}

/// Draws and matches the pairs.
pub(super) fn run(args: &Args) -> anyhow::Result<Measured> {
    let count = if args.quick { 4 } else { args.runs.map_or(100, u64::from) };
    let first = FIRST_SEED + args.seed * 4;
    let drawn: Vec<(FloorKind, Relation, u64)> = (0..count)
        .flat_map(|index| FloorKind::ALL.map(|kind| (index, kind)))
        .flat_map(|(index, kind)| {
            (0_u64..)
                .zip(RELATIONS)
                .map(move |(offset, relation)| (kind, relation, first + 4 * index + offset))
        })
        .collect();
    let bar = progress("X7 labelled pairs", drawn.len() as u64);
    let judged: Vec<Option<Judged>> = drawn
        .par_iter()
        .map(|&(kind, relation, seed)| {
            bar.inc(1);
            match labelled_pair(kind, relation, seed) {
                Ok(pair) => judge(kind, relation, seed, &pair).map(Some),
                Err(SimError::NoSuchPair | SimError::BlockedRoute { .. }) => Ok(None),
                Err(error) => Err(error.into()),
            }
        })
        .collect::<anyhow::Result<_>>()?;
    bar.finish_and_clear();
    let judged: Vec<Judged> = judged.into_iter().flatten().collect();
    let mut section = labelled_tables::section(&judged, drawn.len(), args.quick);
    labelled_curve::add(&mut section, &judged, args.quick);
    let mut measured = Measured::of_section(section);
    measured.runs = judged.iter().map(record).collect();
    Ok(measured)
}

fn judge(
    kind: FloorKind,
    relation: Relation,
    seed: u64,
    pair: &LabelledPair,
) -> anyhow::Result<Judged> {
    let report = match_maps(&pair.target, &pair.source, &MatchParams::default())?;
    let hypotheses: Vec<Best> = report
        .hypotheses
        .iter()
        .map(|hypothesis| {
            let pose = &hypothesis.target_from_source;
            let [displacement, turn] = pair
                .truth
                .map_or([f64::INFINITY; 2], |truth| [truth.displacement(pose), truth.turn(pose)]);
            let unsure = pair.truth.map_or(0.0, |truth| truth.residual);
            let is_right = displacement < RIGHT_M + unsure && turn < RIGHT_RAD;
            Best { probability: hypothesis.probability, is_right, displacement, turn }
        })
        .collect();
    Ok(Judged {
        kind,
        relation,
        seed,
        cell: pair.target.frame().resolution().max(pair.source.frame().resolution()),
        exact: pair.exact,
        truth: pair.truth,
        best: hypotheses.first().copied(),
        refusal: report.outcome.refusal().cloned(),
        is_listed: hypotheses.iter().any(|hypothesis| hypothesis.is_right),
    })
}

fn record(judged: &Judged) -> Run {
    let result = match (&judged.refusal, judged.best, judged.truth) {
        (Some(refusal), _, _) => RunResult::Refused(refusal.clone()),
        (None, Some(best), Some(_)) => RunResult::Transform(TransformError {
            mse_disp: (best.displacement / 0.02).powi(2),
            mse_nn: f64::NAN,
            translation_m: best.displacement,
            rotation: best.turn,
        }),
        _ => RunResult::FalseMerge,
    };
    Run {
        experiment: "X7",
        case: format!("{}, {:?}", judged.kind.name(), judged.relation).to_lowercase(),
        variant: "match".to_owned(),
        seed: judged.seed,
        result,
    }
}
