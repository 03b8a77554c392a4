# SPDX-License-Identifier: GPL-3.0-or-later
"""The example that draws runs as it stands, for models whose faces are triangles or of several kinds."""

import subprocess
import sys

import pytest
from conftest import SAMPLES

EXAMPLE = SAMPLES.parent / "examples" / "python" / "parts.py"


@pytest.mark.parametrize("name", ["whale.obj", "torus.off", "house.obj"])
def test_parts_are_drawn(name, tmp_path):
    picture = tmp_path / "parts.png"
    subprocess.run([sys.executable, EXAMPLE, SAMPLES / name, picture], check=True)
    assert picture.read_bytes().startswith(b"\x89PNG")
    from matplotlib.image import imread

    pixels = imread(picture)
    assert pixels.shape[:2] == (500, 1500)
    # Each third shows something.
    for third in range(3):
        assert pixels[:, 500 * third:500 * (third + 1), :3].min() < 0.8
