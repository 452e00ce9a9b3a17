//! Predict by encoders, correct by laser and IMU, each on its own.

use nalgebra::{Matrix1, Matrix3, RowSVector, SMatrix, SVector, Vector1};
use ogm_core::{RelativePose, Se2, wrap_angle};

use crate::error::EkfError;
use crate::params::EkfParams;
use crate::reading::{Estimate, Reading, Verdict};

/// Pose now (x, y, θ), pose at the last scan, heading at the last yaw rate, bias of the gyroscope.
const SIZE: usize = 8;
const SCAN: usize = 3;
const IMU_HEADING: usize = 6;
const BIAS: usize = 7;

/// A cascaded extended Kalman filter.
///
/// A scan match and a yaw rate speak of motion since an earlier moment. So the state keeps the pose
/// of that moment, with its correlations (stochastic cloning: Roumeliotis, Burdick 2002): the same
/// odometry is not counted twice. Errors of poses are twists about the map's origin (the invariant
/// filter of Barrau, Bonnabel 2017), so that relative motions never seem to say the heading.
#[derive(Debug, Clone)]
pub struct Ekf {
    params: EkfParams,
    time: f64,
    imu_time: f64,
    state: SVector<f64, SIZE>,
    covariance: SMatrix<f64, SIZE, SIZE>,
}

impl Ekf {
    /// A robot at `map_from_robot` at `time` (seconds), sure to `covariance` of (x, y, θ).
    ///
    /// # Errors
    /// A parameter, time, pose or covariance that cannot be meant.
    pub fn new(
        params: EkfParams,
        time: f64,
        map_from_robot: Se2,
        covariance: Matrix3<f64>,
    ) -> Result<Self, EkfError> {
        params.check()?;
        map_from_robot.check_finite()?;
        if !time.is_finite() {
            return Err(EkfError::NonFiniteTime { time });
        }
        if !is_semidefinite(&covariance) {
            return Err(EkfError::NotACovariance { time });
        }
        let mut state = SVector::<f64, SIZE>::zeros();
        let (x, y, theta) = (map_from_robot.x(), map_from_robot.y(), map_from_robot.theta());
        state.fixed_rows_mut::<3>(0).copy_from_slice(&[x, y, theta]);
        let mut whole = SMatrix::<f64, SIZE, SIZE>::zeros();
        let by_pose = by_twist(-x, -y);
        let of_twist = by_pose * covariance * by_pose.transpose();
        whole.fixed_view_mut::<3, 3>(0, 0).copy_from(&of_twist);
        let mut filter = Self { params, time, imu_time: time, state, covariance: whole };
        filter.clone_scan();
        filter.clone_heading();
        filter.covariance[(BIAS, BIAS)] = params.bias_sigma.powi(2);
        Ok(filter)
    }

    /// Takes the next reading, of `time` in seconds; readings may share a time.
    ///
    /// # Errors
    /// A reading that cannot be meant; the filter stays as it was.
    pub fn add(&mut self, time: f64, reading: &Reading) -> Result<Verdict, EkfError> {
        if !time.is_finite() {
            return Err(EkfError::NonFiniteTime { time });
        }
        let (last, limit) = (self.time, self.params.max_gap_s);
        if time < last {
            return Err(EkfError::TimeGoesBack { time, last });
        }
        if time - last > limit {
            return Err(EkfError::Gap { gap: time - last, limit });
        }
        let mut next = self.clone();
        next.time = time;
        let verdict = match reading {
            Reading::Odometry { left_m, right_m } => next.predict(*left_m, *right_m),
            Reading::ScanMatch(scan) => next.correct_by_scan(scan)?,
            Reading::UnmatchedScan => {
                next.clone_scan();
                Verdict::Predicted
            }
            Reading::Imu { yaw_rate } => next.correct_by_yaw_rate(*yaw_rate)?,
        };
        let values = next.state.iter().chain(&next.covariance);
        let distance = match verdict {
            Verdict::Predicted => 0.0,
            Verdict::Used { distance_sq } | Verdict::Gated { distance_sq } => distance_sq,
        };
        if !distance.is_finite() || !values.into_iter().all(|value| value.is_finite()) {
            return Err(EkfError::NonFiniteReading { time });
        }
        *self = next;
        Ok(verdict)
    }

    /// Where the robot is now.
    #[must_use]
    pub fn estimate(&self) -> Estimate {
        let of_twist = self.covariance.fixed_view::<3, 3>(0, 0);
        let by_twist = by_twist(self.state[0], self.state[1]);
        Estimate {
            time: self.time,
            map_from_robot: self.pose(0),
            covariance: by_twist * of_twist * by_twist.transpose(),
        }
    }

    fn pose(&self, at: usize) -> Se2 {
        Se2::new(self.state[at], self.state[at + 1], self.state[at + 2])
    }

    fn predict(&mut self, left: f64, right: f64) -> Verdict {
        let track = self.params.track_m;
        let (travel, turn) = ((left + right) / 2.0, (right - left) / track);
        let before = self.pose(0);
        let after = before * Se2::exp([travel, 0.0, turn].into());
        // θ is kept unwrapped: headings of two moments are subtracted.
        let theta = self.state[2] + turn;
        self.state.fixed_rows_mut::<3>(0).copy_from_slice(&[after.x(), after.y(), theta]);
        // Noise enters along the chord; the curvature of one step is of second order.
        let (sin, cos) = (theta - turn / 2.0).sin_cos();
        let across = travel / (2.0 * track);
        let mut by_wheels = SMatrix::<f64, SIZE, 2>::zeros();
        for (wheel, sign) in [(0, -1.0), (1, 1.0)] {
            by_wheels[(0, wheel)] = cos / 2.0 - sign * across * sin + after.y() * sign / track;
            by_wheels[(1, wheel)] = sin / 2.0 + sign * across * cos - after.x() * sign / track;
            by_wheels[(2, wheel)] = sign / track;
        }
        let variance = self.params.wheel_sigma_per_root_m.powi(2);
        let noise = SMatrix::<f64, 2, 2>::from_diagonal(
            &[variance * left.abs(), variance * right.abs()].into(),
        );
        self.covariance += by_wheels * noise * by_wheels.transpose();
        Verdict::Predicted
    }

    fn correct_by_scan(&mut self, scan: &RelativePose) -> Result<Verdict, EkfError> {
        let time = self.time;
        if !scan.target_from_source.is_finite() {
            return Err(EkfError::NonFiniteReading { time });
        }
        if !is_semidefinite(&scan.covariance) || scan.covariance.cholesky().is_none() {
            return Err(EkfError::NotACovariance { time });
        }
        let last_from_now = self.pose(SCAN).between(&self.pose(0));
        let measured = scan.target_from_source;
        let shift = measured.translation() - last_from_now.translation();
        let turn = wrap_angle(measured.theta() - last_from_now.theta());
        let (sin, cos) = self.state[SCAN + 2].sin_cos();
        let mut by_state = SMatrix::<f64, 3, SIZE>::zeros();
        let turned_back = Matrix3::new(cos, sin, 0.0, -sin, cos, 0.0, 0.0, 0.0, 1.0);
        let by_now = turned_back * by_twist(self.state[0], self.state[1]);
        by_state.fixed_view_mut::<3, 3>(0, 0).copy_from(&by_now);
        by_state.fixed_view_mut::<3, 3>(0, SCAN).copy_from(&-by_now);
        let gate = self.params.scan_gate;
        let innovation = [shift.x, shift.y, turn].into();
        let verdict = self.correct(&innovation, &by_state, &scan.covariance, gate);
        // The next match starts from this scan, whether this one was believed or not.
        self.clone_scan();
        verdict
    }

    fn correct_by_yaw_rate(&mut self, yaw_rate: f64) -> Result<Verdict, EkfError> {
        let covered = self.time - self.imu_time;
        if covered <= 0.0 {
            return Err(EkfError::NoTimeForYawRate { time: self.time });
        }
        self.covariance[(BIAS, BIAS)] += self.params.bias_walk.powi(2) * covered;
        let expected = (self.state[2] - self.state[IMU_HEADING]) / covered + self.state[BIAS];
        let mut by_state = RowSVector::<f64, SIZE>::zeros();
        by_state[2] = 1.0 / covered;
        by_state[IMU_HEADING] = -1.0 / covered;
        by_state[BIAS] = 1.0;
        let noise = Matrix1::new(self.params.yaw_rate_sigma.powi(2));
        let innovation = Vector1::new(yaw_rate - expected);
        let verdict = self.correct(&innovation, &by_state, &noise, self.params.imu_gate);
        self.clone_heading();
        self.imu_time = self.time;
        verdict
    }

    fn correct<const M: usize>(
        &mut self,
        innovation: &SVector<f64, M>,
        by_state: &SMatrix<f64, M, SIZE>,
        noise: &SMatrix<f64, M, M>,
        gate: f64,
    ) -> Result<Verdict, EkfError> {
        let expected = by_state * self.covariance * by_state.transpose() + noise;
        let Some(inverse) = expected.try_inverse() else {
            return Err(EkfError::NotACovariance { time: self.time });
        };
        let distance_sq = innovation.dot(&(inverse * innovation));
        if distance_sq > gate {
            return Ok(Verdict::Gated { distance_sq });
        }
        let gain = self.covariance * by_state.transpose() * inverse;
        let change = gain * innovation;
        for at in [0, SCAN] {
            let twist = change.fixed_rows::<3>(at).into_owned();
            let moved = Se2::exp(twist) * self.pose(at);
            let theta = self.state[at + 2] + twist.z;
            self.state.fixed_rows_mut::<3>(at).copy_from_slice(&[moved.x(), moved.y(), theta]);
        }
        self.state[IMU_HEADING] += change[IMU_HEADING];
        self.state[BIAS] += change[BIAS];
        // Joseph's form stays symmetric and positive where the short one loses digits.
        let kept = SMatrix::<f64, SIZE, SIZE>::identity() - gain * by_state;
        self.covariance =
            kept * self.covariance * kept.transpose() + gain * noise * gain.transpose();
        Ok(Verdict::Used { distance_sq })
    }

    fn clone_scan(&mut self) {
        for axis in 0..3 {
            self.copy_entry(axis, SCAN + axis);
        }
    }

    fn clone_heading(&mut self) {
        self.copy_entry(2, IMU_HEADING);
    }

    fn copy_entry(&mut self, from: usize, to: usize) {
        self.state[to] = self.state[from];
        let row = self.covariance.row(from).into_owned();
        self.covariance.set_row(to, &row);
        let column = self.covariance.column(from).into_owned();
        self.covariance.set_column(to, &column);
    }
}

/// Of (x, y, θ) of a pose at (`x`, `y`) by the twist about the map's origin that moves it.
fn by_twist(x: f64, y: f64) -> Matrix3<f64> {
    Matrix3::new(1.0, 0.0, -y, 0.0, 1.0, x, 0.0, 0.0, 1.0)
}

fn is_semidefinite(covariance: &Matrix3<f64>) -> bool {
    let size = covariance.amax();
    covariance.iter().all(|value| value.is_finite())
        && (covariance - covariance.transpose()).amax() <= 1e-6 * size
        && covariance.symmetric_eigenvalues().min() >= -1e-9 * size
}
