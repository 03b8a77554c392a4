# SPDX-License-Identifier: GPL-3.0-or-later
"""The wheel holds all that it needs."""

import os
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import ridgecraft

ROOT = Path(os.environ["RIDGECRAFT_SOURCE_DIR"])


# What the options of a wheel's build would change in a build folder that has the tests, too.
KEPT = ("CMAKE_BUILD_TYPE", "RIDGECRAFT_PROGRAM", "RIDGECRAFT_PYTHON", "RIDGECRAFT_UNITY")


def settings_of(build):
    lines = (build / "CMakeCache.txt").read_text().splitlines()
    told = dict(re.match(r"(\w+):\w+=(.*)", line).groups() for line in lines if re.match(r"\w+:\w+=", line))
    return " ".join(f"-D{name}={told[name]}" for name in KEPT)


def test_a_wheel_is_built_and_works(tmp_path):
    # In the folder that has all of it compiled: another would take minutes, for the same.
    build = Path(os.environ["RIDGECRAFT_BINARY_DIR"])
    subprocess.run(
        ["sh", ROOT / "python" / "build_wheel.sh", tmp_path],
        check=True,
        env={**os.environ, "RIDGECRAFT_BUILD": str(build), "PYTHON": sys.executable, "CMAKE_ARGS": settings_of(build)},
    )
    (wheel,) = tmp_path.glob(f"ridgecraft-{ridgecraft.__version__}-*.whl")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path / "site")
    assert {"LICENSE", "__init__.py", "_core.pyi", "py.typed"} < {p.name for p in (tmp_path / "site" / "ridgecraft").iterdir()}
    told = subprocess.run(
        [sys.executable, "-c", "import ridgecraft; print(ridgecraft.__file__, len(ridgecraft.hulls("
         "[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])))"],
        check=True, capture_output=True, text=True, env={**os.environ, "PYTHONPATH": str(tmp_path / "site")},
    ).stdout.split()
    assert told == [str(tmp_path / "site" / "ridgecraft" / "__init__.py"), "1"]


def test_a_wheel_has_a_build_of_its_own_elsewhere(tmp_path):
    # Configured as setup.py does where nothing is built yet; the build itself would take minutes.
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DRIDGECRAFT_UNITY=ON", "-DRIDGECRAFT_PROGRAM=OFF", "-DRIDGECRAFT_PYTHON=ON"]
    assert all(option in (ROOT / "python" / "setup.py").read_text() for option in options)
    subprocess.run(["cmake", "-G", "Ninja", "-S", ROOT, "-B", tmp_path, f"-DPython_EXECUTABLE={sys.executable}", *options],
                   check=True, capture_output=True)
    told = subprocess.run(["ninja", "-C", tmp_path, "-t", "commands", "ridgecraft_python"], check=True, capture_output=True, text=True).stdout
    assert "python/background.cpp" in told and "ridgecraft_job" in told
