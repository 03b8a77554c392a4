#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What rolling paper saves: one table, each model with each way of --rolled.

    bench/rolled.py MODELS... [--program build/release/ridgecraft] [--solids] [--ways never,auto] [-- OPTIONS]

MODELS are files or folders; --solids adds a cylinder, a cone and a sphere of fine facets, 150 mm high. Options behind --
go to the program. Figures of nets are those of bench/nets.py; distances need ../shared/check. Needs numpy.

    pieces, seam (m)
    folds    length of the folds that are drawn and folded, m; creases: those of 20 degrees and more, m
    bends    length of the rulings that are rolled, m
    rims     chains of seams whose edges are rims of rolled paper: they have teeth
    mean, max  distance from points of the file's surface to the paper model, % of the diagonal
    normals  mean angle between the normals of both there, degrees
    cpu      seconds of the processor
"""
import argparse
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

import numpy as np

import likeness
import nets

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.append(str(ROOT.parent / "shared/check"))
COLUMNS = ("pieces", "seam", "folds", "creases", "bends", "rims", "mean", "max", "normals", "cpu")
CREASE_DEG = 20.0
SAMPLES = 4000


def turned(profile, sides):
    """A closed body as OFF: a profile of (radius, height) around the z axis; radius 0 is a point of the axis."""
    rings, points, faces = [], [], []
    for radius, height in profile:
        count = sides if radius > 0 else 1
        rings.append([len(points) + i for i in range(count)])
        points += [(radius * math.cos(2 * math.pi * i / sides), radius * math.sin(2 * math.pi * i / sides), height)
                   for i in range(count)]
    for low, high in zip(rings, rings[1:]):
        for i in range(sides):
            a, b = low[i % len(low)], low[(i + 1) % len(low)]
            c, d = high[(i + 1) % len(high)], high[i % len(high)]
            faces += [f for f in ((a, b, c), (a, c, d)) if len(set(f)) == 3]
    lines = [f"OFF\n{len(points)} {len(faces)} 0"] + ["%.9g %.9g %.9g" % p for p in points] + ["3 %d %d %d" % f for f in faces]
    return "\n".join(lines) + "\n"


def solids(folder):
    """Files of bodies whose rolled form is known."""
    ball = [(75 * math.sin(math.pi * i / 32), -75 * math.cos(math.pi * i / 32)) for i in range(33)]
    ball[0], ball[-1] = (0, -75), (0, 75)
    bodies = {"cylinder": [(0, 0), (40, 0), (40, 150), (0, 150)], "cone": [(0, 0), (50, 0), (0, 150)], "sphere": ball}
    for name, profile in bodies.items():
        (folder / f"{name}.off").write_text(turned(profile, 64), encoding="utf-8")
    return [folder / f"{name}.off" for name in bodies]


def of_folds(fold):
    """Folds, creases and bends, m, and rims of rolled paper."""
    whole = nets.Nets(fold)
    bent = fold.get("edges_ridgecraft:bent") or [False] * len(whole.ends)
    row = dict.fromkeys(("folds", "creases", "bends"), 0.0)
    for edge, (way, angle) in enumerate(zip(fold["edges_assignment"], fold["edges_foldAngle"])):
        if way not in "MV" or not angle:
            continue
        row["bends" if bent[edge] else "folds"] += 0.001 * whole.length(edge)
        if not bent[edge] and abs(angle) >= CREASE_DEG:
            row["creases"] += 0.001 * whole.length(edge)
    rolled = {v for edge, is_bent in enumerate(bent) if is_bent for v in whole.ends[edge]}
    row["rims"] = sum(
        1 for chain in fold.get("ridgecraft:chains", [])
        if any(set(whole.ends[e]) <= rolled for j in chain["joins"] for e in whole.joins[j]["edges"]))
    return row


def from_model(fold, model):
    """Mean and largest distance, % of the diagonal, and the mean angle of normals, degrees."""
    import buildable
    points, rings = buildable.read_faces(str(model))
    faces = np.array([(f[0], f[k], f[k + 1]) for f in rings for k in range(1, len(f) - 1)])
    frame = next(f for f in fold["file_frames"] if "foldedForm" in f["frame_classes"])
    paper = np.array(frame["vertices_coords"], float)
    sides = np.array([(f[0], f[k], f[k + 1]) for f in frame["faces_vertices"] for k in range(1, len(f) - 1)])
    used = points[np.unique(faces)]
    scale = np.ptp(paper, axis=0).max() / np.ptp(used, axis=0).max()
    moved = (points - 0.5 * (used.min(0) + used.max(0))) * scale + 0.5 * (paper.min(0) + paper.max(0))
    at, normals = likeness.sample(moved, faces, SAMPLES, np.random.default_rng(1))
    found = likeness.nearest_faces(paper, sides, at)
    off = 100.0 * likeness.distances(paper, sides[found], at) / np.linalg.norm(np.ptp(paper, axis=0))
    there = likeness.normals_and_areas(paper, sides)[0][found]
    angles = np.degrees(np.arccos(np.clip((normals * there).sum(1), -1.0, 1.0)))
    return {"mean": float(off.mean()), "max": float(off.max()), "normals": float(angles.mean())}


def measure(program, model, way, options):
    """A row of figures, or what the program said instead."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "nets.fold"
        with open(pathlib.Path(folder) / "said", "w+", encoding="utf-8") as said:
            process = subprocess.Popen([program, str(model), "-o", str(file), "--rolled", way, "--threads", "1", *options],
                                       stdout=subprocess.DEVNULL, stderr=said)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            said.seek(0)
            if process.returncode != 0:
                return (said.read().strip().splitlines() or ["failed"])[-1]
        fold = json.loads(file.read_text(encoding="utf-8"))
    row = {"pieces": len(fold["ridgecraft:pieces"]), "seam": nets.seam_figures(nets.Nets(fold))["seam"]}
    return row | of_folds(fold) | from_model(fold, model) | {"cpu": usage.ru_utime + usage.ru_stime}


def line(name, way, row):
    return f"{name[:26]:27}{way:>7}" + "".join(f"{row[c]:>9.0f}" if c in ("pieces", "rims") else f"{row[c]:>9.2f}"
                                               for c in COLUMNS)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="*", type=pathlib.Path)
    parser.add_argument("--program", default="build/release/ridgecraft")
    parser.add_argument("--solids", action="store_true")
    parser.add_argument("--ways", default="never,auto")
    arguments = sys.argv[1:]
    own = arguments[:arguments.index("--")] if "--" in arguments else arguments
    options = arguments[len(own) + 1:]
    asked = parser.parse_args(own)
    rows = {way: [] for way in asked.ways.split(",")}
    print("model".ljust(27) + "rolled".rjust(7) + "".join(f"{c:>9}" for c in COLUMNS))
    with tempfile.TemporaryDirectory() as folder:
        models = solids(pathlib.Path(folder)) if asked.solids else []
        models += [m for given in asked.models for m in (sorted(given.iterdir()) if given.is_dir() else [given])
                   if m.suffix in nets.SUFFIXES]
        for model in models:
            for way, of_way in rows.items():
                row = measure(asked.program, model, way, options)
                print(f"{model.name}: {row}" if isinstance(row, str) else line(model.name, way, row), flush=True)
                if not isinstance(row, str):
                    of_way.append(row)
    for way, of_way in rows.items():
        print(line(f"mean of {len(of_way)}", way, {c: statistics.fmean(r[c] for r in of_way) for c in COLUMNS}))


if __name__ == "__main__":
    main()
