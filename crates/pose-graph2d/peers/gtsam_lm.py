"""GTSAM's Levenberg-Marquardt beside ours on the same g2o files, in turns, in one run.

    gtsam_lm.py OPTIMA FILE...

OPTIMA is the example of that name, built. Prints a table of Markdown: chi2 as the sum of squared
Mahalanobis distances, and processor seconds from the graph in memory to the poses, the least of
some rounds. GTSAM starts from the poses of the file, and once more from those of LAGO, whose time
counts; ours finds a start by itself, and its time counts. Fails where we take longer than GTSAM from
the file, or end at a higher cost.
"""

import math
import subprocess
import sys
import time
from pathlib import Path

import gtsam

ROUNDS = 3
# A cost that is higher by this share is another answer.
SAME_COST = 1e-6


def ours(optima, file):
    line = subprocess.run([optima, "time", file], check=True, capture_output=True, text=True)
    _, cost, seconds = line.stdout.split()
    return float(cost), float(seconds)


def theirs(file, by_lago):
    """chi2 and seconds; not a number where GTSAM gives up."""
    graph, start = gtsam.readG2o(file, False)
    first = min(start.keys())
    # LAGO puts the first pose at the origin.
    at = gtsam.Pose2() if by_lago else start.atPose2(first)
    held = graph.clone()
    held.add(gtsam.PriorFactorPose2(first, at, gtsam.noiseModel.Isotropic.Sigma(3, 1e-4)))
    began = time.process_time()
    try:
        if by_lago:
            start = gtsam.lago.initialize(held)
        found = gtsam.LevenbergMarquardtOptimizer(held, start).optimize()
    except RuntimeError as error:
        print(f"{file}, by LAGO {by_lago}: {error}", file=sys.stderr)
        return math.nan, math.nan
    return 2 * graph.error(found), time.process_time() - began


def least(runs):
    return runs[0][0], min(seconds for _, seconds in runs)


def main(optima, *files):
    print("| graph | chi² | GTSAM from the file | from LAGO | CPU, s | GTSAM from the file "
          "| from LAGO | ours over GTSAM | over GTSAM with LAGO |")
    print("| --- " + "| --: " * 8 + "|")
    lost = []
    for file in files:
        runs = [[], [], []]
        for _ in range(ROUNDS):
            runs[0].append(ours(optima, file))
            runs[1].append(theirs(file, by_lago=False))
            runs[2].append(theirs(file, by_lago=True))
        (cost, seconds), (cost_file, by_file), (cost_lago, by_lago) = map(least, runs)
        print(f"| {Path(file).stem} | {cost:.4f} | {cost_file:.4f} | {cost_lago:.4f} "
              f"| {seconds:.3f} | {by_file:.3f} | {by_lago:.3f} "
              f"| {seconds / by_file:.2f} | {seconds / by_lago:.2f} |", flush=True)
        # Comparisons with what is not a number are false.
        is_higher = any(cost > other * (1 + SAME_COST) for other in (cost_file, cost_lago))
        if is_higher or seconds > by_file:
            lost.append(Path(file).stem)
    if lost:
        print(f"lost: {', '.join(lost)}", file=sys.stderr)
    return len(lost) > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
