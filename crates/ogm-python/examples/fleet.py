"""Merges the maps of a fleet on the processes of this machine.

Draws floors and what robots saw of them, a part each, from starts and headings that nobody knows;
prints the groups that hang together.

    python fleet.py [ROBOTS]
"""

import sys

import numpy as np
from distributed import Client, LocalCluster

import ogm_maps as ogm
from ogm_maps import fleet

RESOLUTION = 0.1
ROBOTS_A_FLOOR = 5


def draw_floor(rng: np.random.Generator) -> np.ndarray:
    """Rooms of all sizes along two corridors, 40 by 20 m, furnished."""
    cells = np.zeros((200, 400), dtype=np.int8)
    cells[[0, -1], :] = cells[:, [0, -1]] = 100
    for low, high in [(0, 60), (75, 125), (140, 199)]:
        cells[[low, high], :] = 100
        across = 0
        while (across := across + int(rng.integers(25, 60))) < 380:
            cells[low : high + 1, across] = 100
            door = across - int(rng.integers(12, 20))
            cells[low if low else high, door : door + 9] = 0
    for _ in range(60):
        row, column = rng.integers(5, 185), rng.integers(5, 385)
        height, width = rng.integers(4, 12, 2)
        cells[row : row + height, column : column + width] = 100
    return cells


def explore(floor: np.ndarray, rng: np.random.Generator) -> ogm.Map:
    """Half of a floor, turned by any quarter, with noise, in a frame of its own."""
    left = int(rng.integers(0, 200))
    seen = floor[:, left : left + 200].copy()
    wrong = rng.random(seen.shape) < 0.002
    seen[wrong] = 100 - seen[wrong]
    seen = np.rot90(seen, int(rng.integers(4)))
    framed = np.full(np.add(seen.shape, 20), -1, dtype=np.int8)
    framed[10:-10, 10:-10] = seen
    origin = (*rng.uniform(-30, 30, 2), rng.uniform(-3, 3))
    return ogm.Map.from_array(framed, RESOLUTION, origin)


def main(robots: int) -> None:
    rng = np.random.default_rng(1)
    floors = [draw_floor(rng) for _ in range(-(-robots // ROBOTS_A_FLOOR))]
    maps = [explore(floors[robot // ROBOTS_A_FLOOR], rng) for robot in range(robots)]
    with (
        LocalCluster(
            n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=None
        ) as cluster,
        Client(cluster) as client,
    ):
        merged = fleet.merge_maps(client, maps)
    for component in merged.components:
        print(len(component), "maps:", component.members)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 100)
