"""Many maps at once, on the workers of a Dask cluster.

Every pair is a piece of work of its own; what the pieces find goes into `merge`, which decides. The
answer is that of `ogm_maps.merge` on one machine. Needs `ogm-maps[fleet]`.
"""

from __future__ import annotations

import hashlib
import pickle
import zlib
from collections import OrderedDict, deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from threading import Lock
from typing import Any, Optional

import distributed
from distributed import Client

from ogm_maps._native import (
    Hypothesis,
    Map,
    MapSignature,
    Merge,
    PreparedMap,
    candidate_pairs,
    merge,
)

__all__ = ["align_pairs", "likely_pairs", "merge_maps"]

# Of distributed only a part is typed.
_as_completed: Any = distributed.as_completed

Pair = tuple[int, int]
Found = list[tuple[Pair, list[Hypothesis]]]

# Maps a side of a block of pairs: a worker is sent 16 maps for up to 64 pairs.
_SIDE = 8
# Blocks on their way at once, for each thread of the cluster.
_AHEAD = 3
# Prepared maps that a worker keeps.
_KEPT = 64


def align_pairs(
    client: Client,
    maps: Sequence[Map],
    pairs: Optional[Iterable[Pair]] = None,
    *,
    repeats: bool = False,
    retries: int = 5,
    progress: Optional[Callable[[float], object]] = None,
) -> dict[Pair, list[Hypothesis]]:
    """Searches pairs of `maps`, each by the two maps alone, on the workers of `client`.

    `pairs` are (target, source), places in `maps`; all of them by default, target first. Work that
    a worker takes with it when it dies is done again, up to `retries` times. `progress` is called
    with the share that is done. The result has the hypotheses of every pair, best first.
    """
    wanted = _all_pairs(len(maps)) if pairs is None else list(pairs)
    for pair in wanted:
        if not all(0 <= place < len(maps) for place in pair) or pair[0] == pair[1]:
            raise ValueError(f"{pair} is no pair of {len(maps)} maps")
    blocks = deque(_blocks(wanted))
    packed = [_Packed(place, map) for place, map in enumerate(maps)]
    found: dict[Pair, list[Hypothesis]] = {}

    def submitted(block: list[Pair]) -> Any:
        needed = sorted({place for pair in block for place in pair})
        sent = [packed[place] for place in needed]
        return client.submit(_align, block, sent, repeats, retries=retries, pure=False)

    cluster: Any = client
    threads = max(1, sum(cluster.nthreads().values()))
    ahead = [submitted(blocks.popleft()) for _ in range(min(_AHEAD * threads, len(blocks)))]
    running = _as_completed(ahead)
    for done in running:
        found.update(done.result())
        done.release()
        if blocks:
            running.add(submitted(blocks.popleft()))
        if progress is not None:
            progress(len(found) / len(wanted))
    return found


def likely_pairs(
    client: Client, maps: Sequence[Map], partners: int = 20, *, retries: int = 5
) -> list[Pair]:
    """Pairs of `maps` that look alike from inside, `partners` for each map or more.

    What this saves and what it misses is measured in docs/fleet.md.
    """
    cluster: Any = client
    sent = [
        cluster.submit(_signature, _Packed(place, map), retries=retries, pure=False)
        for place, map in enumerate(maps)
    ]
    return candidate_pairs(cluster.gather(sent), partners)


def merge_maps(
    client: Client,
    maps: Sequence[Map],
    pairs: Optional[Iterable[Pair]] = None,
    *,
    accept: Optional[float] = None,
    repeats: bool = False,
    retries: int = 5,
    progress: Optional[Callable[[float], object]] = None,
    **how: Any,
) -> Merge:
    """As `ogm_maps.merge`, its pairs searched on the workers of `client`.

    Pairs that `pairs` does not name are taken to say nothing. `how` goes to `merge`: `reference`,
    `fusion`, `resolution`, `threads`.
    """
    found = align_pairs(client, maps, pairs, repeats=repeats, retries=retries, progress=progress)
    nothing: dict[Pair, list[Hypothesis]] = {
        pair: [] for pair in _all_pairs(len(maps)) if not _either(found, pair)
    }
    return merge(maps, alignments={**found, **nothing}, accept=accept, repeats=repeats, **how)


def _either(found: dict[Pair, list[Hypothesis]], pair: Pair) -> bool:
    return pair in found or pair[::-1] in found


def _all_pairs(count: int) -> list[Pair]:
    return [(target, source) for target in range(count) for source in range(target + 1, count)]


def _blocks(pairs: list[Pair]) -> Iterator[list[Pair]]:
    """Pairs of the same few maps together, so that each map is sent and prepared seldom."""
    blocks: dict[Pair, list[Pair]] = {}
    for target, source in pairs:
        blocks.setdefault((target // _SIDE, source // _SIDE), []).append((target, source))
    yield from blocks.values()


class _Packed:
    """A map on its way; it goes with the work, so that no worker's death takes it away."""

    def __init__(self, place: int, map: Map) -> None:
        self.place = place
        pickled = pickle.dumps(map)
        self.bytes = zlib.compress(pickled, 1)
        self.key = hashlib.sha256(pickled).digest()


def _signature(packed: _Packed) -> MapSignature:
    return _prepared(packed).signature()


def _align(pairs: list[Pair], packed: list[_Packed], repeats: bool) -> Found:
    maps = {one.place: _prepared(one) for one in packed}
    return [
        (pair, maps[pair[0]].align(maps[pair[1]], repeats=repeats, threads=1).hypotheses)
        for pair in pairs
    ]


_cache: OrderedDict[bytes, PreparedMap] = OrderedDict()
_cache_lock = Lock()


def _prepared(packed: _Packed) -> PreparedMap:
    with _cache_lock:
        known = _cache.get(packed.key)
        if known is not None:
            _cache.move_to_end(packed.key)
            return known
    made = PreparedMap(pickle.loads(zlib.decompress(packed.bytes)), threads=1)
    with _cache_lock:
        _cache[packed.key] = made
        while len(_cache) > _KEPT:
            _cache.popitem(last=False)
    return made
