"""Bags of rosbags merge as files do; a bag of ours reads back the same in three readers.

bags.py NODE OGM TEAM-FOLDER OUT-FOLDER
"""

import hashlib
import json
import pathlib
import subprocess
import sys

from mcap.reader import make_reader
from mcap_ros2.reader import read_ros2_messages
from rosbags.rosbag2 import Reader, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

TYPE = "nav_msgs/msg/OccupancyGrid"
STORE = get_typestore(Stores.ROS2_HUMBLE)


def as_files(message, path):
    """The map in map_server's mode raw, in which every value is kept."""
    grid = STORE.deserialize_cdr(message, TYPE)
    info, origin = grid.info, grid.info.origin
    rows = grid.data.astype("uint8").reshape(info.height, info.width)[::-1]
    path.with_suffix(".pgm").write_bytes(b"P5 %d %d 255\n" % (info.width, info.height) + rows.tobytes())
    yaw = 0.0
    assert origin.orientation.z == 0.0
    path.write_text(
        f"image: {path.stem}.pgm\nmode: raw\nresolution: 0.05\nnegate: 0\n"
        f"origin: [{origin.position.x!r}, {origin.position.y!r}, {yaw}]\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )


def merged(ogm, maps, out):
    command = [ogm, "align", *map(str, maps), "--json", "--quiet"]
    answer = subprocess.run(command, capture_output=True, text=True)
    assert answer.returncode in (0, 3), answer.stderr
    report = json.loads(answer.stdout)
    subprocess.run([ogm, "merge", *map(str, maps), "-o", str(out), "--quiet", "--force"], check=True)
    return report["verdict"], report["target_from_source"], report["probability"]


def main():
    node, ogm, team, out = sys.argv[1], sys.argv[2], *map(pathlib.Path, sys.argv[3:5])
    out.mkdir(parents=True)
    frames = sorted(path.name for path in (team / "robot1").glob("*.cdr"))
    robots = ("robot1", "robot2")
    bags = {}
    for name, plugin in (("sqlite", StoragePlugin.SQLITE3), ("mcap", StoragePlugin.MCAP)):
        bags[name] = out / name
        with Writer(bags[name], version=8, storage_plugin=plugin) as writer:
            topics = {it: writer.add_connection(f"/{it}/map", TYPE, typestore=STORE) for it in robots}
            for second, frame in enumerate(frames):
                for robot in robots:
                    message = (team / robot / frame).read_bytes()
                    writer.write(topics[robot], int((1000 + second) * 1e9), message)
    files = []
    for robot in robots:
        files.append(out / f"{robot}.yaml")
        as_files((team / robot / frames[-1]).read_bytes(), files[-1])
    by_files = merged(ogm, files, out / "by_files.yaml")
    assert by_files[0] == "merged", by_files
    for name, bag in bags.items():
        inner = next(iter(sorted([*bag.glob("*.mcap"), *bag.glob("*.db3")])))
        for source in (bag, inner):
            by_bag = merged(ogm, [f"{source}:/{robot}/map" for robot in robots], out / "by_bag.yaml")
            assert by_bag == by_files, (name, by_bag, by_files)
            pictures = [(out / f"{it}.pgm").read_bytes() for it in ("by_bag", "by_files")]
            assert pictures[0] == pictures[1], name
        first, last = (
            subprocess.run([ogm, "info", f"{bag}:/robot1/map{at}"], capture_output=True, text=True, check=True).stdout
            for at in ("@0", "")
        )
        assert first.split(":/robot1/map@0")[-1] != last.split(":/robot1/map")[-1]
    print("bags merge as files:", by_files)

    wrong = subprocess.run([ogm, "info", f"{bags['mcap']}:/robot9/map"], capture_output=True, text=True)
    assert wrong.returncode == 1 and "/robot1/map, /robot2/map" in wrong.stderr, wrong.stderr

    replayed = out / "replayed"
    subprocess.run([node, "replay", bags["sqlite"], "-o", replayed], check=True)
    ours = next(iter(replayed.glob("*.mcap")))

    def digest(parts):
        sha = hashlib.sha256()
        for topic, time, data in parts:
            sha.update(f"{topic} {time} ".encode())
            sha.update(data)
        return sha.hexdigest()

    with open(ours, "rb") as file:
        plain = [(c.topic, m.log_time, m.data) for _, c, m in make_reader(file).iter_messages()]
    with open(ours, "rb") as file:
        qos = {c.topic: c.metadata["offered_qos_profiles"] for c in make_reader(file).get_summary().channels.values()}
    with Reader(replayed) as reader:
        rosbags = [(c.topic, time, data) for c, time, data in reader.messages()]
        for connection in reader.connections:
            from rosbags.rosbag2.metadata import parse_qos

            assert connection.ext.offered_qos_profiles == parse_qos(qos[connection.topic])
            assert connection.ext.offered_qos_profiles[0].durability.name == "TRANSIENT_LOCAL"
    assert digest(plain) == digest(rosbags) and len(plain) > len(frames)
    maps = [it for it in read_ros2_messages(str(ours)) if it.channel.topic == "/map"]
    by_type = [STORE.deserialize_cdr(data, TYPE) for topic, _, data in plain if topic == "/map"]
    assert len(maps) == len(by_type) > 0
    for a, b in zip(maps, by_type):
        cells = bytes(value & 0xFF for value in a.ros_msg.data)
        assert cells == b.data.astype("uint8").tobytes() and a.ros_msg.info.width == b.info.width
    poses = [it.ros_msg for it in read_ros2_messages(str(ours)) if it.channel.topic == "/tf_static"]
    assert {it.child_frame_id for it in poses[-1].transforms} == {"robot1/map", "robot2/map"}
    statuses = [it.ros_msg for it in read_ros2_messages(str(ours)) if it.channel.topic == "/ogm/status"]
    assert statuses[-1].status[0].name == "ogm: team"
    print("read back by mcap, rosbags, mcap_ros2:", len(plain), "messages")


if __name__ == "__main__":
    main()
