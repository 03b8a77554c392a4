# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes, and the program that the module is held against."""

import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

SAMPLES = Path(os.environ["RIDGECRAFT_SOURCE_DIR"]) / "samples"
PROGRAM = os.environ["RIDGECRAFT_PROGRAM"]


def told(*words):
    """What the program prints as JSON."""
    run = subprocess.run([PROGRAM, *map(str, words), "--json"], check=True, capture_output=True, text=True)
    return json.loads(run.stdout)


def read_obj(name):
    """Vertices and polygons of a sample, by a reader that shares nothing with the module."""
    vertices, faces = [], []
    for line in (SAMPLES / name).read_text().splitlines():
        words = line.split()
        if words and words[0] == "v":
            vertices.append([float(w) for w in words[1:4]])
        elif words and words[0] == "f":
            faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    return np.array(vertices), faces


def voxels(cells):
    """Unit cubes: the squares that only one of them has."""
    vertices, faces = {}, []
    cells = set(cells)
    for cell in sorted(cells):
        for axis in range(3):
            for side in (0, 1):
                there = list(cell)
                there[axis] += 2 * side - 1
                if tuple(there) in cells:
                    continue
                u, v = (axis + 1) % 3, (axis + 2) % 3
                square = []
                for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    corner = list(cell)
                    corner[axis] += side
                    corner[u] += a
                    corner[v] += b
                    square.append(vertices.setdefault(tuple(corner), len(vertices)))
                faces.append(square if side else square[::-1])
    return np.array(list(vertices), dtype=float), np.array(faces)


def volume(vertices, triangles):
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0)


@pytest.fixture
def cross():
    """Seven cubes: one in the middle, one on each of its sides."""
    return voxels([(0, 0, 0), (1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)])


@pytest.fixture
def tetrahedron():
    return np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]), np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])


@pytest.fixture
def cube():
    return voxels([(0, 0, 0)])


@pytest.fixture(scope="session")
def large():
    """A surface that takes seconds: a torus with waves, 40,000 triangles."""
    n, m = 200, 100
    i, j = np.meshgrid(np.arange(n), np.arange(m), indexing="ij")
    u, v = 2 * np.pi * i / n, 2 * np.pi * j / m
    r = 1.0 + 0.25 * np.sin(9 * u) * np.cos(7 * v)
    points = np.stack([(3 + r * np.cos(v)) * np.cos(u), (3 + r * np.cos(v)) * np.sin(u), r * np.sin(v)], axis=-1)
    a, b = i * m + j, ((i + 1) % n) * m + j
    c, d = ((i + 1) % n) * m + (j + 1) % m, i * m + (j + 1) % m
    faces = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
    return points.reshape(-1, 3), faces
