#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Printed colours against the model's own. Needs numpy, Pillow and pdftoppm.

  refolded.py PROGRAM MODEL... [-- OPTION...]

Models are OBJ files, OFF files with colours of faces from 0 to 255, or PLY files as text with colours of faces or
vertices. Each model becomes pages, which are rendered at 300 dpi; the dots are led back to the model by the file of nets, which
folds it up again. Both that and the model as its own file has it are looked at from 50 sides, 200 pixels along their
longest, without light. Of pixels that show both: the mean difference (CIE 1976, sRGB under D65)

  flat     where the original has one colour within 1 mm, and no line or letter is printed
  all      wherever no line or letter is printed
  printed  with all lines and letters

Then seams: every half millimetre along cut edges whose face isn't nearly white, the dot 0.3 mm beyond the outline (the
line itself ends at 0.1) is looked at, unless another line is within 0.7 mm: colours end half-way to it. `slits` is the
share of these dots that are white, `longest` the longest run, mm.
"""
import json
import os
import subprocess
import sys
import tempfile

import numpy as np
from PIL import Image

DPI = 300
PER_MM = DPI / 25.4
SIDES = 50
PIXELS = 200
FLAT_MM = 1.0
BEYOND_MM = 0.3
NEXT_LINE_MM = np.arange(0.35, 0.7, 0.06)
STEP_MM = 0.5
Image.MAX_IMAGE_PIXELS = None


def lab(rgb):
    shown = np.asarray(rgb, float) / 255
    light = np.where(shown <= 0.04045, shown / 12.92, ((shown + 0.055) / 1.055) ** 2.4)
    xyz = light @ np.array([[0.4124, 0.2126, 0.0193], [0.3576, 0.7152, 0.1192], [0.1805, 0.0722, 0.9505]])
    t = xyz / np.array([0.9505, 1.0, 1.089])
    f = np.where(t > 216 / 24389, np.cbrt(t), (24389 / 27 * t + 16) / 116)
    return np.stack([116 * f[..., 1] - 16, 500 * (f[..., 0] - f[..., 1]), 200 * (f[..., 1] - f[..., 2])], -1)


def delta_e(a, b):
    return np.sqrt(((lab(a) - lab(b)) ** 2).sum(-1))


def read_materials(path):
    found, name = {}, None
    for line in open(path, encoding="utf-8", errors="replace"):
        words = line.split()
        if not words:
            continue
        if words[0] == "newmtl":
            name = words[1]
            found[name] = [np.array([255.0] * 3), None]
        elif words[0] == "Kd":
            found[name][0] = np.round(255 * np.array([float(w) for w in words[1:4]]))
        elif words[0] == "map_Kd":
            picture = os.path.join(os.path.dirname(path), words[-1])
            found[name][1] = np.asarray(Image.open(picture).convert("RGB"))
    return found


class Original:
    """Triangles with their colours: those of their corners, over which a face's picture lies where it has one."""

    def __init__(self, path):
        read = {".ply": read_ply, ".off": read_off}.get(os.path.splitext(path)[1], read_obj)
        self.triangles, self.shades, self.uvs, self.picture, self.pictures = read(path)

    def colours(self, face, weights):
        result = np.round((weights[:, :, None] * self.shades[face]).sum(1))
        for number, picture in enumerate(self.pictures):
            own = self.picture[face] == number
            uv = (weights[own][:, :, None] * self.uvs[face[own]]).sum(1)
            height, width = picture.shape[:2]
            x = np.floor(np.mod(uv[:, 0], 1.0000001) * width).astype(int).clip(0, width - 1)
            y = np.floor((1 - np.mod(uv[:, 1], 1.0000001)) * height).astype(int).clip(0, height - 1)
            result[own] = picture[y, x]
        return result


def read_obj(path):
    points, places, corners, uvs, materials, known, name = [], [], [], [], [], {}, None
    for line in open(path, encoding="utf-8", errors="replace"):
        words = line.split()
        if not words:
            continue
        if words[0] == "mtllib":
            known = read_materials(os.path.join(os.path.dirname(path), words[1]))
        elif words[0] == "v":
            points.append([float(w) for w in words[1:4]])
        elif words[0] == "vt":
            places.append([float(w) for w in words[1:3]])
        elif words[0] == "usemtl":
            name = words[1]
        elif words[0] == "f":
            polygon = []
            for word in words[1:]:
                numbers = [int(n) if n else 0 for n in word.split("/")] + [0]
                v = numbers[0] - 1 if numbers[0] > 0 else len(points) + numbers[0]
                t = numbers[1] - 1 if numbers[1] > 0 else len(places) + numbers[1] if numbers[1] else -1
                polygon.append((v, places[t] if t >= 0 else [0, 0]))
            for i in range(2, len(polygon)):
                three = [polygon[0], polygon[i - 1], polygon[i]]
                corners.append([v for v, _ in three])
                uvs.append([t for _, t in three])
                materials.append(name)
    of_faces = [known.get(name, [np.array([255.0] * 3), None]) for name in materials]
    pictures = [picture for _, picture in known.values() if picture is not None]
    number = [next((i for i, one in enumerate(pictures) if one is picture), -1) for _, picture in of_faces]
    shades = np.array([[colour] * 3 for colour, _ in of_faces])
    return np.array(points)[np.array(corners)], shades, np.array(uvs), np.array(number), pictures


def read_ply(path):
    lines = iter(open(path, encoding="utf-8", errors="replace"))
    elements, rows = [], {}
    for line in lines:
        words = line.split()
        if words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            elements[-1][2].append(words[-1])
        elif words[0] == "format" and words[1] != "ascii":
            raise SystemExit(path + ": only PLY files as text are read")
        elif words[0] == "end_header":
            break
    names = {name: properties for name, _, properties in elements}
    for name, count, _ in elements:
        rows[name] = [[float(word) for word in next(lines).split()] for _ in range(count)]

    def colour(row, properties):
        return [row[properties.index(part)] if part in properties else 255.0 for part in ("red", "green", "blue")]

    corners, shades = [], []
    for row in rows["face"]:
        size = int(row[0])
        # The list of corners comes first; behind it one value for each property.
        own = colour(row[size:], names["face"]) if "red" in names["face"] else None
        polygon = [int(v) for v in row[1:size + 1]]
        for i in range(2, size):
            three = [polygon[0], polygon[i - 1], polygon[i]]
            corners.append([rows["vertex"][v][:3] for v in three])
            shades.append([own or colour(rows["vertex"][v], names["vertex"]) for v in three])
    return without_pictures(corners, shades)


def read_off(path):
    rows = [line.split("#")[0].split() for line in open(path, encoding="utf-8", errors="replace")]
    rows = [row for row in rows if row][1:]
    points, faces = int(rows[0][0]), int(rows[0][1])
    places = [[float(word) for word in row[:3]] for row in rows[1:points + 1]]
    corners, shades = [], []
    for row in rows[points + 1:points + faces + 1]:
        size = int(row[0])
        own = [float(word) for word in row[size + 1:size + 4]] or [255.0] * 3
        polygon = [int(v) for v in row[1:size + 1]]
        for i in range(2, size):
            corners.append([places[v] for v in (polygon[0], polygon[i - 1], polygon[i])])
            shades.append([own] * 3)
    return without_pictures(corners, shades)


def without_pictures(corners, shades):
    none = np.full(len(corners), -1)
    return np.array(corners), np.array(shades), np.zeros((len(corners), 3, 2)), none, []


class Refolded:
    """Triangles of the folded model, and where each of them lies on the rendered pages."""

    def __init__(self, nets, pages, plain, lines):
        shape = nets["file_frames"][0]
        points = np.array(shape["vertices_coords"], float)
        flat = np.array(nets["vertices_coords"], float)[:, :2]
        self.triangles = points[np.array(shape["faces_vertices"])][np.array(nets["ridgecraft:faces_model"])]
        self.faces = np.array(nets["faces_vertices"])
        pieces = nets["ridgecraft:pieces"]
        self.page = np.array([pieces[p]["page"] for p in nets["ridgecraft:faces_piece"]])
        on_page = np.empty((len(self.faces), 3, 2))
        for number, sheet in enumerate(nets["ridgecraft:pages"]):
            own = self.page == number
            place = flat[self.faces[own]] - np.array(sheet["origin"])
            on_page[own, :, 0] = place[:, :, 0]
            on_page[own, :, 1] = sheet["size"][1] - place[:, :, 1]
        self.on_page, self.pages, self.plain, self.lines = on_page, pages, plain, lines

    def dots(self, pages, page, place):
        result = np.zeros((len(page),) + pages[0].shape[2:], pages[0].dtype)
        for number, picture in enumerate(pages):
            own = page == number
            x = np.floor(place[own, 0] * PER_MM).astype(int).clip(0, picture.shape[1] - 1)
            y = np.floor(place[own, 1] * PER_MM).astype(int).clip(0, picture.shape[0] - 1)
            result[own] = picture[y, x]
        return result

    def colours(self, face, weights):
        place = (weights[:, :, None] * self.on_page[face]).sum(1)
        return self.dots(self.pages, self.page[face], place), self.dots(self.lines, self.page[face], place)


def render(triangles, right, up, toward, middle, scale):
    """Of each pixel the nearest face (-1 for none, or for one seen from behind) and the weights of its corners."""
    face = np.full((PIXELS, PIXELS), -1)
    weights = np.zeros((PIXELS, PIXELS, 3))
    depth = np.full((PIXELS, PIXELS), -np.inf)
    moved = triangles - middle
    xs = (moved @ right) * scale + PIXELS / 2
    ys = PIXELS / 2 - (moved @ up) * scale
    zs = moved @ toward
    for i in range(len(triangles)):
        x, y, z = xs[i], ys[i], zs[i]
        doubled = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
        if abs(doubled) < 1e-9:
            continue
        low_x, high_x = max(int(x.min()), 0), min(int(x.max()) + 1, PIXELS)
        low_y, high_y = max(int(y.min()), 0), min(int(y.max()) + 1, PIXELS)
        if low_x >= high_x or low_y >= high_y:
            continue
        px = np.arange(low_x, high_x)[None, :] + 0.5
        py = np.arange(low_y, high_y)[:, None] + 0.5
        b = ((px - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (py - y[0])) / doubled
        c = ((x[1] - x[0]) * (py - y[0]) - (px - x[0]) * (y[1] - y[0])) / doubled
        inside = (b >= 0) & (c >= 0) & (b + c <= 1)
        at = z[0] + b * (z[1] - z[0]) + c * (z[2] - z[0])
        window = np.s_[low_y:high_y, low_x:high_x]
        nearer = inside & (at > depth[window])
        depth[window][nearer] = at[nearer]
        # The page's y points down: a face that is seen from its printed side turns clockwise here.
        face[window][nearer] = i if doubled < 0 else -1
        weights[window][nearer] = np.stack([1 - b - c, b, c], -1)[nearer]
    return face, weights


def sides():
    """Directions spread evenly over the sphere."""
    for i in range(SIDES):
        z = 1 - (2 * i + 1) / SIDES
        turn = i * np.pi * (3 - 5**0.5)
        toward = np.array([np.cos(turn) * (1 - z * z) ** 0.5, np.sin(turn) * (1 - z * z) ** 0.5, z])
        right = np.cross([0, 0, 1], toward)
        right /= np.linalg.norm(right)
        yield right, np.cross(toward, right), toward


def flat_pixels(shown, colours, radius):
    """Where all pixels around, as far as something is seen there, have one colour."""
    flat = shown.copy()
    in_lab = lab(colours)
    for dy in range(-radius, radius + 1):
        for dx in range(-radius, radius + 1):
            there = np.roll(in_lab, (dy, dx), (0, 1))
            differs = np.sqrt(((there - in_lab) ** 2).sum(-1)) > 1
            flat &= ~(differs & np.roll(shown, (dy, dx), (0, 1)))
    return flat


def compare(original, refolded):
    low, high = refolded.triangles.min((0, 1)), refolded.triangles.max((0, 1))
    own_low, own_high = original.triangles.min((0, 1)), original.triangles.max((0, 1))
    scale = (high - low).max() / (own_high - own_low).max()
    there = (original.triangles - (own_low + own_high) / 2) * scale + (low + high) / 2
    per_mm = PIXELS / np.linalg.norm(high - low)
    sums = {"flat": [], "all": [], "printed": []}
    for right, up, toward in sides():
        one, one_weights = render(there, right, up, toward, (low + high) / 2, per_mm)
        two, two_weights = render(refolded.triangles, right, up, toward, (low + high) / 2, per_mm)
        both = (one >= 0) & (two >= 0)
        wanted = np.zeros((PIXELS, PIXELS, 3))
        wanted[one >= 0] = original.colours(one[one >= 0], one_weights[one >= 0])
        found, has_line = np.zeros((PIXELS, PIXELS, 3)), np.zeros((PIXELS, PIXELS), bool)
        found[both], has_line[both] = refolded.colours(two[both], two_weights[both])
        off = delta_e(wanted, found)
        flat = flat_pixels(one >= 0, wanted, max(1, round(FLAT_MM * per_mm)))
        sums["flat"].append(off[both & flat & ~has_line])
        sums["all"].append(off[both & ~has_line])
        sums["printed"].append(off[both])
    return {name: float(np.concatenate(values).mean()) if sum(map(len, values)) else float("nan")
            for name, values in sums.items()}


def seams(nets, refolded):
    """Share and longest run, mm, of white dots beyond cut edges of faces that aren't white."""
    borders = {tuple(sorted(edge)) for edge, letter in zip(nets["edges_vertices"], nets["edges_assignment"])
               if letter == "B"}
    looked_at, white, longest = 0, 0, 0.0
    for face, corners in enumerate(refolded.faces):
        for k in range(3):
            if tuple(sorted((int(corners[k]), int(corners[(k + 1) % 3])))) not in borders:
                continue
            a, b, c = (refolded.on_page[face, (k + i) % 3] for i in range(3))
            size = np.linalg.norm(b - a)
            if size < 2:
                continue
            along = (b - a) / size
            outwards = np.array([along[1], -along[0]])
            outwards *= -1 if outwards @ (c - a) > 0 else 1
            run = 0.0
            for at in np.arange(1, size - 1, STEP_MM):
                page = np.array([refolded.page[face]])
                def dot(pictures, away):
                    return refolded.dots(pictures, page, (a + at * along + away * outwards)[None])[0]

                inside, beyond = (dot(refolded.pages, away) for away in (-BEYOND_MM, BEYOND_MM))
                in_gap = any(dot(refolded.plain, away).min() < 250 for away in NEXT_LINE_MM)
                if in_gap or delta_e(inside, [255] * 3) < 10:
                    run = 0.0
                    continue
                looked_at += 1
                is_white = delta_e(beyond, [255] * 3) < 3
                white += is_white
                run = run + STEP_MM if is_white else 0.0
                longest = max(longest, run)
    return white / max(looked_at, 1), longest, looked_at


def printed(program, model, ink, options, folder):
    name = os.path.join(folder, ink)
    subprocess.run([program, model, "-o", name + ".pdf", "-o", name + ".fold", "--no-guide", "--ink", ink, *options],
                   check=True, capture_output=True)
    subprocess.run(["pdftoppm", "-r", str(DPI), "-png", name + ".pdf", name], check=True)
    files = sorted(f for f in os.listdir(folder) if f.startswith(ink + "-") and f.endswith(".png"))
    return name + ".fold", [np.asarray(Image.open(os.path.join(folder, f)).convert("RGB")) for f in files]


def measure(program, model, options):
    with tempfile.TemporaryDirectory() as folder:
        fold, pages = printed(program, model, "colour", options, folder)
        _, plain = printed(program, model, "lines", options, folder)
        nets = json.load(open(fold))
    lines = []
    for page in plain:
        dark = page.min(-1) < 250
        for _ in range(3):  # with the rims that lines have on colours
            dark = dark | np.roll(dark, 1, 0) | np.roll(dark, -1, 0)
            dark = dark | np.roll(dark, 1, 1) | np.roll(dark, -1, 1)
        lines.append(dark)
    refolded = Refolded(nets, pages, plain, lines)
    return compare(Original(model), refolded), seams(nets, refolded)


def main(words):
    options = words[words.index("--") + 1:] if "--" in words else []
    words = words[:words.index("--")] if "--" in words else words
    program, models = words[0], words[1:]
    print("| model | flat | all | printed | slits | longest |\n|---|---|---|---|---|---|")
    for model in models:
        colours, (share, longest, count) = measure(program, model, options)
        print(f"| {os.path.splitext(os.path.basename(model))[0]} | {colours['flat']:.2f} | {colours['all']:.2f} | "
              f"{colours['printed']:.2f} | {100 * share:.2f} % of {count} | {longest:.1f} |", flush=True)


main(sys.argv[1:])
