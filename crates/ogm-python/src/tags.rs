//! Radio tags: logs, and where the tags are.

use std::path::PathBuf;

use nalgebra::Point2;
use ogm_core::{TagEstimate, TagId, TagReading};
use ogm_merge::{FilterParams, localise};
use pyo3::prelude::{Bound, PyAny, PyAnyMethods, PyResult, Python, pyclass, pyfunction, pymethods};

use crate::background::Background;
use crate::error::{MapError, map_error};
use crate::numbers::numbers;

/// Up to here a number of an array is a whole number for certain.
const MOST_EXACT: f64 = 9_007_199_254_740_992.0;

/// Where a tag is believed to be in the frame of one map, and how surely.
#[pyclass(frozen, eq, module = "ogm_maps")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tag(TagEstimate);

#[pymethods]
impl Tag {
    /// Which tag: its number, or the bits of its EPC.
    #[getter]
    fn tag_id(&self) -> u128 {
        self.0.tag_id.bits()
    }

    /// Best position (x, y), metres.
    #[getter]
    fn position(&self) -> (f64, f64) {
        (self.0.position.x, self.0.position.y)
    }

    /// Probability that it is within the window of 3 x 3 cells around the position.
    #[getter]
    fn certainty(&self) -> f64 {
        self.0.certainty
    }

    /// Readings that went into it.
    #[getter]
    fn readings(&self) -> usize {
        self.0.readings
    }

    fn __repr__(&self) -> String {
        let (x, y) = self.position();
        format!("Tag({}, x={x:.3}, y={y:.3}, certainty={:.2})", self.0.tag_id, self.0.certainty)
    }
}

/// Where the tags of a log are (Tsardoulias, Thallas, Petrou, section 3), in the frame of the map
/// of the robot that read them.
///
/// `log` is the path of a CSV with the header tag_id,robot_x_m,robot_y_m,range_m, or an array of
/// these four columns.
#[pyfunction]
#[pyo3(signature = (log, *, progress = None))]
pub(crate) fn localise_tags(
    py: Python<'_>,
    log: &Bound<'_, PyAny>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Vec<Tag>> {
    let readings = readings(log)?;
    let found = Background::new(Some(1), progress)?
        .run(py, |progress| localise(&readings, &FilterParams::default(), progress))?;
    Ok(found.into_iter().map(Tag).collect())
}

/// The tags of each of `maps` maps: for each nothing, what [`localise_tags`] gave, or its log.
pub(crate) fn of_maps(
    given: Option<&Bound<'_, PyAny>>,
    maps: usize,
) -> PyResult<Vec<Vec<TagEstimate>>> {
    let Some(given) = given else {
        return Ok(vec![Vec::new(); maps]);
    };
    let each: Vec<Bound<'_, PyAny>> = given.try_iter()?.collect::<PyResult<_>>()?;
    if each.len() != maps {
        let text = format!("tags are one entry for each of {maps} maps, not {}", each.len());
        return Err(MapError::new_err(text));
    }
    each.iter().map(of_map).collect()
}

fn of_map(given: &Bound<'_, PyAny>) -> PyResult<Vec<TagEstimate>> {
    if given.is_none() {
        return Ok(Vec::new());
    }
    let list = match given.extract::<PathBuf>() {
        Ok(_) => localise_tags(given.py(), given, None)?,
        Err(_) => {
            let tags: Vec<Bound<'_, Tag>> = given.extract()?;
            tags.iter().map(|tag| tag.get().clone()).collect()
        }
    };
    Ok(list.into_iter().map(|tag| tag.0).collect())
}

fn readings(log: &Bound<'_, PyAny>) -> PyResult<Vec<TagReading>> {
    if let Ok(path) = log.extract::<PathBuf>() {
        return log.py().detach(|| ogm_io::read_tags(&path)).map_err(map_error);
    }
    let (shape, numbers) = numbers(log)?;
    if !matches!(shape[..], [_, 4]) {
        let text = format!(
            "readings are rows of tag_id, robot_x_m, robot_y_m, range_m: shape (n, 4), not {shape:?}"
        );
        return Err(MapError::new_err(text));
    }
    let rows = numbers.as_chunks::<4>().0.iter();
    rows.map(|&[id, x, y, range]| {
        Ok(TagReading { tag_id: tag_id(id)?, robot_position: Point2::new(x, y), range })
    })
    .collect()
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked")]
fn tag_id(number: f64) -> PyResult<TagId> {
    if number.fract() == 0.0 && (0.0..=MOST_EXACT).contains(&number) {
        return Ok(TagId::from_bits(number as u128));
    }
    let text = format!("a tag_id in an array is a whole number from 0 to 2^53, not {number}");
    Err(MapError::new_err(text))
}
