//! The deformation beside a lattice of cubic B-splines, on drift that neither was made for.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::f64::consts::{PI, TAU};

use map_warp::{Motion, Warp, WarpParams};
use nalgebra::{DMatrix, DVector, Matrix3, Point2, Vector2, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Side of a floor, metres, and that of its rooms.
const SIDE_M: f64 = 24.0;
const ROOM_M: f64 = 4.0;
const NOISE_M: f64 = 0.03;

/// Waves of 15 to 60 m, as what is left after a loop is closed.
struct Drift([(Vector2<f64>, Vector2<f64>, f64); 3]);

impl Drift {
    fn draw(rng: &mut ChaCha8Rng) -> Self {
        Self(std::array::from_fn(|_| {
            let mut unit = || {
                let angle: f64 = rng.random_range(-PI..PI);
                Vector2::new(angle.cos(), angle.sin())
            };
            let (amplitude, direction) = (unit() * 0.25, unit());
            let number = direction * (TAU / rng.random_range(15.0..60.0));
            (amplitude, number, rng.random_range(-PI..PI))
        }))
    }

    fn at(&self, place: Point2<f64>) -> Vector2<f64> {
        self.0
            .iter()
            .map(|(by, number, phase)| by * (number.dot(&place.coords) + phase).sin())
            .sum()
    }

    fn turn(&self, place: Point2<f64>) -> f64 {
        let slope = |number: &Vector2<f64>, phase: &f64| (number.dot(&place.coords) + phase).cos();
        self.0.iter().map(|(by, number, phase)| 0.5 * number.perp(by) * slope(number, phase)).sum()
    }
}

/// The free-form deformation of Rueckert and others (1999): a tensor product of cubic B-splines over
/// a lattice of control points, here fitted to shifts (it has no use for turns) by least squares with their bending energy as
/// second differences of the lattice, weighed so that it did best of 0.001 to 1.
struct Lattice {
    controls: DMatrix<f64>,
    spacing: f64,
    count: usize,
}

impl Lattice {
    fn fit(motions: &[Motion], spacing: f64) -> Self {
        const SMOOTH: f64 = 0.01;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few")]
        let count = (SIDE_M / spacing).ceil() as usize + 3;
        let unknowns = count * count;
        let mut normal = DMatrix::<f64>::identity(unknowns, unknowns) * 1e-6;
        let mut right = DMatrix::<f64>::zeros(unknowns, 2);
        for motion in motions {
            let row = Self::row(motion.at, spacing, count);
            normal += &row * row.transpose();
            right += &row * motion.shift.transpose();
        }
        let mut bend = |at: [usize; 3]| {
            let mut row = DVector::<f64>::zeros(unknowns);
            for (index, weight) in at.into_iter().zip([1.0, -2.0, 1.0]) {
                row[index] = weight;
            }
            normal += &row * row.transpose() * SMOOTH;
        };
        for a in 0..count {
            for b in 1..count - 1 {
                bend([a * count + b - 1, a * count + b, a * count + b + 1]);
                bend([(b - 1) * count + a, b * count + a, (b + 1) * count + a]);
            }
        }
        Self { controls: normal.cholesky().unwrap().solve(&right), spacing, count }
    }

    fn row(at: Point2<f64>, spacing: f64, count: usize) -> DVector<f64> {
        let mut row = DVector::zeros(count * count);
        let basis = |along: f64| {
            let t = along.fract();
            let weights = [
                (1.0 - t).powi(3),
                3.0 * t.powi(3) - 6.0 * t * t + 4.0,
                -3.0 * t.powi(3) + 3.0 * t * t + 3.0 * t + 1.0,
                t.powi(3),
            ];
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few")]
            (along.floor() as usize, weights.map(|weight| weight / 6.0))
        };
        let ((column, across), (first, up)) = (basis(at.x / spacing), basis(at.y / spacing));
        for (j, &v) in up.iter().enumerate() {
            for (i, &u) in across.iter().enumerate() {
                row[(first + j) * count + column + i] += u * v;
            }
        }
        row
    }

    fn at(&self, place: Point2<f64>) -> Vector2<f64> {
        let row = Self::row(place, self.spacing, self.count);
        let shift = self.controls.transpose() * row;
        Vector2::new(shift[0], shift[1])
    }
}

#[test]
fn drift_is_undone_better_than_by_a_lattice_of_b_splines() {
    let (mut ours, mut theirs, mut count) = (0.0, [0.0; 3], 0.0);
    for seed in 0..20 {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let drift = Drift::draw(&mut rng);
        let rooms = (0..36).map(|room| (f64::from(room % 6), f64::from(room / 6)));
        let rooms: Vec<(f64, f64)> = rooms.filter(|_| rng.random_bool(0.6)).collect();
        let mut noise = |sigma: f64| sigma * 3.0_f64.sqrt() * rng.random_range(-1.0..1.0);
        let motions: Vec<Motion> = rooms
            .into_iter()
            .map(|(column, row)| Point2::new(column + 0.5, row + 0.5) * ROOM_M)
            .map(|at| Motion {
                at,
                shift: drift.at(at) + Vector2::new(noise(NOISE_M), noise(NOISE_M)),
                turn: drift.turn(at) + noise(0.01),
                covariance: Matrix3::from_diagonal(&Vector3::new(9e-4, 9e-4, 1e-4)),
            })
            .collect();
        let params = WarpParams { correlation_m: 8.0, ..WarpParams::default() };
        let warp = Warp::fit(&motions, &params).unwrap();
        let lattices = [4.0, 6.0, 8.0].map(|spacing| Lattice::fit(&motions, spacing));
        for place in (0..400).map(|i| Point2::new(f64::from(i % 20), f64::from(i / 20)) * 1.2) {
            let truth = drift.at(place);
            ours += (warp.apply(place) - place - truth).norm_squared();
            for (sum, lattice) in theirs.iter_mut().zip(&lattices) {
                *sum += (lattice.at(place) - truth).norm_squared();
            }
            count += 1.0;
        }
    }
    let rms = |sum: f64| f64::sqrt(sum / count);
    let (ours, theirs) = (rms(ours), theirs.map(rms));
    assert!(theirs.iter().all(|&theirs| ours < 0.9 * theirs), "{ours} m, {theirs:?} m");
}
