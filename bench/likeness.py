#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much simplified models look like the models that they were made of. Needs numpy.

  likeness.py FOLDER [OTHER]

FOLDER holds pairs NAME.before.obj and NAME.obj as bench_simplify --obj FOLDER writes them; OTHER the NAME.obj of
another program or of other options, to compare with. For each: the mean angle between the normals of both surfaces at
10,000 points of the original (each with the nearest point of the other), and the share by which the silhouettes from
26 sides differ: pixels in one only, over pixels in either. Smaller is more alike.
"""
import glob, os, sys
import numpy as np

POINTS = 10000
PIXELS = 160


def read_obj(path):
    points, faces = [], []
    with open(path) as f:
        for line in f:
            w = line.split()
            if w[:1] == ["v"]:
                points.append([float(x) for x in w[1:4]])
            elif w[:1] == ["f"]:
                faces.append([int(x.split("/")[0]) - 1 for x in w[1:4]])
    return np.array(points), np.array(faces)


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


def normal_angle(before, after):
    at, n = sample(*before, POINTS, np.random.default_rng(1))
    m = normals_and_areas(*after)[0][nearest_faces(*after, at)]
    return np.degrees(np.arccos(np.clip((n * m).sum(1), -1.0, 1.0))).mean()


def directions():
    steps = (-1, 0, 1)
    return [np.array([x, y, z]) / np.linalg.norm([x, y, z]) for x in steps for y in steps for z in steps if (x, y, z) != (0, 0, 0)]


def silhouette(points, faces, direction, middle, scale):
    """Mask of the pixels that any triangle covers: rows of each triangle filled from side to side."""
    up = np.eye(3)[np.abs(direction).argmin()]
    x_axis = np.cross(up, direction)
    x_axis /= np.linalg.norm(x_axis)
    y_axis = np.cross(direction, x_axis)
    flat = np.stack([(points - middle) @ x_axis, (points - middle) @ y_axis], 1) * scale + PIXELS / 2
    t = flat[faces]
    covered = np.zeros((PIXELS, PIXELS + 1), int)
    low = np.maximum(np.ceil(t[:, :, 1].min(1) - 0.5).astype(int), 0)
    high = np.minimum(np.floor(t[:, :, 1].max(1) - 0.5).astype(int), PIXELS - 1)
    rows = high - low + 1
    keep = rows > 0
    f = np.repeat(np.nonzero(keep)[0], rows[keep])
    first = np.repeat(np.cumsum(rows[keep]) - rows[keep], rows[keep])
    row = low[f] + np.arange(len(f)) - first
    y = row + 0.5
    left, right = np.full(len(f), np.inf), np.full(len(f), -np.inf)
    for k in range(3):
        p, q = t[f, k], t[f, (k + 1) % 3]
        d = q[:, 1] - p[:, 1]
        with np.errstate(divide="ignore", invalid="ignore"):
            s = (y - p[:, 1]) / d
            x = p[:, 0] + s * (q[:, 0] - p[:, 0])
        hit = (d != 0) & (s >= 0) & (s <= 1)
        left[hit] = np.minimum(left[hit], x[hit])
        right[hit] = np.maximum(right[hit], x[hit])
    start = np.clip(np.ceil(np.where(np.isfinite(left), left, 0) - 0.5).astype(int), 0, PIXELS)
    end = np.clip(np.floor(np.where(np.isfinite(right), right, -1) - 0.5).astype(int) + 1, 0, PIXELS)
    some = end > start
    np.add.at(covered, (row[some], start[some]), 1)
    np.add.at(covered, (row[some], end[some]), -1)
    return np.cumsum(covered, 1)[:, :PIXELS] > 0


def silhouette_difference(before, after):
    low, high = before[0].min(0), before[0].max(0)
    middle, scale = (low + high) / 2, 0.9 * PIXELS / np.linalg.norm(high - low)
    one, either = 0, 0
    for d in directions():
        a, b = (silhouette(*m, d, middle, scale) for m in (before, after))
        one += (a ^ b).sum()
        either += (a | b).sum()
    return one / either


def main(folders):
    print("%-36s %6s %9s %9s" % ("model", "faces", "normals", "outlines") +
          ("   %6s %9s %9s" % ("faces", "normals", "outlines") if len(folders) > 1 else ""))
    for path in sorted(glob.glob(os.path.join(folders[0], "*.before.obj"))):
        name = os.path.basename(path)[:-len(".before.obj")]
        before = read_obj(path)
        cells = "%-36.36s" % name
        for folder in folders:
            after = read_obj(os.path.join(folder, name + ".obj"))
            cells += " %6d %7.2f°  %7.2f %%  " % (len(after[1]), normal_angle(before, after),
                                                 100 * silhouette_difference(before, after))
        print(cells, flush=True)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(sys.argv[1:])
