//! The front door for a team: any number of maps in, one report out.

mod copies;
mod join;
mod link;
mod pairs;
mod params;
mod part;
mod place;
mod report;

use std::cmp::Reverse;

use nalgebra::Matrix3;
use ogm_core::{Outcome, Progress, Refusal, Se2, Stage};

use crate::merge::{Component, Member};
use crate::{MergeError, RobotMap};

use self::copies::copies;
pub(crate) use self::join::join;
pub(crate) use self::link::{Evidences, contradiction, is_apart};
pub(crate) use self::pairs::{Matched, Proposal, given, matched, prepared};
pub(crate) use self::part::Part;
pub(crate) use self::place::{Place, agreeing, placed};
pub(crate) use self::report::probability_between;

pub use self::params::{KnownPose, PairAlignment, TeamParams};
pub use self::report::{Join, TeamPair, TeamReport};

/// Shares of the work after which the maps are prepared, the pairs matched, and all is joined.
const PREPARED: f64 = 0.05;
const MATCHED: f64 = 0.8;

/// Finds which maps hang together, and where each lies.
///
/// Every pair is matched by itself. Then groups of maps are joined, the surest first: what speaks
/// for and against a join is counted once, on the maps of each group laid together, so that a map
/// that no single other places may be placed by all of them, and one pair whose maps contradict
/// each other in a join vetoes it. What cannot be placed stays apart. The joint poses are those of
/// least squares over all pairs that agree. Neither copies nor the order of the maps change the
/// answer.
///
/// # Errors
/// Input that cannot be meant, or a call that was cancelled; maps that do not hang together are
/// several components.
pub fn merge_team(
    maps: &[RobotMap<'_>],
    params: &TeamParams,
    progress: &dyn Progress,
) -> Result<TeamReport, MergeError> {
    params.check(maps.len())?;
    let copies = copies(maps, params.reference);
    let is_copy = |map: usize| copies.iter().any(|(copy, _)| *copy == map);
    let originals: Vec<usize> = (0..maps.len()).filter(|&map| !is_copy(map)).collect();
    let thresholds = &params.align.matching.thresholds;
    let prepared = prepared(maps, thresholds, &Stage::new(progress, 0.0, PREPARED))?;
    let all: Vec<(usize, usize)> = originals
        .iter()
        .enumerate()
        .flat_map(|(index, &a)| originals[index + 1..].iter().map(move |&b| (a, b)))
        .collect();
    let known = |map: usize| params.known(map);
    let mut aligned: Vec<Matched> = params.alignments.iter().map(Matched::elsewhere).collect();
    aligned.sort_by_key(Matched::maps);
    aligned.dedup_by_key(|pair| pair.maps());
    let is_open = |&(a, b): &(usize, usize)| given(known(a), known(b)).is_none();
    aligned.retain(|pair| all.binary_search(&pair.maps()).is_ok() && is_open(&pair.maps()));
    let is_aligned =
        |maps: &(usize, usize)| aligned.binary_search_by_key(maps, Matched::maps).is_ok();
    let open = all.iter().copied().filter(|maps| is_open(maps) && !is_aligned(maps));
    let open: Vec<_> = open.collect();
    let matching = Stage::new(progress, PREPARED, MATCHED);
    let searched = matched(maps, &prepared, &open, &params.align, &known, &matching)?;
    let searched = searched.into_iter().map(|(pair, report)| (pair, Some(report)));
    let mut found: Vec<_> = aligned.into_iter().map(|pair| (pair, None)).chain(searched).collect();
    found.sort_by_key(|(pair, _)| pair.maps());
    let (pairs, reports): (Vec<_>, Vec<_>) = found.into_iter().unzip();

    let matching = &params.align.matching;
    let evidences = Evidences { prepared: &prepared, pairs: &pairs, repeats: matching.repeats };
    let is_given = |map: usize| params.known(map).filter(|known| known.is_given());
    let known = originals.iter().filter_map(|&map| Some((map, is_given(map)?.reference_from_map)));
    let known: Vec<(usize, Se2)> = known.collect();
    let mut parts = Vec::with_capacity(originals.len());
    if known.len() > 1 {
        parts.push(Part::of(known.clone(), &prepared, thresholds)?);
    }
    let is_known = |map: usize| known.len() > 1 && known.iter().any(|(known, _)| *known == map);
    let alone = originals.iter().copied().filter(|&map| !is_known(map));
    parts.extend(alone.map(Part::alone));
    let joining = Stage::new(progress, MATCHED, 1.0);
    let (parts, joins) = join(parts, &evidences, matching, &|_, _| true, &joining)?;

    let mut components = Vec::with_capacity(parts.len());
    for part in &parts {
        let maps = part.maps();
        let reference = if maps.contains(&params.reference) { params.reference } else { maps[0] };
        let places = placed(&part.members, &pairs, &prepared, reference)?;
        components.push(component(&places, reference, &copies));
    }
    components.sort_by_key(|component| {
        let first = component.members.iter().map(|member| member.map).min();
        (Reverse(component.pose(params.reference).is_some()), first)
    });
    let mut matched = pairs.into_iter().zip(reports).peekable();
    let pairs = all.into_iter().map(|(target, source)| {
        let target_from_source = components
            .iter()
            .find_map(|component| Some(component.pose(target)?.between(&component.pose(source)?)));
        let found = matched.next_if(|(pair, _)| pair.maps() == (target, source));
        let hypothesis = found
            .as_ref()
            .zip(target_from_source)
            .and_then(|((pair, _), pose)| agreeing(pair, &pose, &prepared));
        let report = found.and_then(|(_, report)| report);
        TeamPair { target, source, report, target_from_source, hypothesis }
    });
    let pairs = pairs.collect();
    progress.report(1.0);
    Ok(TeamReport { components, pairs, joins, copies })
}

/// The reference first, the others ascending, copies where their originals are.
fn component(places: &[Place], reference: usize, copies: &[(usize, usize)]) -> Component {
    let member = |map: usize, place: &Place| Member {
        map,
        reference_from_map: place.reference_from_map,
        covariance: if place.map == reference { Some(Matrix3::zeros()) } else { place.covariance },
        bend_m: place.bend_m,
    };
    let mut members: Vec<Member> = Vec::new();
    for place in places {
        members.push(member(place.map, place));
        let same = copies.iter().filter(|(_, original)| *original == place.map);
        members.extend(same.map(|(copy, _)| member(*copy, place)));
    }
    members.sort_by_key(|member| (member.map != reference, member.map));
    Component { members }
}

impl Component {
    /// Maps points of `map` into the frame of the component; `None` if it is not in it.
    #[must_use]
    pub fn pose(&self, map: usize) -> Option<Se2> {
        let member = self.members.iter().find(|member| member.map == map);
        member.map(|member| member.reference_from_map)
    }
}

impl TeamPair {
    /// Why the pair is not merged, by the two maps themselves; `None` if they match or were given.
    #[must_use]
    pub fn refusal(&self) -> Option<&Refusal> {
        self.report.as_ref().and_then(|report| match &report.outcome {
            Outcome::Refused(refusal) => Some(refusal),
            Outcome::Found(_) => None,
        })
    }
}
