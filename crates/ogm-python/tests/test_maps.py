"""Maps from files, arrays and messages, and back."""

import copy
import math
import pickle
from types import SimpleNamespace

import numpy as np
import pytest

import ogm_maps as ogm

# No symmetry, and every value that a cell can have.
CELLS = np.arange(-1, 101, dtype=np.int8).reshape(6, 17)


def message(data, width, height, quaternion=(0.0, 0.0, 0.0, 1.0)):
    axes = dict(zip("xyzw", quaternion))
    origin = SimpleNamespace(
        position=SimpleNamespace(x=-1.0, y=2.0, z=0.0), orientation=SimpleNamespace(**axes)
    )
    info = SimpleNamespace(resolution=0.05, width=width, height=height, origin=origin)
    return SimpleNamespace(info=info, data=data)


def test_an_array_comes_back_as_it_was_given():
    m = ogm.Map.from_array(CELLS, 0.05, (-1.0, 2.0, 0.3))
    assert m.array.dtype == np.int8
    np.testing.assert_array_equal(m.array, CELLS)
    np.testing.assert_array_equal(np.asarray(m), CELLS)
    assert (m.shape, m.height, m.width, m.resolution) == ((6, 17), 6, 17, 0.05)
    assert tuple(m.origin) == pytest.approx((-1.0, 2.0, 0.3), abs=1e-12)


@pytest.mark.parametrize(
    "arranged",
    [
        CELLS.T,
        CELLS[::-1],
        CELLS[:, ::-1],
        CELLS[::2, ::3],
        CELLS.T[::2],
        np.asfortranarray(CELLS),
        np.tile(CELLS, (23, 9)).T,
        np.asfortranarray(np.tile(CELLS, (11, 12))),
        np.broadcast_to(CELLS[0], (4, 17)),
        CELLS.astype(np.int64).T,
        CELLS.astype(">i4"),
        np.abs(CELLS).astype(np.uint8),
        CELLS.tolist(),
    ],
    ids=lambda _: "",
)
def test_the_shape_of_an_array_counts_and_not_its_order_in_memory(arranged):
    m = ogm.Map.from_array(arranged, 0.05)
    np.testing.assert_array_equal(m.array, np.asarray(arranged))


def test_row_0_is_the_lowest():
    cells = np.full((30, 40), -1, np.int8)
    cells[0, 39] = 100
    walls = np.argwhere(ogm.Map.from_array(cells, 0.1).array == 100)
    assert walls.tolist() == [[0, 39]]
    m = ogm.Map.from_array(cells, 0.1)
    # In a frame that is turned by a quarter the lower right corner is the upper right one.
    turned = ogm.fuse([m], [(0.0, 0.0, math.pi / 2)]).map
    (row, column), = np.argwhere(turned.array == 100)
    x, y, _ = turned.origin
    centre = (x + (column + 0.5) * 0.1, y + (row + 0.5) * 0.1)
    assert centre == pytest.approx((-0.05, 3.95), abs=1e-9)


def test_a_later_change_of_the_array_does_not_reach_the_map():
    cells = CELLS.copy()
    m = ogm.Map.from_array(cells, 0.05)
    cells[:] = 0
    np.testing.assert_array_equal(m.array, CELLS)


def test_what_a_map_shows_of_itself_cannot_be_written_to():
    m = ogm.Map.from_array(CELLS, 0.05)
    with pytest.raises(ValueError, match="read-only"):
        m.array[0, 0] = 0
    assert m.array is m.array


@pytest.mark.parametrize(
    "given, resolution, error, says",
    [
        (np.array([[0, 101]], np.int8), 0.05, ogm.MapError, "from 0 to 101"),
        (np.array([[0, 255]], np.uint8), 0.05, ogm.MapError, "from 0 to 255"),
        (np.array([[-2, 0]], np.int64), 0.05, ogm.MapError, "from -2 to 0"),
        (np.array([[0, 2**63]], np.uint64), 0.05, ogm.MapError, "9223372036854775808"),
        (np.zeros((3, 0), np.int8), 0.05, ogm.MapError, "0 × 3 cells has no area"),
        (np.zeros(9, np.int8), 0.05, ogm.MapError, r"\(height, width\), not \[9\]"),
        (np.zeros((3, 3, 3), np.int8), 0.05, ogm.MapError, "3, 3, 3"),
        (np.zeros((3, 3)), 0.05, TypeError, "integers"),
        (np.zeros((3, 3), bool), 0.05, TypeError, "integers"),
        ([["a"]], 0.05, TypeError, "integers"),
        (np.zeros((3, 3), np.int8), math.nan, ogm.MapError, "resolution of NaN"),
        (np.zeros((3, 3), np.int8), 0.0, ogm.MapError, "resolution"),
        (np.broadcast_to(np.int8(0), (1 << 20, 1 << 20)), 0.05, ogm.MapError, "limit"),
    ],
)
def test_what_cannot_be_a_map_is_an_error_that_says_why(given, resolution, error, says):
    with pytest.raises(error, match=says):
        ogm.Map.from_array(given, resolution)


@pytest.mark.parametrize("kind", [list, tuple, np.array, memoryview])
def test_a_message_is_known_by_its_fields(kind):
    flat = CELLS.ravel()
    half = math.radians(30.0) / 2
    given = message(kind(flat), 17, 6, (0.0, 0.0, math.sin(half), math.cos(half)))
    m = ogm.Map.from_occupancy_grid(given)
    np.testing.assert_array_equal(m.array, CELLS)
    assert tuple(m.origin) == pytest.approx((-1.0, 2.0, math.radians(30.0)), abs=1e-12)
    assert m == ogm.Map.from_array(CELLS, 0.05, m.origin)


def test_an_orientation_that_nobody_set_is_none():
    m = ogm.Map.from_occupancy_grid(message(CELLS.ravel(), 17, 6, (0.0, 0.0, 0.0, 0.0)))
    assert m.origin.theta == 0.0


@pytest.mark.parametrize(
    "given, says",
    [
        (message(CELLS.ravel()[1:], 17, 6), "17 x 6 cells, which are 102"),
        (message(CELLS, 17, 6), "shape"),
        (message(CELLS.ravel(), 0, 6), "no area"),
        (message(CELLS.ravel(), 17, 6, (0.7, 0.0, 0.0, 0.7)), "no turn about the vertical"),
        (message(CELLS.ravel(), 17, 6, (math.nan, 0.0, 0.0, 1.0)), "no turn about the vertical"),
    ],
)
def test_a_message_that_contradicts_itself_is_an_error(given, says):
    with pytest.raises(ogm.MapError, match=says):
        ogm.Map.from_occupancy_grid(given)


def test_what_is_no_message_is_an_error_that_names_the_field():
    with pytest.raises(AttributeError, match="info"):
        ogm.Map.from_occupancy_grid(object())


def test_a_map_is_saved_and_loaded(tmp_path, target):
    path = tmp_path / "m.yaml"
    target.save(path)
    assert ogm.load(path) == target
    with pytest.raises(ogm.MapError, match="exists"):
        target.save(path)
    m = ogm.Map.from_array(CELLS, 0.05, (1.0, -2.0, 0.25))
    m.save(str(path), overwrite=True)
    assert ogm.load(path) != m, "classes keep no probabilities"
    exact = tmp_path / "exact.yaml"
    m.save(exact, probabilities=True)
    assert ogm.load(exact) == m


def test_files_that_are_not_there_and_files_that_are_odd_say_so(tmp_path, target):
    with pytest.raises(ogm.MapError, match="cannot read .*none.yaml"):
        ogm.load(tmp_path / "none.yaml")
    target.save(tmp_path / "m.yaml")
    yaml = tmp_path / "m.yaml"
    yaml.write_text(yaml.read_text().replace("free_thresh: 0.196", "free_thresh: 0.25"))
    (warning,) = ogm.load(yaml).warnings
    assert "205" in warning
    assert target.warnings == []


def test_maps_and_transforms_are_pickled_and_copied():
    m = ogm.Map.from_array(CELLS, 0.05, (-1.0, 2.0, 0.0))
    for other in (pickle.loads(pickle.dumps(m)), copy.deepcopy(m), copy.copy(m)):
        assert other == m
    t = ogm.Transform(1.0, 2.0, 0.5)
    assert np.allclose(pickle.loads(pickle.dumps(t)).matrix, t.matrix, rtol=0, atol=1e-15)
    assert issubclass(pickle.loads(pickle.dumps(ogm.MapError("a"))).__class__, ValueError)


def test_a_map_shows_itself(target):
    assert target._repr_png_().startswith(b"\x89PNG\r\n\x1a\n")
    assert repr(target) == f"Map({target.width} x {target.height} cells of 0.05 m)"


def test_a_map_is_drawn_in_its_own_metres(target):
    figure = pytest.importorskip("matplotlib.figure")
    cells = np.full((10, 20), -1, np.int8)
    cells[0, 19] = 100
    m = ogm.Map.from_array(cells, 0.5, (3.0, -1.0, math.pi / 2))
    ax = figure.Figure().add_subplot()
    assert m.plot(ax) is ax
    (image,) = ax.images
    to_data = image.get_transform() - ax.transData
    # The lower right corner of the grid, 10 m along its x.
    assert to_data.transform((10.0, 0.0)) == pytest.approx((3.0, 9.0), abs=1e-9)
    assert image.get_array()[0, 19] == 100
    assert ax.get_xlim()[0] <= -2.0 and ax.get_ylim()[1] >= 9.0
