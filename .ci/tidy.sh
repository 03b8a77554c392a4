#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# tidy.sh CLANG_BUILD GCC_BUILD [COMMIT | all]: clang-tidy, as the files .clang-tidy say, on all code, compiled as in two
# build folders: the one of the preset clang, which makes a unit of a folder's files, and for the Python module one of the
# preset test. Looked at is what reads a file that differs from COMMIT, by default the one in .ci/tidied, when all was
# clean; where what all depends on has changed, or git doesn't have the commit (a clone may be shallow), all but the tests.
# Precompiled headers are left out: so a folder that doesn't name what it uses is found, too. What there is no time for is
# printed; only findings fail.
set -eu
cd "$(dirname "$0")/.."
sh cmake/install-packages.sh tests/clang-packages.txt
clang=$1
gcc=$2
since=${3:-$(cat .ci/tidied)}
limit_s=600

changed=$(mktemp)
trap 'rm -f "$changed"' EXIT
if [ "$since" = all ]; then
  echo all >"$changed"
elif git cat-file -e "$since^{commit}" 2>/dev/null; then
  git diff --name-only --diff-filter=d "$since" >"$changed"
else
  echo "tidy: without the tests, as git doesn't have commit $since here" >&2
  echo all but tests >"$changed"
fi

python3 - "$clang" "$gcc" "$changed" "$limit_s" <<'END'
import concurrent.futures, json, os, re, subprocess, sys, tempfile, time

clang, gcc, changed, limit = sys.argv[1:]
changed = set(open(changed).read().splitlines())
# What all code is looked at by, and compiled with.
common = {".clang-tidy", "cmake/compiler.cmake", "cmake/dependencies.cmake", "tests/clang-packages.txt"}


def repository_name(path):
    """A file's name in the repository: public headers are copied into the build folder."""
    return re.sub(r"^build/[^/]*/include/ridgecraft/", "", os.path.relpath(path))


def entries_of(build):
    """What a build folder compiles: entries of compile_commands.json with the names of all files that each reads."""
    reads = {}
    listed = subprocess.run(["ninja", "-C", build, "-t", "deps"], capture_output=True, text=True, check=True).stdout
    for paragraph in listed.split("\n\n"):
        lines = paragraph.strip().splitlines()
        if lines:
            reads[lines[0].split(":")[0]] = {repository_name(os.path.join(build, line.strip())) for line in lines[1:]}
    for entry in json.load(open(f"{build}/compile_commands.json")):
        # Nothing is known of what hasn't been compiled.
        entry["reads"] = reads.get(re.search(r" -o (\S+)", entry["command"])[1], changed)
        if "tests" in os.path.relpath(entry["file"]).split(os.sep):
            yield from tests_of(entry)
        else:
            yield entry | {"test": False}


def tests_of(entry):
    """Tests are looked at one by one, where they or the headers of their names have changed: for a unit of them its files."""
    unit = entry["file"]
    for file in re.findall(r'#include "(.+)"', open(unit).read()) if f"{os.sep}Unity{os.sep}" in unit else [unit]:
        name = os.path.relpath(file)
        yield entry | {"test": True, "file": file, "command": entry["command"].replace(unit, file),
                       "reads": {name, re.sub(r"\.cpp$", ".hpp", name)}}


def to_be_looked_at(entry):
    return ("all" in changed or not entry["reads"].isdisjoint(changed)
            or (not entry["test"] and ("all but tests" in changed or not common.isdisjoint(changed))))


entries = [entry for entry in entries_of(clang) if to_be_looked_at(entry)]
entries += [entry for entry in entries_of(gcc)
            if os.path.relpath(entry["file"]).startswith("python/") and to_be_looked_at(entry)]
for entry in entries:
    entry["command"] = re.sub(r" -Winvalid-pch|( -Xclang)? -include(-pch)? *( -Xclang)? *\S*cmake_pch\S*| -fpch-\S*", "",
                              entry["command"])
# Once where several targets compile the same file. Those that CMake compiles for precompiled headers are nobody's.
files = sorted({entry["file"] for entry in entries if "cmake_pch" not in entry["file"]})
# The tests last: if time runs out, then for them.
files.sort(key=lambda file: os.path.relpath(file).startswith("tests"))
until = time.monotonic() + float(limit)


def look(file):
    """The findings in a file; None where there was no time left."""
    if time.monotonic() > until:
        return None
    run = subprocess.run(
        ["clang-tidy-22", "--quiet", "--warnings-as-errors=*", "-p", folder,
         # What the module's settings, which are GCC's, don't say to clang (cmake/compiler.cmake).
         "--extra-arg=-Wno-unknown-warning-option", "--extra-arg=-Wno-double-promotion"]
        # Units lie in the build folder, where no settings are found.
        + (["--config-file=.clang-tidy"] if f"{os.sep}Unity{os.sep}" in file else []) + [file],
        capture_output=True, text=True)
    return "" if run.returncode == 0 else f"{file}\n{run.stdout}{run.stderr}"


with tempfile.TemporaryDirectory() as folder:
    json.dump([{k: v for k, v in entry.items() if k not in ("reads", "test")} for entry in entries], open(f"{folder}/compile_commands.json", "w"))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        results = dict(zip(files, pool.map(look, files)))
bad = [said for said in results.values() if said]
late = [file for file, said in results.items() if said is None]
print(*bad, sep="\n", end="", file=sys.stderr)
print(f"tidy: {len(files) - len(late)} of {len(files)} units looked at, {len(bad)} with findings", file=sys.stderr)
if late:
    print(f"skipped: tidy had no time left within {limit} s for " + " ".join(map(os.path.relpath, late)), file=sys.stderr)
sys.exit(1 if bad else 0)
END
