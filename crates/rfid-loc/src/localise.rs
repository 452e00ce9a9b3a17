//! Whole logs of readings.

use std::collections::BTreeMap;

use nalgebra::Point2;
use ogm_core::{Progress, Steps, TagEstimate, TagId, TagReading};

use crate::filter::check_reading;
use crate::fit::Bias;
use crate::{FilterParams, TagError, TagFilter};

/// Where the tags of a log are, in the frame of its robot positions, sorted by tag.
///
/// Each tag is searched around where the robot first read it ([`TagFilter::around`]), and its
/// readings multiply over gaps in which it was out of range (Tsardoulias et al., section 3).
///
/// A bias is one of the reader, so all tags are asked for it together: what one tag cannot tell
/// from a place further away, several can. A certainty is lowered by what they say, or by what its
/// own readings say if that is more.
///
/// Readings that no such reader gives (not finite, below zero, beyond its range) are left out and
/// counted in [`TagEstimate::dropped`]; a tag without any other has no estimate.
///
/// # Errors
/// Parameters that cannot be meant, or [`TagError::Cancelled`].
pub fn localise(
    readings: &[TagReading],
    params: &FilterParams,
    progress: &dyn Progress,
) -> Result<Vec<TagEstimate>, TagError> {
    let mut by_tag: BTreeMap<TagId, Vec<&TagReading>> = BTreeMap::new();
    for reading in readings {
        by_tag.entry(reading.tag_id).or_default().push(reading);
    }
    let done = Steps::new(progress, readings.len());
    let mut fitted = Vec::with_capacity(by_tag.len());
    for (tag_id, readings) in by_tag {
        let (usable, bad): (Vec<&TagReading>, Vec<_>) = readings.into_iter().partition(|reading| {
            check_reading(reading.robot_position, reading.range, params).is_ok()
        });
        let first = usable.first().map_or(Point2::origin(), |first| first.robot_position);
        let mut filter = TagFilter::around(first, params)?;
        for reading in usable {
            filter.update(reading.robot_position, reading.range)?;
            done.step()?;
        }
        let tag = filter.fitted(tag_id);
        fitted.extend(tag.map(|(tag, bias)| (TagEstimate { dropped: bad.len(), ..tag }, bias)));
    }
    progress.report(1.0);
    let reader = Bias::pooled(fitted.iter().filter_map(|(_, bias)| bias.as_ref())).unbiased();
    let believed = fitted.into_iter().map(|(tag, bias)| match bias {
        Some(bias) => TagEstimate { certainty: tag.certainty * reader.min(bias.support()), ..tag },
        None => tag,
    });
    Ok(believed.collect())
}

#[cfg(test)]
mod tests {
    use super::localise;
    use crate::{FilterParams, TagError};
    use nalgebra::Point2;
    use ogm_core::TagReading;

    /// Exact ranges from a half circle of robot positions.
    fn log(tag_id: u32, tag: Point2<f64>) -> Vec<TagReading> {
        (0..30)
            .map(|step| {
                let angle = 0.1 * f64::from(step);
                let robot_position = Point2::new(1.5 * angle.cos(), 1.5 * angle.sin());
                let range = (tag - robot_position).norm();
                TagReading { tag_id: tag_id.into(), robot_position, range }
            })
            .collect()
    }

    #[test]
    fn tags_come_out_sorted_and_independent_of_how_their_logs_interleave() {
        let tags = [(9, Point2::new(0.7, 0.4)), (2, Point2::new(-1.1, 0.9))];
        let logs = tags.map(|(id, position)| log(id, position));
        let interleaved: Vec<_> =
            logs[0].iter().zip(&logs[1]).flat_map(|(&a, &b)| [a, b]).collect();
        let params = FilterParams::default();
        let estimates = localise(&interleaved, &params, &()).unwrap();
        assert_eq!(estimates, localise(&logs.concat(), &params, &()).unwrap());
        for (estimate, (id, position)) in estimates.iter().zip([tags[1], tags[0]]) {
            assert_eq!((estimate.tag_id, estimate.readings), (id.into(), 30));
            let error = (estimate.position - position).norm();
            assert!(error < 0.01, "tag {id} is {error} m off, more than half a cell");
        }
    }

    #[test]
    fn no_readings_no_tags() {
        assert_eq!(localise(&[], &FilterParams::default(), &()), Ok(vec![]));
    }

    #[test]
    fn impossible_readings_are_counted_and_change_nothing_else() {
        let params = FilterParams::default();
        let good = log(4, Point2::new(0.2, 0.2));
        let expected = localise(&good, &params, &()).unwrap();
        let mut readings = good.clone();
        let nowhere = Point2::new(f64::NAN, 0.0);
        readings.insert(0, TagReading { robot_position: nowhere, ..good[0] });
        for (at, range) in [(3, f64::NAN), (9, -0.02), (17, 3.21)] {
            readings.insert(at, TagReading { range, ..good[at] });
        }
        let found = localise(&readings, &params, &()).unwrap();
        assert_eq!((found[0].dropped, found[0].readings), (4, good.len()));
        assert_eq!(
            (found[0].position, found[0].misfit),
            (expected[0].position, expected[0].misfit)
        );

        let only_bad = [TagReading { range: f64::INFINITY, ..good[0] }];
        assert_eq!(localise(&only_bad, &params, &()), Ok(vec![]));
    }

    #[test]
    fn parameters_that_describe_no_reader_are_an_error() {
        let params = FilterParams { range_sigma: f64::NAN, ..FilterParams::default() };
        let error = localise(&log(4, Point2::origin()), &params, &()).unwrap_err();
        assert!(matches!(error, TagError::Parameter(_)), "{error}");
    }
}
