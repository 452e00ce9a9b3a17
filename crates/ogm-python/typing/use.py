"""What a typed program may write; read by type checkers, never run."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import ogm_maps as ogm


def align(folder: Path) -> tuple[float, float, float]:
    a, b = ogm.load(folder / "a.yaml"), ogm.load("b.yaml")
    r = ogm.align(a, b, prior=(1.0, 2.0, 0.5), prior_sigma=(1.0, 0.1), progress=print)
    if r.transform is None:
        raise SystemExit(r.reason)
    corner: NDArray[np.float64] = r.transform @ np.zeros((4, 2))
    back: ogm.Transform = r.transform.inverse() @ r.transform
    print(corner.shape, back, r.covariance, [h.score for h in r.hypotheses])
    x, y, theta = r.transform
    return x, y, theta


def merge(maps: list[ogm.Map]) -> NDArray[np.int8]:
    t = ogm.merge(maps, fusion="first", method="match")
    if t.map is None or t.conflicts is None:
        raise SystemExit(t.reason)
    print(t.conflicts.sum(), [component.members for component in t.components])
    t.map.save(Path("out.yaml"), overwrite=True)
    known = ogm.fuse(maps, [(0, 0, 0), np.eye(3)])
    return known.map.array


def steps(m: ogm.Map, start: ogm.Transform) -> None:
    tags: list[ogm.Tag] = ogm.localise_tags(np.zeros((0, 4)))
    longest = max(wall.length for wall in ogm.wall_segments(m))
    print(tags, longest, ogm.icp(m, m, start).rmse, ogm.random_walk(m, m, start).psi)


def mistakes(m: ogm.Map) -> None:
    ogm.align(m, "b.yaml")  # type: ignore[arg-type]
    ogm.align(m, m, method="best")  # type: ignore[arg-type]
    m.resolution = 1.0  # type: ignore[misc]
