//! The tags that two maps share, and whether they are known well enough (Table 3).

use std::collections::BTreeMap;

use nalgebra::Point2;
use ogm_core::{Outcome, Refusal, TagEstimate, TagId, require};

use crate::filter::MAX_COORDINATE;
use crate::{SelectionParams, TagError};

/// One tag as two maps know it. Made by [`common_tags`], so both estimates are usable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TagPair {
    target: TagEstimate,
    source: TagEstimate,
}

impl TagPair {
    /// Which tag.
    #[must_use]
    pub fn tag_id(&self) -> TagId {
        self.target.tag_id
    }

    /// The tag in the target map.
    #[must_use]
    pub fn target(&self) -> &TagEstimate {
        &self.target
    }

    /// The tag in the source map.
    #[must_use]
    pub fn source(&self) -> &TagEstimate {
        &self.source
    }

    /// The smaller certainty of the two: the pair's precision in Table 3.
    #[must_use]
    pub fn certainty(&self) -> f64 {
        self.target.certainty.min(self.source.certainty)
    }
}

/// The tags that both maps know, the most certain pair first and of equal ones the smaller id.
///
/// Tags whose maximum touches the border of their search area in either map are left out.
///
/// # Errors
/// A tag twice in one map; a position or certainty that is not finite or out of range.
pub fn common_tags(
    target: &[TagEstimate],
    source: &[TagEstimate],
) -> Result<Vec<TagPair>, TagError> {
    let target = by_id(target)?;
    let source = by_id(source)?;
    let mut pairs: Vec<TagPair> = target
        .values()
        .filter_map(|&&target| {
            let source = **source.get(&target.tag_id)?;
            (!target.touches_border && !source.touches_border).then_some(TagPair { target, source })
        })
        .collect();
    // Stable, and the map was ordered by id.
    pairs.sort_by(|a, b| b.certainty().total_cmp(&a.certainty()));
    Ok(pairs)
}

/// The three most certain pairs that lie apart, if the third and the best exceed their thresholds
/// (Tsardoulias et al., sections 4 and 4.2).
///
/// `pairs` are ordered as [`common_tags`] gives them. A pair too near a better one is passed over
/// as long as others are sure enough; otherwise the three most certain are taken wherever they
/// lie. Refuses with [`Refusal::TooFewTags`] or [`Refusal::LowCertainty`].
///
/// # Errors
/// A threshold that is no probability, or a separation that is no distance.
pub fn select_tags(
    pairs: &[TagPair],
    params: &SelectionParams,
) -> Result<Outcome<[TagPair; 3]>, TagError> {
    select(pairs, params)
}

/// As [`select_tags`], with two tags: the direction from one to the other turns the map, so that
/// they must lie apart (Tsardoulias et al., section 6, future work).
///
/// # Errors
/// As [`select_tags`].
pub fn select_two_tags(
    pairs: &[TagPair],
    params: &SelectionParams,
) -> Result<Outcome<[TagPair; 2]>, TagError> {
    select(pairs, params)
}

/// All pairs that are as sure as the third must be, in the order of `pairs`.
#[must_use]
pub fn sure_tags<'a>(pairs: &'a [TagPair], params: &SelectionParams) -> &'a [TagPair] {
    let sure = pairs.iter().take_while(|pair| pair.certainty() > params.third_above);
    &pairs[..sure.count()]
}

fn select<const N: usize>(
    pairs: &[TagPair],
    params: &SelectionParams,
) -> Result<Outcome<[TagPair; N]>, TagError> {
    let is_probability = |value: f64| (0.0..=1.0).contains(&value);
    let &SelectionParams { best_above, third_above, min_separation } = params;
    require(is_probability(best_above), "best_above", "in [0, 1]", best_above)?;
    require(is_probability(third_above), "third_above", "in [0, 1]", third_above)?;
    let is_distance = (0.0..=MAX_COORDINATE).contains(&min_separation);
    require(is_distance, "min_separation", "0 to 1e9 m", min_separation)?;

    let Some(first) = pairs.first_chunk::<N>() else {
        return Ok(Outcome::Refused(Refusal::TooFewTags { have: pairs.len(), need: N }));
    };
    for (pair, need) in [(&first[0], best_above), (&first[N - 1], third_above)] {
        let reached = pair.certainty();
        let is_enough = reached > need;
        if !is_enough {
            return Ok(Outcome::Refused(Refusal::LowCertainty { best: reached, need }));
        }
    }
    Ok(Outcome::Found(apart(pairs, params).unwrap_or(*first)))
}

/// The most certain pairs of which none is nearer to a better one than the separation.
fn apart<const N: usize>(pairs: &[TagPair], params: &SelectionParams) -> Option<[TagPair; N]> {
    let mut chosen: Vec<TagPair> = Vec::with_capacity(N);
    for pair in sure_tags(pairs, params) {
        let apart = |better: &TagPair| {
            let in_target = (pair.target.position - better.target.position).norm();
            let in_source = (pair.source.position - better.source.position).norm();
            in_target.min(in_source) >= params.min_separation
        };
        if chosen.len() < N && chosen.iter().all(apart) {
            chosen.push(*pair);
        }
    }
    chosen.try_into().ok()
}

/// The positions of pairs, (target, source), metres in their maps.
pub(crate) fn positions(pair: &TagPair) -> (Point2<f64>, Point2<f64>) {
    (pair.target.position, pair.source.position)
}

fn by_id(estimates: &[TagEstimate]) -> Result<BTreeMap<TagId, &TagEstimate>, TagError> {
    let mut by_id = BTreeMap::new();
    for estimate in estimates {
        let &TagEstimate { tag_id, position, certainty, .. } = estimate;
        let is_near = |x: f64| x.abs() <= MAX_COORDINATE;
        if !(is_near(position.x) && is_near(position.y) && (0.0..=1.0).contains(&certainty)) {
            return Err(TagError::Estimate { tag_id, x: position.x, y: position.y, certainty });
        }
        if by_id.insert(tag_id, estimate).is_some() {
            return Err(TagError::DuplicateTag { tag_id });
        }
    }
    Ok(by_id)
}

#[cfg(test)]
mod tests {
    use super::{common_tags, select_tags, select_two_tags, sure_tags};
    use crate::fixture::estimate;
    use crate::{SelectionParams, TagError};
    use ogm_core::{Outcome, Refusal, TagEstimate};

    /// Estimates of equal place from (tag, percent).
    fn known(tags: &[(u32, u32)]) -> Vec<TagEstimate> {
        tags.iter()
            .map(|&(id, percent)| TagEstimate {
                certainty: f64::from(percent) / 100.0,
                ..estimate(id, 1.0, 2.0)
            })
            .collect()
    }

    fn select(target: &[(u32, u32)], source: &[(u32, u32)]) -> Outcome<Vec<(u128, f64)>> {
        let pairs = common_tags(&known(target), &known(source)).unwrap();
        match select_tags(&pairs, &SelectionParams::default()).unwrap() {
            Outcome::Found(pairs) => {
                Outcome::Found(pairs.map(|pair| (pair.tag_id().bits(), pair.certainty())).to_vec())
            }
            Outcome::Refused(refusal) => Outcome::Refused(refusal),
        }
    }

    #[test]
    fn t_q1_table_3_orders_the_tags_by_their_lesser_certainty() {
        let selected = select(&[(5, 82), (7, 99), (9, 91)], &[(5, 92), (7, 76), (9, 92)]);
        assert_eq!(selected, Outcome::Found(vec![(9, 0.91), (5, 0.82), (7, 0.76)]));
    }

    #[test]
    fn of_equal_certainty_the_smaller_id_comes_first_whatever_the_order() {
        let selected =
            select(&[(8, 95), (3, 95), (6, 95), (1, 95)], &[(6, 97), (8, 97), (1, 97), (3, 97)]);
        let ids: Vec<u128> = selected.found().unwrap().iter().map(|tag| tag.0).collect();
        assert_eq!(ids, [1, 3, 6]);
    }

    #[test]
    fn both_thresholds_are_strict_and_each_refusal_names_its_own() {
        let all = [(1, 99), (2, 99), (3, 99)];
        for (tags, best, need) in
            [([(1, 95), (2, 90), (3, 75)], 0.75, 0.75), ([(1, 90), (2, 85), (3, 80)], 0.90, 0.90)]
        {
            let refusal = select(&tags, &all).refusal().cloned();
            assert_eq!(refusal, Some(Refusal::LowCertainty { best, need }));
        }
        assert!(select(&[(1, 91), (2, 76), (3, 76)], &all).found().is_some());
    }

    #[test]
    fn tags_known_to_one_robot_or_at_the_border_do_not_count() {
        let mut target = known(&[(1, 99), (2, 99), (3, 99), (4, 99)]);
        target[1].touches_border = true;
        let source = known(&[(1, 99), (2, 99), (3, 99)]);
        let pairs = common_tags(&target, &source).unwrap();
        let refused = select_tags(&pairs, &SelectionParams::default()).unwrap();
        let too_few = Refusal::TooFewTags { have: 2, need: 3 };
        assert_eq!(refused.refusal(), Some(&too_few));
    }

    #[test]
    fn a_tag_beside_a_better_one_is_passed_over_while_another_is_sure_enough() {
        let at = |id, x, certainty| TagEstimate { certainty, ..estimate(id, x, 0.0) };
        let ids = |tags: &[TagEstimate]| {
            let pairs = common_tags(tags, tags).unwrap();
            let selected =
                select_tags(&pairs, &SelectionParams::default()).unwrap().found().unwrap();
            selected.map(|pair| pair.tag_id().bits())
        };
        let beside = [at(1, 0.0, 0.99), at(2, 0.1, 0.98), at(3, 2.0, 0.97), at(4, 4.0, 0.80)];
        assert_eq!(ids(&beside), [1, 3, 4]);
        let unsure = [at(1, 0.0, 0.99), at(2, 0.1, 0.98), at(3, 2.0, 0.97), at(4, 4.0, 0.70)];
        assert_eq!(ids(&unsure), [1, 2, 3], "nearness never lowers the certainty asked for");
    }

    #[test]
    fn two_tags_suffice_where_two_are_asked_for_and_lie_apart_if_they_can() {
        let at = |id, x, certainty| TagEstimate { certainty, ..estimate(id, x, 0.0) };
        let params = SelectionParams::default();
        let tags = [at(1, 0.0, 0.99), at(2, 0.1, 0.98), at(3, 2.0, 0.80)];
        let pairs = common_tags(&tags, &tags).unwrap();
        let two = select_two_tags(&pairs, &params).unwrap().found().unwrap();
        assert_eq!(two.map(|pair| pair.tag_id().bits()), [1, 3]);
        let refused = select_two_tags(&pairs[..1], &params).unwrap();
        assert_eq!(refused.refusal(), Some(&Refusal::TooFewTags { have: 1, need: 2 }));
        assert_eq!(sure_tags(&pairs, &params).len(), 3);
        let strict = SelectionParams { third_above: 0.80, ..params };
        assert_eq!(sure_tags(&pairs, &strict).len(), 2);
    }

    #[test]
    fn thresholds_that_are_none_are_errors() {
        let good = SelectionParams::default();
        for bad in [
            SelectionParams { best_above: f64::NAN, ..good },
            SelectionParams { third_above: 1.5, ..good },
            SelectionParams { min_separation: -0.1, ..good },
            SelectionParams { min_separation: f64::NAN, ..good },
        ] {
            assert!(matches!(select_tags(&[], &bad), Err(TagError::Parameter(_))), "{bad:?}");
        }
    }

    #[test]
    fn estimates_that_cannot_be_meant_are_errors() {
        let good = known(&[(1, 99)]);
        for bad in [
            TagEstimate { certainty: f64::NAN, ..good[0] },
            TagEstimate { certainty: 1.5, ..good[0] },
            estimate(1, f64::INFINITY, 0.0),
            estimate(1, 0.0, f64::NAN),
        ] {
            let error = common_tags(&good, &[bad]).unwrap_err();
            assert!(matches!(error, TagError::Estimate { tag_id, .. } if tag_id == 1.into()));
        }
        let twice = common_tags(&known(&[(1, 99), (1, 98)]), &good);
        assert_eq!(twice, Err(TagError::DuplicateTag { tag_id: 1.into() }));
    }
}
