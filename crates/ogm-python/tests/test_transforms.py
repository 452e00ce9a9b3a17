"""Transforms: a group that acts on points."""

import math
import pickle

import numpy as np
import pytest

import ogm_maps as ogm

A = ogm.Transform(3.0, -1.0, math.pi / 2)
B = ogm.Transform(-0.5, 4.0, 2.5)


def test_points_are_turned_and_then_moved():
    assert A @ (1.0, 0.0) == pytest.approx([3.0, 0.0], abs=1e-12)
    points = np.array([[1.0, 0.0], [0.0, 2.0], [5.0, 7.0]])
    expected = points @ A.matrix[:2, :2].T + A.matrix[:2, 2]
    np.testing.assert_allclose(A @ points, expected, atol=1e-12)
    np.testing.assert_allclose(A @ np.asfortranarray(points), expected, atol=1e-12)
    np.testing.assert_allclose(A @ points[::-1], expected[::-1], atol=1e-12)
    assert (A @ np.empty((0, 2))).shape == (0, 2)


def test_products_and_inverses_are_those_of_the_matrices():
    np.testing.assert_allclose((A @ B).matrix, A.matrix @ B.matrix, atol=1e-12)
    np.testing.assert_allclose((B @ B.inverse()).matrix, np.eye(3), atol=1e-12)
    np.testing.assert_allclose(np.asarray(B), B.matrix)
    x, y, theta = B
    assert (x, y, theta) == (B.x, B.y, B.theta)
    np.testing.assert_allclose(ogm.Transform.from_matrix(B.matrix).matrix, B.matrix, atol=1e-12)


@pytest.mark.parametrize(
    "pose", [B, tuple(B), list(B), np.array(tuple(B)), B.matrix, B.matrix.tolist()]
)
def test_a_pose_is_written_in_any_of_these_ways(pose, target):
    origin = ogm.Map.from_array(target.array, 0.05, pose).origin
    np.testing.assert_allclose(origin.matrix, B.matrix, atol=1e-12)


@pytest.mark.parametrize(
    "pose, error",
    [
        (np.diag([2.0, 2.0, 1.0]), ogm.MapError),
        (np.diag([1.0, -1.0, 1.0]), ogm.MapError),
        (np.full((3, 3), math.nan), ogm.MapError),
        ((0.0, 0.0, math.inf), ogm.MapError),
        ((0.0, 0.0), TypeError),
        ("abc", TypeError),
        (7, TypeError),
    ],
)
def test_what_is_no_turn_and_move_is_an_error(pose, error, target):
    with pytest.raises(error):
        ogm.Map.from_array(target.array, 0.05, pose)
    with pytest.raises(ogm.MapError):
        ogm.Transform(math.nan)
    with pytest.raises(ogm.MapError, match=r"shape \(2,\) or \(n, 2\)"):
        A @ np.zeros((2, 3))


def test_pickles_are_the_same_to_the_last_bit():
    turn = ogm.Transform(0.1, 0.2, 0.3)
    product = ogm.Transform()
    for _ in range(50):
        product = product @ turn
        assert pickle.loads(pickle.dumps(product)) == product
