"""Three independent readers of a bag of ours: mcap, rosbags, mcap_ros2."""

import hashlib
from types import SimpleNamespace

from mcap.reader import make_reader
from mcap_ros2.reader import read_ros2_messages
from rosbags.rosbag2 import Reader
from rosbags.rosbag2.metadata import parse_qos
from rosbags.typesys import Stores, get_typestore

TYPE = "nav_msgs/msg/OccupancyGrid"
STORE = get_typestore(Stores.ROS2_HUMBLE)


def digest(parts):
    sha = hashlib.sha256()
    for topic, time, data in parts:
        sha.update(f"{topic} {time} ".encode())
        sha.update(data)
    return sha.hexdigest()


def read_back(bag):
    """The merged maps, the frames that were placed last, the last status, and how many messages there
    are, if all three readers see the same bytes, cells and quality of service in `bag`, a folder
    or a file."""
    ours = bag if bag.is_file() else next(bag.glob("*.mcap"))
    with open(ours, "rb") as file:
        plain = [(c.topic, m.log_time, m.data) for _, c, m in make_reader(file).iter_messages()]
    with open(ours, "rb") as file:
        qos = {c.topic: c.metadata["offered_qos_profiles"] for c in make_reader(file).get_summary().channels.values()}
    with Reader(bag) as reader:
        rosbags = [(c.topic, time, data) for c, time, data in reader.messages()]
        for connection in reader.connections:
            assert connection.ext.offered_qos_profiles == parse_qos(qos[connection.topic])
            assert connection.ext.offered_qos_profiles[0].durability.name == "TRANSIENT_LOCAL"
    assert digest(plain) == digest(rosbags)
    maps, placed, status = [], {}, []
    # One at a time: that reader makes a list of numbers of every map.
    decoded = read_ros2_messages(str(ours))
    for (topic, _, data), message in zip(plain, decoded, strict=True):
        assert message.channel.topic == topic
        message = message.ros_msg
        if topic == "/map":
            maps.append(STORE.deserialize_cdr(data, TYPE))
            cells = bytes(value & 0xFF for value in message.data)
            assert cells == maps[-1].data.astype("uint8").tobytes()
            assert message.info.width == maps[-1].info.width
        elif topic == "/tf_static":
            placed = {it.child_frame_id: it.transform for it in message.transforms}
        elif topic == "/ogm/status":
            status = message.status
    assert maps
    return SimpleNamespace(maps=maps, placed=placed, status=status, messages=len(plain))
