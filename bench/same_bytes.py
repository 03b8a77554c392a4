#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether two builds of the program write the same bytes: every output of every verb for all given models.

    bench/same_bytes.py MODELS... --program build/release/ridgecraft --record FIGURES.json
    bench/same_bytes.py MODELS... --program build/release/ridgecraft --against FIGURES.json

MODELS are files or folders of models. Recorded is a hash of each file that a command wrote, of its summary and of what
--json printed, without the seconds; each command runs with one thread and with two. Exits with 1 where two differ.
"""
import argparse
import concurrent.futures
import hashlib
import json
import pathlib
import re
import subprocess
import sys
import tempfile

SUFFIXES = {".obj", ".off", ".ply", ".stl"}
# The keys of --json, and the line of the summary, that tell the time.
TIMES = {"seconds", "stages"}
TIME_LINE = re.compile(r"^  time .*\n", re.MULTILINE)
COMMANDS = {
    "paper": ["MODEL", "-o", "."],
    "paper-png": ["MODEL", "-o", "page.png", "--paper", "letter", "--pieces", "few"],
    "unfold": ["unfold", "MODEL", "--whole", "--tabs", "--faces", "400", "-o", "nets.fold"],
    "segment": ["segment", "MODEL", "-o", "parts.ply", "--labels", "parts.seg", "--hierarchy", "all.json"],
    "hulls": ["hulls", "MODEL", "-o", "hulls.obj", "--max-vertices", "32"],
    "info": ["info", "MODEL"],
}


def digest(data):
    return hashlib.sha256(data).hexdigest()[:16]


def without_times(value):
    if isinstance(value, dict):
        return {k: without_times(v) for k, v in value.items() if k not in TIMES}
    return [without_times(v) for v in value] if isinstance(value, list) else value


def outputs(task):
    program, model, name, threads, as_json = task
    command = [str(model) if word == "MODEL" else word for word in COMMANDS[name]]
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([program, *command, "--threads", str(threads), *(["--json"] if as_json else [])],
                              capture_output=True, cwd=folder, check=False)
        text = done.stdout.decode(errors="replace")
        if as_json and text.strip():
            text = json.dumps(without_times(json.loads(text)), indent=1)
        found = {"code": done.returncode, "printed": digest(TIME_LINE.sub("", text).encode()),
                 "told": digest(done.stderr)}
        for file in sorted(pathlib.Path(folder).rglob("*")):
            if file.is_file():
                found[file.name] = digest(file.read_bytes())
    return f"{model.parent.name}/{model.name} {name} threads={threads}{' json' if as_json else ''}", found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="+", type=pathlib.Path)
    parser.add_argument("--program", required=True, type=pathlib.Path)
    parser.add_argument("--record", type=pathlib.Path)
    parser.add_argument("--against", type=pathlib.Path)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", nargs="*", default=list(COMMANDS), help="of " + ", ".join(COMMANDS))
    arguments = parser.parse_args()
    models = []
    for path in arguments.models:
        models += sorted(p for p in path.iterdir() if p.suffix in SUFFIXES) if path.is_dir() else [path]
    program = str(arguments.program.resolve())
    # Threads are varied with --json, so that every command runs once for a person and twice for a machine.
    tasks = [(program, model.resolve(), name, threads, as_json) for model in models for name in arguments.only
             for threads, as_json in ((1, False), (1, True), (2, True))]
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        found = dict(pool.map(outputs, tasks))
    differ = 0
    for key, files in found.items():
        if key.endswith("threads=2 json") and files != found[key.replace("threads=2", "threads=1")]:
            print(f"{key}: differs from one thread")
            differ += 1
    if arguments.record:
        arguments.record.write_text(json.dumps(found, indent=1) + "\n")
    if arguments.against:
        before = json.loads(arguments.against.read_text())
        for key, files in found.items():
            names = sorted(n for n in {*files, *before.get(key, {})} if files.get(n) != before.get(key, {}).get(n))
            if names:
                print(f"{key}: {', '.join(names)}")
                differ += 1
    print(f"{len(models)} models, {len(found)} runs, {sum(map(len, found.values()))} outputs, {differ} runs differ")
    sys.exit(1 if differ else 0)


if __name__ == "__main__":
    main()
