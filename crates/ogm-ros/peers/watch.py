"""Follows what the node publishes, and writes what it saw as lines of JSON.

watch.py SECONDS OUT
"""

import json
import math
import sys
import time

from cyclonedds.domain import DomainParticipant
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic

import ros2


def main():
    seconds, out = float(sys.argv[1]), open(sys.argv[2], "w")
    participant = DomainParticipant(0)

    def reader(name, kind):
        return DataReader(participant, Topic(participant, name, kind), qos=ros2.latched())

    maps = reader("rt/map", ros2.OccupancyGrid)
    transforms = reader("rt/tf_static", ros2.TFMessage)
    status = reader("rt/ogm/status", ros2.DiagnosticArray)
    conflicts = reader("rt/ogm/conflicts", ros2.OccupancyGrid)

    def note(**what):
        out.write(json.dumps(what) + "\n")
        out.flush()

    end = time.time() + seconds
    while time.time() < end:
        now = time.time()
        for kind, topic in (("map", maps), ("conflicts", conflicts)):
            for grid in topic.take(N=10):
                info, stamp = grid.info, grid.header.stamp
                yaw = 2 * math.atan2(info.origin.orientation.z, info.origin.orientation.w)
                data = bytes(grid.data)
                note(
                    kind=kind,
                    at=now,
                    latency=now - stamp.sec - stamp.nanosec * 1e-9,
                    frame=grid.header.frame_id,
                    width=info.width,
                    height=info.height,
                    resolution=info.resolution,
                    origin=[info.origin.position.x, info.origin.position.y, yaw],
                    occupied=sum(map(data.count, range(65, 101))),
                    known=len(data) - data.count(255),
                )
        for message in transforms.take(N=10):
            poses = {
                it.child_frame_id: [
                    it.transform.position.x,
                    it.transform.position.y,
                    2 * math.atan2(it.transform.orientation.z, it.transform.orientation.w),
                ]
                for it in message.transforms
            }
            parents = sorted({it.header.frame_id for it in message.transforms})
            note(kind="tf", at=now, poses=poses, parents=parents)
        for message in status.take(N=10):
            robots = {it.name: [it.level, it.message] for it in message.status}
            note(kind="status", at=now, robots=robots)
        time.sleep(0.005)


if __name__ == "__main__":
    main()
