"""Occupancy grid maps in memory, pixels and metres, and the answer that a peer gives."""

import argparse
import json
import math
import re
import time

import cv2
import numpy as np

FREE, OCCUPIED, UNKNOWN = 0, 1, 2


class GridMap:
    """Cells of a map; row 0 is the lowest, so that rows grow with the y of its frame."""

    def __init__(self, image_path, yaml_path):
        header = read_header(yaml_path)
        pixels = cv2.imread(image_path, cv2.IMREAD_GRAYSCALE)
        if pixels is None:
            raise SystemExit(f"{image_path}: not an image")
        pixels = np.flipud(pixels).astype(np.float64)
        shade = pixels if float(header.get("negate", 0)) else 255.0 - pixels
        probability = shade / 255.0
        self.cells = np.full(pixels.shape, UNKNOWN, np.uint8)
        self.cells[probability > float(header.get("occupied_thresh", 0.65))] = OCCUPIED
        self.cells[probability < float(header.get("free_thresh", 0.196))] = FREE
        self.resolution = float(header["resolution"])
        self.origin = header["origin"]

    @property
    def shape(self):
        return self.cells.shape

    def mask(self, kind):
        return (self.cells == kind).astype(np.uint8)

    def occupied_pixels(self):
        """The centres of occupied cells, one column each: u to the right, v upwards."""
        rows, columns = np.nonzero(self.cells == OCCUPIED)
        return np.vstack([columns, rows]).astype(np.float64)

    def grey(self):
        """The map as an image in three greys: walls black, unknown grey, free white."""
        return np.array([254, 0, 205], np.uint8)[self.cells]

    def metres_from_pixels(self):
        """Maps pixel centres into the frame of the map, metres."""
        x, y, yaw = self.origin
        half = 0.5 * self.resolution
        in_grid = np.array([[self.resolution, 0, half], [0, self.resolution, half], [0, 0, 1]])
        return motion(x, y, yaw) @ in_grid


def read_header(path):
    """The scalars and the origin of a map_server file: as much YAML as those files use."""
    header = {}
    with open(path, encoding="utf-8") as file:
        text = file.read()
    for line in text.splitlines():
        key, colon, value = line.split("#")[0].partition(":")
        if colon and value.strip() and not line.startswith((" ", "-", "\t")):
            header[key.strip()] = value.strip().strip("'\"")
    numbers = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
    origin = re.search(r"^origin\s*:(.*?)(?=^\w|\Z)", text, re.MULTILINE | re.DOTALL)
    found = [float(number) for number in re.findall(numbers, origin.group(1))]
    header["origin"] = (found + [0.0, 0.0, 0.0])[:3]
    if header.get("negate", "0").lower() in ("true", "false"):
        header["negate"] = int(header["negate"].lower() == "true")
    return header


def motion(x, y, theta):
    """A rigid motion of the plane as a 3 × 3 matrix."""
    cosine, sine = math.cos(theta), math.sin(theta)
    return np.array([[cosine, -sine, x], [sine, cosine, y], [0.0, 0.0, 1.0]])


def apply(matrix, points):
    """The images of points, one column each."""
    return matrix[:2, :2] @ points + matrix[:2, 2:]


def rigid_in_metres(target_from_source_pixels, target, source):
    """x, y (metres) and turn (radians) between the frames of two maps.

    What is left of a scale is dropped such that the middle of the source's known cells stays where
    it was put.
    """
    whole = (
        target.metres_from_pixels()
        @ target_from_source_pixels
        @ np.linalg.inv(source.metres_from_pixels())
    )
    theta = math.atan2(whole[1, 0] - whole[0, 1], whole[0, 0] + whole[1, 1])
    rows, columns = np.nonzero(source.cells != UNKNOWN)
    middle = np.array([[columns.mean()], [rows.mean()]])
    middle = apply(source.metres_from_pixels(), middle)
    shift = apply(whole, middle) - apply(motion(0.0, 0.0, theta), middle)
    return float(shift[0, 0]), float(shift[1, 0]), theta


def run(name, options, solve):
    """Reads the maps of the command line, solves, prints the answer.

    `solve(target, source, arguments)` gives the pixel transform or `None`, and a note.
    """
    parser = argparse.ArgumentParser(description=name)
    for argument in ("a_image", "a_yaml", "b_image", "b_yaml"):
        parser.add_argument(argument)
    for flag, settings in options:
        parser.add_argument(flag, **settings)
    arguments = parser.parse_args()
    cv2.setNumThreads(1)
    cv2.setRNGSeed(1)
    target = GridMap(arguments.a_image, arguments.a_yaml)
    source = GridMap(arguments.b_image, arguments.b_yaml)
    begin = time.process_time()
    pixels, note = solve(target, source, arguments)
    pose = None if pixels is None else rigid_in_metres(pixels, target, source)
    answer = {"peer": name, "ok": pose is not None, "dx": None, "dy": None, "theta_deg": None}
    if pose is not None:
        x, y, theta = pose
        answer |= {"dx": x, "dy": y, "theta_deg": math.degrees(theta)}
    answer |= {"cpu_seconds": time.process_time() - begin, "note": note}
    print(json.dumps(answer))
