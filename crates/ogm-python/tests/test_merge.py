"""Maps made one."""

import numpy as np
import pytest

import ogm_maps as ogm


def test_two_maps_become_one_that_holds_both(target, source, found):
    t = ogm.merge([target, source])
    assert t and t.reason is None
    (component,) = t.components
    assert component.members == [0, 1] and len(component) == 2
    first, second = component.poses
    assert first == ogm.Transform() and second == found.transform
    assert not component.covariances[0].any()
    np.testing.assert_array_equal(component.covariances[1], found.covariance)
    assert t.map == component.map and t.map.resolution == target.resolution
    assert t.conflicts.shape == t.map.shape and t.conflicts.dtype == bool
    assert t.conflicts.sum() == component.conflict_cells < 0.05 * component.compared_cells
    (pair,) = t.pairs
    assert (pair.target, pair.source, pair.transform) == (0, 1, found.transform)
    assert pair.alignment.to_dict() == found.to_dict()
    assert (t.map.array >= 0).sum() > max((m.array >= 0).sum() for m in (target, source))
    with pytest.raises(ValueError, match="read-only"):
        t.conflicts[0, 0] = True
    assert t._repr_png_().startswith(b"\x89PNG")


def test_where_only_the_first_map_knows_the_merged_one_is_the_first(target, source):
    merged = ogm.merge([target, source], fusion="first").map
    column, row = np.rint(
        (np.array([target.origin.x, target.origin.y]) - [merged.origin.x, merged.origin.y])
        / merged.resolution
    ).astype(int)
    part = merged.array[row : row + target.height, column : column + target.width]
    known = target.array >= 0
    np.testing.assert_array_equal(part[known], target.array[known])


def test_maps_that_do_not_hang_together_stay_apart(target):
    empty = ogm.Map.from_array(np.full((50, 50), -1), 0.05)
    t = ogm.merge([target, empty])
    assert not t and t.map is None and t.conflicts is None and t._repr_png_() is None
    assert t.reason == t.pairs[0].alignment.reason
    assert [component.members for component in t.components] == [[0], [1]]
    alone = t.components[0].map
    assert (alone.array[alone.array >= 0].size) == (target.array >= 0).sum()
    assert "[[0], [1]]" in repr(t)


def test_maps_in_known_poses_are_fused_as_the_transforms_say():
    left = ogm.Map.from_array([[100, 100, 100], [100, 0, 0], [100, 100, 100]], 0.5)
    right = ogm.Map.from_array([[100, 100, 100], [0, 0, 100], [100, 100, 100]], 0.5)
    room = ogm.fuse([left, right], [(0, 0, 0), (1.0, 0.0, 0.0)])
    wall = np.array([[1, 1, 1, 1, 1], [1, 0, 0, 0, 1], [1, 1, 1, 1, 1]], bool)
    np.testing.assert_array_equal(room.map.array > 50, wall)
    assert (room.compared_cells, room.conflict_cells) == (3, 0)
    assert room.members == [0, 1]
    shut = ogm.Map.from_array(100 - right.array, 0.5)
    clash = ogm.fuse([left, shut], [(0, 0, 0), (1.0, 0.0, 0.0)], fusion="log-odds")
    assert clash.conflict_cells == clash.conflicts.sum() == 3
    coarse = ogm.fuse([left], [(0, 0, 0)], resolution=1.5)
    assert coarse.map.resolution == 1.5 and coarse.map.shape == (1, 1)


def test_what_cannot_be_fused_is_an_error(target, source):
    with pytest.raises(ogm.MapError, match="one pose for each of 2 maps, not 1"):
        ogm.fuse([target, source], [(0, 0, 0)])
    with pytest.raises(ogm.MapError, match="keep-walls, log-odds, max-confidence, occupied"):
        ogm.fuse([target], [(0, 0, 0)], fusion="max")
    with pytest.raises(ogm.MapError, match="limit"):
        ogm.fuse([target, source], [(0, 0, 0), (9e6, 0, 0)])
    with pytest.raises(ogm.MapError):
        ogm.fuse([target], [(0, 0, 0)], resolution=float("nan"))
    with pytest.raises(ogm.MapError):
        ogm.fuse([], [])
    for count in (0, 1):
        with pytest.raises(ogm.MapError, match=f"at least two maps, not {count}"):
            ogm.merge([target] * count)


def test_two_maps_are_drawn_on_each_other(target, source, found, tmp_path):
    picture = ogm.overlay(target, source, found.transform)
    assert picture.png == found.picture().png == found._repr_png_()
    assert picture.width > 100 and picture.height > 100
    picture.save(tmp_path / "o.png")
    assert (tmp_path / "o.png").read_bytes() == picture.png
    with pytest.raises(ogm.MapError, match="exists"):
        picture.save(tmp_path / "o.png")
    with pytest.raises(ogm.MapError):
        ogm.overlay(target, source, (9e9, 0, 0))


@pytest.fixture(scope="module")
def part(target):
    """A third of the target and more, as a robot with another start would have it."""
    cells = np.array(target.array[:, : target.width * 2 // 3])
    return ogm.Map.from_array(cells, target.resolution, PART_FROM_TARGET @ target.origin)


PART_FROM_TARGET = ogm.Transform(7.0, 3.0, 0.8)


@pytest.fixture(scope="module")
def team(target, source, part):
    empty = ogm.Map.from_array(np.full((50, 50), -1), 0.05)
    return ogm.merge([target, source, part, empty])


def test_a_team_is_placed_and_a_stranger_stays_apart(team, truth):
    assert not team and team.map is None
    assert [component.members for component in team.components] == [[0, 1, 2], [3]]
    assert "[0, 1, 2], [3]" in team.reason
    _, source, part = team.components[0].poses
    for found, true in ((source, truth), (part, PART_FROM_TARGET.inverse())):
        off = true.inverse() @ found
        assert np.hypot(off.x, off.y) < 0.1 and abs(off.theta) < 0.01
    places = [(pair.target, pair.source) for pair in team.pairs]
    assert places == [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]
    assert [pair.transform is not None for pair in team.pairs] == [1, 1, 0, 1, 0, 0]
    assert team.pairs[0].alignment.verdict == "merged"
    assert len(team.joins) == 2
    assert 0.9 <= team.probability(0, 1) <= 1.0 and team.probability(0, 3) is None
    assert {join.probability for join in team.joins} <= {
        team.probability(0, 1), team.probability(0, 2), team.probability(1, 2)
    }
    with pytest.raises(ogm.MapError, match="no map 4 of 4"):
        team.probability(0, 4)


def test_another_reference_gives_its_frame(target, source, part, team):
    turned = ogm.merge([target, source, part], reference=2)
    assert turned and turned.reason is None and turned.map.shape == turned.conflicts.shape
    (component,) = turned.components
    place = dict(zip(component.members, component.poses))
    assert component.members[0] == 2 and place[2] == ogm.Transform()
    before = team.components[0].poses
    np.testing.assert_allclose(
        (place[0].inverse() @ place[1]).matrix, before[1].matrix, atol=0.02
    )


def test_known_poses_are_taken_as_given(target, source, part):
    given = {1: (1.0, 2.0, 0.3), 2: ogm.Transform(-5.0, 0.0, 0.0)}
    t = ogm.merge([target, source, part], poses=given)
    (component,) = t.components
    np.testing.assert_allclose(component.poses[1].matrix, ogm.Transform(1, 2, 0.3).matrix)
    np.testing.assert_allclose(component.poses[2].matrix, ogm.Transform(-5, 0, 0).matrix)
    assert all(pair.alignment is None for pair in t.pairs)
    two = ogm.merge([target, source], poses={1: (1.0, 2.0, 0.3)})
    np.testing.assert_allclose(two.components[0].poses[1].matrix, component.poses[1].matrix)


def test_copies_are_named(target, source):
    t = ogm.merge([target, source, target])
    assert t.copies == [(2, 0)] and t.probability(0, 2) == 1.0
    assert t.components[0].members == [0, 1, 2]


def test_what_is_for_two_maps_is_not_for_three(target, source, part):
    maps = [target, source, part]
    with pytest.raises(ogm.MapError, match="for two maps"):
        ogm.merge(maps, prior=(0, 0, 0), prior_sigma=(1, 1))
    with pytest.raises(ogm.MapError, match="for two maps"):
        ogm.merge(maps, method="radon")
    for options in ({"reference": 3}, {"poses": {3: (0, 0, 0)}}):
        with pytest.raises(ogm.MapError, match="map 3"):
            ogm.merge(maps, **options)
    with pytest.raises(ogm.MapError, match="sigma"):
        ogm.merge(maps, poses={1: (0, 0, 0)}, poses_sigma=(-1, 0))
