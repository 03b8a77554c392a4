# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads SVG files of machine presets by other libraries than the program's and says what is wrong with them.

usage: machine_svg.py [--inkscape] FILE...

Every closed path is a simple polygon, no path is shorter than 0.2 mm and no step of an outline than 0.05, no
stretch is there twice, operations come in the order of work, nothing lies outside the sheet. With --inkscape the
layer of outlines is where Inkscape finds it.
"""

import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

from shapely.geometry import LineString, Polygon

SVG = "{http://www.w3.org/2000/svg}"
ORDER = ["registration", "engrave", "mountain", "valley", "tab", "cut-inner", "cut"]
ROUNDING = 0.0005  # of four decimals, and some


def read(file):
    root = ElementTree.parse(file).getroot()
    box = [float(x) for x in root.get("viewBox").split()]
    found = []
    for group in root.iter(SVG + "g"):
        for path in group.iter(SVG + "path"):
            for part in re.findall("M[^M]*", path.get("d")):
                points = [tuple(map(float, p.split(","))) for p in re.findall(r"-?[\d.]+,-?[\d.]+", part)]
                found.append((group.get("id"), points, "Z" in part, float(path.get("stroke-width"))))
    return box, found


def collinear_overlap(one, other):
    (ax, ay), (bx, by) = one
    (cx, cy), (dx, dy) = other
    size = ((bx - ax) ** 2 + (by - ay) ** 2) ** 0.5
    ux, uy = (bx - ax) / size, (by - ay) / size
    beside = [ux * (y - ay) - uy * (x - ax) for x, y in other]
    if max(map(abs, beside)) > 0.005:
        return 0.0
    along = sorted(ux * (x - ax) + uy * (y - ay) for x, y in other)
    return min(size, along[1]) - max(0.0, along[0])


def check(file, with_inkscape):
    faults = []
    box, paths = read(file)
    places = [ORDER.index(layer) for layer, _, _, _ in paths]
    if not paths or places != sorted(places):
        faults.append("operations are out of order")
    sides = []
    cut = []
    for layer, points, closed, width in paths:
        ring = points + points[:1] if closed else points
        if LineString(ring).length < 0.2 - ROUNDING:
            faults.append(f"{layer}: a path of {LineString(ring).length:.4f} mm")
        if closed and not Polygon(points).is_valid:
            faults.append(f"{layer}: a path that crosses itself at {points[0]}")
        if closed and min(LineString(s).length for s in zip(ring, ring[1:])) < 0.05 - ROUNDING:
            faults.append(f"{layer}: a step below 0.05 mm")
        if any(not (box[0] <= x <= box[2] and box[1] <= y <= box[3]) for x, y in points):
            faults.append(f"{layer}: outside the sheet")
        if layer != "engrave":
            sides += list(zip(ring, ring[1:]))
        if layer == "cut":
            cut += [(x + s * width / 2, y + s * width / 2) for x, y in points for s in (-1, 1)]
    sides.sort(key=lambda s: min(s[0][0], s[1][0]))
    for i, one in enumerate(sides):
        right = max(one[0][0], one[1][0])
        for other in sides[i + 1 :]:
            if min(other[0][0], other[1][0]) > right + 0.01:
                break
            if collinear_overlap(one, other) > 0.05:
                faults.append(f"twice: {one} and {other}")
    if with_inkscape:
        told = subprocess.run(["inkscape", "--query-all", file], capture_output=True, text=True).stdout
        layer = [line.split(",")[1:] for line in told.splitlines() if line.startswith("cut,")]
        per_mm = 96 / 25.4
        low = [min(p[k] for p in cut) * per_mm for k in (0, 1)]
        size = [(max(p[k] for p in cut) - min(p[k] for p in cut)) * per_mm for k in (0, 1)]
        if not layer or any(abs(float(a) - b) > 1.5 for a, b in zip(layer[0], low + size)):
            faults.append(f"Inkscape finds the layer of outlines at {layer}, not at {low + size}")
    return faults


def main(words):
    with_inkscape = "--inkscape" in words
    failed = False
    for file in (w for w in words if w != "--inkscape"):
        for fault in check(file, with_inkscape):
            failed = True
            print(f"{file}: {fault}")
    return 1 if failed else 0


sys.exit(main(sys.argv[1:]))
