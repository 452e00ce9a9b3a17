//! The alignment: pair, move, repeat while the gate shrinks.

use nalgebra::{Point2, Vector2};
use ogm_core::{Outcome, Refusal, Se2, wrap_angle};

use crate::cloud::Cloud;
use crate::pairing::Matcher;
use crate::step::{Centres, point_to_line, point_to_point};
use crate::structure::{Shape, shapes, unobservable_direction};
use crate::{Alignment, IcpError, IcpParams, Metric, Section, Termination, WallPoints};

/// Aligns `source` to `target` by iterated closest points (Besl and McKay 1992) in their common
/// section (Tsardoulias et al., section 4.3), starting at `init_target_from_source`.
///
/// It finds the nearest local minimum: the start must be good to about the first gate. Equal input
/// gives equal bits.
///
/// Refuses with [`Refusal::TooLittleStructure`] if a set has fewer points than
/// [`IcpParams::min_pairs`], and with [`Refusal::TooFewPairs`] if fewer pairs than that are found.
/// A search that diverged gives back the start and says so in [`Alignment::termination`].
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
    let start = init_target_from_source;
    let need = params.min_pairs;
    let have = target.points().len().min(source.points().len());
    if have < need {
        return Ok(Outcome::Refused(Refusal::TooLittleStructure { have, need }));
    }
    let spacing = target.spacing().max(source.spacing());
    let section = Section::common(
        target.points().iter().map(|point| point.position),
        source.points().iter().map(|point| start * point.position),
        params.section_margin.resolve(spacing),
    );
    let Some(section) = section else {
        return Ok(Outcome::Refused(Refusal::TooFewPairs { have: 0, need }));
    };
    let in_target = target.points().iter().copied();
    let in_target = in_target.filter(|point| section.contains(point.position));
    let in_source = source.points().iter().copied();
    let in_source = in_source.filter(|point| section.contains(start * point.position));
    let target = Cloud::new(in_target, target.spacing());
    let source = Cloud::new(in_source, source.spacing());
    let search = Search {
        section,
        start_target_from_source: start,
        shapes: shapes(&target, spacing),
        spacing,
        params,
    };
    let reciprocity = params.reciprocity.resolve(spacing);
    let mut matcher =
        Matcher::new(&target, &source, params.pairing, params.min_side_cosine, reciprocity);
    Ok(search.run(&mut matcher).into())
}

/// What stays the same over the iterations.
struct Search<'a> {
    section: Section,
    start_target_from_source: Se2,
    /// Around each target point.
    shapes: Vec<Shape>,
    /// Of the coarser map, metres.
    spacing: f64,
    params: &'a IcpParams,
}

impl Search<'_> {
    fn run(&self, matcher: &mut Matcher<'_>) -> Result<Alignment, Refusal> {
        let final_gate = self.params.final_gate.resolve(self.spacing);
        let mut gate = self.params.initial_gate.resolve(self.spacing).max(final_gate);
        let stop = self.params.stop_translation.resolve(self.spacing);

        let initial_rmse = self
            .pair(matcher, &self.start_target_from_source, final_gate)
            .map(|()| matcher.rmse())
            .ok();
        let initial_pairs = matcher.pairs.len();
        let mut target_from_source = self.start_target_from_source;
        let mut termination = Termination::IterationLimit;
        let mut iterations = 0;
        while iterations < self.params.max_iterations {
            self.pair(matcher, &target_from_source, gate)?;
            let centres = Centres::of(matcher);
            let next = self.step(matcher, &centres, &target_from_source);
            let (translation, rotation) = movement(&target_from_source, &next, centres.source);
            target_from_source = next;
            iterations += 1;
            let still = rotation < self.params.stop_rotation && translation < stop;
            if gate <= final_gate && still {
                termination = Termination::Converged;
                break;
            }
            gate = (gate * self.params.gate_factor).max(final_gate);
        }
        self.pair(matcher, &target_from_source, final_gate)?;
        let mut result = Alignment {
            target_from_source,
            termination,
            iterations,
            pairs: matcher.pairs.len(),
            rmse: matcher.rmse(),
            initial_pairs,
            initial_rmse,
            unobservable: self.unobservable(matcher),
            section: self.section,
        };
        if let Some(divergence) = self.divergence(matcher, &result) {
            self.pair(matcher, &self.start_target_from_source, final_gate)?;
            result.target_from_source = self.start_target_from_source;
            result.termination = divergence;
            result.pairs = matcher.pairs.len();
            result.rmse = matcher.rmse();
            result.unobservable = self.unobservable(matcher);
        }
        Ok(result)
    }

    fn pair(
        &self,
        matcher: &mut Matcher<'_>,
        target_from_source: &Se2,
        gate: f64,
    ) -> Result<(), Refusal> {
        matcher.pair(target_from_source, gate);
        let (have, need) = (matcher.pairs.len(), self.params.min_pairs);
        if have < need {
            return Err(Refusal::TooFewPairs { have, need });
        }
        Ok(())
    }

    fn step(&self, matcher: &Matcher<'_>, centres: &Centres, target_from_source: &Se2) -> Se2 {
        let moved = match self.params.metric {
            Metric::PointToPoint => point_to_point(matcher, centres),
            Metric::PointToLine => {
                point_to_line(matcher, &self.shapes, centres, target_from_source)
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
        unobservable_direction(&matcher.pairs, &self.shapes, min_ratio)
    }

    fn divergence(&self, matcher: &Matcher<'_>, end: &Alignment) -> Option<Termination> {
        let centre = Centres::of(matcher).source;
        let (translation, rotation) =
            movement(&self.start_target_from_source, &end.target_from_source, centre);
        let limit = self.params.max_translation.resolve(self.spacing);
        if translation > limit || rotation > self.params.max_rotation {
            return Some(Termination::MovedTooFar { translation, rotation });
        }
        // More pairs are a better fit even where they lie further apart; rounding is no divergence.
        let further = |initial: f64| end.rmse > initial + 1e-9 * self.spacing;
        let worse = end.initial_rmse.is_some_and(further) && end.pairs <= end.initial_pairs;
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
