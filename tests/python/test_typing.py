# SPDX-License-Identifier: GPL-3.0-or-later
"""The stubs: strict checkers find nothing to say about the package, or about those who use it rightly."""

import os
import subprocess
import sys
from pathlib import Path

import ridgecraft

RIGHT = """
import numpy as np
import ridgecraft

vertices, faces = ridgecraft.read("whale.obj")
parts = int(ridgecraft.segment(vertices, faces, concavity=0.1).max()) + 1
for points, triangles in ridgecraft.hulls([[0.0, 0.0, 0.0]], [[0, 0, 0]], max_vertices=64, threads=2):
    print(points.shape, int(triangles.max()))
for part in ridgecraft.run_coacd(ridgecraft.Mesh(vertices, faces), threshold=0.05):
    print(len(part))
nets = ridgecraft.unfold(np.zeros((3, 3)), [[0, 1, 2]], size=10.0, progress=lambda stage, share: None)
made = ridgecraft.run(vertices, faces, simplify=400)
pages: bytes = made.pdf()
print(nets.flat.shape, made.page_count, made.figures["pieces"])
"""

WRONG = """
import ridgecraft

ridgecraft.segment([[0.0, 0.0, 0.0]], [[0, 0, 0]], concavity="much")
ridgecraft.segment([[0.0, 0.0, 0.0]], [[0, 0, 0]], concaveness=1)
ridgecraft.run([[0.0, 0.0, 0.0]], [[0, 0, 0]]).pages
"""


def told_by_mypy(folder, *paths):
    return subprocess.run(
        ["mypy", "--strict", "--python-executable", sys.executable, "--cache-dir", folder / "cache", *paths],
        capture_output=True, text=True,
        env={**os.environ, "MYPYPATH": str(Path(ridgecraft.__file__).parent.parent)},
    )


def test_the_package_and_its_users_are_typed(tmp_path):
    (tmp_path / "right.py").write_text(RIGHT)
    told = told_by_mypy(tmp_path, Path(ridgecraft.__file__).parent, tmp_path / "right.py")
    assert told.returncode == 0, told.stdout + told.stderr


def test_mistakes_are_found(tmp_path):
    (tmp_path / "wrong.py").write_text(WRONG)
    told = told_by_mypy(tmp_path, tmp_path / "wrong.py")
    assert told.returncode == 1
    assert [line.split(":")[1] for line in told.stdout.splitlines() if "error:" in line] == ["4", "5", "6"], told.stdout
