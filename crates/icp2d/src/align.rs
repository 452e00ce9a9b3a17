//! The alignment: pair, move, repeat while the reach of pairs shrinks.

use nalgebra::{Point2, Vector2};
use ogm_core::{Outcome, Refusal, Se2, wrap_angle};

use crate::cloud::Cloud;
use crate::pairing::Matcher;
use crate::step::{Centres, Weighing, covariance, point_to_line, point_to_point};
use crate::structure::{Shape, unobservable_direction};
use crate::target::{Index, Target};
use crate::{Alignment, IcpError, IcpParams, Metric, Section, Termination, WallPoints};

/// Aligns `source` to `target` by iterated closest points (Besl and McKay 1992) in their common
/// section (Tsardoulias et al., section 4.3), starting at `init_target_from_source`.
///
/// It finds the nearest local minimum: the start must be good to about the first distance of
/// correspondences. Equal input gives equal bits.
///
/// Refuses with [`Refusal::TooLittleStructure`] if a set has fewer points than
/// [`IcpParams::min_correspondences`], and with [`Refusal::TooFewPairs`] if fewer correspondences
/// than that are found. A search that diverged gives back the start and says so in
/// [`Alignment::termination`].
///
/// # Errors
/// A non-finite start, or a parameter outside its range.
pub fn align(
    target: &WallPoints,
    source: &WallPoints,
    init_target_from_source: Se2,
    params: &IcpParams,
) -> Result<Outcome<Alignment>, IcpError> {
    params.check()?;
    init_target_from_source.check_finite()?;
    let section = match section(target, source, init_target_from_source, params) {
        Ok(section) => section,
        Err(refusal) => return Ok(Outcome::Refused(refusal)),
    };
    let in_target = target.points().iter().copied();
    let in_target = in_target.filter(|point| section.contains(point.position));
    let target = Index::of_points(in_target, target.spacing());
    Ok(run(&target, source, section, init_target_from_source, params).into())
}

/// As [`align()`] of plain points, metres: their spacing is the median distance to the nearest
/// other, and points have no free side, so that any two may correspond.
///
/// # Errors
/// As [`align()`], and points that are not finite.
pub fn align_points(
    target: &[Point2<f64>],
    source: &[Point2<f64>],
    init_target_from_source: Se2,
    params: &IcpParams,
) -> Result<Outcome<Alignment>, IcpError> {
    let target = WallPoints::from_positions(target)?;
    let source = WallPoints::from_positions(source)?;
    align(&target, &source, init_target_from_source, params)
}

/// As [`align()`], with an index that was built once: for many sources on one target.
///
/// All points of the target take part, where [`align()`] looks at those in the common section.
///
/// # Errors
/// As [`align()`].
pub fn align_to(
    target: &Target,
    source: &WallPoints,
    init_target_from_source: Se2,
    params: &IcpParams,
) -> Result<Outcome<Alignment>, IcpError> {
    params.check()?;
    init_target_from_source.check_finite()?;
    let section = match section(target.points(), source, init_target_from_source, params) {
        Ok(section) => section,
        Err(refusal) => return Ok(Outcome::Refused(refusal)),
    };
    Ok(run(&target.index, source, section, init_target_from_source, params).into())
}

fn section(
    target: &WallPoints,
    source: &WallPoints,
    target_from_source: Se2,
    params: &IcpParams,
) -> Result<Section, Refusal> {
    let need = params.min_correspondences;
    let have = target.points().len().min(source.points().len());
    if have < need {
        return Err(Refusal::TooLittleStructure { have, need });
    }
    let spacing = target.spacing().max(source.spacing());
    Section::common(
        target.points().iter().map(|point| point.position),
        source.points().iter().map(|point| target_from_source * point.position),
        params.section_margin.resolve(spacing),
    )
    .ok_or(Refusal::TooFewPairs { have: 0, need })
}

fn run(
    target: &Index,
    source: &WallPoints,
    section: Section,
    start_target_from_source: Se2,
    params: &IcpParams,
) -> Result<Alignment, Refusal> {
    let spacing = target.cloud.spacing.max(source.spacing());
    let in_source = source.points().iter().copied();
    let in_source =
        in_source.filter(|point| section.contains(start_target_from_source * point.position));
    let source = Cloud::new(in_source, source.spacing());
    let search = Search {
        section,
        start_target_from_source,
        shapes: &target.shapes,
        weighing: Weighing { kernel: params.kernel, spacing },
        spacing,
        params,
    };
    search.run(&mut Matcher::new(&target.cloud, &source, params, spacing))
}

/// What stays the same over the iterations.
struct Search<'a> {
    section: Section,
    start_target_from_source: Se2,
    /// Around each target point.
    shapes: &'a [Shape],
    weighing: Weighing,
    /// Of the coarser map, metres.
    spacing: f64,
    params: &'a IcpParams,
}

impl Search<'_> {
    fn run(&self, matcher: &mut Matcher<'_>) -> Result<Alignment, Refusal> {
        let max_correspondence_distance =
            self.params.max_correspondence_distance.resolve(self.spacing);
        let mut reach = self
            .params
            .initial_correspondence_distance
            .resolve(self.spacing)
            .max(max_correspondence_distance);
        let stop = self.params.translation_epsilon.resolve(self.spacing);

        let initial_rmse = self
            .pair(matcher, &self.start_target_from_source, max_correspondence_distance)
            .map(|()| matcher.rmse())
            .ok();
        let initial_correspondences = matcher.pairs.len();
        let mut target_from_source = self.start_target_from_source;
        let mut termination = Termination::IterationLimit;
        let mut iterations = 0;
        while iterations < self.params.max_iterations {
            self.pair(matcher, &target_from_source, reach)?;
            let centres = Centres::of(matcher, &self.weighing);
            let next = self.step(matcher, &centres, &target_from_source);
            let (translation, rotation) = movement(&target_from_source, &next, centres.source);
            target_from_source = next;
            iterations += 1;
            let still = rotation < self.params.rotation_epsilon && translation < stop;
            if reach <= max_correspondence_distance && still {
                termination = Termination::Converged;
                break;
            }
            reach = (reach * self.params.distance_factor).max(max_correspondence_distance);
        }
        self.pair(matcher, &target_from_source, max_correspondence_distance)?;
        let mut result = Alignment {
            target_from_source,
            termination,
            iterations,
            covariance: None,
            correspondences: matcher.pairs.len(),
            inlier_ratio: 0.0,
            rmse: matcher.rmse(),
            initial_correspondences,
            initial_rmse,
            unobservable: self.unobservable(matcher),
            section: self.section,
        };
        if let Some(divergence) = self.divergence(matcher, &result) {
            self.pair(matcher, &self.start_target_from_source, max_correspondence_distance)?;
            result.target_from_source = self.start_target_from_source;
            result.termination = divergence;
            result.correspondences = matcher.pairs.len();
            result.rmse = matcher.rmse();
            result.unobservable = self.unobservable(matcher);
        }
        result.inlier_ratio = result.correspondences as f64 / matcher.source.positions.len() as f64;
        if result.unobservable.is_none() {
            let end = &result.target_from_source;
            result.covariance = covariance(matcher, self.shapes, end, &self.weighing);
        }
        Ok(result)
    }

    fn pair(
        &self,
        matcher: &mut Matcher<'_>,
        target_from_source: &Se2,
        reach: f64,
    ) -> Result<(), Refusal> {
        matcher.pair(target_from_source, reach);
        let (have, need) = (matcher.pairs.len(), self.params.min_correspondences);
        if have < need {
            return Err(Refusal::TooFewPairs { have, need });
        }
        Ok(())
    }

    fn step(&self, matcher: &Matcher<'_>, centres: &Centres, target_from_source: &Se2) -> Se2 {
        let moved = match self.params.metric {
            Metric::PointToPoint => point_to_point(matcher, centres, &self.weighing),
            Metric::PointToLine => {
                point_to_line(matcher, self.shapes, centres, target_from_source, &self.weighing)
            }
        };
        self.unobservable(matcher).map_or(moved, |direction| {
            let drift = moved * centres.source - self.start_target_from_source * centres.source;
            let back = -direction * direction.dot(&drift);
            Se2::new(back.x, back.y, 0.0) * moved
        })
    }

    fn unobservable(&self, matcher: &Matcher<'_>) -> Option<Vector2<f64>> {
        let min_ratio = self.params.min_eigenvalue_ratio;
        unobservable_direction(&matcher.pairs, self.shapes, min_ratio)
    }

    fn divergence(&self, matcher: &Matcher<'_>, end: &Alignment) -> Option<Termination> {
        let centre = Centres::of(matcher, &self.weighing).source;
        let (translation, rotation) =
            movement(&self.start_target_from_source, &end.target_from_source, centre);
        let limit = self.params.max_translation.resolve(self.spacing);
        if translation > limit || rotation > self.params.max_rotation {
            return Some(Termination::MovedTooFar { translation, rotation });
        }
        // More pairs are a better fit even where they lie further apart; rounding is no divergence.
        let further = |initial: f64| end.rmse > initial + 1e-9 * self.spacing;
        let worse = end.initial_rmse.is_some_and(further)
            && end.correspondences <= end.initial_correspondences;
        worse.then_some(Termination::WorseFit { rmse: end.rmse })
    }
}

/// How far `centre` of the source moves, metres, and the map turns, radians, between two motions.
fn movement(
    before_target_from_source: &Se2,
    after_target_from_source: &Se2,
    centre: Point2<f64>,
) -> (f64, f64) {
    let (before, after) = (*before_target_from_source, *after_target_from_source);
    let translation = (after * centre - before * centre).norm();
    (translation, wrap_angle(after.theta() - before.theta()).abs())
}
