"""What a cluster costs beside the threads of one process, on the maps of `fleet.py`, and what the
death of one of its two workers changes.

    python fleet_cost.py [ROBOTS] [--partners COUNT] [--splice DOCUMENT]

Searches the pairs that look alike from inside, COUNT or more a map. Prints a table of Markdown, and puts it into the document between its marks.
"""

import argparse
import os
import pickle
import signal
import time
import zlib
from pathlib import Path

import numpy as np
from distributed import Client, LocalCluster
from fleet import ROBOTS_A_FLOOR, draw_floor, explore
from splice import splice

import ogm_maps as ogm
from ogm_maps import fleet


def same(one: ogm.Merge, other: ogm.Merge) -> bool:
    """Whether both merges have the same groups, poses and cells."""
    return len(one.components) == len(other.components) and all(
        a.members == b.members and a.poses == b.poses and a.map == b.map
        for a, b in zip(one.components, other.components)
    )


def seconds(client: Client) -> dict[str, float]:
    """On the clock, and of processors in this process and in each worker."""
    spent = {"": time.perf_counter(), "here": time.process_time()}
    return {**spent, **client.run(time.process_time)}


def main(robots: int, partners: int) -> str:
    rng = np.random.default_rng(1)
    floors = [draw_floor(rng) for _ in range(-(-robots // ROBOTS_A_FLOOR))]
    maps = [explore(floors[robot // ROBOTS_A_FLOOR], rng) for robot in range(robots)]
    size = sum(len(zlib.compress(pickle.dumps(one), 1)) for one in maps) / robots
    with (
        LocalCluster(
            n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=None
        ) as cluster,
        Client(cluster) as client,
    ):
        pairs = fleet.likely_pairs(client, maps, partners)
        places = range(robots)
        others = {(a, b): [] for a in places for b in places if a < b and (a, b) not in pairs}
        start = seconds(client)
        here = ogm.merge(maps, alignments=others, threads=2)
        between = seconds(client)
        there = fleet.merge_maps(client, maps, pairs, threads=2)
        end = seconds(client)

        victim = next(iter(client.run(os.getpid).values()))
        heard: list[float] = []

        def kill(share: float) -> None:
            heard.append(share)
            if share > 0.3 and heard[-2] <= 0.3:
                os.kill(victim, signal.SIGKILL)

        without = fleet.merge_maps(client, maps, pairs, threads=2, progress=kill)
    process, workers = between[""] - start[""], end[""] - between[""]
    cpu = [sum(b[of] - a[of] for of in a if of) for a, b in ((start, between), (between, end))]
    rows = [
        "| maps | pairs | bytes a map | 2 threads, s | 2 workers, s | beside "
        "| processor s, threads | workers | beside | same | same after a death |",
        "| --: | --: | --: | --: | --: | --: | --: | --: | --: | --- | --- |",
        f"| {robots} | {len(pairs)} | {size:.0f} "
        f"| {process:.1f} | {workers:.1f} | {workers / process:.2f} "
        f"| {cpu[0]:.1f} | {cpu[1]:.1f} | {cpu[1] / cpu[0]:.2f} "
        f"| {'yes' if same(here, there) else 'no'} | {'yes' if same(here, without) else 'no'} |",
    ]
    return "\n".join(rows)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("robots", type=int, nargs="?", default=100)
    parser.add_argument("--partners", type=int, default=10)
    parser.add_argument("--splice", type=Path)
    args = parser.parse_args()
    text = main(args.robots, args.partners)
    print(text)
    if args.splice:
        command = "python crates/ogm-python/examples/fleet_cost.py"
        command += f" {args.robots} --partners {args.partners}"
        splice(args.splice, "cluster", text, command)
