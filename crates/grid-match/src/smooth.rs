//! Gaussian smoothing of a field of single precision.

/// `field` smoothed by a Gaussian of `sigma` cells, cut off at three; what lies outside is zero.
pub(crate) fn smooth_rows_and_columns(field: Vec<f32>, width: usize, sigma: f64) -> Vec<f32> {
    let kernel = half_kernel(sigma);
    let mut across = vec![0.0; field.len()];
    for (output, row) in across.chunks_exact_mut(width).zip(field.chunks_exact(width)) {
        add_shifted(output, row, &kernel);
    }
    let mut smooth = field;
    smooth.fill(0.0);
    let height = smooth.len() / width;
    for (row, output) in smooth.chunks_exact_mut(width).enumerate() {
        for (offset, &weight) in kernel.iter().enumerate() {
            let above = Some(row + offset).filter(|&above| above < height);
            let below = row.checked_sub(offset).filter(|_| offset > 0);
            for near in above.into_iter().chain(below) {
                for (sum, &value) in output.iter_mut().zip(&across[near * width..][..width]) {
                    *sum += weight * value;
                }
            }
        }
    }
    smooth
}

fn add_shifted(output: &mut [f32], row: &[f32], kernel: &[f32]) {
    for (offset, &weight) in kernel.iter().enumerate().take(row.len()) {
        for (sum, &value) in output.iter_mut().zip(&row[offset..]) {
            *sum += weight * value;
        }
        if offset > 0 {
            for (sum, &value) in output[offset..].iter_mut().zip(row) {
                *sum += weight * value;
            }
        }
    }
}

/// The middle of the kernel and one flank; both flanks and the middle sum to one.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a radius of some cells and weights below one"
)]
fn half_kernel(sigma: f64) -> Vec<f32> {
    let radius = (3.0 * sigma).ceil() as usize;
    let weight = |offset: usize| (-0.5 * (offset as f64 / sigma).powi(2)).exp();
    let total = (1..=radius).map(|offset| 2.0 * weight(offset)).sum::<f64>() + 1.0;
    (0..=radius).map(|offset| (weight(offset) / total) as f32).collect()
}

#[cfg(test)]
mod tests {
    use super::smooth_rows_and_columns;

    #[test]
    fn a_single_cell_spreads_evenly_and_keeps_its_sum() {
        let mut field = vec![0.0; 21 * 17];
        field[8 * 21 + 10] = 1.0;
        let smooth = smooth_rows_and_columns(field, 21, 1.5);
        assert!((smooth.iter().sum::<f32>() - 1.0).abs() < 1e-5);
        let at = |column: usize, row: usize| smooth[row * 21 + column];
        assert!(at(10, 8) > at(11, 8) && at(11, 8) > at(12, 8) && at(12, 8) > 0.0);
        for (a, b) in [((7, 8), (13, 8)), ((10, 5), (10, 11)), ((7, 8), (10, 5))] {
            assert!((at(a.0, a.1) - at(b.0, b.1)).abs() < 1e-7);
        }
    }
}
