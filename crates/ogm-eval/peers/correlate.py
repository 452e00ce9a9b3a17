"""Exhaustive search: every rotation by one degree, every translation by FFT, the best refined."""

import math

import cv2
import numpy as np
from scipy import fft, optimize

import maps

COARSE_M = 0.2
STEP_DEG = 1.0
KEPT = 8
# What a wall on free space costs against a wall on a wall.
CONFLICT = 0.3
# Accepted: agreement of the walls, share of walls on walls, score of the second over the best.
LEAST_AGREEMENT = 0.65
LEAST_OVERLAP = 0.08
MOST_SECOND = 0.8
MOST_WALLS = 8000


def coarsened(grid, resolution):
    """Walls and free space on coarser cells: a wall anywhere is a wall, free is free for the most
    part."""
    shrink = resolution / grid.resolution
    rows, columns = (math.ceil(side / shrink) for side in grid.shape)
    counts = []
    for kind in (maps.OCCUPIED, maps.FREE):
        v, u = np.nonzero(grid.cells == kind)
        into = (v / shrink).astype(int) * columns + (u / shrink).astype(int)
        counts.append(np.bincount(into, minlength=rows * columns).reshape(rows, columns))
    walls = (counts[0] > 0).astype(np.float32)
    free = ((counts[1] > 0.5 * shrink * shrink) & (counts[0] == 0)).astype(np.float32)
    return walls, free


def candidates(target, source, resolution):
    """Score, turn (degrees) and coarse pixel transform of each rotation's best translation."""
    walls, free = coarsened(target, resolution)
    source_walls, source_free = coarsened(source, resolution)
    rows, columns = source_walls.shape
    side = math.ceil(math.hypot(rows, columns)) + 2
    shape = tuple(fft.next_fast_len(length + side, real=True) for length in walls.shape)
    smooth = np.minimum(1.0, 2.5 * cv2.GaussianBlur(walls, (0, 0), 1.0))
    of_field = fft.rfft2(smooth - CONFLICT * free, shape)
    of_walls = fft.rfft2(walls, shape)
    middle = np.array([[(columns - 1) / 2], [(rows - 1) / 2]])
    found = []
    for degrees in np.arange(0.0, 360.0, STEP_DEG):
        turn = maps.motion(0.0, 0.0, math.radians(degrees))
        turn[:2, 2:] = (side - 1) / 2 - turn[:2, :2] @ middle
        turned = [
            cv2.warpAffine(image, turn[:2], (side, side), flags=cv2.INTER_NEAREST)
            for image in (source_walls, source_free)
        ]
        of_turned = [np.conj(fft.rfft2(image, shape)) for image in turned]
        score = fft.irfft2(of_field * of_turned[0] - CONFLICT * of_walls * of_turned[1], shape)
        v, u = np.unravel_index(int(score.argmax()), score.shape)
        best = float(score[v, u])
        # Shifts beyond the target are negative ones, wrapped around.
        shift = [
            at - length if at > limit else at
            for at, length, limit in zip((u, v), shape[::-1], walls.shape[::-1])
        ]
        found.append((best, degrees, maps.motion(*shift, 0.0) @ turn))
    return sorted(found, key=lambda candidate: -candidate[0]), np.vstack([middle, [[1.0]]])


def apart(found, middle):
    """The best candidates of different places, at most KEPT."""
    kept = []
    for candidate in found:
        _, degrees, place = candidate

        def is_other(one):
            turn = abs(degrees - one[1])
            distance = np.linalg.norm(((place - one[2]) @ middle)[:2])
            return min(turn, 360.0 - turn) > 2.0 or distance > 5.0

        if all(is_other(one) for one in kept):
            kept.append(candidate)
        if len(kept) == KEPT:
            break
    return kept


class Field:
    """How well points lie on the target's walls, on its own cells."""

    def __init__(self, target):
        off_walls = (target.cells != maps.OCCUPIED).astype(np.uint8)
        distance = cv2.distanceTransform(off_walls, cv2.DIST_L2, 3) * target.resolution
        sigma = max(2.0 * target.resolution, 0.1)
        on_free = (target.cells == maps.FREE) & (distance > 2.0 * sigma)
        self.values = np.exp(-0.5 * (distance / sigma) ** 2).astype(np.float32)
        self.values -= CONFLICT * on_free.astype(np.float32)

    def nearest(self, points):
        """The sum over the nearest cells."""
        u, v = np.rint(points).astype(int)
        rows, columns = self.values.shape
        inside = (u >= 0) & (v >= 0) & (u < columns) & (v < rows)
        return float(self.values[v[inside], u[inside]].sum())

    def smooth(self, points):
        """The sum between the cells, for a search by small steps."""
        u, v = points.astype(np.float32)
        sampled = cv2.remap(
            self.values,
            u[None],
            v[None],
            cv2.INTER_LINEAR,
            borderMode=cv2.BORDER_CONSTANT,
            borderValue=0,
        )
        return float(sampled.sum())


def refined(field, walls, start, reach):
    """The best score near `start`, and its transform: by whole cells first, then between them."""
    middle = walls.mean(axis=1, keepdims=True)
    place = maps.apply(start, middle)
    theta = math.atan2(start[1, 0], start[0, 0])
    arms = walls - middle

    def images(turn, shift):
        return maps.motion(0.0, 0.0, turn)[:2, :2] @ arms + place + np.reshape(shift, (2, 1))

    best = None
    for turn in theta + np.radians(np.arange(-0.75, 0.76, 0.25)):
        turned = images(turn, (0.0, 0.0))
        for dv in range(-reach, reach + 1):
            for du in range(-reach, reach + 1):
                score = field.nearest(turned + [[du], [dv]])
                if best is None or score > best[0]:
                    best = (score, turn, du, dv)
    first = np.array(best[1:], dtype=float)
    simplex = np.vstack([first, first + np.diag([0.003, 0.7, 0.7])])
    result = optimize.minimize(
        lambda x: -field.smooth(images(x[0], x[1:])),
        first,
        method="Nelder-Mead",
        options={"initial_simplex": simplex, "xatol": 1e-4, "fatol": 0.01, "maxiter": 150},
    )
    turn, shift = result.x[0], result.x[1:]
    found = maps.motion(0.0, 0.0, turn)
    found[:2, 2:] = place + np.reshape(shift, (2, 1)) - found[:2, :2] @ middle
    return -result.fun, turn, place.ravel() + shift, found


def agreement(target, source, target_from_source):
    """Walls on walls over walls on anything known; walls on walls over those of the lesser map."""
    hits = conflicts = 0
    totals = []
    tolerance = max(2.0 * target.resolution, 0.15) / target.resolution
    directions = [
        (target, source, target_from_source),
        (source, target, np.linalg.inv(target_from_source)),
    ]
    for under, over, under_from_over in directions:
        off_walls = (under.cells != maps.OCCUPIED).astype(np.uint8)
        distance = cv2.distanceTransform(off_walls, cv2.DIST_L2, 3)
        walls = over.occupied_pixels()
        u, v = np.rint(maps.apply(under_from_over, walls)).astype(int)
        rows, columns = under.shape
        inside = (u >= 0) & (v >= 0) & (u < columns) & (v < rows)
        u, v = u[inside], v[inside]
        hit = distance[v, u] <= tolerance
        hits += int(hit.sum())
        conflicts += int((~hit & (under.cells[v, u] == maps.FREE)).sum())
        totals.append(walls.shape[1])
    return hits / max(1, hits + conflicts), hits / max(1, 2 * min(totals))


def solve(target, source, _arguments):
    resolution = max(target.resolution, source.resolution, COARSE_M)
    found, middle = candidates(target, source, resolution)

    def coarse_from(grid):
        scale = grid.resolution / resolution
        offset = 0.5 * scale - 0.5
        return np.array([[scale, 0, offset], [0, scale, offset], [0, 0, 1]])

    walls = source.occupied_pixels()
    if walls.shape[1] > MOST_WALLS:
        chosen = np.random.default_rng(1).choice(walls.shape[1], MOST_WALLS, replace=False)
        walls = walls[:, chosen]
    # Walls of the source in pixels of the target's size, so that what is sought is rigid.
    enlarged = source.resolution / target.resolution
    offset = 0.5 * enlarged - 0.5
    sized = np.array([[enlarged, 0, offset], [0, enlarged, offset], [0, 0, 1]])
    walls = maps.apply(sized, walls)
    field = Field(target)
    reach = math.ceil(resolution / target.resolution) + 1
    results = []
    for _, _, place in apart(found, middle):
        start = np.linalg.inv(coarse_from(target)) @ place @ coarse_from(source)
        start = start @ np.linalg.inv(sized)
        results.append(refined(field, walls, start, reach))
    results.sort(key=lambda result: -result[0])
    best, turn, place, transform = results[0]

    def is_elsewhere(result):
        difference = abs((result[1] - turn + math.pi) % (2.0 * math.pi) - math.pi)
        distance = np.linalg.norm(result[2] - place) * target.resolution
        return difference > 0.05 or distance > 1.0

    rivals = [result[0] for result in results[1:] if is_elsewhere(result)]
    second = max(rivals, default=0.0) / max(best, 1e-9)
    transform = transform @ sized
    share, overlap = agreement(target, source, transform)
    note = f"agreement {share:.3f}, overlap {overlap:.3f}, second {second:.3f}"
    accepted = share >= LEAST_AGREEMENT and overlap >= LEAST_OVERLAP and second <= MOST_SECOND
    return (transform if accepted else None), note


if __name__ == "__main__":
    maps.run("correlate", [], solve)
