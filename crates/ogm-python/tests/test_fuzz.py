"""Calls that nobody would make: what comes back is a value or an exception."""

import math
import random
from types import SimpleNamespace

import numpy as np

import ogm_maps as ogm

CALLS = 5000


def arrays(draw):
    """Arrays of every kind of number, shape, order and stride."""
    height, width = draw.choice([(0, 3), (1, 1), (2, 5), (7, 3), (40, 30), (1, 400)])
    dtype = draw.choice([np.int8, np.uint8, np.int16, ">i4", np.int64, np.float64, bool, object])
    cells = np.random.default_rng(draw.getrandbits(32)).integers(-1, 102, (height, width))
    cells = np.where(cells > 100, draw.choice([100, 0, -1, 101, -2]), cells).astype(dtype)
    arrange = draw.choice(
        [
            lambda a: a,
            lambda a: a.T,
            np.asfortranarray,
            lambda a: a[::-1],
            lambda a: a[::2, ::-3],
            lambda a: a.ravel(),
            lambda a: a[None],
            lambda a: np.broadcast_to(a[:1], (9, a.shape[1])) if len(a) else a,
            lambda a: np.lib.stride_tricks.as_strided(a, (6, 4), (0, 0)) if a.size else a,
            lambda a: np.ma.masked_less(a, 0) if a.dtype.kind in "if" else a,
            lambda a: a.tolist(),
            lambda a: a.tobytes(),
            lambda a: memoryview(np.ascontiguousarray(a)) if a.dtype != object else a,
        ]
    )
    return arrange(cells)


ODD = [
    None,
    True,
    -1,
    0,
    1,
    2**31,
    2**64,
    -(2**70),
    0.05,
    -0.0,
    1e-320,
    1e308,
    math.nan,
    math.inf,
    "",
    "auto",
    "match",
    "\0",
    "x" * 10_000,
    "\ud800",
    b"\xff",
    (),
    (0, 0, 0),
    (1e7, -1e7, 1e9),
    (math.nan, 0, 0),
    (1e308, 1e308, 1e308),
    (0, 0),
    [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
    np.eye(3),
    np.full((3, 3), math.inf),
    np.zeros((2, 2), complex),
    {},
    {"x": 1},
    object(),
    len,
    iter([1, 2, 3]),
    SimpleNamespace(info=None, data=[1]),
]


class Enough(Exception):
    """The call was going on."""


def given_up(share):
    raise Enough


def value(draw, maps):
    """Any argument."""
    return draw.choice(
        [
            lambda: draw.choice(ODD),
            lambda: draw.choice(maps),
            lambda: arrays(draw),
            lambda: [draw.choice(maps) for _ in range(draw.randrange(4))],
            lambda: [draw.choice(ODD) for _ in range(draw.randrange(4))],
            lambda: ogm.Transform(draw.uniform(-9, 9), draw.uniform(-9, 9), draw.uniform(-9, 9)),
            lambda: np.random.default_rng(draw.getrandbits(32)).normal(size=(5, 4)),
        ]
    )()


def likely(draw, maps, name):
    """An argument that often has the type which the call wants."""
    if draw.random() < 0.3:
        return value(draw, maps)
    pose = lambda: (draw.uniform(-3, 3), draw.uniform(-3, 3), draw.uniform(-4, 4))
    kinds = {
        "map": lambda: draw.choice(maps),
        "maps": lambda: [draw.choice(maps) for _ in range(draw.choice([1, 2, 2, 3]))],
        "poses": lambda: [pose() for _ in range(draw.choice([1, 2, 2, 3]))],
        "pose": pose,
        "array": lambda: arrays(draw),
        "number": lambda: draw.choice([0, 1, 3, 0.05, 0.5, 1e-3, 1e3, 1e-9, 1e20, math.nan]),
        "count": lambda: draw.choice([0, 1, 2, 5, 10**6, 2**62]),
        "word": lambda: draw.choice(["auto", "match", "rfid3", "carpin", "radon", "first", "no"]),
        "pair": lambda: (draw.choice([0.0, 0.1, -1.0, 1e9]), draw.choice([0.0, 0.1, math.nan])),
        "known": lambda: {draw.choice([0, 1, 2, 9]): pose()},
        "tags": lambda: draw.choice([(None, None), ([], []), ["a", "b"], [None]]),
        "log": lambda: np.abs(np.random.default_rng(draw.getrandbits(9)).integers(0, 3, (9, 4))),
        "flag": lambda: draw.random() < 0.5,
    }
    return kinds[name]()


SEARCH = {
    "method": "word",
    "tags": "tags",
    "prior": "pose",
    "prior_sigma": "pair",
    "accept": "number",
    "repeats": "flag",
    "seed": "count",
}
FUSION = {"fusion": "word", "resolution": "number"}
FUNCTIONS = [
    (ogm.Map.from_array, ["array", "number"], {"origin": "pose"}),
    (ogm.align, ["map", "map"], SEARCH),
    (ogm.merge, ["maps"], {**SEARCH, **FUSION, "poses": "known", "poses_sigma": "pair"}),
    (ogm.fuse, ["maps", "poses"], FUSION),
    (ogm.overlay, ["map", "map", "pose"], {}),
    (ogm.icp, ["map", "map", "pose"], {"metric": "word"}),
    (ogm.random_walk, ["map", "map", "pose"], {"samples": "count", "walks": "count", "seed": "count"}),
    (ogm.wall_segments, ["map"], {"seed": "count"}),
    (ogm.localise_tags, ["log"], {}),
    (ogm.Transform, ["number", "number", "number"], {}),
    (ogm.Transform.from_matrix, ["array"], {}),
    (ogm.Transform(1, 2, 3).__matmul__, ["array"], {}),
]
HEARD = (ogm.align, ogm.merge, ogm.fuse, ogm.random_walk, ogm.localise_tags)


def message(draw, maps):
    field = lambda kind: likely(draw, maps, kind)
    orientation = SimpleNamespace(x=0.0, y=0.0, z=field("number"), w=field("number"))
    position = SimpleNamespace(x=field("number"), y=field("number"), z=0.0)
    origin = SimpleNamespace(position=position, orientation=orientation)
    width, height = field("count"), field("count")
    info = SimpleNamespace(
        resolution=field("number"), width=width, height=height, origin=origin
    )
    return SimpleNamespace(info=info, data=field("array"))


def test_odd_calls_end_in_a_value_or_an_exception(target, source):
    draw = random.Random(20)
    small = np.full((20, 30), -1, np.int8)
    small[2:18, 2:28] = 0
    small[[2, 17], 2:28] = 100
    maps = [
        ogm.Map.from_array(small, 0.2),
        ogm.Map.from_array(small.T, 0.3, (1e7, -1e7, 2.0)),
        ogm.Map.from_array(small, 1e-4),
        ogm.Map.from_array(small, 1e3),
        ogm.Map.from_array(np.full((1, 1), 100), 0.05),
        ogm.Map.from_array(np.full((1, 500), -1), 0.05),
    ]
    ended = {"value": 0, "exception": 0}
    for _ in range(CALLS):
        call, wanted, options = draw.choice(FUNCTIONS)
        arguments = [likely(draw, maps, kind) for kind in wanted]
        if draw.random() < 0.05:
            arguments = arguments[:-1]
        chosen = {name: likely(draw, maps, kind) for name, kind in options.items() if draw.random() < 0.3}
        if call in HEARD:
            chosen["progress"] = given_up
        if draw.random() < 0.1:
            call, arguments, chosen = ogm.Map.from_occupancy_grid, [message(draw, maps)], {}
        try:
            call(*arguments, **chosen)
            ended["value"] += 1
        # A panic is none of these.
        except Exception as error:
            assert str(error) or isinstance(error, Enough), (call, arguments, chosen)
            ended["exception"] += 1
    assert min(ended.values()) > CALLS / 20, ended
