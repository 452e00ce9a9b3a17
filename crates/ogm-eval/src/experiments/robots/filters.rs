//! One robot's log through the three filters.

use ekf_slam::{Ekf, EkfParams, Reading, Verdict};
use nalgebra::{Matrix3, Point2};
use ogm_core::{RelativePose, Se2};
use ogm_sim::{SensorLog, SensorParams};

use super::record::{End, Filter, Robot};
use super::scan_matching::{Scan, motion};
use crate::judge::{PoseError, nees};

/// What a filter made of a log.
pub(super) struct Track {
    /// The pose of the start and after every sample, in the frame of the start.
    pub(super) start_from_robot: Vec<Se2>,
    covariance: Matrix3<f64>,
    /// Scan matches used, gated, and refused by ICP.
    scans: [usize; 3],
}

/// What a filter is told of the robot: what the simulator knows.
fn told(params: &SensorParams) -> EkfParams {
    EkfParams {
        track_m: params.track,
        wheel_sigma_per_root_m: params.wheel_sigma_per_root_m,
        yaw_rate_sigma: params.yaw_rate_sigma,
        bias_sigma: params.bias_sigma,
        bias_walk: params.bias_walk,
        ..EkfParams::default()
    }
}

pub(super) fn track(
    filter: Filter,
    log: &SensorLog,
    params: &SensorParams,
) -> anyhow::Result<Track> {
    let mut ekf = Ekf::new(told(params), 0.0, Se2::identity(), Matrix3::zeros())?;
    let beams = params.lidar.directions();
    let mut last_scan = (Scan::new(&beams, &log.first_ranges)?, Se2::identity());
    let mut track = Track {
        start_from_robot: vec![Se2::identity()],
        covariance: Matrix3::zeros(),
        scans: [0; 3],
    };
    for sample in &log.samples {
        let odometry = Reading::Odometry { left_m: sample.left_m, right_m: sample.right_m };
        ekf.add(sample.time, &odometry)?;
        if filter == Filter::EkfWithScans
            && let Some(ranges) = &sample.ranges
        {
            let scan = Scan::new(&beams, ranges)?;
            let expected = last_scan.1.between(&ekf.estimate().map_from_robot);
            match motion(&last_scan.0, &scan, expected)? {
                Some(matched) => match ekf.add(sample.time, &Reading::ScanMatch(matched))? {
                    Verdict::Gated { .. } => track.scans[1] += 1,
                    _ => track.scans[0] += 1,
                },
                None => {
                    ekf.add(sample.time, &Reading::UnmatchedScan)?;
                    track.scans[2] += 1;
                }
            }
            last_scan = (scan, ekf.estimate().map_from_robot);
        }
        if filter != Filter::DeadReckoning {
            ekf.add(sample.time, &Reading::Imu { yaw_rate: sample.yaw_rate })?;
        }
        track.start_from_robot.push(ekf.estimate().map_from_robot);
    }
    track.covariance = ekf.estimate().covariance;
    Ok(track)
}

/// What the last pose of each track, in the order of [`Filter::ALL`], is worth.
pub(super) fn judge(log: &SensorLog, tracks: &[Track; 3]) -> Robot {
    let world_from_robot = || {
        let after = log.samples.iter().map(|sample| sample.world_from_robot);
        std::iter::once(log.world_from_start).chain(after)
    };
    let truth = world_from_robot().last().unwrap_or(log.world_from_start);
    let truth = log.world_from_start.between(&truth);
    let end = |track: &Track| {
        let found = track.start_from_robot.last().copied().unwrap_or_else(Se2::identity);
        let pose = RelativePose {
            target_from_source: found,
            covariance: track.covariance,
            probability: 1.0,
        };
        End {
            error: PoseError::at(Point2::origin(), &found, &truth),
            nees: nees(&pose, &truth),
            scans: track.scans,
        }
    };
    let place = |world_from_robot: Se2| Point2::from(world_from_robot.translation());
    let path = |track: &Track| -> Vec<Point2<f64>> {
        track
            .start_from_robot
            .iter()
            .map(|&start_from_robot| place(log.world_from_start * start_from_robot))
            .collect()
    };
    let driven: Vec<Point2<f64>> = world_from_robot().map(place).collect();
    let [a, b, c] = tracks;
    Robot {
        length: driven.windows(2).map(|ends| (ends[1] - ends[0]).norm()).sum(),
        ends: [end(a), end(b), end(c)],
        paths: [driven, path(a), path(b), path(c)],
    }
}
