#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What each pass of unfold/ and each detector and trial loop of prepare/ is worth: results without it.

    bench/ablation.py build FOLDER                     a program in which each step can be left out
    bench/ablation.py run FOLDER MODELS... [--seeds 3] [--only STEP,STEP] [--limit SECONDS] [--all]
    bench/ablation.py table FOLDER [--seeds 3]

`build` copies the sources into FOLDER, rewrites the lines that STEPS names so that the environment variable
RIDGECRAFT_LEFT_OUT leaves a step out, and builds: the program itself has no switches. `run` appends a line of JSON
a run to FOLDER/runs.jsonl, leaves out what is there already, and can be stopped at any time. A step is tried with
more seeds than the first only on models where it changes the nets (--all: on all). `table` prints, per step, the mean
change of each figure when the step is left out, beside the noise: the standard error of the same difference between
seeds of the whole program. A figure that gets worse by more than twice its noise is marked with `*`, one that gets
better with `+`.

MODELS are files or folders. The figures of nets are those of ../shared/check (net_shape.py, craft.py); needs numpy.
    turns     on bodies with a rotation: share of the seam whose image under every rotation is a seam
    moved     largest distance between surfaces that the program reports, % of the size
    normals   mean angle between the paper model's normals and the file's, degrees (bench/likeness.py)
    care      pieces for which no order of folding was found
    together  share of the pieces that fold with all creases together (bench/nets.py)
    hidden    edge ends without a place for their number, %
"""
import argparse
import functools
import hashlib
import json
import math
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import time

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
SUFFIXES = {".obj", ".off", ".ply", ".stl"}
SWITCH = """#pragma once
#ifdef __cplusplus
#include <cstdlib>
#include <cstring>
inline bool ablation_leaves_out(const char* step) {
  const char* const asked = std::getenv("RIDGECRAFT_LEFT_OUT");
  return asked != nullptr && std::strcmp(asked, step) == 0;
}
#endif
"""
# Step: file, the text that is replaced (once), and what replaces it; OUT stands for the question whether it is left out.
STEPS = {
    # unfold/
    "symmetry_of_nets": ("unfold/pieces/symmetry.cpp", "if (weights.mirror > 0.0 &&", "if (!OUT && weights.mirror > 0.0 &&"),
    "turns": ("unfold/pieces/symmetry.cpp", "    find_turn(surface, context, symmetry);", "    if (!OUT) find_turn(surface, context, symmetry);"),
    "best_pieces": ("unfold/unfold.cpp", "folds_ = best_pieces(problem_, folds_, symmetry_.images, context_);", "if (!OUT) folds_ = best_pieces(problem_, folds_, symmetry_.images, context_);"),
    "foldable_trees": ("unfold/pieces/foldable_trees.cpp", "  std::vector<std::vector<std::uint32_t>> pieces = lay_out(patch, folds).faces;\n  for (std::vector<std::uint32_t>& faces : pieces) {\n    std::sort", "  if (OUT) {\n    return folds;\n  }\n  std::vector<std::vector<std::uint32_t>> pieces = lay_out(patch, folds).faces;\n  for (std::vector<std::uint32_t>& faces : pieces) {\n    std::sort"),
    "one_of_each": ("unfold/unfold.cpp", "each_(one_of_each(whole)),", "each_(OUT ? std::nullopt : one_of_each(whole)),"),
    "close_flat_cuts": ("unfold/unfold.cpp", "  close_flat_cuts(", "  if (!OUT) close_flat_cuts("),
    "kept_bands": ("unfold/plan.cpp", "if (rules.mode != PieceMode::few) {", "if (!OUT && rules.mode != PieceMode::few) {"),
    "exact_half": ("unfold/energy/forest_search.cpp", "if (best_ && state_.tabs && rules_.exact_trials", "if (!OUT && best_ && state_.tabs && rules_.exact_trials"),
    "fit_tabs": ("unfold/tabs_of_nets.cpp", "if (task.options.sheet) {\n    fit_tabs", "if (!OUT && task.options.sheet) {\n    fit_tabs"),
    "improved_tabs": ("unfold/tabs/place/place_tabs.cpp", "auto chosen = assign_tabs(sites, preferred_sides(sites), options,", "auto chosen = assign_tabs(sites, OUT ? decltype(preferred_sides(sites))(preferred_sides(sites).size()) : preferred_sides(sites), options,"),
    "base_tabs": ("unfold/unfold.cpp", "    add_base_tabs(whole_", "    if (!OUT) add_base_tabs(whole_"),
    # prepare/
    "thin_walls": ("prepare/clean_bodies.cpp", "  report.thin_walls = merge_thin_walls(model, simplify.skins, simplify.tiny_edge_mm / mm, context);", "  if (!OUT) report.thin_walls = merge_thin_walls(model, simplify.skins, simplify.tiny_edge_mm / mm, context);"),
    "details": ("prepare/clean_bodies.cpp", "  const double mm = judged_mm_per_unit(model, size);\n  if (simplify.mode == Simplification::keep || !(mm > 0.0)) {\n    return {};", "  const double mm = judged_mm_per_unit(model, size);\n  if (OUT || simplify.mode == Simplification::keep || !(mm > 0.0)) {\n    return {};"),
    "over_detailed": ("prepare/clean_bodies.cpp", "Simplification::automatic && has_too_many_faces(", "Simplification::automatic && !OUT && has_too_many_faces("),
    "reliefs_of_bodies": ("prepare/clean_bodies.cpp", "    find_reliefs();\n", "    if (!OUT) find_reliefs();\n"),
    "reliefs": ("prepare/features/trim_reliefs.cpp", "double height_mm,\n                         const Context& context) {\n", "double height_mm,\n                         const Context& context) {\n  if (OUT) {\n    return 0;\n  }\n"),
    "rulings": ("prepare/features/thin_rulings.cpp", "double largest_mm,\n                         const Context& context) {\n", "double largest_mm,\n                         const Context& context) {\n  if (OUT) {\n    return 0;\n  }\n"),
    "coarser_attempts": ("prepare/simplify/simplify.cpp", "scale < most_detail && left > 0.0;", "scale < (OUT ? 1.1 : most_detail) && left > 0.0;"),
    "symmetry": ("prepare/domains/find_domain.cpp", "half = half_of(model, all, largest_deviation);", "half = OUT ? std::nullopt : half_of(model, all, largest_deviation);"),
    "shared_twins": ("prepare/domains/find_domain.cpp", "  take_out_twins(domain, model.surface, context);", "  if (!OUT) take_out_twins(domain, model.surface, context);"),
    "attached_bodies": ("prepare/at_size.cpp", "if (simplify.part_attached) {", "if (!OUT && simplify.part_attached) {"),
    "twin_copies": ("prepare/at_size.cpp", "  copy_equal_bodies(prepared", "  if (!OUT) copy_equal_bodies(prepared"),
    "other_sizes": ("prepare/prepare.cpp", "  if (size.adapts) {", "  if (size.adapts && !OUT) {"),
    "judged_again": ("job/job.cpp", "    if (as_read_) {\n      in_stage", "    if (as_read_ && !OUT) {\n      in_stage"),
    "details_of_union": ("job/job.cpp", "  if (result.skin.united > 0) {\n    result.cleanup.left_out", "  if (!OUT && result.skin.united > 0) {\n    result.cleanup.left_out"),
}
FIGURES = ["pieces", "pages", "round", "fill", "slits", "mirror", "turns", "seam", "bare", "weak", "hours", "tiny",
           "loose", "apart", "evening", "faces", "moved", "normals", "hidden", "care", "together", "buildable", "cpu"]
MORE_IS_BETTER = {"fill", "together", "mirror", "turns", "evening", "buildable"}


def build(folder):
    tree = folder / "tree"
    shutil.rmtree(tree, ignore_errors=True)
    names = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\n")
    for name in filter(None, names):
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / name, tree / name)
    missing = []
    for step, (name, old, new) in STEPS.items():
        text = (tree / name).read_text()
        if text.count(old) != 1:
            missing.append(f"{step}: {text.count(old)} places in {name}")
            continue
        new = new.replace("OUT", f'ablation_leaves_out("{step}")')
        if new.count("(") > new.count(")") + old.count("(") - old.count(")"):
            # A bracket that was opened is closed before the block begins.
            end = text.index(" {\n", text.index(old))
            text = text[:end] + ")" + text[end:]
        (tree / name).write_text(text.replace(old, new))
    if missing:
        sys.exit("steps that the code no longer has in this form:\n  " + "\n  ".join(missing))
    switch = folder / "switch.hpp"
    switch.write_text(SWITCH)
    subprocess.run(["cmake", "--preset", "release", f"-DCMAKE_CXX_FLAGS=-include {switch}"], cwd=tree, check=True)
    subprocess.run(["cmake", "--build", "build/release", "--target", "ridgecraft"], cwd=tree, check=True)


def rotations(vertices):
    """Rotations about an axis through the centre that bring the corners onto each other (to 1 % of the size)."""
    size = float(np.ptp(vertices, axis=0).max())
    found = []
    for centre in (0.5 * (vertices.min(0) + vertices.max(0)),):
        p = vertices - centre
        for k in range(3):
            axis = np.eye(3)[k]
            for order in (2, 3, 4, 5, 6, 8, 12, 16):
                a = 2 * math.pi / order
                u, v = np.eye(3)[(k + 1) % 3], np.eye(3)[(k + 2) % 3]
                turn = np.outer(axis, axis) + math.cos(a) * (np.outer(u, u) + np.outer(v, v)) + math.sin(a) * (
                    np.outer(v, u) - np.outer(u, v))
                q = p @ turn.T
                far = max(float(np.linalg.norm(q[i:i + 256, None] - p[None], axis=2).min(1).max())
                          for i in range(0, len(q), 256))
                if far < 0.01 * size:
                    found.append((turn, centre))
    return found


def seam_ends(fold):
    """Both ends of each join on the folded model."""
    frame = next(f for f in fold["file_frames"] if "foldedForm" in f["frame_classes"])
    points, faces = np.array(frame["vertices_coords"], float), frame["faces_vertices"]
    corner = {}
    for f, ring in enumerate(fold["faces_vertices"]):
        for i, a in enumerate(ring):
            corner[frozenset((a, ring[(i + 1) % len(ring)]))] = (f, i)
    ends = []
    for join in fold["ridgecraft:joins"]:
        f, i = corner[frozenset(fold["edges_vertices"][join["edges"][0]])]
        ring = faces[fold["ridgecraft:faces_model"][f]]
        ends.append((points[ring[i]], points[ring[(i + 1) % len(ring)]]))
    used = np.unique(np.concatenate([np.array(f) for f in faces]))
    return points[used], np.array(ends)


@functools.cache
def of_folded_form(model, text):
    """Rotations and angle of normals of a folded form, which many nets have in common."""
    frame = json.loads(text)
    used = np.unique(np.concatenate([np.array(f) for f in frame["faces_vertices"]]))
    vertices = np.array(frame["vertices_coords"], float)[used]
    return rotations(vertices) if len(vertices) <= 3000 else [], angle_of_normals(frame, model)


def rotational_likeness(fold, turns):
    vertices, ends = seam_ends(fold)
    if not turns or not len(ends):
        return None
    size = float(np.ptp(vertices, axis=0).max())
    a, b = ends[:, 0], ends[:, 1]
    length = np.linalg.norm(b - a, axis=1)
    hit = np.ones((len(a), 3), bool)
    for turn, centre in turns:
        for k, t in enumerate((0.25, 0.5, 0.75)):
            s = (a + t * (b - a) - centre) @ turn.T + centre
            ab = b - a
            for i in range(len(s)):
                u = np.clip(((s[i] - a) * ab).sum(1) / np.maximum((ab * ab).sum(1), 1e-30), 0, 1)
                hit[i, k] &= np.linalg.norm(a + u[:, None] * ab - s[i], axis=1).min() < 0.015 * size
    return float((hit.mean(1) * length).sum() / length.sum())


def figures(path, model, report, seconds):
    sys.path[:0] = [str(ROOT.parent / "shared/check"), str(ROOT / "bench")]
    import craft
    import net_shape
    import nets
    fold = json.loads(path.read_text())
    shape, work = net_shape.measure(str(path)), craft.measure(str(path))
    joins = max(1, report["joins"])
    simplified = report.get("simplified") or {}
    size = max(report["size_mm"])
    faces = len(fold["faces_vertices"])
    row = {k: shape[k] for k in ("pieces", "pages", "round", "fill", "slits", "mirror", "seam", "bare", "weak")}
    row |= {k: work[k] for k in ("hours", "tiny", "loose", "apart", "faces")}
    row["evening"] = 0.0 if work["why"] else 1.0
    frame = next(f for f in fold["file_frames"] if "foldedForm" in f["frame_classes"])
    turns, row["normals"] = of_folded_form(model, json.dumps({k: frame[k] for k in ("vertices_coords", "faces_vertices")}))
    row["turns"] = rotational_likeness(fold, turns)
    row["moved"] = 100 * (simplified.get("deviation_mm") or 0.0) / size
    row["hidden"] = 100 * report.get("labels_left_out", 0) / (2 * joins)
    row["care"] = len(report["pieces_to_fold_with_care"])
    row["together"] = nets.linear_share(nets.Nets(fold))
    row["buildable"] = float(work["apart"] < 10 and row["hidden"] <= 5 and report.get("slivers", 0) <= 0.05 * faces and
                             report["joins_without_tab"] <= 0.15 * joins and faces <= 1000 and
                             not simplified.get("still_too_fine"))
    row["cpu"] = seconds
    return row


def angle_of_normals(frame, model):
    """Mean angle, degrees, between the normals of the file's surface and of the paper model's at 1,500 points."""
    import buildable
    import likeness
    try:
        points, faces = buildable.read_faces(str(model))
    except buildable.Unreadable:
        return None
    faces = np.array([(f[0], f[k], f[k + 1]) for f in faces for k in range(1, len(f) - 1)])
    paper = np.array(frame["vertices_coords"], float)
    rings = [(f[0], f[k], f[k + 1]) for f in frame["faces_vertices"] for k in range(1, len(f) - 1)]
    used = points[np.unique(faces)]
    scale = np.ptp(paper, axis=0).max() / np.ptp(used, axis=0).max()
    moved = (points - 0.5 * (used.min(0) + used.max(0))) * scale + 0.5 * (paper.min(0) + paper.max(0))
    at, n = likeness.sample(moved, faces, 1500, np.random.default_rng(1))
    there = likeness.normals_and_areas(paper, np.array(rings))[0][likeness.nearest_faces(paper, np.array(rings), at)]
    return float(np.degrees(np.arccos(np.clip((n * there).sum(1), -1.0, 1.0))).mean())


def one_run(program, model, step, seed, limit, whole):
    """A row of figures; `whole`: that of the whole program, whose nets may be the same."""
    environment = dict(os.environ, RIDGECRAFT_LEFT_OUT=step)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "nets.fold"
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        try:
            run = subprocess.run([program, model, "-o", path, "--json", "--threads", "1", "--seed", str(seed)],
                                 capture_output=True, text=True, timeout=limit, env=environment)
        except subprocess.TimeoutExpired:
            return {"exit": "time", "cpu": limit}
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        if run.returncode != 0:
            return {"exit": run.returncode, "cpu": seconds}
        row = {"exit": 0, "digest": hashlib.sha256(path.read_bytes()).hexdigest()[:16]}
        if whole and whole.get("digest") == row["digest"]:
            return whole | {"cpu": seconds}
        return row | figures(path, model, json.loads(run.stdout), seconds)


def run(args):
    program = args.folder / "tree/build/release/ridgecraft"
    models = []
    for given in map(pathlib.Path, args.models):
        models += sorted(p for p in given.iterdir() if p.suffix in SUFFIXES) if given.is_dir() else [given]
    steps = args.only.split(",") if args.only else list(STEPS)
    results = args.folder / "runs.jsonl"
    rows = {}
    for line in results.read_text().splitlines() if results.exists() else []:
        row = json.loads(line)
        rows[row["step"], row["model"], row["seed"]] = row
    with results.open("a") as out:
        for seed in range(1, args.seeds + 1):
            for step in ["", *steps]:
                for model in models:
                    name = f"{model.parent.name}/{model.name}"
                    first, whole = rows.get((step, name, 1)), rows.get(("", name, 1))
                    idle = seed > 1 and step and first and whole and first.get("digest") == whole.get("digest")
                    if (step, name, seed) in rows or (idle and not args.all):
                        continue
                    found = one_run(program, model, step, seed, args.limit, rows.get(("", name, seed)) if step else None)
                    row = found | {"step": step, "model": name, "seed": seed}
                    rows[step, name, seed] = row
                    out.write(json.dumps(row) + "\n")
                    out.flush()


def table(args):
    rows = {}
    for line in (args.folder / "runs.jsonl").read_text().splitlines():
        row = json.loads(line)
        rows[row["step"], row["model"], row["seed"]] = row
    models = sorted({m for s, m, _ in rows if s == ""})
    seeds = sorted({k[2] for k in rows if k[0] == ""})

    def value(step, model, seed, figure):
        row = rows.get((step, model, seed)) or rows.get((step, model, 1) if step else (step, model, seed))
        if row is None or row["exit"] != 0:
            return row["cpu"] if row and figure == "cpu" else None
        if step and (step, model, seed) not in rows:  # it changes nothing there
            row = rows.get(("", model, seed))
        return row.get(figure) if row else None

    def means(step_a, step_b, seed_a, seed_b, figure, tried):
        a = [(value(step_a, m, seed_a, figure), value(step_b, m, seed_b, figure)) for m in tried]
        a = [(x, y) for x, y in a if x is not None and y is not None]
        return (sum(x - y for x, y in a) / len(a), len(a)) if a else (None, 0)

    print("| step | models changed | " + " | ".join(FIGURES) + " |")
    noise = {}
    for figure in FIGURES:
        pairs = [means("", "", s, t, figure, models)[0] for i, s in enumerate(seeds) for t in seeds[i + 1:]]
        pairs = [p for p in pairs if p is not None]
        noise[figure] = math.sqrt(sum(p * p for p in pairs) / len(pairs)) if pairs else 0.0
    base = {f: [value("", m, 1, f) for m in models] for f in FIGURES}

    def show(x):
        return "-" if x is None else f"{x:.4g}"

    print("| all | %d | " % len(models) + " | ".join(
        show(sum(v for v in base[f] if v is not None) / max(1, sum(v is not None for v in base[f]))) for f in FIGURES) + " |")
    print("| noise | | " + " | ".join(show(noise[f]) for f in FIGURES) + " |")
    for step in STEPS:
        tried = [m for m in models if (step, m, 1) in rows]
        if not tried:
            continue
        changed = [m for m in tried if rows[step, m, 1].get("digest") != rows["", m, 1].get("digest")]
        failed = [m for m in tried if rows[step, m, 1]["exit"] != 0 and rows["", m, 1]["exit"] == 0]
        cells = []
        for figure in FIGURES:
            got = [means(step, "", s, s, figure, tried)[0] for s in seeds if any((step, m, s) in rows for m in tried)]
            got = [g for g in got if g is not None]
            change = sum(got) / len(got) if got else None
            mark = ""
            if change is not None and abs(change) > 2 * noise[figure] / math.sqrt(max(1, len(got))) and abs(change) > 1e-9:
                worse = change < 0 if figure in MORE_IS_BETTER else change > 0
                mark = "*" if worse else "+"
            cells.append(("-" if change is None else f"{change:+.3g}") + mark)
        print(f"| {step} | {len(changed)} of {len(tried)}" + (f", {len(failed)} fail" if failed else "") + " | " + " | ".join(cells) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("task", choices=["build", "run", "table"])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("models", nargs="*")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--only", default="")
    parser.add_argument("--limit", type=float, default=120.0)
    parser.add_argument("--all", action="store_true")
    args = parser.parse_args()
    args.folder = args.folder.resolve()
    args.folder.mkdir(parents=True, exist_ok=True)
    {"build": lambda: build(args.folder), "run": lambda: run(args), "table": lambda: table(args)}[args.task]()


if __name__ == "__main__":
    main()
