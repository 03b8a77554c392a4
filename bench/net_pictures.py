#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Nets before and now, as a picture: outlines, folds and tabs on their pages, a row for each model.

    bench/net_pictures.py PICTURE.png BEFORE NOW [MODEL ...]

BEFORE and NOW are folders of .fold files (bench/nets.py --keep FOLDER); MODEL are their names without .fold, all that
both folders have by default. Needs Pillow.
"""
import json
import pathlib
import sys

from PIL import Image, ImageDraw

SCALE = 0.56  # pixels a mm
GAP = 8
GROUPS_APART = 24
TITLE = 16
LETTER = 7  # about the width of one, pixels
FINER = 3  # drawn so many times as large, for smooth lines
PAPER, FACE, TAB, FOLD, CUT = "white", "#f2e9d8", "#d8d8d8", "#777777", "black"


def pages(path):
    """One picture for each page of a .fold file."""
    fold = json.loads(path.read_text())
    made = []
    for page in fold["ridgecraft:pages"]:
        size = [round(FINER * SCALE * side) for side in page["size"]]
        picture = Image.new("RGB", size, PAPER)
        made.append((picture, ImageDraw.Draw(picture), page))

    def points(number, ring):
        x, y = made[number][2]["origin"]
        height = made[number][2]["size"][1]
        return [(FINER * SCALE * (p[0] - x), FINER * SCALE * (height - p[1] + y)) for p in ring]

    xy = fold["vertices_coords"]
    page_of_piece = [piece["page"] for piece in fold["ridgecraft:pieces"]]
    face_page = [page_of_piece[piece] for piece in fold["ridgecraft:faces_piece"]]
    page_of_vertex = {v: p for ring, p in zip(fold["faces_vertices"], face_page) for v in ring}
    ends = fold["edges_vertices"]
    for tab in fold.get("ridgecraft:tabs", []):
        number = page_of_vertex[ends[tab["edge"]][0]]
        made[number][1].polygon(points(number, tab["polygon"]), fill=TAB, outline=FOLD)
    for ring, number in zip(fold["faces_vertices"], face_page):
        made[number][1].polygon(points(number, [xy[v] for v in ring]), fill=FACE)
    for kinds, color, width in ("MV", FOLD, 1), ("B", CUT, FINER):
        for (a, b), kind in zip(ends, fold["edges_assignment"]):
            if kind in kinds:
                number = page_of_vertex[a]
                made[number][1].line(points(number, [xy[a], xy[b]]), fill=color, width=width)
    small = []
    for picture, draw, _ in made:
        draw.rectangle([0, 0, picture.width - 1, picture.height - 1], outline="#bbbbbb", width=FINER)
        small.append(picture.resize((picture.width // FINER, picture.height // FINER), Image.LANCZOS))
    return small


def row(name, before, now):
    groups = [pages(before / f"{name}.fold"), pages(now / f"{name}.fold")]
    titles = [f"{name}: before", "now"]
    widths = [max(sum(p.width + GAP for p in group), LETTER * len(title)) for title, group in zip(titles, groups)]
    picture = Image.new("RGB", (sum(widths) + GROUPS_APART, TITLE + max(p.height for g in groups for p in g) + GAP), "white")
    draw = ImageDraw.Draw(picture)
    x = 0
    for title, width, group in zip(titles, widths, groups):
        draw.text((x + 2, 2), title, fill="black")
        at = x
        for page in group:
            picture.paste(page, (at, TITLE))
            at += page.width + GAP
        x += width + GROUPS_APART
    return picture


def main(arguments):
    if len(arguments) < 3:
        sys.exit(__doc__)
    before, now = map(pathlib.Path, arguments[1:3])
    names = arguments[3:] or sorted({p.stem for p in before.glob("*.fold")} & {p.stem for p in now.glob("*.fold")})
    rows = [row(name, before, now) for name in names]
    picture = Image.new("RGB", (max(r.width for r in rows), sum(r.height for r in rows)), "white")
    y = 0
    for part in rows:
        picture.paste(part, (0, y))
        y += part.height
    picture.quantize(48).save(arguments[0], optimize=True)


if __name__ == "__main__":
    main(sys.argv[1:])
