# SPDX-License-Identifier: GPL-3.0-or-later
"""parts.py MODEL PICTURE.png: draws a model's nearly convex parts, their hulls, and the nets they unfold into.

The marks `# %%` make cells of it in editors that know notebooks.
"""

# %% A model: any arrays of points and faces would do.
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

import ridgecraft

vertices, faces = ridgecraft.read(sys.argv[1])

# %% Parts, a hull around each, and nets.
labels = ridgecraft.segment(vertices, faces, concavity=0.1)
hulls = ridgecraft.hulls(vertices, faces, concavity=0.1, max_vertices=64)
nets = ridgecraft.unfold(vertices, faces, size=150)

# %% What is drawn in which colour: parts and hulls have the same.
colours = plt.get_cmap("tab20")(np.arange(len(hulls)) % 20)


def draw_solid(axes, polygons, face_colours, title):
    """Polygons in space, lit from above, seen so that all axes have one scale."""
    normals = np.array([np.cross(p[1] - p[0], p[2] - p[0]) for p in polygons])
    sizes = np.linalg.norm(normals, axis=1)
    up = normals @ np.array([0.3, -0.5, 0.8]) / np.where(sizes > 0, sizes, 1)
    shade = (0.65 + 0.35 * up)[:, None]
    axes.add_collection3d(
        Poly3DCollection(polygons, facecolors=np.clip(face_colours[:, :3] * shade, 0, 1), edgecolors="none")
    )
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]), title=title)
    axes.set_box_aspect(high - low, zoom=1.4)
    axes.set_axis_off()


figure = plt.figure(figsize=(15, 5), layout="constrained")
draw_solid(
    figure.add_subplot(1, 3, 1, projection="3d"),
    [vertices[face] for face in faces],
    colours[np.maximum(labels, 0)],
    f"{len(hulls)} parts",
)
draw_solid(
    figure.add_subplot(1, 3, 2, projection="3d"),
    [triangle for points, triangles in hulls for triangle in points[triangles]],
    np.repeat(colours, [len(triangles) for _, triangles in hulls], axis=0),
    "their hulls",
)

# %% Each piece lies in a plane of its own: in rows, as text runs.
axes = figure.add_subplot(1, 3, 3)
x = y = row_height = 0.0
for piece in range(len(nets.piece_names)):
    flat = nets.flat[nets.piece == piece]
    low, high = flat.min(axis=(0, 1)), flat.max(axis=(0, 1))
    if x > 0 and x + high[0] - low[0] > 300:
        x, y, row_height = 0.0, y - row_height - 10, 0.0
    placed = flat - [low[0] - x, high[1] - y]
    axes.add_collection(PolyCollection(placed, facecolors="#f4efe6", edgecolors="#777777", linewidths=0.4))
    x += high[0] - low[0] + 10
    row_height = max(row_height, high[1] - low[1])
axes.autoscale_view()
axes.set_aspect("equal")
axes.set_axis_off()
axes.set_title(f"{len(nets.piece_names)} nets, mm")

figure.savefig(sys.argv[2], dpi=100)
