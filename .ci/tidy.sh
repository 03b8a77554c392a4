#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# tidy.sh CLANG_BUILD GCC_BUILD [COMMIT | all]: clang-tidy, as the files .clang-tidy say, on all code outside tests/, whatever
# has changed, compiled as in two build folders: the one of the preset clang, which makes a unit of a folder's files (so all
# of it takes four minutes of a processor), and for the Python module one of the preset test. Each of the tests is a unit,
# so only those are looked at that differ from COMMIT, by default the one in .ci/tests-tidied, when all of them were clean;
# where git doesn't have it (a clone may be shallow), that is told. Precompiled headers are left out: so a folder that
# doesn't name what it uses is found, too.
set -eu
cd "$(dirname "$0")/.."
sh cmake/install-packages.sh tests/clang-packages.txt
clang=$1
gcc=$2
since=${3:-$(cat .ci/tests-tidied)}
limit_s=600

changed=$(mktemp)
trap 'rm -f "$changed"' EXIT
if [ "$since" = all ]; then
  git ls-files 'tests/*.cpp' 'tests/*.hpp' >"$changed"
elif git cat-file -e "$since^{commit}" 2>/dev/null; then
  git diff --name-only --diff-filter=d "$since" -- 'tests/*.cpp' 'tests/*.hpp' >"$changed"
else
  echo "tidy: without the tests, as git doesn't have commit $since here" >&2
fi

python3 - "$clang" "$gcc" "$changed" "$limit_s" <<'END'
import concurrent.futures, json, os, re, subprocess, sys, tempfile, time

clang, gcc, changed, limit = sys.argv[1:]
# A changed header of the tests is looked at with the source of its name.
changed = {re.sub(r"\.hpp$", ".cpp", name) for name in open(changed).read().split()}
entries = [entry for entry in json.load(open(f"{clang}/compile_commands.json"))
           if not (test := os.path.relpath(entry["file"])).startswith("tests/") or test in changed]
entries += [entry for entry in json.load(open(f"{gcc}/compile_commands.json"))
            if os.path.relpath(entry["file"]).startswith("python/")]
for entry in entries:
    entry["command"] = re.sub(r" -Winvalid-pch|( -Xclang)? -include(-pch)? *( -Xclang)? *\S*cmake_pch\S*| -fpch-\S*", "",
                              entry["command"])
# Once where several targets compile the same file. Those that CMake compiles for precompiled headers are nobody's.
files = sorted({entry["file"] for entry in entries if "cmake_pch" not in entry["file"]})
until = time.monotonic() + float(limit)


def look(file):
    """What is to be mended in a file; None where there was no time left."""
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
    json.dump(entries, open(f"{folder}/compile_commands.json", "w"))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        told = dict(zip(files, pool.map(look, files)))
bad = [said for said in told.values() if said]
late = [file for file, said in told.items() if said is None]
print(*bad, sep="\n", end="", file=sys.stderr)
print(f"tidy: {len(files) - len(late)} of {len(files)} units looked at, {len(bad)} with something to mend", file=sys.stderr)
if late:
    print("tidy: no time left for " + " ".join(late), file=sys.stderr)
sys.exit(1 if bad or late or not files else 0)
END
