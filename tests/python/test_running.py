# SPDX-License-Identifier: GPL-3.0-or-later
"""While work goes on: other threads run, progress is told, Ctrl-C ends it. What is ended here takes seconds else."""

import os
import signal
import subprocess
import sys
import threading
import time

import pytest
from conftest import read_obj

import ridgecraft


def interrupt_after(seconds):
    timer = threading.Timer(seconds, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    return timer


def test_ctrl_c_ends_it(large):
    interrupt_after(0.3)
    with pytest.raises(KeyboardInterrupt):
        ridgecraft.segment(*large, 0.01, effort=3)


def test_ctrl_c_ends_paper(large):
    interrupt_after(1.0)
    with pytest.raises(KeyboardInterrupt):
        ridgecraft.run(*large, size=3000, simplify="keep")


def test_a_program_that_was_interrupted_ends(large, tmp_path):
    script = tmp_path / "work.py"
    script.write_text(
        "import numpy as np, ridgecraft\n"
        "rng = np.random.default_rng(1)\n"
        "n = 3000\n"
        "points = rng.normal(size=(3 * n, 3))\n"
        "ridgecraft.segment(points, np.arange(3 * n).reshape(n, 3), 0.005, effort=3,"
        " progress=lambda stage, share: print(stage, flush=True))\n"
    )
    with subprocess.Popen([sys.executable, script], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout.readline()
        process.send_signal(signal.SIGINT)
        _, told = process.communicate(timeout=60)
    assert process.returncode != 0
    assert b"KeyboardInterrupt" in told


def test_other_threads_run_meanwhile(large):
    done = threading.Event()
    counted = 0

    def count():
        nonlocal counted
        while not done.is_set():
            counted += 1
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    ridgecraft.segment(*large)
    done.set()
    counter.join()
    assert counted > 20


CALLS = {
    "segment": lambda mesh: ridgecraft.segment(*mesh).tobytes(),
    "hulls": lambda mesh: [part.tobytes() for hull in ridgecraft.hulls(*mesh) for part in hull],
    "unfold": lambda mesh: ridgecraft.unfold(*mesh, size=100).fold,
    "run": lambda mesh: ridgecraft.run(*mesh, size=100).pdf(),
}


@pytest.mark.parametrize("name", CALLS)
def test_a_hundred_calls_leave_nothing_behind(name, tetrahedron):
    def kilobytes():
        with open("/proc/self/statm") as statm:
            return int(statm.read().split()[1]) * os.sysconf("SC_PAGESIZE") // 1024

    # Nets take longer: of four faces.
    mesh = read_obj("whale.obj") if name in ("segment", "hulls") else tetrahedron
    for _ in range(20):
        CALLS[name](mesh)
    grown = []
    for _ in range(3):
        before = kilobytes()
        for _ in range(100):
            CALLS[name](mesh)
        grown.append(kilobytes() - before)
    # What is left behind comes with each hundred calls, what the allocator keeps only once.
    # The arrays that one call gives are some 100 kB.
    assert min(grown) < 1024


@pytest.mark.parametrize("name", CALLS)
def test_two_threads_at_once_give_what_one_gives(name, cross):
    alone = CALLS[name](cross)
    results = [None, None]

    def call(i):
        results[i] = CALLS[name](cross)

    threads = [threading.Thread(target=call, args=(i,)) for i in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert results == [alone, alone]


def test_progress_is_told(large):
    stages = []
    ridgecraft.segment(*large, progress=lambda stage, share: stages.append((stage, share, threading.get_ident())))
    assert stages
    assert all(isinstance(stage, str) and 0.0 <= share <= 1.0 for stage, share, _ in stages)
    assert {thread for _, _, thread in stages} == {threading.get_ident()}


def test_what_progress_raises_ends_the_work(large):
    class Enough(Exception):
        pass

    def stop(stage, share):
        raise Enough(stage)

    with pytest.raises(Enough):
        ridgecraft.segment(*large, 0.01, effort=3, progress=stop)
    # And the next call works as ever.
    assert len(ridgecraft.segment(*large, 0.5)) == len(large[1])
