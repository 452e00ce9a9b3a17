"""Robots that publish the maps of a recorded drive, a map a second, through CycloneDDS.

team.py FOLDER [--start SECOND] [--only ROBOT] [--hold SECONDS]
"""

import argparse
import math
import pathlib
import random
import time

from cyclonedds.domain import DomainParticipant
from cyclonedds.pub import DataWriter
from cyclonedds.topic import Topic

import ros2


def move(origin, x, y, yaw):
    """The pose as a frame at (x, y, yaw) sees it."""
    at, turn = origin.position, 2 * math.atan2(origin.orientation.z, origin.orientation.w)
    dx, dy, c, s = at.x - x, at.y - y, math.cos(yaw), math.sin(yaw)
    at.x, at.y = c * dx + s * dy, c * dy - s * dx
    half = (turn - yaw) / 2
    origin.orientation = ros2.Quaternion(z=math.sin(half), w=math.cos(half))


def speckled(grid, rng):
    """The map with some of its free cells occupied, as when somebody walks by."""
    cells = bytearray(grid.data)
    for cell in rng.sample(range(len(cells)), len(cells) // 1000):
        if cells[cell] == 0:
            cells[cell] = 100
    grid.data = bytes(cells)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--start", type=int, default=0)
    parser.add_argument("--seconds", type=int)
    parser.add_argument("--only")
    parser.add_argument("--moved", help="X,Y,RAD: the map frame in that of the recording")
    parser.add_argument("--hold", type=int, default=0, help="how long the last maps go on to change")
    args = parser.parse_args()
    robots = sorted(path for path in args.folder.iterdir() if path.is_dir())
    robots = [path for path in robots if args.only in (None, path.name)]
    participant = DomainParticipant(0)
    writers = []
    for path in robots:
        topic = Topic(participant, f"rt/{path.name}/map", ros2.OccupancyGrid)
        writers.append((DataWriter(participant, topic, qos=ros2.latched()), path))
    began = time.time()
    frames = sorted(path.name for path in robots[0].glob("*.cdr"))[args.start :][: args.seconds]
    driven = len(frames)
    frames += frames[-1:] * args.hold
    rng = random.Random(1)
    for turn, frame in enumerate(frames):
        for writer, path in writers:
            grid = ros2.OccupancyGrid.deserialize((path / frame).read_bytes())
            if args.moved:
                move(grid.info.origin, *map(float, args.moved.split(",")))
            if turn >= driven:
                speckled(grid, rng)
            now = time.time()
            grid.header.stamp = ros2.Time(int(now), int(now % 1 * 1e9))
            writer.write(grid)
        time.sleep(max(0.0, began + turn + 1 - time.time()))
    # A writer that leaves takes what it keeps for others along.
    time.sleep(3)


if __name__ == "__main__":
    main()
