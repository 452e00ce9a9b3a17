"""How long maps of 1, 4 and 16 MB take to a CycloneDDS reader with default buffers: a reader that
is there, and one that comes late.

wire.py WIRE-EXAMPLE
"""

import json
import subprocess
import sys
import time

from cyclonedds.domain import DomainParticipant
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic

import ros2
import scenario

COUNT = 5
MOST_S = {1000: 1.0, 2000: 2.0, 4000: 4.0}
MOST_LATE_S = 15.0


def read(seconds, last):
    """Seconds from now, and from its stamp, at which each map came, up to the last one."""
    participant = DomainParticipant(0)
    topic = Topic(participant, "rt/map", ros2.OccupancyGrid)
    reader = DataReader(participant, topic, qos=ros2.latched())
    began, came = time.time(), []
    while time.time() < began + seconds and not (came and came[-1][2] == last):
        for grid in reader.take(N=10):
            now, stamp, data = time.time(), grid.header.stamp, bytes(grid.data)
            turn = data[0]
            right = bytes((7 * cell + turn) % 101 for cell in range(101)) * (len(data) // 101 + 1)
            assert data == right[: len(data)], "the cells are not those that were sent"
            came.append((now - began, now - stamp.sec - stamp.nanosec * 1e-9, turn))
        time.sleep(0.002)
    return came


def main():
    scenario.alone()
    for side, most in MOST_S.items():
        writer = subprocess.Popen([sys.argv[1], str(side), str(COUNT)])
        there = read(3 + COUNT + 10, COUNT - 1)
        time.sleep(5)
        late = read(MOST_LATE_S + 5, COUNT - 1)
        writer.kill()
        writer.wait()
        latency = [round(latency, 3) for _, latency, _ in there]
        print(json.dumps({"MB": side**2 / 1e6, "there s": latency, "late s": [round(it[0], 2) for it in late][-1:]}))
        assert len(there) == COUNT, f"{len(there)} of {COUNT} maps of {side}² came"
        assert scenario.median(latency) <= most
        assert late and late[-1][0] <= MOST_LATE_S, "nothing came for who was late"
        assert late[-1][2] == COUNT - 1, "who was late got an old map"


if __name__ == "__main__":
    main()
