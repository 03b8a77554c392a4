#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The shape of the nets that the program makes by default: one table, medians of a few seeds.

    bench/nets.py MODELS... [--program build/release/ridgecraft] [--seeds 3] [--jobs 1] [--against FIGURES.json]
                  [--json FIGURES.json] [--keep FOLDER] [-- OPTIONS]

MODELS are files or folders. Options behind -- go to the program. --against prints the means of an earlier run below
those of this one; --keep leaves the .fold files of the first seed in a folder. Needs numpy.

    pieces, pages
    round   perimeter^2 / (4 pi area) of the pieces without their tabs, weighted by area: 1 for a disk
    fill    area of the pieces / area of their convex hulls
    slits   share of the seam that opens by less than 20 degrees
    mirror  on symmetric models: share of the seam whose mirror image is a seam
    seam    length of all joins, m; bare: without a tab; weak: with none, or one that is lower than 3 mm along more
            than half of the edge
    necks   folds that are three times narrower than what hangs on them is wide
    care    pieces for which no order of folding was found
    linear  share of the pieces that fold with all creases together
    cpu     seconds of the processor
"""
import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

import numpy as np

SUFFIXES = {".obj", ".off", ".ply", ".stl"}
COLUMNS = ("pieces", "pages", "round", "fill", "slits", "mirror", "seam", "bare", "weak", "necks", "care", "linear",
           "cpu")
SLIT_DEG = 20.0
TAB_MM = 2.999  # 3, but for what the file rounds
NECK_RATIO = 3.0
# A model counts as symmetric when so many of its corners have a mirror image within this share of its size.
MIRRORED_CORNERS = 0.9
CORNER_OFF = 0.02
SEAM_OFF = 0.015


class Nets:
    """A .fold file with its sides: who lies behind which, and in which piece."""

    def __init__(self, fold):
        self.fold = fold
        self.xy = np.array(fold["vertices_coords"], float)[:, :2]
        self.faces = fold["faces_vertices"]
        self.piece = fold["ridgecraft:faces_piece"]
        self.ends = fold["edges_vertices"]
        self.tabs = fold.get("ridgecraft:tabs", [])
        self.joins = fold.get("ridgecraft:joins", [])
        self.face_at = {}
        for number, ring in enumerate(self.faces):
            for k, start in enumerate(ring):
                self.face_at[start, ring[(k + 1) % len(ring)]] = number, k

    def area(self, face):
        ring = self.xy[self.faces[face]]
        beyond = np.roll(ring, -1, axis=0)
        return 0.5 * float(np.sum(ring[:, 0] * beyond[:, 1] - beyond[:, 0] * ring[:, 1]))

    def length(self, edge):
        a, b = self.ends[edge]
        return float(np.linalg.norm(self.xy[a] - self.xy[b]))

    def owner(self, edge):
        """The face that an edge of an outline belongs to, with the number of its side."""
        a, b = self.ends[edge]
        return self.face_at.get((a, b)) or self.face_at[b, a]


def hull_area(points):
    points = sorted(set(map(tuple, points)))

    def chain(ordered):
        kept = []
        for p in ordered:
            while len(kept) > 1:
                (ax, ay), (bx, by) = kept[-2], kept[-1]
                if (bx - ax) * (p[1] - ay) - (by - ay) * (p[0] - ax) > 0:
                    break
                kept.pop()
            kept.append(p)
        return kept[:-1]

    ring = np.array(chain(points) + chain(points[::-1]))
    beyond = np.roll(ring, -1, axis=0)
    return 0.5 * float(np.sum(ring[:, 0] * beyond[:, 1] - beyond[:, 0] * ring[:, 1]))


def shape_figures(nets):
    count = max(nets.piece) + 1
    area, outline, points = [0.0] * count, [0.0] * count, [[] for _ in range(count)]
    for number, ring in enumerate(nets.faces):
        piece = nets.piece[number]
        area[piece] += nets.area(number)
        points[piece].extend(nets.xy[v] for v in ring)
        for k, a in enumerate(ring):
            b = ring[(k + 1) % len(ring)]
            if (b, a) not in nets.face_at:
                outline[piece] += float(np.linalg.norm(nets.xy[a] - nets.xy[b]))
    whole = sum(area)
    return {"pieces": count, "pages": len(nets.fold.get("ridgecraft:pages", [])),
            "round": sum(o * o for o in outline) / (4.0 * math.pi * whole),
            "fill": whole / sum(hull_area(p) for p in points)}


def opening(nets, one, other):
    """The angle, in degrees, by which two edges open that meet in one vertex of the net; none where they don't."""
    shared = set(nets.ends[one]) & set(nets.ends[other])
    if len(shared) != 1:
        return None
    at = shared.pop()
    arms = [nets.xy[(set(nets.ends[e]) - {at}).pop()] - nets.xy[at] for e in (one, other)]
    turn = math.atan2(arms[0][0] * arms[1][1] - arms[0][1] * arms[1][0], float(arms[0] @ arms[1]))
    return abs(math.degrees(turn))


def holds(nets, tab):
    """Is a tab 3 mm high along half of the edges that it serves?"""
    ring = np.array(tab["polygon"], float)[:, :2]
    base = ring[1] - ring[0]
    size = float(np.linalg.norm(base))
    if size == 0.0:
        return False
    along = (ring - ring[0]) @ (base / size)
    high = np.abs((ring - ring[0]) @ np.array([-base[1], base[0]]) / size)
    crossings = []
    for k in range(len(ring)):
        low, top = high[k] - TAB_MM, high[(k + 1) % len(ring)] - TAB_MM
        if low * top <= 0.0 and low != top:
            crossings.append(along[k] + low / (low - top) * (along[(k + 1) % len(ring)] - along[k]))
    wanted = sum(nets.length(e) for e in tab.get("edges", [tab["edge"]] if "edge" in tab else []))
    return bool(crossings) and max(crossings) - min(crossings) >= 0.5 * wanted - 1e-6


def seam_figures(nets):
    seam = bare = weak = slits = 0.0
    for join in nets.joins:
        one, other = join["edges"]
        long = nets.length(one)
        seam += long
        tab = join.get("tab")
        bare += long if tab is None else 0.0
        weak += long if tab is None or not holds(nets, nets.tabs[tab]) else 0.0
        if nets.piece[nets.owner(one)[0]] == nets.piece[nets.owner(other)[0]]:
            angle = opening(nets, one, other)
            slits += long if angle is not None and angle < SLIT_DEG else 0.0
    return {"seam": seam / 1000.0, "bare": bare / 1000.0, "weak": weak / 1000.0, "slits": slits / seam if seam else 0.0}


def count_necks(nets):
    """Folds behind which hangs something three times as wide as they are long."""
    beside = [[] for _ in nets.faces]
    for (a, b), (face, _) in nets.face_at.items():
        if (b, a) in nets.face_at:
            beside[face].append((nets.face_at[b, a][0], float(np.linalg.norm(nets.xy[a] - nets.xy[b]))))
    seen, necks = [False] * len(nets.faces), 0
    for root in range(len(nets.faces)):
        if seen[root]:
            continue
        order, above = [root], {root: None}
        seen[root] = True
        for face in order:
            for other, long in beside[face]:
                if not seen[other]:
                    seen[other] = True
                    above[other] = face, long
                    order.append(other)
        behind = {face: nets.area(face) for face in order}
        for face in reversed(order[1:]):
            behind[above[face][0]] += behind[face]
        for face in order[1:]:
            width = math.sqrt(max(0.0, min(behind[face], behind[root] - behind[face])))
            necks += width > NECK_RATIO * above[face][1]
    return necks


def mirror_share(nets):
    frame = next((f for f in nets.fold.get("file_frames", []) if "foldedForm" in f.get("frame_classes", [])), None)
    if frame is None or not nets.joins:
        return None
    points = np.array(frame["vertices_coords"], float)
    faces = frame["faces_vertices"]
    corners = points[sorted({v for ring in faces for v in ring})]
    size = float(np.ptp(corners, axis=0).max())
    middles = np.array([points[ring].mean(axis=0) for ring in faces])
    areas = np.array([0.5 * np.linalg.norm(np.cross(points[r[1]] - points[r[0]], points[r[2]] - points[r[0]]))
                      for r in faces])
    centre = (middles * areas[:, None]).sum(axis=0) / areas.sum()
    axes = np.linalg.svd((middles - centre) * np.sqrt(areas)[:, None], full_matrices=False)[2]
    best = None
    for normal in (*np.eye(3), *axes):
        for through in (centre, 0.5 * (corners.min(axis=0) + corners.max(axis=0))):
            images = corners - 2.0 * ((corners - through) @ normal)[:, None] * normal
            near = [np.linalg.norm(corners - p, axis=1).min() < CORNER_OFF * size for p in images]
            share = float(np.mean(near))
            if share >= MIRRORED_CORNERS and (best is None or share > best[0]):
                best = share, normal, through
    if best is None:
        return None
    _, normal, through = best
    model_face = nets.fold["ridgecraft:faces_model"]
    starts, ends = [], []
    for join in nets.joins:
        face, k = nets.owner(join["edges"][0])
        ring = faces[model_face[face]]
        starts.append(points[ring[k]])
        ends.append(points[ring[(k + 1) % len(ring)]])
    starts, along = np.array(starts), np.array(ends) - np.array(starts)
    squares = np.maximum((along * along).sum(axis=1), 1e-30)
    lengths = np.sqrt(squares)
    met = 0.0
    for share in (0.25, 0.5, 0.75):
        for point, long in zip(starts + share * along, lengths):
            image = point - 2.0 * ((point - through) @ normal) * normal
            at = np.clip(((image - starts) * along).sum(axis=1) / squares, 0.0, 1.0)
            if np.linalg.norm(starts + at[:, None] * along - image, axis=1).min() < SEAM_OFF * size:
                met += long / 3.0
    return met / float(lengths.sum())


def linear_share(nets):
    """Of the pieces with folds: how many fold with all creases together."""
    steps = nets.fold.get("ridgecraft:fold_order", [])
    together = [len(order) <= 1 for order in steps if order]
    return sum(together) / len(together) if together else None


def measure(fold):
    nets = Nets(fold)
    return {**shape_figures(nets), **seam_figures(nets), "necks": count_necks(nets), "mirror": mirror_share(nets),
            "linear": linear_share(nets)}


def run(task):
    program, model, seed, options, keep = task
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / f"{model.stem}.fold"
        command = [program, str(model), "-o", str(file), "--json", "--seed", str(seed), "--threads", "1", *options]
        with open(pathlib.Path(folder) / "told", "w+", encoding="utf-8") as told, \
                open(pathlib.Path(folder) / "errors", "w+", encoding="utf-8") as errors:
            process = subprocess.Popen(command, stdout=told, stderr=errors)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            told.seek(0)
            errors.seek(0)
            if process.returncode != 0:
                return {"failed": (errors.read().strip().splitlines() or [""])[-1]}
            care = len(json.load(told).get("pieces_to_fold_with_care", []))
        text = file.read_text(encoding="utf-8")
        if keep and seed == 1:
            (pathlib.Path(keep) / file.name).write_text(text, encoding="utf-8")
    return {**measure(json.loads(text)), "care": care, "cpu": usage.ru_utime + usage.ru_stime}


def median(rows):
    """Of the runs of one model; a column that one of them lacks is left out."""
    return {c: None if any(r[c] is None for r in rows) else statistics.median(r[c] for r in rows) for c in COLUMNS}


def mean(rows):
    told = {c: [r[c] for r in rows if r[c] is not None] for c in COLUMNS}
    return {c: statistics.fmean(v) if v else None for c, v in told.items()}


def line(name, row):
    def cell(column):
        value = row.get(column)
        return "-" if value is None else f"{value:.0f}" if column in ("necks", "care") else f"{value:.3g}" \
            if column in ("pieces", "pages") else f"{value:.3f}"
    return f"{name[:19]:20}" + "".join(f"{cell(c):>8}" for c in COLUMNS)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="+", type=pathlib.Path)
    parser.add_argument("--program", default="build/release/ridgecraft")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--against", type=pathlib.Path)
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--keep", type=pathlib.Path)
    arguments = sys.argv[1:]
    own = arguments[:arguments.index("--")] if "--" in arguments else arguments
    options = arguments[len(own) + 1:]
    asked = parser.parse_args(own)
    if asked.keep:
        asked.keep.mkdir(parents=True, exist_ok=True)
    models = [m for given in asked.models
              for m in (sorted(given.iterdir()) if given.is_dir() else [given]) if m.suffix in SUFFIXES]
    tasks = [(asked.program, m, seed, options, asked.keep) for m in models for seed in range(1, asked.seeds + 1)]
    with concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
        runs = list(pool.map(run, tasks))
    print(f"{asked.seeds} seeds, medians".ljust(20) + "".join(f"{c:>8}" for c in COLUMNS))
    rows, failed = {}, 0
    for number, model in enumerate(models):
        of_model = runs[number * asked.seeds:(number + 1) * asked.seeds]
        trouble = next((r["failed"] for r in of_model if "failed" in r), None)
        if trouble is not None:
            failed += 1
            print(f"{model.name}: {trouble}")
            continue
        rows[model.name] = median(of_model)
        print(line(model.name, rows[model.name]))
    print(line(f"mean of {len(rows)}", mean(list(rows.values()))))
    if asked.against:
        before = json.loads(asked.against.read_text(encoding="utf-8"))["models"]
        print(line(f"before, {len(before)}", mean(list(before.values()))))
    if asked.json:
        figures = {"seeds": asked.seeds, "options": options, "models": rows, "mean": mean(list(rows.values()))}
        asked.json.write_text(json.dumps(figures, indent=1) + "\n", encoding="utf-8")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
