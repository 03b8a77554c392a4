# SPDX-License-Identifier: GPL-3.0-or-later
"""The wheel holds all that it needs."""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import ridgecraft

ROOT = Path(os.environ["RIDGECRAFT_SOURCE_DIR"])


def test_a_wheel_is_built_and_works(tmp_path):
    # Its own build folder is kept beside this one's, so that the next run has little to do.
    build = Path(ridgecraft.__file__).resolve().parent.parent / "wheel"
    subprocess.run(
        ["sh", ROOT / "python" / "build_wheel.sh", tmp_path],
        check=True,
        env={**os.environ, "RIDGECRAFT_BUILD": str(build), "PYTHON": sys.executable,
             # Half of the time goes into optimising, which other tests are for.
             "CMAKE_ARGS": "-DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS=-O0"},
    )
    (wheel,) = tmp_path.glob(f"ridgecraft-{ridgecraft.__version__}-*.whl")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path / "site")
    assert {"__init__.py", "_core.pyi", "py.typed"} < {p.name for p in (tmp_path / "site" / "ridgecraft").iterdir()}
    told = subprocess.run(
        [sys.executable, "-c", "import ridgecraft; print(ridgecraft.__file__, len(ridgecraft.hulls("
         "[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])))"],
        check=True, capture_output=True, text=True, env={**os.environ, "PYTHONPATH": str(tmp_path / "site")},
    ).stdout.split()
    assert told == [str(tmp_path / "site" / "ridgecraft" / "__init__.py"), "1"]
