# SPDX-License-Identifier: GPL-3.0-or-later
"""The Dask program of docs/guide/batches.md, on a cluster of two workers of which one is killed."""

import os
import re
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

distributed = pytest.importorskip("distributed")

ROOT = Path(os.environ["RIDGECRAFT_SOURCE_DIR"])
PROGRAM = Path(os.environ["RIDGECRAFT_PROGRAM"])
SAMPLES = ("cube.obj", "house.obj", "lantern.obj", "mug.obj", "torus.off", "whale.obj")


def dask_program() -> str:
    text = (ROOT / "docs/guide/batches.md").read_text()
    section = text[text.index("\nDask") : text.index("\nRay")]
    return "\n".join(line[4:] for line in section.splitlines() if line.startswith("    ") or not line)


def test_every_result_is_there_once_though_a_worker_is_killed(tmp_path):
    samples = [path for path in sorted((ROOT / "samples").iterdir()) if path.name in SAMPLES]
    assert len(samples) >= 4
    models = []
    for i in range(6):
        for sample in samples:
            models.append(tmp_path / f"{i}-{sample.name}")
            models[-1].write_bytes(sample.read_bytes())
    (tmp_path / "list.txt").write_text("".join(f"{model}\n" for model in models))
    (tmp_path / "hulls").mkdir()
    (tmp_path / "hulls_of_all.py").write_text(dask_program())
    # What workers start is found on their path.
    os.environ["PATH"] = f"{PROGRAM.parent}{os.pathsep}{os.environ['PATH']}"
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        run = subprocess.Popen(
            [sys.executable, tmp_path / "hulls_of_all.py", cluster.scheduler_address, tmp_path / "list.txt",
             tmp_path / "hulls"], stdout=subprocess.PIPE, text=True)
        victim = next(iter(cluster.workers.values())).process.pid

        def kill_after_some() -> None:
            while len(list((tmp_path / "hulls").iterdir())) < 3 and run.poll() is None:
                time.sleep(0.01)
            os.kill(victim, signal.SIGKILL)

        killer = threading.Thread(target=kill_after_some)
        killer.start()
        out, _ = run.communicate(timeout=300)
        killer.join()
    assert run.returncode == 0
    lines = sorted(out.splitlines())
    assert lines == sorted(f"0 {model}" for model in models)
    for model in models:
        assert re.match(r"# .*\n", (tmp_path / "hulls" / f"{model.name}.obj").read_text())
