# SPDX-License-Identifier: GPL-3.0-or-later
"""Looks for the slits of nets in files for machines: each is an open cut of two points, there once, and in the operation
of cuts in a piece; nothing else is drawn along it.

usage: machine_slits.py NETS.fold FILE...

Files are SVG, DXF, LightBurn projects, EPS, HPGL and the PDF for packaging, of the same run as the nets; of files for
one page each the name ends in its number. Prints how many slits were found in each kind of file.
"""

import json
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from collections import Counter
from pathlib import Path

SVG = "{http://www.w3.org/2000/svg}"
EXACT = 0.001  # mm, of what is written with four decimals
NUMBER = r"-?[\d.]+(?:e-?\d+)?"


def slits_of(nets):
    """Of each page, from its lower left corner, and the page's height."""
    pages = [(page["origin"], page["size"], []) for page in nets["ridgecraft:pages"]]
    for tab in nets["ridgecraft:tabs"] + nets.get("ridgecraft:more_tabs", []):
        if "slit" not in tab:
            continue
        x, y = tab["slit"][0]
        for origin, size, slits in pages:
            if 0 <= x - origin[0] <= size[0] and 0 <= y - origin[1] <= size[1]:
                slits.append([(p[0] - origin[0], p[1] - origin[1]) for p in tab["slit"]])
    return [(size[1], slits) for _, size, slits in pages]


def svg_paths(file, height):
    for group in ElementTree.parse(file).getroot().iter(SVG + "g"):
        for path in group.iter(SVG + "path"):
            for part in re.findall("M[^M]*", path.get("d")):
                points = [tuple(map(float, p.split(","))) for p in re.findall(r"-?[\d.]+,-?[\d.]+", part)]
                yield group.get("id"), [(x, height - y) for x, y in points], "Z" in part


def dxf_paths(file, _):
    import ezdxf

    document = ezdxf.readfile(file)
    audit = document.audit()
    assert not audit.errors and not audit.fixes, (file, audit.errors, audit.fixes)
    names = {"CUT_INNER": "cut-inner", "ENGRAVE": "engrave"}
    for entity in document.modelspace():
        operation = names.get(entity.dxf.layer, entity.dxf.layer)
        if entity.dxftype() == "LINE":
            yield operation, [tuple(entity.dxf.start)[:2], tuple(entity.dxf.end)[:2]], False
        else:
            points = entity.get_points("xy") if entity.dxftype() == "LWPOLYLINE" else entity.points()
            yield operation, [tuple(p)[:2] for p in points], entity.is_closed


def lbrn_paths(file, _):
    names = {}
    root = ElementTree.parse(file).getroot()
    for setting in root.iter("CutSetting"):
        words = setting.find("name").get("Value")
        names[setting.find("index").get("Value")] = {"Holes and slits": "cut-inner", "Numbers": "engrave"}.get(words, words)
    for shape in root.iter("Shape"):
        text = shape.find("VertList").text
        points = [tuple(map(float, p)) for p in re.findall(rf"V({NUMBER}) ({NUMBER})c0x1c1x1", text)]
        yield names[shape.get("CutIndex")], points, shape.find("PrimList").text == "LineClosed"


def eps_paths(file, _):
    operation, points = None, []
    for line in Path(file).read_text().splitlines():
        words = line.split()
        if line.startswith("% "):
            operation = {"inner": "cut-inner", "numbers": "engrave"}.get(line[2:], line[2:])
        elif words[-1:] == ["moveto"]:
            points = [(float(words[0]), float(words[1]))]
        elif words[-1:] == ["lineto"]:
            points.append((float(words[0]), float(words[1])))
        elif line in ("stroke", "closepath stroke"):
            yield operation, points, line != "stroke"


def plt_paths(file, _):
    pen, points = 0, []
    for word in Path(file).read_text().replace("\n", "").split(";"):
        if word.startswith("SP"):
            pen = int(word[2:] or 0)
        elif word[:2] in ("PU", "PD") and len(word) > 2:
            read = [float(n) / 40 for n in word[2:].split(",")]
            if word.startswith("PU"):
                points = []
            points += list(zip(read[::2], read[1::2]))
            if word.startswith("PD"):
                yield "cut-inner" if pen == 2 else "score", points, points[0] == points[-1]


def pdf_paths(file):
    """Of each page."""
    text = subprocess.run(["qpdf", "--qdf", "--object-streams=disable", file, "-"], capture_output=True, check=True)
    text = text.stdout.decode("latin-1")
    names = {}
    for layer, number in re.findall(r"/(L\d) (\d+) 0 R", text):
        name = re.search(rf"\n{number} 0 obj\n.*?/Name \((\w+)\)", text, re.DOTALL)[1]
        names[layer] = {"Cut": "cut-inner", "Notes": "engrave", "Glue": "engrave"}.get(name, name)
    pages = []
    for content in re.findall(r"stream\n(/GS gs\n.*?)endstream", text, re.DOTALL):
        paths = []
        operation = None
        for line in content.splitlines():
            if line.startswith("/OC"):
                operation = names[line.split()[1][1:]]
            elif line.endswith(" S"):
                points = [tuple(map(float, p)) for p in re.findall(rf"({NUMBER}) ({NUMBER}) [ml]", line)]
                paths.append((operation, points, line.endswith("h S")))
        pages.append(paths)
    return pages


READERS = {".svg": svg_paths, ".dxf": dxf_paths, ".lbrn2": lbrn_paths, ".eps": eps_paths, ".plt": plt_paths}


def same(one, other, tolerance):
    return any(
        all(abs(a - b) <= tolerance for p, q in zip(one, way) for a, b in zip(p, q)) for way in (other, other[::-1])
    )


def overlap(one, other):
    """The length along which two segments lie on each other."""
    (ax, ay), (bx, by) = one
    size = ((bx - ax) ** 2 + (by - ay) ** 2) ** 0.5
    ux, uy = (bx - ax) / size, (by - ay) / size
    if max(abs(ux * (y - ay) - uy * (x - ax)) for x, y in other) > 0.05:
        return 0.0
    along = sorted(ux * (x - ax) + uy * (y - ay) for x, y in other)
    return min(size, along[1]) - max(0.0, along[0])


def faults_of(paths, slits, tolerance):
    faults = []
    paths = list(paths)
    for slit in slits:
        found = [(o, p, c) for o, p, c in paths if len(p) == 2 and same(slit, p, tolerance)]
        if len(found) != 1 or found[0][0] != "cut-inner" or found[0][2]:
            faults.append(f"the slit {slit} is there as {found}")
        for operation, points, closed in paths:
            if operation == "engrave" or (operation, points, closed) in found:
                continue
            ring = points + points[:1] if closed else points
            if any(overlap(slit, side) > 0.05 for side in zip(ring, ring[1:])):
                faults.append(f"along the slit {slit} there is another line of {operation}")
    return faults


def main(words):
    pages = slits_of(json.loads(Path(words[0]).read_text()))
    count = Counter()
    failed = False
    for file in words[1:]:
        kind = Path(file).suffix
        if kind == ".pdf":
            read = list(zip(pdf_paths(file), pages, strict=True))
        else:
            number = re.search(r"-(\d+)(-mm)?$", Path(file).stem)
            page = pages[int(number[1]) - 1 if number else 0]
            read = [(READERS[kind](file, page[0]), page)]
        for paths, (_, slits) in read:
            count[kind] += len(slits)
            # A step of a plotter is 0.025 mm.
            for fault in faults_of(paths, slits, 0.02 if kind == ".plt" else EXACT):
                failed = True
                print(f"{file}: {fault}")
    print(dict(count))
    return 1 if failed or not all(count.values()) else 0


sys.exit(main(sys.argv[1:]))
