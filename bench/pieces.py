#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pieces and pages of a folder of models in each mode, beside a peer's; prints the table of docs/design/unfolding.md.

    bench/pieces.py MODELS --peer FIGURES.csv [--program build/release/ridgecraft] [--jobs 1] [-- OPTIONS]

The peer's figures are a CSV with the columns model, status, pieces, pages; models are matched by name without suffix.
Options behind -- go to the program; "--margin 5mm --faces keep" is what the peer's figures were made with. Exits with 1
where a rule is broken: more pages than the peer in any mode, more pieces than the peer with --pieces few, a piece of
more than 80 panels by default, or a piece beyond the number of parts without a reason.
"""
import argparse
import collections
import concurrent.futures
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

SUFFIXES = {".obj", ".off", ".ply", ".stl"}
MODES = ("parts", "few", "small")
MOST_PANELS = 80
# Folds no sharper than this, degrees, lie inside a panel (prepare/prepared/panels.hpp).
FLAT_DEG = 0.1


def largest_piece(fold):
    """Panels of the piece with most of them: what its folds without an angle leave apart."""
    owner = list(range(len(fold["faces_vertices"])))

    def top(face):
        while owner[face] != face:
            owner[face] = owner[owner[face]]
            face = owner[face]
        return face

    edges = zip(fold["edges_vertices"], fold["edges_assignment"], fold["edges_foldAngle"])
    flat = {tuple(sorted(edge)) for edge, kind, angle in edges if kind in "MVF" and abs(angle or 0.0) <= FLAT_DEG}
    first = {}
    for face, ring in enumerate(fold["faces_vertices"]):
        for edge in zip(ring, ring[1:] + ring[:1]):
            key = tuple(sorted(edge))
            if key in flat:
                owner[top(face)] = top(first.setdefault(key, face))
    panels = collections.defaultdict(set)
    for face, piece in enumerate(fold["ridgecraft:faces_piece"]):
        panels[piece].add(top(face))
    return max(len(p) for p in panels.values())


def run(task):
    program, model, mode, options = task
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "nets.fold"
        done = subprocess.run([program, str(model), "-o", str(file), "--json", "--pieces", mode, *options],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            return {"failed": (done.stderr.strip().splitlines() or [""])[-1]}
        figures = json.loads(done.stdout)
        fold = json.loads(file.read_text())
    reasons = collections.Counter(p["reason"] for p in figures["extra_pieces"] if p["why"])
    return {"parts": figures["parts"], "pieces": figures["pieces"], "pages": figures["pages"],
            "joins": figures["joins"], "missing": figures["joins_without_tab"], "reasons": reasons,
            "panels": largest_piece(fold), "seconds": figures["seconds"]["total"]}


def broken_rules(model, modes, peer):
    broken = []
    for mode, got in modes.items():
        if "failed" in got:
            broken.append("%s, %s: %s" % (model, mode, got["failed"]))
            continue
        if got["pieces"] - sum(got["reasons"].values()) > got["parts"]:
            broken.append("%s, %s: pieces without a reason" % (model, mode))
        if peer and got["pages"] > int(peer["pages"]):
            broken.append("%s, %s: %d pages, the peer has %s" % (model, mode, got["pages"], peer["pages"]))
    if peer and modes["few"].get("pieces", 0) > int(peer["pieces"]):
        broken.append("%s, few: %d pieces, the peer has %s" % (model, modes["few"]["pieces"], peer["pieces"]))
    if modes["parts"].get("panels", 0) > MOST_PANELS:
        broken.append("%s, parts: a piece of %d panels" % (model, modes["parts"]["panels"]))
    return broken


def cell(got):
    if "failed" in got:
        return "failed | "
    return "%d / %d | %d of %d" % (got["pieces"], got["pages"], got["missing"], got["joins"])


def reasons_text(got):
    return ", ".join("%d %s" % (n, reason) for reason, n in sorted(got.get("reasons", {}).items()))


def print_table(rows):
    print("| model | peer: pieces / pages | parts | default: pieces / pages | without tab | extra pieces | most panels "
          "| few: pieces / pages | without tab | small: pieces / pages | without tab | s |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    for model, modes, peer in rows:
        print("| %s | %s | %s | %s | %s | %s | %s | %s | %s |" % (
            model, "%s / %s" % (peer["pieces"], peer["pages"]) if peer else "–", modes["parts"].get("parts", ""),
            cell(modes["parts"]), reasons_text(modes["parts"]), modes["parts"].get("panels", ""), cell(modes["few"]),
            cell(modes["small"]), ", ".join("%.1f" % modes[m].get("seconds", 0) for m in MODES)))


def print_totals(rows):
    with_peer = [(modes, peer) for _, modes, peer in rows if peer]
    text = ["peer %d pieces, %d pages" % tuple(sum(int(p[k]) for _, p in with_peer) for k in ("pieces", "pages"))]
    for mode in MODES:
        text.append("%s %d pieces, %d pages" % (mode, *(sum(m[mode].get(k, 0) for m, _ in with_peer)
                                                         for k in ("pieces", "pages"))))
    print("\n%d models that the peer accepts: %s" % (len(with_peer), "; ".join(text)))


def main():
    arguments = sys.argv[1:]
    options = []
    if "--" in arguments:
        at = arguments.index("--")
        arguments, options = arguments[:at], arguments[at + 1:]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", type=pathlib.Path)
    parser.add_argument("--peer", type=pathlib.Path, required=True)
    parser.add_argument("--program", default="build/release/ridgecraft")
    parser.add_argument("--jobs", type=int, default=1)
    given = parser.parse_args(arguments)
    with open(given.peer, newline="", encoding="utf-8") as file:
        peers = {row["model"]: row for row in csv.DictReader(file) if row["status"] == "ok"}
    models = sorted((p for p in given.models.iterdir() if p.suffix.lower() in SUFFIXES), key=lambda p: p.stem)
    if not models:
        sys.exit("no models in %s" % given.models)
    tasks = [(given.program, model, mode, options) for model in models for mode in MODES]
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        results = dict(zip(((t[1].stem, t[2]) for t in tasks), pool.map(run, tasks)))
    rows = [(m.stem, {mode: results[m.stem, mode] for mode in MODES}, peers.get(m.stem)) for m in models]
    print_table(rows)
    print_totals(rows)
    broken = [rule for row in rows for rule in broken_rules(*row)]
    print("\n".join(broken))
    sys.exit(1 if broken else 0)


if __name__ == "__main__":
    main()
