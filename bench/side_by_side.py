#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of models beside what is made of them: the file, the paper model, the first page. Needs numpy, PIL, poppler's
pdftoppm, and the Python module (PYTHONPATH=build/test/python).

  side_by_side.py PROGRAM OUT.png MODEL... [-- options for the program]

Each model is a row. File and paper model are seen from the same side, from above at 25 degrees, and lit alike.
"""
import json, os, subprocess, sys, tempfile
import numpy as np
from PIL import Image, ImageDraw, ImageFont
import ridgecraft

SIDE = 420  # pixels of a picture's side
SHOWN_TURN = np.radians(-35.0)
SHOWN_TILT = np.radians(25.0)


def triangles_of(points, polygons):
    """Corners of triangles, fans of the polygons: n x 3 x 3."""
    fans = [(p[0], p[i], p[i + 1]) for p in polygons for i in range(1, len(p) - 1)]
    return np.asarray(points)[np.array(fans, dtype=int)]


def of_file(path):
    points, polygons = ridgecraft.read(path)
    return triangles_of(points, polygons)


def of_paper(fold):
    folded = next(f for f in fold["file_frames"] if "foldedForm" in f.get("frame_classes", []))
    faces = folded.get("faces_vertices", fold.get("faces_vertices"))
    return triangles_of(np.array(folded["vertices_coords"], dtype=float), faces)


def standing(triangles, up):
    """With this axis of the file as the third."""
    axes = {"x": (1, 2, 0), "y": (2, 0, 1), "z": (0, 1, 2)}[up]
    return triangles[:, :, axes]


def picture(triangles):
    """Flat shading, far faces first; both sides of a face are seen."""
    turn = np.array([[np.cos(SHOWN_TURN), -np.sin(SHOWN_TURN), 0], [np.sin(SHOWN_TURN), np.cos(SHOWN_TURN), 0], [0, 0, 1]])
    tilt = np.array([[1, 0, 0], [0, np.cos(SHOWN_TILT), -np.sin(SHOWN_TILT)], [0, np.sin(SHOWN_TILT), np.cos(SHOWN_TILT)]])
    seen = triangles @ (tilt @ turn).T  # x right, y away, z up
    low, high = seen.reshape(-1, 3).min(0), seen.reshape(-1, 3).max(0)
    scale = 0.92 * 2 * SIDE / max(high[0] - low[0], high[2] - low[2])
    middle = 0.5 * (low + high)
    normals = np.cross(seen[:, 1] - seen[:, 0], seen[:, 2] - seen[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    light = np.array([-0.45, -0.65, 0.6])
    shade = 0.35 + 0.65 * np.abs(normals @ (light / np.linalg.norm(light)))
    image = Image.new("RGB", (2 * SIDE, 2 * SIDE), "white")
    draw = ImageDraw.Draw(image)
    flat = np.stack([SIDE + scale * (seen[:, :, 0] - middle[0]), SIDE - scale * (seen[:, :, 2] - middle[2])], axis=2)
    for t in np.argsort(-seen[:, :, 1].mean(1)):
        tone = int(255 * min(1.0, shade[t]))
        draw.polygon([tuple(p) for p in flat[t]], fill=(tone, tone, min(255, tone + 8)))
    return image.resize((SIDE, SIDE), Image.LANCZOS)


def first_page(pdf, folder):
    subprocess.run(["pdftoppm", "-r", "110", "-l", "1", "-png", "-singlefile", pdf, f"{folder}/page"], check=True)
    page = Image.open(f"{folder}/page.png").convert("RGB")
    page.thumbnail((SIDE, SIDE), Image.LANCZOS)
    return page


def row_of(program, model, options):
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([program, model, *options, "--json", "-o", f"{folder}/x.fold", "-o", f"{folder}/x.pdf", "--no-guide"],
                              capture_output=True, text=True)
        told = json.loads(done.stdout) if done.returncode == 0 else {}
        row = Image.new("RGB", (3 * SIDE, SIDE + 26), "white")
        name = os.path.splitext(os.path.basename(model))[0]
        text = name if told else f"{name}: {done.stderr.strip().splitlines()[-1] if done.stderr.strip() else done.returncode}"
        if told:
            fold = json.load(open(f"{folder}/x.fold"))
            up = fold.get("ridgecraft:up", "z")
            text += f": {told['pieces']} pieces on {told['pages']} pages"
            row.paste(picture(standing(of_file(model), up)), (0, 26))
            row.paste(picture(standing(of_paper(fold), up)), (SIDE, 26))
            row.paste(first_page(f"{folder}/x.pdf", folder), (2 * SIDE + 60, 26))
        font = ImageFont.truetype("DejaVuSans.ttf", 17)
        ImageDraw.Draw(row).text((8, 3), text, fill="black", font=font)
        return row


def main():
    words = sys.argv[1:]
    options = words[words.index("--") + 1:] if "--" in words else []
    words = words[:words.index("--")] if "--" in words else words
    if len(words) < 3:
        sys.exit(__doc__)
    rows = [row_of(words[0], model, options) for model in words[2:]]
    sheet = Image.new("RGB", (3 * SIDE, sum(r.height for r in rows)), "white")
    top = 0
    for row in rows:
        sheet.paste(row, (0, top))
        top += row.height
    sheet.save(words[1])


main()
