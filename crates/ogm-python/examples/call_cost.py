"""What importing, converting and calling cost; for a machine that does nothing else.

    python call_cost.py [--splice DOCUMENT]

Prints a table of Markdown, and puts it into the document between its marks.
"""

import argparse
import re
import statistics
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from splice import splice

import ogm_maps as ogm

PLAN_A = Path(__file__).parents[3] / "fixtures" / "plan-a"
ROUNDS = 2000
CALLS_A_ROUND = 5


def import_ms(module: str) -> float:
    """The median of 21 imports in processes of their own."""
    command = [sys.executable, "-X", "importtime", "-c", f"import {module}"]
    pattern = re.compile(rf"\| +(\d+) \| {module}$", re.MULTILINE)
    times = []
    for _ in range(21):
        run = subprocess.run(command, capture_output=True, check=True, text=True)
        times.append(int(pattern.findall(run.stderr)[0]) / 1000)
    return statistics.median(times)


def best_ms(call: Callable[[], object], count: int) -> float:
    times = []
    for _ in range(count):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return 1000 * min(times)


def resident_mb() -> float:
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096 / 1e6


def growth_mb() -> float:
    """How much the process has grown after 10 000 calls, the first thousands left out."""
    cells = np.full((60, 80), -1, np.int8)
    cells[5:55, 5:75] = 0
    cells[[5, 54], 5:75] = 100
    other = ogm.Map.from_array(cells, 0.1)

    def calls(rounds: int) -> None:
        for _ in range(rounds):
            one = ogm.Map.from_array(cells, 0.1)
            ogm.wall_segments(one)
            ogm.fuse([one, other], [(0, 0, 0), (1, 0, 0)], threads=1)
            ogm.align(one, other, threads=1).to_dict()
            assert one.array.shape == (60, 80)

    calls(ROUNDS // 4)
    before = resident_mb()
    calls(ROUNDS)
    return resident_mb() - before


def two_threads() -> float:
    """How many times as much two Python threads get done as one; searches of one thread each."""
    target, source = (ogm.load(PLAN_A / f"{name}.yaml") for name in ("target", "source"))

    def walk() -> None:
        ogm.random_walk(target, source, (0, 0, 0), samples=400, walks=1, threads=1)

    def both() -> None:
        threads = [threading.Thread(target=walk) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()

    one, two = [], []
    for _ in range(3):
        one.append(best_ms(walk, 1))
        two.append(best_ms(both, 1))
    return 2 * min(one) / min(two)


def main() -> str:
    big = np.random.default_rng(0).integers(-1, 101, (4000, 4000)).astype(np.int8)
    maps = iter([ogm.Map.from_array(big, 0.05) for _ in range(5)])
    rows = [
        ("`import ogm_maps`, median", f"{import_ms('ogm_maps'):.1f} ms"),
        ("`import numpy`, at the first call that needs it, median", f"{import_ms('numpy'):.0f} ms"),
        ("`Map.from_array`, 4000 × 4000 `int8`", f"{best_ms(lambda: ogm.Map.from_array(big, 0.05), 7):.1f} ms"),
        ("the same, transposed", f"{best_ms(lambda: ogm.Map.from_array(big.T, 0.05), 7):.1f} ms"),
        ("`Map.array`, 4000 × 4000", f"{best_ms(lambda: next(maps).array, 5):.1f} ms"),
        ("two Python threads beside one, a search of one thread each", f"{two_threads():.2f} ×"),
        (f"memory after {ROUNDS * CALLS_A_ROUND} calls", f"{growth_mb():+.2f} MB"),
    ]
    return "\n".join(["| what | cost |", "| --- | --: |", *(f"| {what} | {cost} |" for what, cost in rows)])


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--splice", type=Path)
    args = parser.parse_args()
    text = main()
    print(text)
    if args.splice:
        splice(args.splice, "calls", text, "python crates/ogm-python/examples/call_cost.py")
