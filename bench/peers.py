#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sets our pieces and pages beside a peer's: runs the program on a folder of models, prints a table, writes JSON.

    bench/peers.py MODELS [--peer FIGURES.csv] [--program build/release/ridgecraft] [--json OUT.json] [-- OPTIONS]

The peer's figures are a CSV with the columns model, status, pieces, pages, tabs, utilisation, seconds (others are
ignored); models are matched by name without suffix. Options behind -- go to the program.
"""
import argparse
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

SUFFIXES = {".obj", ".off", ".ply", ".stl"}


def area_used(fold):
    """Area of all faces over the printable area (page less margins) of all pages."""
    points = fold["vertices_coords"]
    paper = 0.0
    for face in fold["faces_vertices"]:
        ring = [points[v] for v in face]
        paper += 0.5 * sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(ring, ring[1:] + ring[:1]))
    room = 0.0
    for page in fold["ridgecraft:pages"]:
        left, bottom, right, top = page["margins"]
        room += (page["size"][0] - left - right) * (page["size"][1] - bottom - top)
    return paper / room if room else 0.0


def run(program, model, options):
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "nets.fold"
        done = subprocess.run([program, str(model), "-o", str(file), "--json", *options],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            lines = done.stderr.strip().splitlines() or [""]
            return {"status": "exit %d" % done.returncode, "message": lines[-1]}
        figures = json.loads(done.stdout)
        seconds = figures["seconds"]
        return {"status": "ok", "faces": figures["faces"], "pieces": figures["pieces"], "pages": figures["pages"],
                "tabs": figures["tabs"], "joins_without_tab": figures["joins_without_tab"],
                "utilisation": round(area_used(json.loads(file.read_text())), 4),
                "seconds": seconds.get("total", round(sum(seconds.values()), 3))}


def read_peer(path):
    if path is None:
        return {}
    with open(path, newline="", encoding="utf-8") as file:
        return {row["model"]: row for row in csv.DictReader(file)}


def cell(row, key):
    value = row.get(key, "") if row else ""
    return "" if value is None else str(value)


def print_table(rows):
    keys = ["pieces", "pages", "tabs", "utilisation", "seconds"]
    print("%-18s | %s | %s" % ("model", "   ours: " + " ".join("%11s" % k for k in keys),
                               "   peer: " + " ".join("%11s" % k for k in keys)))
    for row in rows:
        sides = []
        for side in (row["ours"], row["peer"]):
            status = "" if not side or side.get("status") == "ok" else side["status"]
            sides.append("%8s " % status[:8] + " ".join("%11s" % cell(side, k) for k in keys))
        print("%-18s | %s | %s" % (row["model"], sides[0], sides[1]))


def totals(rows):
    """Sums over the models that both managed, and over all of ours."""
    both = [r for r in rows if r["ours"]["status"] == "ok" and r["peer"] and r["peer"]["status"] == "ok"]
    ours = [r["ours"] for r in rows if r["ours"]["status"] == "ok"]
    result = {"models": len(rows), "ours_ok": len(ours), "both_ok": len(both),
              "ours_pieces": sum(o["pieces"] for o in ours), "ours_pages": sum(o["pages"] for o in ours),
              "ours_utilisation": round(sum(o["utilisation"] for o in ours) / len(ours), 4) if ours else None}
    for key in ("pieces", "pages"):
        result["both_ours_" + key] = sum(r["ours"][key] for r in both)
        result["both_peer_" + key] = sum(int(r["peer"][key]) for r in both)
    return result


def main():
    arguments = sys.argv[1:]
    options = []
    if "--" in arguments:
        at = arguments.index("--")
        arguments, options = arguments[:at], arguments[at + 1:]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", type=pathlib.Path)
    parser.add_argument("--peer", type=pathlib.Path)
    parser.add_argument("--program", default="build/release/ridgecraft")
    parser.add_argument("--json", type=pathlib.Path)
    given = parser.parse_args(arguments)
    peer = read_peer(given.peer)
    models = sorted((p for p in given.models.iterdir() if p.suffix.lower() in SUFFIXES), key=lambda p: p.stem)
    if not models:
        sys.exit("no models in %s" % given.models)
    rows = [{"model": m.stem, "ours": run(given.program, m, options), "peer": peer.get(m.stem)} for m in models]
    print_table(rows)
    summary = totals(rows)
    print(json.dumps(summary))
    if given.json:
        given.json.write_text(json.dumps({"options": options, "totals": summary, "rows": rows}, indent=1) + "\n")


if __name__ == "__main__":
    main()
