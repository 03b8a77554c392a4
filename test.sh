#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds Ridgecraft with its tests (installing what is missing with apt) and runs them.
#   ./test.sh [--asan | --tsan] [--update-golden] [ctest options]
# --tsan builds and runs what works on several threads.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
preset=test
target=all
only=
while [ $# -gt 0 ]; do
  case "$1" in
    --asan) preset=asan ;;
    --tsan)
      preset=tsan
      target=thread_tests
      only="-L threads"
      ;;
    # Golden files are written anew instead of compared; `git diff` is the review.
    --update-golden) export RIDGECRAFT_UPDATE_GOLDEN=1 ;;
    *) break ;;
  esac
  shift
done

sh "$here/cmake/install-packages.sh" "$here/cmake/packages.txt" "$here/tests/packages.txt"

jobs=$(nproc)
mkdir -p "$here/build"
log="$here/build/$preset.log"
. "$here/cmake/quietly.sh"
quietly cmake -S "$here" --preset "$preset"
echo "Building ($preset)" >&2
quietly cmake --build "$here/build/$preset" -j "$jobs" --target "$target"

# What libraries of others leave behind at the program's end is theirs.
export LSAN_OPTIONS="suppressions=$here/tests/leaks.supp:print_suppressions=0"

cd "$here/build/$preset"
# shellcheck disable=SC2086 # two words on purpose
ctest --output-on-failure -j "$jobs" $only "$@" && outcome=0 || outcome=$?
# What a test couldn't do here, which ctest keeps to itself.
sed -n 's/^ *skipped: /skipped: /p' Testing/Temporary/LastTest.log 2>/dev/null | sort | uniq -c >&2 || true
exit "$outcome"
