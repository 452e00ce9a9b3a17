"""A simulated team that drives, merged live: poses against the truth, latency, memory.

team_run.py NODE TEAM-FOLDER OUT-FOLDER
"""

import json
import math
import pathlib
import sys
import time

import scenario


def main():
    scenario.alone()
    node, team, out = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
    truth = json.loads((team / "truth.json").read_text())
    seconds = len(list((team / "robot1").glob("*.cdr")))
    run = scenario.Scenario(node, out)
    run.live("--state", pathlib.Path(out) / "state.json")
    run.python("watch.py", seconds + 6, pathlib.Path(out) / "watch.jsonl")
    time.sleep(2)
    began = time.time()
    robots = run.python("team.py", team)
    robots.wait(seconds + 60)
    time.sleep(3)
    run.end()
    placed_at, wrong, last = scenario.judged(run.seen(), truth)
    maps = [it for it in run.seen() if it["kind"] == "map"]
    latency = [it["latency"] for it in maps]
    memory = [rss for _, rss, _ in run.usage]
    third = len(memory) // 3
    cpu = (run.usage[-1][2] - run.usage[0][2]) / (run.usage[-1][0] - run.usage[0][0])
    summary = {
        "placed after s": {robot: round(at - began, 1) for robot, at in placed_at.items()},
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
    print(json.dumps(summary))
    assert not wrong, "a robot was placed wrongly"
    assert set(placed_at) == set(truth), "a robot was not placed"
    assert all(m <= scenario.FAR_M and rad <= scenario.FAR_RAD for m, rad in last.values())
    assert scenario.median(latency) <= 1.0


if __name__ == "__main__":
    main()
