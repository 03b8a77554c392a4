# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces as arrays of points and of faces: points drawn from one, and the nearest faces of another. Needs numpy."""
import numpy as np


def normals_and_areas(points, faces):
    a, b, c = (points[faces[:, k]] for k in range(3))
    n = np.cross(b - a, c - a)
    size = np.linalg.norm(n, axis=1)
    return n / np.maximum(size, 1e-300)[:, None], 0.5 * size


def sample(points, faces, count, random):
    n, area = normals_and_areas(points, faces)
    f = random.choice(len(faces), count, p=area / area.sum())
    u, v = random.random(count), random.random(count)
    flip = u + v > 1.0
    u[flip], v[flip] = 1.0 - u[flip], 1.0 - v[flip]
    a, b, c = (points[faces[f, k]] for k in range(3))
    return a + u[:, None] * (b - a) + v[:, None] * (c - a), n[f]


def nearest_faces(points, faces, queries):
    """Of each query the nearest face: all triangles tried (Ericson, Real-Time Collision Detection, 5.1.5)."""
    a, b, c = (points[faces[:, k]] for k in range(3))
    ab, ac = b - a, c - a
    d00, d01, d11 = (ab * ab).sum(1), (ab * ac).sum(1), (ac * ac).sum(1)
    det = np.maximum(d00 * d11 - d01 * d01, 1e-300)

    def to_segment(p, s, d):
        t = np.clip(((p - s) * d).sum(-1) / np.maximum((d * d).sum(-1), 1e-300), 0.0, 1.0)
        r = p - s - t[..., None] * d
        return (r * r).sum(-1)

    found = np.empty(len(queries), int)
    chunk = max(1, 400000 // len(faces))
    for i in range(0, len(queries), chunk):
        p = queries[i:i + chunk, None, :]
        ap = p - a
        e, f = (ap * ab).sum(-1), (ap * ac).sum(-1)
        v, w = (d11 * e - d01 * f) / det, (d00 * f - d01 * e) / det
        r = ap - v[..., None] * ab - w[..., None] * ac
        inside = (v >= 0) & (w >= 0) & (v + w <= 1)
        edge = np.minimum(np.minimum(to_segment(p, a, ab), to_segment(p, a, ac)), to_segment(p, b, c - b))
        found[i:i + chunk] = np.where(inside, (r * r).sum(-1), edge).argmin(1)
    return found


def distances(points, triangles, queries):
    """Of each query how far it is from the triangle of the same row."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    n, _ = normals_and_areas(points, triangles)
    height = np.abs(((queries - a) * n).sum(1))

    def beyond(s, e):
        return (np.cross(e - s, queries - s) * n).sum(1) < 0.0

    def to_segment(s, e):
        d = e - s
        t = np.clip(((queries - s) * d).sum(1) / np.maximum((d * d).sum(1), 1e-300), 0.0, 1.0)
        return np.linalg.norm(queries - s - t[:, None] * d, axis=1)

    outside = beyond(a, b) | beyond(b, c) | beyond(c, a)
    edges = np.minimum(np.minimum(to_segment(a, b), to_segment(b, c)), to_segment(c, a))
    return np.where(outside, edges, height)
