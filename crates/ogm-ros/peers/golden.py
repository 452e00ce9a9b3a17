"""Writes the messages that tests/golden.rs expects, by CycloneDDS, and checks that rosbags agrees.

golden.py FOLDER
"""

import pathlib
import sys

from rosbags.typesys import Stores, get_typestore

import ros2

STORE = get_typestore(Stores.ROS2_HUMBLE)


def main():
    header = ros2.Header(ros2.Time(12, 345), "robot1/map")
    pose = ros2.Pose(ros2.Point(1.5, -2.25, 0.0), ros2.Quaternion(0.0, 0.0, 0.6, 0.8))
    info = ros2.MapMetaData(ros2.Time(), 0.05, 3, 2, pose)
    data = bytes([0, 100, 255, 50, 255, 7])
    values = [ros2.KeyValue("probability", "0.9990"), ros2.KeyValue("x_m", "1.5")]
    status = ros2.DiagnosticStatus(1, "ogm: robot1", "no place yet", "", values)
    messages = {
        "nav_msgs/msg/OccupancyGrid": ros2.OccupancyGrid(header, info, data),
        "map_msgs/msg/OccupancyGridUpdate": ros2.OccupancyGridUpdate(header, 1, 0, 2, 1, data[:2]),
        "tf2_msgs/msg/TFMessage": ros2.TFMessage([ros2.TransformStamped(header, "robot2/map", pose)]),
        "diagnostic_msgs/msg/DiagnosticArray": ros2.DiagnosticArray(header, [status]),
        "geometry_msgs/msg/PoseWithCovarianceStamped": ros2.PoseWithCovarianceStamped(
            header, pose, [float(it) for it in range(36)]
        ),
        "std_msgs/msg/String": ros2.String("separate robot2"),
    }
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(exist_ok=True)
    for kind, message in messages.items():
        written = message.serialize()
        (folder / f"{kind.rsplit('/', 1)[1]}.cdr").write_bytes(written)
        if kind in STORE.types:
            again = bytes(STORE.serialize_cdr(STORE.deserialize_cdr(written, kind), kind))
            assert again[4:] == written[4 : len(again)], kind


if __name__ == "__main__":
    main()
