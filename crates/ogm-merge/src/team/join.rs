//! Groups of maps become one, the surest first, as long as what all of their walls say together
//! makes it probable enough.

use std::collections::BTreeMap;

use grid_match::MatchParams;
use ogm_core::Progress;

use super::link::{Evidences, Link};
use super::part::Part;
use super::place::placed;
use super::report::Join;
use crate::MergeError;
use crate::parallel::map_in_order;

/// Joins `parts` as far as the evidence goes, beginning with those that are open.
///
/// Two maps that overlap each other show a third the same alias, so that their agreement is no
/// second witness: evidence is counted once, on the groups laid together, and every join is
/// weighed anew after each other.
pub(crate) fn join(
    mut parts: Vec<Part>,
    evidences: &Evidences<'_>,
    matching: &MatchParams,
    is_open: &dyn Fn(&Part, &Part) -> bool,
    progress: &dyn Progress,
) -> Result<(Vec<Part>, Vec<Join>), MergeError> {
    let first = |part: &Part| &evidences.prepared[part.members[0].0];
    parts.sort_by(|a, b| first(a).order(first(b)));
    let mut parts: Vec<Option<Part>> = parts.into_iter().map(Some).collect();
    let mut links: BTreeMap<(usize, usize), Link> = BTreeMap::new();
    let all = (0..parts.len()).flat_map(|a| (a + 1..parts.len()).map(move |b| (a, b)));
    let is_open = |&(a, b): &(usize, usize)| match (&parts[a], &parts[b]) {
        (Some(first), Some(second)) => is_open(first, second),
        _ => false,
    };
    let mut open: Vec<(usize, usize)> = all.filter(is_open).collect();
    let mut joins = Vec::new();
    let count = parts.len().max(1);
    loop {
        progress.go_on(joins.len() as f64 / count as f64)?;
        let found = map_in_order(&open, |&(a, b)| match (&parts[a], &parts[b]) {
            (Some(first), Some(second)) => evidences.link(first, second),
            _ => Ok(None),
        });
        for (key, link) in open.drain(..).zip(found) {
            if let Some(link) = link? {
                links.insert(key, link);
            }
        }
        let Some((key, link)) = best(&links, matching.accept) else { break };
        links.remove(&key);
        let (a, b) = key;
        let [Some(first), Some(second)] = [&parts[a], &parts[b]] else { continue };
        if evidences.is_vetoed(first, second, &link.first_from_second)? {
            continue;
        }
        joins.push(Join {
            first: first.maps(),
            second: second.maps(),
            probability: link.probability,
            score: link.score,
        });
        let moved = second.members.iter().map(|(map, pose)| (*map, link.first_from_second * *pose));
        let members: Vec<_> = first.members.iter().copied().chain(moved).collect();
        let reference = members[0].0;
        let places = placed(&members, evidences.pairs, evidences.prepared, reference)?;
        let members = places.iter().map(|place| (place.map, place.reference_from_map)).collect();
        parts[a] = Some(Part::of(members, evidences.prepared, &matching.thresholds)?);
        parts[b] = None;
        links.retain(|&(first, second), _| ![a, b].contains(&first) && ![a, b].contains(&second));
        let others = (0..parts.len()).filter(|&other| other != a && parts[other].is_some());
        open.extend(others.map(|other| (a.min(other), a.max(other))));
    }
    Ok((parts.into_iter().flatten().collect(), joins))
}

/// The surest link, by score where the probabilities are equal.
fn best(links: &BTreeMap<(usize, usize), Link>, accept: f64) -> Option<((usize, usize), Link)> {
    let probable = links.iter().filter(|(_, link)| link.probability >= accept);
    probable
        .max_by(|(_, a), (_, b)| {
            a.probability.total_cmp(&b.probability).then(a.score.total_cmp(&b.score))
        })
        .map(|(key, link)| (*key, *link))
}
