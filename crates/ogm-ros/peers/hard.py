"""A team with a liar in it; the node is killed and started again, a robot starts again in another
frame, and somebody subscribes late.

hard.py NODE TEAM-FOLDER OUT-FOLDER
"""

import json
import math
import pathlib
import signal
import subprocess
import sys
import time

import scenario

# What the map frame of the robot that starts again is, in its old one.
MOVED = (2.0, -1.0, 0.7)


def composed(a, b):
    c, s = math.cos(a[2]), math.sin(a[2])
    return a[0] + c * b[0] - s * b[1], a[1] + s * b[0] + c * b[1], a[2] + b[2]


def main():
    scenario.alone()
    node, team, out = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    truth = json.loads((team / "truth.json").read_text())
    moved = {**truth, "robot2": composed(truth["robot2"], MOVED)}
    seconds = len(list((team / "robot1").glob("*.cdr")))
    kill_at, restart_at = seconds // 3, 2 * seconds // 3
    run = scenario.Scenario(node, out)
    state = out / "state.json"
    watch = out / "watch.jsonl"
    first = run.live("--state", state)
    run.python("watch.py", seconds + 40, watch)
    time.sleep(2)
    began = time.time()
    # The first to come holds the world.
    robots = {"robot1": run.python("team.py", team, "--only", "robot1")}
    time.sleep(3)
    robots |= {it: run.python("team.py", team, "--only", it) for it in truth if it not in robots}
    time.sleep(2)
    run.python("liar.py", seconds)
    time.sleep(max(0, began + kill_at - time.time()))
    first.send_signal(signal.SIGKILL)
    killed = time.time()
    time.sleep(1)
    run.live("--state", state)
    time.sleep(max(0, began + restart_at - time.time()))
    robots["robot2"].kill()
    time.sleep(1)
    moved_at = time.time()
    run.python("team.py", team, "--only", "robot2", "--start", restart_at, "--moved", ",".join(map(str, MOVED)))
    robots["robot1"].wait(seconds + 60)
    late = out / "late.jsonl"
    began_late = time.time()
    subscriber = run.python("watch.py", 8, late)
    subscriber.wait(60)
    run.end()

    seen = run.seen()
    transforms = [it for it in seen if it["kind"] == "tf"]
    reference = next(iter(transforms[0]["poses"])).removesuffix("/map")
    wrong = []
    for it in transforms:
        assert it["poses"][f"{reference}/map"] == transforms[0]["poses"][f"{reference}/map"]
        assert "liar/map" not in it["poses"], "noise was placed"
        for robot in truth:
            if f"{robot}/map" not in it["poses"]:
                continue
            truths = [truth, moved] if it["at"] > moved_at else [truth]
            errors = [scenario.error_of(it["poses"], one, reference, robot) for one in truths]
            if not any(m < scenario.WRONG_M and rad < scenario.WRONG_RAD for m, rad in errors):
                wrong.append((robot, round(it["at"] - began, 1), errors))
    last = {it: scenario.error_of(transforms[-1]["poses"], moved, reference, it) for it in truth}
    after_kill = next(it["at"] for it in seen if it["kind"] == "map" and it["at"] > killed)
    liar = [it["robots"]["ogm: liar"] for it in seen if it["kind"] == "status" and "ogm: liar" in it["robots"]]
    said = " ".join(message for _, message in liar)
    came = {it["kind"]: round(it["at"] - began_late, 1) for it in reversed(run.seen("late.jsonl"))}
    print(
        json.dumps(
            {
                "wrong": wrong,
                "errors m, deg": {it: [round(m, 4), round(math.degrees(rad), 3)] for it, (m, rad) in last.items()},
                "map after kill s": round(after_kill - killed, 1),
                "late subscriber s": came,
            }
        )
    )
    assert not wrong
    assert all(m <= scenario.FAR_M and rad <= scenario.FAR_RAD for m, rad in last.values())
    # A header of 400 million cells and a message without a cell too few are told apart by words.
    for words in ("at most", "a resolution of NaN", "cells, but has"):
        assert words in said, f"{words!r} is not in what was said of the liar: {set(m for _, m in liar)}"
    assert {"map", "tf", "status", "conflicts"} <= set(came)


if __name__ == "__main__":
    main()
