//! Occupancy as ROS messages hold it, and as grids do: -1 and 0 to 100, against bytes.

use std::array::from_fn;

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use ogm_core::{Grid, Occupancy};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::{Bound, PyAny, PyAnyMethods, PyResult, Python};

use crate::error::{MapError, map_error};

const UNKNOWN: i8 = -1;
const OCCUPIED: i8 = 100;

/// The cells of an array of integers of shape (height, width), row 0 the lowest, in whatever order
/// they lie in memory.
pub(crate) fn from_array(given: &Bound<'_, PyAny>) -> PyResult<Grid<Occupancy>> {
    let numpy = given.py().import("numpy")?;
    let array = numpy.call_method1("asarray", (given,))?;
    let shape: Vec<usize> = array.getattr("shape")?.extract()?;
    if shape.len() != 2 {
        let text = format!("cells are an array of shape (height, width), not {shape:?}");
        return Err(MapError::new_err(text));
    }
    let dtype = array.getattr("dtype")?;
    let kind: String = dtype.getattr("kind")?.extract()?;
    if !matches!(&*kind, "i" | "u") {
        let text = format!("cells are integers, -1 and 0 to 100, not {dtype}");
        return Err(PyTypeError::new_err(text));
    }
    let (height, width) = (shape[0], shape[1]);
    ogm_core::cell_count(width, height).map_err(map_error)?;
    let narrow = if dtype.getattr("itemsize")?.extract::<usize>()? == 1 && kind == "i" {
        array
    } else {
        let extreme = |which| -> PyResult<i128> {
            array.call_method0(which)?.call_method0("item")?.extract()
        };
        check(extreme("min")?, extreme("max")?)?;
        array.call_method1("astype", ("int8",))?
    };
    // Columns one after another are the rows of the transposed array.
    let flags = narrow.getattr("flags")?;
    let by_columns = !flags.getattr("c_contiguous")?.extract::<bool>()?
        && flags.getattr("f_contiguous")?.extract::<bool>()?;
    let in_rows = if by_columns { narrow.getattr("T")? } else { narrow };
    let ordered = numpy.call_method1("ascontiguousarray", (in_rows,))?;
    let cells: PyReadonlyArray2<'_, i8> = ordered.extract()?;
    let rows = if by_columns { [width, height] } else { [height, width] };
    if !cells.is_c_contiguous() || cells.shape() != rows {
        return Err(PyTypeError::new_err("the array does not become one in C order"));
    }
    let cells = cells.as_slice().map_err(map_error)?;
    let (least, most) = cells
        .iter()
        .fold((i8::MAX, i8::MIN), |(least, most), &cell| (least.min(cell), most.max(cell)));
    check(least.into(), most.into())?;
    let bytes: [Occupancy; 256] = from_fn(|index| {
        let percent = u8::try_from(index).unwrap_or(0).cast_signed();
        if percent == UNKNOWN {
            Occupancy::UNKNOWN
        } else {
            Occupancy::from_probability(f64::from(percent) / f64::from(OCCUPIED))
        }
    });
    let read = |&cell: &i8| bytes[usize::from(cell.cast_unsigned())];
    let cells =
        if by_columns { transposed(cells, height, read) } else { cells.iter().map(read).collect() };
    Grid::new(width, height, cells).map_err(map_error)
}

/// Rows one after another, of columns of `height` cells one after another. By squares, of which
/// both sides stay in the cache.
fn transposed(columns: &[i8], height: usize, read: impl Fn(&i8) -> Occupancy) -> Vec<Occupancy> {
    const SQUARE: usize = 64;
    let width = columns.len() / height;
    let mut cells = vec![Occupancy::UNKNOWN; columns.len()];
    for row in (0..height).step_by(SQUARE) {
        let rows = row..height.min(row + SQUARE);
        for column in (0..width).step_by(SQUARE) {
            for column in column..width.min(column + SQUARE) {
                let part = &columns[column * height..][rows.clone()];
                for (row, cell) in rows.clone().zip(part) {
                    cells[row * width + column] = read(cell);
                }
            }
        }
    }
    cells
}

fn check(least: i128, most: i128) -> PyResult<()> {
    if least < UNKNOWN.into() || most > OCCUPIED.into() {
        let text = format!(
            "cells are -1 (unknown) or 0 (free) to 100 (occupied), but these reach from {least} \
             to {most}; grey levels of an image are no cells, load them with their YAML"
        );
        return Err(MapError::new_err(text));
    }
    Ok(())
}

/// The cells as an array of shape (height, width) that nobody can write to.
pub(crate) fn to_array<'py>(
    py: Python<'py>,
    cells: &Grid<Occupancy>,
) -> PyResult<Bound<'py, PyArray2<i8>>> {
    let percents: [i8; 256] = from_fn(|index| {
        let cell = Occupancy::from_byte(u8::try_from(index).unwrap_or(u8::MAX));
        cell.probability().map_or(UNKNOWN, percent)
    });
    let values: Vec<i8> =
        cells.cells().iter().map(|cell| percents[usize::from(cell.byte())]).collect();
    read_only(&PyArray1::from_vec(py, values).reshape([cells.height(), cells.width()])?)
}

#[expect(clippy::cast_possible_truncation, reason = "0 to 100")]
fn percent(p: f64) -> i8 {
    (p * f64::from(OCCUPIED)).round() as i8
}

/// A mask as an array of shape (height, width) that nobody can write to.
pub(crate) fn mask<'py>(
    py: Python<'py>,
    cells: &Grid<bool>,
) -> PyResult<Bound<'py, PyArray2<bool>>> {
    let mask = PyArray1::from_slice(py, cells.cells());
    read_only(&mask.reshape([cells.height(), cells.width()])?)
}

fn read_only<'py, T: numpy::Element>(
    array: &Bound<'py, PyArray2<T>>,
) -> PyResult<Bound<'py, PyArray2<T>>> {
    array.call_method1("setflags", (false,))?;
    Ok(array.clone())
}
