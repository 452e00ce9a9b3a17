"""What a cluster costs beside the threads of one process, on the maps of `fleet.py`.

Prints a table of Markdown.

    python fleet_cost.py [ROBOTS]
"""

import pickle
import sys
import time
import zlib

import numpy as np
from distributed import Client, LocalCluster
from fleet import ROBOTS_A_FLOOR, draw_floor, explore

import ogm_maps as ogm
from ogm_maps import fleet


def main(robots: int) -> None:
    rng = np.random.default_rng(1)
    floors = [draw_floor(rng) for _ in range(-(-robots // ROBOTS_A_FLOOR))]
    maps = [explore(floors[robot // ROBOTS_A_FLOOR], rng) for robot in range(robots)]
    pairs = robots * (robots - 1) // 2
    size = sum(len(zlib.compress(pickle.dumps(one), 1)) for one in maps) / robots

    start = time.perf_counter()
    here = ogm.merge(maps, threads=2)
    one_process = time.perf_counter() - start
    with (
        LocalCluster(
            n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=None
        ) as cluster,
        Client(cluster) as client,
    ):
        start = time.perf_counter()
        there = fleet.merge_maps(client, maps, threads=2)
        two_workers = time.perf_counter() - start
    same = all(
        one.members == other.members and one.poses == other.poses
        for one, other in zip(here.components, there.components)
    )
    print("| robots | pairs | bytes a map | one process, 2 threads, s | 2 workers, s | beside | same |")
    print("| --: | --: | --: | --: | --: | --: | --- |")
    print(
        f"| {robots} | {pairs} | {size:.0f} | {one_process:.1f} | {two_workers:.1f} "
        f"| {two_workers / one_process:.2f} | {'yes' if same else 'no'} |"
    )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 100)
