#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether simplification keeps mirror planes. Needs numpy.

  partners.py FOLDER [OTHER]

FOLDER holds pairs NAME.before.obj and NAME.obj in mm, as bench_simplify --obj FOLDER writes them; OTHER the NAME.obj
of another program or of other options, to compare with. A model counts as mirrored at a plane across an axis, through
the middle of its box, when the image of each of its corners is within 0.05 mm of one. For each such plane: the share
of the corners of the result whose image is within 0.5 mm of one, and the farthest.
"""
import glob, os, sys
import numpy as np
from likeness import read_obj

SAME_MM = 0.05
PARTNER_MM = 0.5


def partner_distances(points, axis, middle):
    """Of each point, how far its mirror image is from the nearest one."""
    image = points.copy()
    image[:, axis] = 2 * middle - image[:, axis]
    found = np.empty(len(points))
    for i in range(0, len(points), 256):
        found[i:i + 256] = np.sqrt(((image[i:i + 256, None] - points[None]) ** 2).sum(-1).min(1))
    return found


def corners(path):
    points, faces = read_obj(path)
    return points[np.unique(faces)]


def main(folders):
    kept, planes = [0] * len(folders), 0
    for path in sorted(glob.glob(os.path.join(folders[0], "*.before.obj"))):
        name = os.path.basename(path)[:-len(".before.obj")]
        before = corners(path)
        after = [corners(os.path.join(folder, name + ".obj")) for folder in folders]
        for axis in range(3):
            middle = (before[:, axis].min() + before[:, axis].max()) / 2
            if partner_distances(before, axis, middle).max() > SAME_MM:
                continue
            planes += 1
            cells = "%-36.36s %s %6d" % (name, "xyz"[axis], len(before))
            for i, points in enumerate(after):
                d = partner_distances(points, axis, middle)
                kept[i] += d.max() <= PARTNER_MM
                cells += "   %5d %6.1f %% %8.3f mm" % (len(points), 100 * (d <= PARTNER_MM).mean(), d.max())
            print(cells, flush=True)
    print("planes kept: %s of %d" % (", ".join(map(str, kept)), planes))


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(sys.argv[1:])
