"""A team whose maps grow."""

import numpy as np
import pytest

import ogm_maps as ogm


def seen(map: ogm.Map, share: float) -> ogm.Map:
    """The part of a map within a share of its size of its middle."""
    cells = map.array.copy()
    rows, columns = np.indices(cells.shape)
    away = np.hypot(rows / cells.shape[0] - 0.5, columns / cells.shape[1] - 0.5)
    cells[away > share * 0.8] = -1
    return ogm.Map.from_array(cells, map.resolution, map.origin)


def test_growing_maps_find_their_places(target, source, truth):
    session = ogm.Session()
    kinds = []
    for share in (0.3, 0.6, 1.0):
        for robot, map in (("a", target), ("b", source)):
            kinds += [(c.robot, c.kind) for c in session.update(robot, seen(map, share))]
    assert kinds == [("a", "placed"), ("b", "placed")]
    a, b = session.robots
    assert a.transform == ogm.Transform() and a.probability == 1.0
    assert np.allclose(b.transform.matrix, truth.matrix, atol=0.1)
    assert b.probability >= 0.9 and b.covariance.shape == (3, 3)
    assert b.together_with == ["a"] and b.best_match[0] == "a"
    assert session.map().shape[0] > 0


def test_what_is_asked_for_holds(target, source):
    session = ogm.Session()
    session.update("a", target)
    session.update("b", source)
    (change,) = session.separate("b")
    assert (change.robot, change.kind, change.reason) == ("b", "undone", "as asked")
    (change,) = session.set_pose("b", (1.0, 2.0, 0.5))
    assert tuple(change.transform) == pytest.approx((1.0, 2.0, 0.5))
    session.release("b")
    assert session.remove("b") and not session.remove("b")
    with pytest.raises(ogm.MapError, match="nobody"):
        session.separate("nobody")


def test_a_session_goes_on_where_it_was_saved(target, source):
    session = ogm.Session()
    session.update("a", target)
    session.update("b", source)
    again = ogm.Session.resume(session.save())
    assert not again.update("b", source)
    found = [np.array(list(s.robots[1].transform)) for s in (session, again)]
    assert np.allclose(*found, atol=1e-9)
    with pytest.raises(ogm.MapError, match="saved session"):
        ogm.Session.resume("{}")


def test_an_exception_in_progress_ends_a_call_and_leaves_the_session(target, source):
    session = ogm.Session()
    session.update("a", target)

    def stop(share):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        session.update("b", source, progress=stop)
    session.update("b", seen(source, 0.99))
    assert session.robots[1].transform is not None
