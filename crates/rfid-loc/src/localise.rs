//! Whole logs of readings.

use std::collections::BTreeMap;

use ogm_core::{Progress, Steps, TagEstimate, TagReading};

use crate::{FilterParams, TagError, TagFilter};

/// Where the tags of a log are, in the frame of its robot positions, sorted by tag.
///
/// Each tag is searched around where the robot first read it ([`TagFilter::around`]), and its
/// readings multiply over gaps in which it was out of range (Tsardoulias et al., section 3).
///
/// # Errors
/// The first reading that [`TagFilter::update`] does not take, of the smallest tag that has one,
/// or [`TagError::Cancelled`].
pub fn localise(
    readings: &[TagReading],
    params: &FilterParams,
    progress: &dyn Progress,
) -> Result<Vec<TagEstimate>, TagError> {
    let mut by_tag: BTreeMap<u32, Vec<&TagReading>> = BTreeMap::new();
    for reading in readings {
        by_tag.entry(reading.tag_id).or_default().push(reading);
    }
    let done = Steps::new(progress, readings.len());
    let mut estimates = Vec::with_capacity(by_tag.len());
    for (tag_id, readings) in by_tag {
        let Some(first) = readings.first() else {
            continue;
        };
        let mut filter = TagFilter::around(first.robot_position, params)?;
        for reading in readings {
            filter.update(reading.robot_position, reading.range)?;
            done.step()?;
        }
        estimates.extend(filter.estimate(tag_id));
    }
    progress.report(1.0);
    Ok(estimates)
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
                TagReading { tag_id, robot_position, range: (tag - robot_position).norm() }
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
            assert_eq!((estimate.tag_id, estimate.readings), (id, 30));
            let error = (estimate.position - position).norm();
            assert!(error < 0.01, "tag {id} is {error} m off, more than half a cell");
        }
    }

    #[test]
    fn no_readings_no_tags() {
        assert_eq!(localise(&[], &FilterParams::default(), &()), Ok(vec![]));
    }

    #[test]
    fn one_impossible_reading_is_an_error_and_not_a_gap() {
        let mut readings = log(4, Point2::new(0.2, 0.2));
        readings[7].range = f64::NAN;
        let error = localise(&readings, &FilterParams::default(), &()).unwrap_err();
        assert!(matches!(error, TagError::Range { .. }), "{error}");
    }
}
