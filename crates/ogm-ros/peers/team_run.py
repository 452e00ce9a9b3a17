"""A simulated team that drives, merged live: poses against the truth, latency, memory.

team_run.py NODE TEAM-FOLDER OUT-FOLDER [--hold SECONDS] [--enough METRES] [--record]
"""

import argparse
import json
import math
import pathlib
import time

import readers
import scenario

# Wall in common with the world, metres, by which a robot ought to have its place soon.
WALLS_M = (20, 40, 60)
SOON_S = 20
WAITED = "right after sharing so many m of wall, s"
# What counts as the same memory.
FLAT = 1.1


def near_enough(shared, robots, reference, wall_m):
    """The first second by which a robot hangs by pairs that share `wall_m` together with the reference."""
    first = {}
    for second in range(len(next(iter(shared.values())))):
        joined = {reference}
        edges = [pair.split() for pair, lengths in shared.items() if lengths[second] >= wall_m]
        while grown := [b for ends in edges for a, b in (ends, ends[::-1]) if a in joined and b not in joined]:
            joined.update(grown)
        for robot in joined & set(robots):
            first.setdefault(robot, second)
    return first


def main():
    scenario.alone()
    parser = argparse.ArgumentParser()
    parser.add_argument("node")
    parser.add_argument("team", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--hold", type=int, default=0, help="how long the maps change after the drive")
    parser.add_argument("--enough", type=int, choices=WALLS_M, help="wall by which a robot must be placed soon")
    parser.add_argument("--record", action="store_true", help="records too, and reads that back")
    args = parser.parse_args()
    node, team, out, hold = args.node, args.team, args.out, args.hold
    truth = json.loads((team / "truth.json").read_text())
    seconds = len(list((team / "robot1").glob("*.cdr")))
    run = scenario.Scenario(node, out)
    run.live("--state", out / "state.json")
    if args.record:
        run.start(node, "record", "-o", out / "recorded", log="record.log")
    run.python("watch.py", seconds + hold + 6, out / "watch.jsonl")
    time.sleep(2)
    began = time.time()
    robots = run.python("team.py", team, "--hold", hold)
    robots.wait(seconds + hold + 60)
    time.sleep(3)
    run.end()
    reference, right_at, wrong, last = scenario.judged(run.seen(), truth)
    shared = json.loads((team / "shared.json").read_text())
    waited = {}
    for wall_m in WALLS_M:
        near = near_enough(shared, truth, reference, wall_m)
        after = {it: right_at.get(it, math.inf) - began - near[it] for it in near if it != reference}
        waited[wall_m] = {it: round(max(late, 0.0), 1) for it, late in after.items()}
    maps = [it for it in run.seen() if it["kind"] == "map"]
    latency = [it["latency"] for it in maps]
    memory = [rss for _, rss, _ in run.usage]
    third = len(memory) // 3
    held = [rss for at, rss, _ in run.usage if began + seconds + 5 < at < began + seconds + hold]
    half = len(held) // 2
    cpu = (run.usage[-1][2] - run.usage[0][2]) / (run.usage[-1][0] - run.usage[0][0])
    summary = {
        "robots": len(truth),
        "right after s": {robot: round(at - began, 1) for robot, at in right_at.items()},
        WAITED: waited,
        "errors m, deg": {
            robot: [round(m, 4), round(math.degrees(rad), 3)] for robot, (m, rad) in last.items()
        },
        "wrong": wrong,
        "maps": len(maps),
        "size": [maps[-1]["width"], maps[-1]["height"]],
        "latency median, max s": [round(scenario.median(latency), 3), round(max(latency), 3)],
        "memory MB, thirds": [round(max(memory[at : at + third])) for at in (0, third, 2 * third)],
        "processors": round(cpu, 2),
    }
    if hold:
        summary["memory MB, held: halves"] = [round(max(it)) for it in (held[:half], held[half:])]
    print(json.dumps(summary))
    (out / "summary.json").write_text(json.dumps(summary))
    assert not wrong, "a robot was placed wrongly"
    assert set(right_at) == set(truth), "a robot was not placed"
    assert all(m <= scenario.FAR_M and rad <= scenario.FAR_RAD for m, rad in last.values())
    assert all(late <= SOON_S for late in waited.get(args.enough, {}).values()), "a robot waited too long"
    assert scenario.median(latency) <= 1.0
    assert not hold or max(held[half:]) <= FLAT * max(held[:half]), "the memory grows"
    if args.record:
        recorded = readers.read_back(out / "recorded")
        print("recorded, and read back by mcap, rosbags, mcap_ros2:", recorded.messages, "messages")
        assert set(recorded.placed) == {f"{it}/map" for it in truth}
        assert recorded.status[0].name == "ogm: team" and len(recorded.maps) >= 0.9 * len(maps)
        cells = recorded.maps[-1].data
        assert [(cells >= 65).sum(), (cells >= 0).sum()] == [maps[-1]["occupied"], maps[-1]["known"]]


if __name__ == "__main__":
    main()
