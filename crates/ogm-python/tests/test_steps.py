"""The steps of the papers, by their names."""

import math

import numpy as np
import pytest

import ogm_maps as ogm


def room(resolution=0.05, turn=0.0):
    """A room of 5 m by 3 m with one bay, in a frame that is turned."""
    cells = np.full((80, 120), -1, np.int8)
    cells[10:70, 10:110] = 0
    cells[[10, 69], 10:110] = 100
    cells[10:70, [10, 109]] = 100
    cells[40, 10:50] = 100
    cells[41:69, 49] = 100
    return ogm.Map.from_array(cells, resolution, (0.0, 0.0, turn))


def test_a_tag_is_where_the_ranges_to_it_say():
    tag = np.array([1.4, 0.6])
    angle = np.linspace(0.0, 3.0, 60)
    robot = np.column_stack([np.sin(angle), 1.0 - np.cos(angle)])
    ranges = np.linalg.norm(tag - robot, axis=1)
    log = np.column_stack([np.full(60, 7), robot, ranges])
    for rows in (log, np.asfortranarray(log), log.tolist()):
        (found,) = ogm.localise_tags(rows)
        assert (found.tag_id, found.readings) == (7, 60)
        assert found.position == pytest.approx(tag, abs=0.02)
        assert found.certainty > 0.75
    assert ogm.localise_tags(np.empty((0, 4))) == []


@pytest.mark.parametrize(
    "log",
    [np.zeros((3, 3)), np.zeros(4), [[0.5, 0, 0, 1]], [[-1, 0, 0, 1]]],
)
def test_a_log_that_cannot_be_meant_is_an_error(log):
    with pytest.raises(ogm.MapError):
        ogm.localise_tags(log)


def test_a_reading_that_is_no_place_is_left_out():
    assert ogm.localise_tags([[1, math.nan, 0, 1]]) == []


def test_numbers_that_are_none_are_type_errors():
    for log in (np.zeros((3, 4), complex), [["a"] * 4], None, object()):
        with pytest.raises(TypeError):
            ogm.localise_tags(log)


def test_the_tags_of_a_file_are_those_of_its_rows(folder):
    path = folder / "target.tags.csv"
    rows = np.loadtxt(path, delimiter=",", skiprows=1)
    assert ogm.localise_tags(path) == ogm.localise_tags(str(path)) == ogm.localise_tags(rows)
    with pytest.raises(ogm.MapError, match="none.csv"):
        ogm.localise_tags(folder / "none.csv")


def test_walls_turn_with_the_map():
    straight, turned = ogm.wall_segments(room()), ogm.wall_segments(room(turn=0.3))
    assert straight and len(straight) == len(turned) >= 3
    assert max(wall.length for wall in straight) == pytest.approx(99 * 0.05, abs=0.1)
    for before, wall in zip(straight, turned):
        off = (wall.direction - before.direction - 0.3) % math.pi
        assert min(off, math.pi - off) < 1e-6
        dx, dy = np.subtract(wall.end, wall.start)
        assert math.hypot(dx, dy) == pytest.approx(wall.length)
        assert 0.6 <= wall.reliability <= 1.0 and wall.support > 10
    assert list(turned) == turned.segments


def test_a_map_without_walls_has_none_and_says_so():
    walls = ogm.wall_segments(ogm.Map.from_array(np.zeros((50, 50), int), 0.05))
    assert not walls and len(walls) == 0 and list(walls) == []
    assert walls.reason is not None and walls.reason in repr(walls)


@pytest.mark.parametrize("metric", ["point-to-point", "point-to-line", None])
def test_icp_brings_a_start_home(metric):
    new_from_old = ogm.Transform(4.0, -2.0, 0.4)
    target = room()
    source = ogm.Map.from_array(target.array, 0.05, new_from_old)
    truth = new_from_old.inverse()
    start = truth @ ogm.Transform(0.1, -0.08, 0.01)
    found = ogm.icp(target, source, start, metric=metric)
    assert found and found.termination == "converged" and found.correspondences > 100
    np.testing.assert_allclose(found.transform.matrix, truth.matrix, atol=0.01)
    assert found.rmse < 0.01


def test_icp_refuses_maps_without_walls():
    free = ogm.Map.from_array(np.zeros((50, 50), int), 0.05)
    found = ogm.icp(room(), free, (0, 0, 0))
    assert not found and found.transform is None and found.rmse is None
    assert found.reason.startswith("too little structure")
    with pytest.raises(ogm.MapError, match="point-to-line"):
        ogm.icp(room(), free, (0, 0, 0), metric="nearest")


def test_a_random_walk_makes_maps_more_alike():
    found = ogm.random_walk(room(), room(), (0.3, -0.2, 0.05), seed=3)
    assert found and found.psi < 0.3 * found.start_psi
    assert (np.diff(found.trace) <= 0).all() and found.trace[-1] == found.psi
    assert found.resolution == 0.05
    with pytest.raises(ogm.MapError, match="walks"):
        ogm.random_walk(room(), room(), (0, 0, 0), walks=0)
