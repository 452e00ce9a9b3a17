"""Maps merged on the workers of a cluster."""

import importlib.util
import os
import signal
from pathlib import Path

import numpy as np
import pytest

import ogm_maps as ogm

distributed = pytest.importorskip("distributed")
from ogm_maps import fleet  # noqa: E402

EXAMPLE = Path(__file__).parents[1] / "examples" / "fleet.py"


def maps_of(robots: int) -> list:
    spec = importlib.util.spec_from_file_location("fleet_example", EXAMPLE)
    example = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(example)
    rng = np.random.default_rng(7)
    floors = [example.draw_floor(rng) for _ in range(2)]
    return [example.explore(floors[robot % 2], rng) for robot in range(robots)]


@pytest.fixture(scope="module")
def client():
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client


def test_hypotheses_come_back_as_they_were(found):
    import pickle

    best = found.hypotheses[0]
    again = pickle.loads(pickle.dumps(best))
    assert again.transform == best.transform and again.score == best.score
    assert np.array_equal(again.covariance, best.covariance)


def test_a_cluster_gives_the_answer_of_one_machine(client):
    maps = maps_of(8)
    here = ogm.merge(maps)
    shares = []
    there = fleet.merge_maps(client, maps, progress=shares.append)
    assert shares[-1] == 1.0 and shares == sorted(shares)
    assert [c.members for c in here.components] == [c.members for c in there.components]
    assert len(here.components[0]) >= 3
    for one, other in zip(here.components, there.components):
        assert one.poses == other.poses
        assert one.map == other.map


def test_the_death_of_a_worker_costs_no_result(client):
    maps = maps_of(8)
    (victim, *_) = client.run(os.getpid).values()
    killed = []

    def kill(share):
        if not killed:
            killed.append(victim)
            os.kill(victim, signal.SIGKILL)

    found = fleet.align_pairs(client, maps, progress=kill)
    assert killed and len(found) == 28
    client.wait_for_workers(2, timeout=60)


def test_pairs_are_chosen_by_the_caller(client):
    maps = maps_of(4)
    found = fleet.align_pairs(client, maps, [(2, 0)])
    assert list(found) == [(2, 0)]
    merged = fleet.merge_maps(client, maps, [(2, 0)])
    assert sum(len(c) for c in merged.components) == 4
    with pytest.raises(ValueError, match="no pair"):
        fleet.align_pairs(client, maps, [(0, 9)])


def test_maps_that_look_alike_are_proposed(client):
    maps = maps_of(8)
    likely = fleet.likely_pairs(client, maps, 2)
    assert 8 <= len(likely) <= 16 and likely == sorted(set(likely))
    one_floor = [(a, b) for a, b in likely if a % 2 == b % 2]
    assert len(one_floor) > len(likely) / 2
