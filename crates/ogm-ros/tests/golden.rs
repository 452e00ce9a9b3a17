//! Messages as CycloneDDS and rosbags write them; `peers/golden.py` made the files.
#![expect(clippy::disallowed_methods, clippy::unwrap_used, reason = "a test")]

use std::fmt::Debug;
use std::path::Path;

use ogm_io::ros::{
    Header, MapMetaData, OccupancyGridMessage, Point, Pose, Quaternion, TfMessage, Time,
    TransformStamped, from_cdr, to_cdr,
};
use ogm_ros::message::{
    DiagnosticArray, DiagnosticStatus, KeyValue, OccupancyGridUpdate, PoseWithCovarianceStamped,
    Text,
};
use serde::Serialize;
use serde::de::DeserializeOwned;

fn agrees<T: Serialize + DeserializeOwned + PartialEq + Debug>(name: &str, expected: &T) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/golden/{name}.cdr"));
    let bytes = std::fs::read(file).unwrap();
    assert_eq!(&from_cdr::<T>(&bytes).unwrap(), expected);
    // CycloneDDS fills up to a multiple of four and says so in the header.
    let written = to_cdr(expected).unwrap();
    assert_eq!(written[4..], bytes[4..written.len()], "{name}");
    assert!(bytes.len() - written.len() < 4, "{name}");
    for length in 0..written.len() {
        assert!(from_cdr::<T>(&written[..length]).is_err(), "{length} bytes of {name}");
    }
}

fn header() -> Header {
    Header { stamp: Time { sec: 12, nanosec: 345 }, frame_id: "robot1/map".to_owned() }
}

fn pose() -> Pose {
    Pose {
        position: Point { x: 1.5, y: -2.25, z: 0.0 },
        orientation: Quaternion { x: 0.0, y: 0.0, z: 0.6, w: 0.8 },
    }
}

#[test]
fn maps_and_their_updates_are_the_bytes_of_others() {
    let info = MapMetaData {
        map_load_time: Time::default(),
        resolution: 0.05,
        width: 3,
        height: 2,
        origin: pose(),
    };
    let data = vec![0, 100, 255, 50, 255, 7];
    agrees("OccupancyGrid", &OccupancyGridMessage { header: header(), info, data });
    let data = vec![0, 100];
    let update = OccupancyGridUpdate { header: header(), x: 1, y: 0, width: 2, height: 1, data };
    agrees("OccupancyGridUpdate", &update);
}

#[test]
fn transforms_and_poses_are_the_bytes_of_others() {
    let child_frame_id = "robot2/map".to_owned();
    let transform = TransformStamped { header: header(), child_frame_id, transform: pose() };
    agrees("TFMessage", &TfMessage { transforms: vec![transform] });
    let covariance = std::array::from_fn(|at| at as f64);
    let given = PoseWithCovarianceStamped { header: header(), pose: pose(), covariance };
    agrees("PoseWithCovarianceStamped", &given);
}

#[test]
fn the_status_and_orders_are_the_bytes_of_others() {
    let value = |key: &str, value: &str| KeyValue { key: key.to_owned(), value: value.to_owned() };
    let status = DiagnosticStatus {
        level: 1,
        name: "ogm: robot1".to_owned(),
        message: "no place yet".to_owned(),
        hardware_id: String::new(),
        values: vec![value("probability", "0.9990"), value("x_m", "1.5")],
    };
    agrees("DiagnosticArray", &DiagnosticArray { header: header(), status: vec![status] });
    agrees("String", &Text { data: "separate robot2".to_owned() });
}
