//! `nav_msgs/OccupancyGrid` by its fields, whoever made the class.

use ogm_core::{GridFrame, OccupancyGrid, Se2};
use pyo3::prelude::{Bound, PyAny, PyAnyMethods, PyResult};

use crate::cells::from_array;
use crate::error::{MapError, map_error};

/// The largest tilt of an origin, as |x| or |y| of its unit quaternion: 0.1 degrees.
const MAX_TILT: f64 = 1e-3;

/// The map of a message: `info.resolution`, `info.width`, `info.height`, `info.origin`, `data`.
pub(crate) fn map_of(message: &Bound<'_, PyAny>) -> PyResult<OccupancyGrid> {
    let info = message.getattr("info")?;
    let resolution: f64 = info.getattr("resolution")?.extract()?;
    let (width, height): (usize, usize) =
        (info.getattr("width")?.extract()?, info.getattr("height")?.extract()?);
    let map_from_grid = origin(&info.getattr("origin")?)?;
    let frame = GridFrame::new(resolution, map_from_grid).map_err(map_error)?;

    let numpy = message.py().import("numpy")?;
    let data = numpy.call_method1("asarray", (message.getattr("data")?,))?;
    let shape: Vec<usize> = data.getattr("shape")?.extract()?;
    let wanted = ogm_core::cell_count(width, height).map_err(map_error)?;
    if shape != [wanted] {
        let text = format!(
            "the message says {width} x {height} cells, which are {wanted}, but its data has the \
             shape {shape:?}"
        );
        return Err(MapError::new_err(text));
    }
    let cells = from_array(&data.call_method1("reshape", ((height, width),))?)?;
    Ok(OccupancyGrid::new(frame, cells))
}

fn origin(pose: &Bound<'_, PyAny>) -> PyResult<Se2> {
    let number =
        |part: &str, axis: &str| -> PyResult<f64> { pose.getattr(part)?.getattr(axis)?.extract() };
    let (x, y) = (number("position", "x")?, number("position", "y")?);
    let [qx, qy, qz, qw] = [
        number("orientation", "x")?,
        number("orientation", "y")?,
        number("orientation", "z")?,
        number("orientation", "w")?,
    ];
    let norm = [qx, qy, qz, qw].iter().map(|part| part * part).sum::<f64>().sqrt();
    // What ROS 1 puts where nobody set an orientation.
    if norm == 0.0 {
        return Ok(Se2::new(x, y, 0.0));
    }
    let is_flat = (norm - 1.0).abs() <= 0.01 && qx.abs().max(qy.abs()) <= MAX_TILT * norm;
    if !is_flat {
        let text = format!(
            "the origin's orientation ({qx}, {qy}, {qz}, {qw}) is no turn about the vertical"
        );
        return Err(MapError::new_err(text));
    }
    Ok(Se2::new(x, y, 2.0 * qz.atan2(qw)))
}
