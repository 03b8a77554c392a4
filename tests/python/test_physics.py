# SPDX-License-Identifier: GPL-3.0-or-later
"""Hulls in CoACD's form, as physics engines take them: Debian's Bullet loads them (drop_hulls.cpp)."""

import os
import subprocess

import numpy as np
import pytest
from conftest import SAMPLES

import ridgecraft as coacd


def triangles_of(faces):
    return np.array([(face[0], face[k], face[k + 1]) for face in faces for k in range(1, len(face) - 1)])


def dropped(parts, points):
    """Shapes, points outside of them, speed at the end, height of the middle at the end."""
    lines = [str(len(parts))]
    for rows in [vertices for vertices, _ in parts] + [points]:
        lines.append(str(len(rows)))
        lines += [" ".join(map(repr, row)) for row in rows.tolist()]
    run = subprocess.run(
        [os.environ["RIDGECRAFT_DROP_HULLS"]], input="\n".join(lines), check=True, capture_output=True, text=True
    )
    shapes, outside, speed, height = run.stdout.split()
    return int(shapes), int(outside), float(speed), float(height)


@pytest.mark.parametrize("name", ["whale.obj", "mug.obj", "chess_rook.obj", "dinosaur.obj", "gem.stl", "torus.off"])
def test_bullet_takes_the_hulls(name):
    vertices, faces = coacd.read(SAMPLES / name)
    # Of the size of things that stand on a table, in metres, about their middle: what Bullet is made for.
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    vertices = (vertices - (low + high) / 2) / (high - low).max()
    mesh = coacd.Mesh(vertices, triangles_of(faces))
    parts = coacd.run_coacd(mesh, threshold=0.05, max_convex_hull=-1, decimate=True, max_ch_vertex=256)
    used = vertices[np.unique(mesh.indices)]
    shapes, outside, speed, height = dropped(parts, used)
    assert shapes == len(parts)
    assert outside == 0
    # It has come to rest, above the plane.
    assert speed < 0.05
    assert 0 < height < 1
    if len(parts) > 1:
        # Points are found outside where a hull is missing.
        assert dropped(parts[1:], used)[1] > 0
