"""A robot that lies: noise, a header of 20 000², a resolution of NaN, a wrong length; one each second.

liar.py SECONDS
"""

import math
import random
import sys
import time

from cyclonedds.domain import DomainParticipant
from cyclonedds.pub import DataWriter
from cyclonedds.topic import Topic

import ros2


def main():
    rng = random.Random(1)
    participant = DomainParticipant(0)
    topic = Topic(participant, "rt/liar/map", ros2.OccupancyGrid)
    writer = DataWriter(participant, topic, qos=ros2.latched())
    side = 400
    end = time.time() + float(sys.argv[1])
    turn = 0
    while time.time() < end:
        noise = bytes(rng.choices([0, 100, 255], weights=[6, 1, 3], k=side * side))
        info = ros2.MapMetaData(resolution=0.05, width=side, height=side)
        grid = ros2.OccupancyGrid(info=info, data=noise)
        match turn % 4:
            case 1:
                info.width = info.height = 20_000
            case 2:
                info.resolution = math.nan
            case 3:
                grid.data = noise[:-1]
        grid.header.frame_id = "map"
        writer.write(grid)
        turn += 1
        time.sleep(1)


if __name__ == "__main__":
    main()
