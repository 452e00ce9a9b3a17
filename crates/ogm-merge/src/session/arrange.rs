//! Which maps of a session hang together, anew or as far as they already stand.

use grid_match::{PreparedMap, score_pose};
use ogm_core::{Progress, Se2};

use super::group::{Group, Standing};
use crate::MergeError;
use crate::team::{
    Evidences, Join, KnownPose, Matched, Part, agreeing, contradiction, given, is_apart, join,
    placed, probability_between,
};

/// What groups are made of.
#[derive(Clone, Copy)]
pub(crate) struct Arranging<'a> {
    pub(crate) prepared: &'a [PreparedMap],
    pub(crate) pairs: &'a [Matched],
    pub(crate) align: &'a crate::AlignParams,
    /// What is known about where a map lies in the world.
    pub(crate) known: &'a dyn Fn(usize) -> Option<KnownPose>,
    /// Maps that stay by themselves.
    pub(crate) apart: &'a [usize],
    /// Pairs whose groups may be joined; those of no others are looked at before they are.
    pub(crate) open: &'a [(usize, usize)],
}

/// Walls of two maps that stand in one group and contradict it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Contradiction {
    maps: (usize, usize),
    first_from_second: Se2,
    pub(crate) conflict_m: f64,
    pub(crate) hit_m: f64,
}

impl Arranging<'_> {
    /// Joins what may be joined to `standing`, whose first group is the world and whose first map
    /// there holds its frame; poses are those of least squares.
    pub(crate) fn arranged(
        &self,
        standing: &[Group],
        progress: &dyn Progress,
    ) -> Result<Vec<Group>, MergeError> {
        let Some(world) = standing.first() else { return Ok(Vec::new()) };
        let gauge = &world.members[0];
        let is_given = |map: usize| (self.known)(map).filter(KnownPose::is_given);
        let all = || standing.iter().flat_map(|group| &group.members);
        let pinned: Vec<(usize, Se2)> = all()
            .filter(|member| !self.apart.contains(&member.map))
            .filter_map(|member| Some((member.map, is_given(member.map)?.reference_from_map)))
            .collect();
        let is_pinned = |map: usize| pinned.iter().any(|(pinned, _)| *pinned == map);

        let mut groups: Vec<Vec<(usize, Se2)>> = Vec::new();
        for (index, group) in standing.iter().enumerate() {
            let mut poses = group.poses();
            poses.retain(|(map, _)| !is_pinned(*map));
            if index == 0 {
                poses.extend(&pinned);
            }
            let (apart, together): (Vec<_>, Vec<_>) =
                poses.into_iter().partition(|(map, _)| self.apart.contains(map));
            groups.extend(apart.into_iter().map(|pose| vec![pose]));
            groups.push(together);
        }
        groups.retain(|group| !group.is_empty());
        let (apart, together): (Vec<_>, Vec<_>) = groups
            .into_iter()
            .partition(|group| group.len() == 1 && self.apart.contains(&group[0].0));

        let mut joins = Vec::new();
        let mut parts: Vec<Vec<(usize, Se2)>> = together;
        if parts.len() > 1 {
            let matching = &self.align.matching;
            let (prepared, pairs) = (self.prepared, self.pairs);
            let evidences = Evidences { prepared, pairs, repeats: matching.repeats };
            let of = |poses: Vec<(usize, Se2)>| match &poses[..] {
                [(map, _)] => Ok(Part::alone(*map)),
                _ => Part::of(poses, prepared, &matching.thresholds),
            };
            let open = parts.into_iter().map(of).collect::<Result<_, MergeError>>()?;
            let is_open = |first: &Part, second: &Part| {
                let is_across = |&(a, b): &(usize, usize)| {
                    let across = |a, b| first.pose(a).is_some() && second.pose(b).is_some();
                    across(a, b) || across(b, a)
                };
                self.open.iter().any(is_across)
            };
            let (joined, by) = join(open, &evidences, matching, &is_open, progress)?;
            parts = joined.into_iter().map(|part| part.members).collect();
            joins = by;
        }
        let mut arranged = Vec::with_capacity(parts.len() + apart.len());
        for mut members in parts {
            members.sort_by_key(|(map, _)| *map);
            arranged.push(self.settled(&members, gauge, &joins, standing)?);
        }
        let alone = |poses: &Vec<(usize, Se2)>| {
            let (map, pose) = poses[0];
            Group::alone(map, if map == gauge.map { pose } else { Se2::identity() })
        };
        arranged.extend(apart.iter().map(alone));
        let has_gauge = |group: &Group| group.of(gauge.map).is_some();
        arranged.sort_by_key(|group| (!has_gauge(group), group.members[0].map));
        Ok(arranged)
    }

    /// A group by least squares, its frame held by `gauge` or else by its first map.
    fn settled(
        &self,
        members: &[(usize, Se2)],
        gauge: &Standing,
        joins: &[Join],
        standing: &[Group],
    ) -> Result<Group, MergeError> {
        let is_world = members.iter().any(|(map, _)| *map == gauge.map);
        let reference = if is_world { gauge.map } else { members[0].0 };
        let frame = (self.known)(gauge.map).filter(KnownPose::is_given);
        let world_from_gauge = frame.map_or(gauge.group_from_map, |known| known.reference_from_map);
        let group_from_reference = if is_world { world_from_gauge } else { Se2::identity() };
        let places = placed(members, self.pairs, self.prepared, reference)?;
        let stood = |map: usize| {
            let group = standing.iter().find(|group| group.of(reference).is_some())?;
            Some(group.of(map)?.probability)
        };
        let mut standings = Vec::with_capacity(places.len());
        for place in &places {
            let known = given((self.known)(reference), (self.known)(place.map)).is_some();
            let probability = if known || place.map == reference {
                1.0
            } else {
                let said = probability_between(joins, reference, place.map);
                said.or_else(|| stood(place.map)).unwrap_or(0.0)
            };
            standings.push(Standing::new(place, &group_from_reference, probability));
        }
        standings.sort_by_key(|standing| (standing.map != reference, standing.map));
        Ok(Group { members: standings })
    }

    /// What the walls say for `groups`, log-odds against that nothing hangs together: of every
    /// group the pairs that hold it together best. More pairs of the same maps see the same walls.
    pub(crate) fn evidence(&self, groups: &[Group]) -> Result<f64, MergeError> {
        let mut sum = 0.0;
        for group in groups {
            let mut reached = vec![0];
            while reached.len() < group.members.len() {
                let mut best = (f64::NEG_INFINITY, 0);
                for next in (0..group.members.len()).filter(|next| !reached.contains(next)) {
                    for &from in &reached {
                        let score = self.score(&group.members[from], &group.members[next])?;
                        if score > best.0 {
                            best = (score, next);
                        }
                    }
                }
                sum += best.0;
                reached.push(best.1);
            }
        }
        Ok(sum)
    }

    fn score(&self, a: &Standing, b: &Standing) -> Result<f64, MergeError> {
        if given((self.known)(a.map), (self.known)(b.map)).is_some() {
            return Ok(0.0);
        }
        let a_from_b = a.group_from_map.between(&b.group_from_map);
        Ok(score_pose(&self.prepared[a.map], &self.prepared[b.map], &a_from_b)?.score())
    }

    /// Every two maps of a group, one of them in `touched`, whose walls contradict it.
    pub(crate) fn contradictions(
        &self,
        groups: &[Group],
        touched: &[usize],
    ) -> Result<Vec<Contradiction>, MergeError> {
        let mut contradictions = Vec::new();
        for group in groups {
            for (index, a) in group.members.iter().enumerate() {
                for b in &group.members[index + 1..] {
                    let is_touched = touched.contains(&a.map) || touched.contains(&b.map);
                    let known = given((self.known)(a.map), (self.known)(b.map)).is_some();
                    if !is_touched || known {
                        continue;
                    }
                    let a_from_b = a.group_from_map.between(&b.group_from_map);
                    let maps = [a, b].map(|standing| &self.prepared[standing.map]);
                    let evidence = score_pose(maps[0], maps[1], &a_from_b)?;
                    if let Some(walls) = contradiction(&evidence) {
                        let (conflict_m, hit_m) = (walls.conflict_m, walls.hit_m);
                        contradictions.push(Contradiction {
                            maps: (a.map, b.map),
                            first_from_second: a_from_b,
                            conflict_m,
                            hit_m,
                        });
                    }
                }
            }
        }
        Ok(contradictions)
    }

    /// Whether two maps lie in `groups` as their walls contradict.
    pub(crate) fn keeps(&self, groups: &[Group], contradiction: &Contradiction) -> bool {
        let (a, b) = contradiction.maps;
        let centre = self.prepared[b].centre();
        let both = groups.iter().find_map(|group| group.of(a).zip(group.of(b)));
        both.is_some_and(|(a, b)| {
            let a_from_b = a.group_from_map.between(&b.group_from_map);
            !is_apart(&a_from_b, &contradiction.first_from_second, centre)
        })
    }

    /// Whether a pair of `searched` that stands in one of `groups` now has another pose for its
    /// best, or a map of `touched` has nothing left that holds it.
    pub(crate) fn is_doubted(
        &self,
        groups: &[Group],
        searched: &[(usize, usize)],
        touched: &[usize],
    ) -> Result<bool, MergeError> {
        for pair in self.pairs.iter().filter(|p| searched.contains(&p.maps())) {
            let stand = groups.iter().find_map(|group| {
                let [target, source] = [pair.target, pair.source].map(|map| group.of(map));
                Some(target?.group_from_map.between(&source?.group_from_map))
            });
            let (Some(stand), Some(best)) = (stand, pair.proposals.first()) else { continue };
            let agreeing = agreeing(pair, &stand, self.prepared);
            if best.pose.probability >= 0.5 && agreeing != Some(0) {
                return Ok(true);
            }
        }
        for group in groups.iter().filter(|group| group.members.len() > 1) {
            for member in group.members.iter().filter(|member| touched.contains(&member.map)) {
                let mut held = f64::NEG_INFINITY;
                for other in group.members.iter().filter(|other| other.map != member.map) {
                    held = held.max(self.score(other, member)?);
                }
                if held < 0.0 {
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }
}
