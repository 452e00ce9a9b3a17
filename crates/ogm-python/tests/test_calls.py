"""Calls beside each other, heard, ended, and in other processes."""

import multiprocessing
import os
import signal
import threading
import time

import pytest

import ogm_maps as ogm

# A walk that nobody waits for.
ENDLESS = {"samples": 10**9, "walks": 1}
HERE = ogm.Transform()


def test_progress_is_told_on_the_calling_thread_and_only_grows(target, source):
    shares = []
    threads = set()

    def progress(share):
        shares.append(share)
        threads.add(threading.get_ident())

    ogm.random_walk(target, source, HERE, samples=300, progress=progress)
    assert threads == {threading.get_ident()}
    assert shares == sorted(shares) and shares[-1] == 1.0
    assert len(shares) > 1, "the walk took less than one tick"
    assert all(0.0 <= share <= 1.0 for share in shares)


def test_an_exception_in_progress_ends_the_call_and_is_raised(target, source):
    class Enough(Exception):
        pass

    calls = []

    def progress(share):
        calls.append(share)
        if len(calls) == 2:
            raise Enough

    with pytest.raises(Enough):
        ogm.random_walk(target, source, HERE, **ENDLESS, progress=progress)
    assert len(calls) == 2


def test_ctrl_c_ends_a_call(target, source):
    # A shell starts what it runs in the background deaf to it.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    ask = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    ask.start()
    with pytest.raises(KeyboardInterrupt):
        ogm.random_walk(target, source, HERE, **ENDLESS)
    ask.join()
    signal.signal(signal.SIGINT, before)


def test_other_threads_run_meanwhile(target, source):
    ended = threading.Event()
    heard = []

    def progress(share):
        if ended.is_set():
            raise InterruptedError

    def call():
        with pytest.raises(InterruptedError):
            ogm.random_walk(target, source, HERE, **ENDLESS, progress=progress)
        heard.append(True)

    worker = threading.Thread(target=call)
    worker.start()
    # Each of these calls has to come and go while the other one runs.
    for _ in range(20):
        ogm.wall_segments(ogm.Map.from_array([[100] * 90], 0.05))
        time.sleep(0.001)
    assert worker.is_alive()
    ended.set()
    worker.join(60)
    assert heard == [True]


def _in_child(answers, target, source):
    answers.put(ogm.random_walk(target, source, HERE, walks=2, threads=2).psi)


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_a_child_process_gives_the_same_answer(method, target, source):
    here = ogm.random_walk(target, source, HERE, walks=2, threads=2).psi
    context = multiprocessing.get_context(method)
    answers = context.Queue()
    child = context.Process(target=_in_child, args=(answers, target, source))
    child.start()
    assert answers.get(timeout=120) == here
    child.join(60)
    assert child.exitcode == 0
