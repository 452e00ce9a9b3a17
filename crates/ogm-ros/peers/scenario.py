"""Processes of one scenario, in a network of their own, and what they leave behind."""

import json
import math
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time

HERE = pathlib.Path(__file__).parent
FAR_M, FAR_RAD = 0.1, math.radians(1)
WRONG_M, WRONG_RAD = 0.5, math.radians(5)


def alone():
    """Moves this process into a network namespace with nothing but a loopback that multicasts."""
    if os.environ.get("OGM_ALONE") != "yes":
        os.environ["OGM_ALONE"] = "yes"
        root = [] if os.geteuid() == 0 else ["--map-root-user"]
        os.execvp("unshare", ["unshare", *root, "--net", sys.executable, *sys.argv])
    for command in ("ip link set lo up multicast on", "ip route add 224.0.0.0/4 dev lo"):
        subprocess.run(command.split(), check=True)


class Scenario:
    def __init__(self, node, folder):
        self.node, self.folder = node, pathlib.Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        self.started = []
        self.usage = []

    def start(self, *command, log=None):
        out = open(self.folder / log, "a") if log else subprocess.DEVNULL
        process = subprocess.Popen(list(map(str, command)), stdout=out, stderr=subprocess.STDOUT)
        self.started.append(process)
        return process

    def python(self, name, *arguments, log=None):
        return self.start(sys.executable, HERE / name, *arguments, log=log or f"{name}.log")

    def live(self, *arguments):
        process = self.start(self.node, "live", *arguments, log="node.log")
        threading.Thread(target=self._watch, args=(process,), daemon=True).start()
        return process

    def _watch(self, process):
        """Memory in MB and processor seconds of the node, each second."""
        tick = os.sysconf("SC_CLK_TCK")
        while process.poll() is None:
            try:
                fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
            except OSError:
                break
            cpu = (int(fields[11]) + int(fields[12])) / tick
            rss = int(fields[21]) * os.sysconf("SC_PAGE_SIZE") / 1e6
            self.usage.append((time.time(), rss, cpu))
            time.sleep(1)

    def end(self):
        for process in reversed(self.started):
            if process.poll() is None:
                process.send_signal(signal.SIGTERM)
        for process in self.started:
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()
                raise AssertionError(f"{process.args} does not end on SIGTERM")

    def seen(self, name="watch.jsonl"):
        return [json.loads(line) for line in (self.folder / name).read_text().splitlines()]


def error_of(poses, truth, reference, robot):
    """How far a robot's pose relative to the reference is from the truth: metres, radians."""

    def relative(a, b):
        dx, dy, c, s = b[0] - a[0], b[1] - a[1], math.cos(a[2]), math.sin(a[2])
        return c * dx + s * dy, c * dy - s * dx, b[2] - a[2]

    said = relative(poses[f"{reference}/map"], poses[f"{robot}/map"])
    true = relative(truth[reference], truth[robot])
    turn = math.remainder(said[2] - true[2], 2 * math.pi)
    return math.hypot(said[0] - true[0], said[1] - true[1]), abs(turn)


def judged(seen, truth):
    """Who holds the world, when each robot first had its right place, poses that were wrong, and the
    last errors; asserts that the frame stands still."""
    maps = [it for it in seen if it["kind"] == "map"]
    transforms = [it for it in seen if it["kind"] == "tf"]
    assert maps and transforms, "nothing was published"
    assert {it["frame"] for it in maps} == {"world"}
    assert {parent for it in transforms for parent in it["parents"]} <= {"world"}
    first = maps[0]
    for it in maps:
        assert it["resolution"] == first["resolution"] and it["origin"][2] == 0.0
        for axis in (0, 1):
            cells = (it["origin"][axis] - first["origin"][axis]) / it["resolution"]
            assert abs(cells - round(cells)) < 1e-3, f"the lattice moved by {cells} cells"
    # Whoever was there first holds the world.
    reference = next(iter(transforms[0]["poses"])).removesuffix("/map")
    start = transforms[0]["poses"][f"{reference}/map"]
    right_at, wrong, last = {}, [], {}
    for it in transforms:
        assert it["poses"][f"{reference}/map"] == start, "the world moved"
        for frame in it["poses"]:
            robot = frame.removesuffix("/map")
            error = error_of(it["poses"], truth, reference, robot)
            if error[0] <= FAR_M and error[1] <= FAR_RAD:
                right_at.setdefault(robot, it["at"])
            last[robot] = error
            if error[0] > WRONG_M or error[1] > WRONG_RAD:
                wrong.append((robot, error))
    return reference, right_at, wrong, last


def median(numbers):
    numbers = sorted(numbers)
    return numbers[len(numbers) // 2] if numbers else math.nan
