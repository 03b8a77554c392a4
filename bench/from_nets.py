#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether nets made before are kept by --from: of the same model, at another size, and of a changed model.

  from_nets.py PROGRAM MODEL...      (models in OBJ, others are compared as they are and at another size alone)

For each model and each case: the exit code, the share (by length) of the cuts that are cuts again, that are folds now
though an edge lies there, and where there is no edge any more. Changed: all points of the upper tenth of the model are
moved up by a twentieth of its height. Needs numpy. Exit code 1 where nets are refused or a cut that has its edge is lost.
"""
import json, os, subprocess, sys, tempfile
import numpy as np

SAMPLES = 9          # places along an edge that are looked at
NEAR = 0.05          # mm: they lie on another edge
MOST_FOLDED = 0.01   # of the cuts' length: the one for which a net can't be kept, as the notes then say


def edges(path):
    """Points of the folded form, its cuts and its folds as pairs of points."""
    with open(path) as f:
        fold = json.load(f)
    frame = fold["file_frames"][0]
    points = np.array(frame["vertices_coords"])
    kind = {frozenset(e): a for e, a in zip(fold["edges_vertices"], fold["edges_assignment"])}
    cuts, folds = [], []
    for flat, face in zip(fold["faces_vertices"], fold["ridgecraft:faces_model"]):
        solid = frame["faces_vertices"][face]
        for k in range(len(flat)):
            n = (k + 1) % len(flat)
            cut = kind[frozenset((flat[k], flat[n]))] == "B"
            (cuts if cut else folds).append((points[solid[k]], points[solid[n]]))
    return points, cuts, folds


def distance(places, segments):
    if not segments:
        return np.full(len(places), np.inf)
    a, b = (np.array([s[k] for s in segments]) for k in range(2))
    d = b - a
    size = np.maximum((d * d).sum(1), 1e-30)
    found = np.empty(len(places))
    for i in range(0, len(places), 200):
        p = places[i:i + 200, None, :]
        t = np.clip(((p - a) * d).sum(-1) / size, 0, 1)
        found[i:i + 200] = np.sqrt((((p - a) - t[..., None] * d) ** 2).sum(-1)).min(1)
    return found


def kept(before, after, move):
    """Shares of the cuts' length: cut again, folded now, without an edge. `move` takes points to where they are now."""
    places, weight = [], []
    for a, b in before[1]:
        for i in range(SAMPLES):
            places.append(a + (b - a) * (i + 0.5) / SAMPLES)
            weight.append(np.linalg.norm(b - a))
    places, weight = move(np.array(places)), np.array(weight)
    cut, fold = distance(places, after[1]) < NEAR, distance(places, after[2]) < NEAR
    share = [(weight * which).sum() / weight.sum() for which in (cut, ~cut & fold, ~cut & ~fold)]
    return share


def box_to_box(before, after):
    low, high = before[0].min(0), before[0].max(0)
    to_low, to_high = after[0].min(0), after[0].max(0)
    factor = (to_high - to_low).max() / (high - low).max()
    return lambda p: (p - (low + high) / 2) * factor + (to_low + to_high) / 2


def changed(path, out):
    """The OBJ file with its upper tenth pulled up."""
    with open(path) as f:
        lines = f.read().split("\n")
    up = [float(w.split()[2]) for w in lines if w.startswith("v ")]
    low, high = min(up), max(up)
    with open(out, "w") as f:
        for line in lines:
            w = line.split()
            if w[:1] == ["v"] and float(w[2]) > high - 0.1 * (high - low):
                w[2] = repr(float(w[2]) + 0.05 * (high - low))
                line = " ".join(w)
            f.write(line + "\n")


def run(program, model, *options):
    return subprocess.run([program, model, "-q", *options], capture_output=True).returncode


def main():
    if len(sys.argv) < 3:
        print(__doc__, file=sys.stderr)
        return 2
    program, bad = sys.argv[1], 0
    print("%-34s %-8s %4s %8s %8s %8s" % ("model", "case", "exit", "cut %", "folded %", "no edge %"), flush=True)
    for model in sys.argv[2:]:
        with tempfile.TemporaryDirectory() as folder:
            old = os.path.join(folder, "old.fold")
            name = os.path.basename(model)
            if run(program, model, "-o", old) != 0:
                print("%-34s no nets" % name, flush=True)
                continue
            before = edges(old)
            cases = [("same", model, []), ("larger", model, ["--size", "200mm"])]
            if model.lower().endswith(".obj"):
                other = os.path.join(folder, name)
                changed(model, other)
                cases.append(("changed", other, []))
            for case, path, options in cases:
                new = os.path.join(folder, case + ".fold")
                code = run(program, path, "--from", old, "-o", new, *options)
                if code != 0:
                    print("%-34s %-8s %4d" % (name, case, code), flush=True)
                    bad += 1
                    continue
                after = edges(new)
                if case == "changed":
                    # The lower part is where it was; its box tells where that is now.
                    low_before, low_after = before[0].min(0), after[0].min(0)
                    middle = (before[0].min(0) + before[0].max(0)) / 2
                    now = (after[0].min(0) + after[0].max(0)) / 2
                    extent = (before[0].max(0) - before[0].min(0)), (after[0].max(0) - after[0].min(0))
                    factor = extent[1][0] / extent[0][0]
                    shift = np.array([now[0], low_after[1], now[2]]) - \
                        factor * np.array([middle[0], low_before[1], middle[2]])
                    share = kept(before, after, lambda p: factor * p + shift)
                else:
                    share = kept(before, after, box_to_box(before, after))
                bad += share[1] > MOST_FOLDED
                print("%-34s %-8s %4d %8.2f %8.2f %8.2f" % (name, case, code, *(100 * s for s in share)), flush=True)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
