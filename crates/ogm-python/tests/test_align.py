"""The transform between two maps against the truth, and refusals."""

import math

import numpy as np
import pytest

import ogm_maps as ogm


def error(found, truth):
    """Metres in the middle of the source, and radians."""
    middle = np.array([0.0, 0.0])
    metres = np.linalg.norm(found @ middle - truth @ middle)
    return metres, abs((truth.inverse() @ found).theta)


def test_two_maps_of_one_building_are_aligned_to_centimetres(found, truth):
    assert found and found.verdict == "merged" and found.reason is None
    metres, radians = error(found.transform, truth)
    assert metres < 0.1 and radians < 0.01
    assert found.probability > 0.9
    best = found.hypotheses[0]
    assert (best.transform, best.probability) == (found.transform, found.probability)
    np.testing.assert_array_equal(best.covariance, found.covariance)
    assert found.covariance.shape == (3, 3)
    assert (np.linalg.eigvalsh(found.covariance) > 0).all()
    np.testing.assert_array_equal(found.covariance, found.covariance.T)
    assert 0.0 < found.overlap <= 1.0 and 0.5 < found.agreement <= 1.0
    assert (found.method, found.seed) == ("match", 0)
    x, y, theta = found.transform
    assert repr(found).startswith(f"Alignment(merged, x={x:.3f}, y={y:.3f}, theta={theta:.4f}")


def test_the_other_way_round_is_the_inverse(target, source, found):
    back = ogm.align(source, target)
    metres, radians = error(back.transform, found.transform.inverse())
    assert metres < 0.1 and radians < 0.01


def test_a_source_in_another_frame_moves_the_answer_by_it(target, source, found):
    new_from_old = ogm.Transform(20.0, -7.0, 1.0)
    moved = ogm.Map.from_array(source.array, source.resolution, new_from_old @ source.origin)
    metres, radians = error(ogm.align(target, moved).transform @ new_from_old, found.transform)
    assert metres < 0.01 and radians < 0.001


def test_maps_that_say_nothing_are_refused_and_nothing_is_raised(target):
    empty = ogm.Map.from_array(np.full((50, 50), -1), 0.05)
    r = ogm.align(target, empty)
    assert not r and r.verdict == "no-match"
    assert (r.transform, r.probability, r.covariance, r.hypotheses) == (None, None, None, [])
    assert r.reason.startswith("too little structure:")
    assert r.picture() is None and r._repr_png_() is None
    assert r.reason in repr(r)


def test_what_was_not_believed_is_kept_apart_from_the_answer(target, source, found):
    r = ogm.align(target, source, accept=1.0)
    assert found.probability < 1.0, "nothing is certain"
    assert not r and r.transform is None
    metres, radians = error(r.hypotheses[0].transform, found.transform)
    assert metres < 0.01 and radians < 0.001
    assert r.picture().png.startswith(b"\x89PNG")


def test_a_prior_bounds_the_search(target, source, truth, found):
    near = truth @ ogm.Transform(0.3, -0.2, 0.05)
    r = ogm.align(target, source, prior=near, prior_sigma=(0.5, 0.1))
    metres, radians = error(r.transform, truth)
    assert metres < 0.1 and radians < 0.01
    away = truth @ ogm.Transform(0.0, 0.0, math.pi / 2)
    wrong = ogm.align(target, source, prior=away, prior_sigma=(0.1, 0.02))
    assert not wrong
    for pose in wrong.hypotheses:
        assert error(pose.transform, away)[1] <= 3.1 * 0.02


def test_tags_give_the_answer_where_both_robots_read_them(target, source, folder, truth):
    logs = [folder / "target.tags.csv", folder / "source.tags.csv"]
    by_path = ogm.align(target, source, tags=logs)
    assert by_path and by_path.method == "rfid3"
    metres, radians = error(by_path.transform, truth)
    assert metres < 0.1 and radians < 0.02
    tags = [ogm.localise_tags(log) for log in logs]
    assert ogm.align(target, source, tags=tags).to_dict() == by_path.to_dict()
    assert ogm.align(target, source, tags=(None, None)).method == "match"


def test_every_method_can_be_named(target, source, folder, truth):
    tags = [folder / "target.tags.csv", folder / "source.tags.csv"]
    for method in ["match", "rfid1", "rfid1b", "rfid2", "rfid3"]:
        r = ogm.align(target, source, method=method, tags=tags)
        assert r.method == method
        metres, _ = error(r.hypotheses[0].transform, truth)
        assert metres < 0.5, method
    r = ogm.align(target, source, method="carpin", prior=truth, prior_sigma=(0.2, 0.05))
    assert r.method == "carpin" and r.probability is None


@pytest.mark.parametrize(
    "options, error, says",
    [
        ({"method": "best"}, ogm.MapError, "match, rfid1, rfid1b, rfid2, rfid3, two-tags, tags-icp, carpin, radon"),
        ({"method": "rfid3"}, ogm.MapError, "needs tags"),
        ({"prior": (0, 0, 0)}, TypeError, "prior_sigma"),
        ({"prior_sigma": (1, 1)}, TypeError, "go together"),
        ({"prior": (0, 0, 0), "prior_sigma": (-1, 1)}, ogm.MapError, "-1"),
        ({"prior": (0, 0, 0), "prior_sigma": (1, 1), "method": "radon"}, ogm.MapError, "no prior"),
        ({"accept": 0.0}, ogm.MapError, "above 0"),
        ({"accept": math.nan}, ogm.MapError, "above 0"),
        ({"seed": -1}, OverflowError, "negative"),
        ({"threads": 0}, ogm.MapError, "threads must be 1 to"),
        ({"threads": 10**6}, ogm.MapError, "threads must be 1 to"),
        ({"progress": 7}, TypeError, "callable"),
        ({"tags": [None]}, ogm.MapError, "each of 2 maps"),
        ({"tags": [None, [7]]}, TypeError, "Tag"),
        ({"tags": ["none.csv", None]}, ogm.MapError, "none.csv"),
        ({"unknown": 1}, TypeError, "unknown"),
    ],
)
def test_options_that_cannot_be_meant_are_errors(target, source, options, error, says):
    with pytest.raises(error, match=says):
        ogm.align(target, source, **options)


def test_other_things_than_maps_are_type_errors(target):
    for other in (None, 7, target.array, "target.yaml"):
        with pytest.raises(TypeError):
            ogm.align(target, other)


def test_copies_of_one_map_are_called_that(target):
    r = ogm.align(target, target)
    assert any("copies" in warning for warning in r.warnings)


def test_the_answer_is_the_same_on_one_thread_and_on_three(target, source, found, truth):
    assert ogm.align(target, source, threads=1).to_dict() == found.to_dict()
    start = truth @ ogm.Transform(0.3, 0.1, 0.05)
    ways = [
        ogm.random_walk(target, source, start, samples=60, walks=3, seed=5, threads=threads)
        for threads in (1, 3)
    ]
    assert ways[0].transform == ways[1].transform
    np.testing.assert_array_equal(ways[0].trace, ways[1].trace)
    assert ogm.random_walk(target, source, start, samples=60, walks=3, seed=6).transform != ways[0].transform
