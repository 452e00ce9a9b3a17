//! Reports as JSON.

mod component;
mod pair;
mod stages;
mod team;

use nalgebra::Matrix3;

/// Row after row.
fn rows(matrix: &Matrix3<f64>) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| matrix[(row, column)]))
}
