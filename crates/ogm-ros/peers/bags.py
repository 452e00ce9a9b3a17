"""Bags of rosbags merge as files do; a bag of ours reads back the same in three readers.

bags.py NODE OGM TEAM-FOLDER OUT-FOLDER
"""

import json
import math
import pathlib
import subprocess
import sys

from rosbags.rosbag2 import StoragePlugin, Writer

import readers
from readers import STORE, TYPE


def as_files(message, path):
    """The map in map_server's mode raw, in which every value is kept."""
    grid = STORE.deserialize_cdr(message, TYPE)
    info, origin = grid.info, grid.info.origin
    rows = grid.data.astype("uint8").reshape(info.height, info.width)[::-1]
    path.with_suffix(".pgm").write_bytes(b"P5 %d %d 255\n" % (info.width, info.height) + rows.tobytes())
    yaw = 0.0
    assert origin.orientation.z == 0.0
    path.write_text(
        f"image: {path.stem}.pgm\nmode: raw\nresolution: 0.05\nnegate: 0\n"
        f"origin: [{origin.position.x!r}, {origin.position.y!r}, {yaw}]\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )


def merged(ogm, maps, out):
    command = [ogm, "align", *map(str, maps), "--json", "--quiet"]
    answer = subprocess.run(command, capture_output=True, text=True)
    assert answer.returncode in (0, 3), answer.stderr
    report = json.loads(answer.stdout)
    subprocess.run([ogm, "merge", *map(str, maps), "-o", str(out), "--quiet", "--force"], check=True)
    return report["verdict"], report["target_from_source"], report["probability"]


def main():
    node, ogm, team, out = sys.argv[1], sys.argv[2], *map(pathlib.Path, sys.argv[3:5])
    out.mkdir(parents=True)
    frames = sorted(path.name for path in (team / "robot1").glob("*.cdr"))
    robots = ("robot1", "robot2")
    bags = {}
    for name, plugin in (("sqlite", StoragePlugin.SQLITE3), ("mcap", StoragePlugin.MCAP)):
        bags[name] = out / name
        with Writer(bags[name], version=8, storage_plugin=plugin) as writer:
            topics = {it: writer.add_connection(f"/{it}/map", TYPE, typestore=STORE) for it in robots}
            for second, frame in enumerate(frames):
                for robot in robots:
                    message = (team / robot / frame).read_bytes()
                    writer.write(topics[robot], int((1000 + second) * 1e9), message)
    files = []
    for robot in robots:
        files.append(out / f"{robot}.yaml")
        as_files((team / robot / frames[-1]).read_bytes(), files[-1])
    by_files = merged(ogm, files, out / "by_files.yaml")
    assert by_files[0] == "merged", by_files
    for name, bag in bags.items():
        inner = next(iter(sorted([*bag.glob("*.mcap"), *bag.glob("*.db3")])))
        for source in (bag, inner):
            by_bag = merged(ogm, [f"{source}:/{robot}/map" for robot in robots], out / "by_bag.yaml")
            assert by_bag == by_files, (name, by_bag, by_files)
            pictures = [(out / f"{it}.pgm").read_bytes() for it in ("by_bag", "by_files")]
            assert pictures[0] == pictures[1], name
        first, last = (
            subprocess.run([ogm, "info", f"{bag}:/robot1/map{at}"], capture_output=True, text=True, check=True).stdout
            for at in ("@0", "")
        )
        assert first.split(":/robot1/map@0")[-1] != last.split(":/robot1/map")[-1]
    print("bags merge as files:", by_files)

    written = out / "merged.mcap"
    subprocess.run([ogm, "merge", *map(str, files), "-o", written, "--quiet"], check=True)
    (grid,), placed = (seen := readers.read_back(written)).maps, seen.placed
    x, y, theta = (by_files[1][name] for name in ("x_m", "y_m", "theta_deg"))
    at, turn = placed["robot2/map"].translation, placed["robot2/map"].rotation
    assert (at.x, at.y) == (x, y) and abs(2 * math.degrees(math.atan2(turn.z, turn.w)) - theta) < 1e-9
    infos = [
        json.loads(subprocess.run([ogm, "info", map, "--json"], capture_output=True, check=True).stdout)
        for map in (out / "by_files.yaml", f"{written}:/map")
    ]
    for name in ("width", "height", "resolution_m", "origin"):
        assert infos[0][name] == infos[1][name], (name, infos)
    # The files say of a cell no more than that it is occupied, free or unknown.
    assert infos[0]["cells"]["occupied"] == infos[1]["cells"]["occupied"] > 0
    assert grid.header.frame_id == "world" and grid.info.width == infos[0]["width"]
    print("ogm merge -o merged.mcap:", grid.info.width, "x", grid.info.height, "cells, read by all three")

    wrong = subprocess.run([ogm, "info", f"{bags['mcap']}:/robot9/map"], capture_output=True, text=True)
    assert wrong.returncode == 1 and "/robot1/map, /robot2/map" in wrong.stderr, wrong.stderr

    replayed = out / "replayed"
    subprocess.run([node, "replay", bags["sqlite"], "-o", replayed], check=True)
    seen = readers.read_back(replayed)
    assert set(seen.placed) == {"robot1/map", "robot2/map"} and seen.messages > len(frames)
    assert seen.status[0].name == "ogm: team"
    print("read back by mcap, rosbags, mcap_ros2:", seen.messages, "messages")


if __name__ == "__main__":
    main()
