#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# tidy.sh BUILD [BASE]: clang-tidy, as .clang-tidy says, on the lines that differ from BASE, compiled as in a build folder.
# BASE is where the branch left main; on main itself the commit before. Precompiled headers are left out: so a file that
# doesn't name what it uses is found, too.
set -eu
cd "$(dirname "$0")/.."
sh cmake/install-packages.sh tests/clang-packages.txt
build=$1
limit_s=420

base=${2:-}
if [ -z "$base" ]; then
  for main in origin/main main; do
    base=$(git merge-base "$main" HEAD 2>/dev/null) || continue
    [ "$base" = "$(git rev-parse HEAD)" ] || break
    base=
  done
fi
[ -n "$base" ] || base=$(git rev-parse -q --verify HEAD~1) || {
  echo "tidy: no earlier commit to compare with" >&2
  exit 0
}

# What the build knows of; a changed header is looked at with the source of its name, other headers not at all.
git diff -U0 --no-prefix --diff-filter=d "$base" -- '*.cpp' '*.hpp' >"$build/tidy.diff"
python3 - "$build/compile_commands.json" "$build/tidy.diff" "$limit_s" <<'END'
import concurrent.futures, json, os, re, subprocess, sys, tempfile, time

database, limit = json.load(open(sys.argv[1])), float(sys.argv[3])
changed = {}
for line in open(sys.argv[2], errors="replace"):
    if line.startswith("+++ "):
        lines = changed.setdefault(line[4:].split("\t")[0].strip(), [])
    elif at := re.match(r"@@ \S+ \+(\d+)(?:,(\d+))? @@", line):
        first, count = int(at[1]), int(at[2] or 1)
        if count > 0:
            lines.append([first, first + count - 1])
for entry in database:
    entry["command"] = re.sub(r" -Winvalid-pch|( -Xclang)? -include(-pch)? *( -Xclang)? *\S*cmake_pch\S*", "", entry["command"])
known = {os.path.relpath(entry["file"]): entry for entry in database}
wanted = {name if name.endswith(".cpp") else name[:-3] + "cpp" for name in changed}
files = sorted(wanted & known.keys())
line_filter = json.dumps([{"name": name, "lines": lines} for name, lines in changed.items() if lines])
# GCC's settings; CGAL 5.5 has templates that clang can't read before somebody uses them.
extra = ["--extra-arg=" + word for word in (
    "-Wno-unknown-warning-option", "-Wno-c2y-extensions", "-Wno-double-promotion", "-Wno-deprecated-declarations",
    "-fdelayed-template-parsing", "-Wno-delayed-template-parsing-in-cxx20")]
until = time.monotonic() + limit


def look(file):
    if time.monotonic() > until:
        return file, None
    run = subprocess.run(
        ["clang-tidy-22", "--quiet", "--warnings-as-errors=*", "--line-filter=" + line_filter, "-p", folder, *extra, file],
        capture_output=True, text=True)
    return file, (run.returncode, run.stdout + run.stderr)


with tempfile.TemporaryDirectory() as folder:
    json.dump(database, open(os.path.join(folder, "compile_commands.json"), "w"))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        told = dict(pool.map(look, files))
bad = {file: said[1] for file, said in told.items() if said and said[0] != 0}
for said in bad.values():
    print(said, file=sys.stderr)
late = [file for file, said in told.items() if said is None]
print(f"tidy: {len(files) - len(late)} of {len(files)} changed files looked at, {len(bad)} with something to mend",
      file=sys.stderr)
if late:
    print("tidy: no time left for " + " ".join(late), file=sys.stderr)
sys.exit(1 if bad or late else 0)
END
