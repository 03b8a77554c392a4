#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds Ridgecraft with its tests (installing what is missing with apt) and runs those that are quick.
#   ./test.sh [--all] [--asan | --tsan] [--update-golden] [ctest options]
# --all: every test. Both by clang: --asan under the address and undefined-behaviour sanitizers, --tsan what works on
# several threads under the thread sanitizer.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
preset=test
target=all
only="-LE slow"
while [ $# -gt 0 ]; do
  case "$1" in
    --all) only= ;;
    --asan) preset=clang ;;
    --tsan)
      preset=tsan
      target=thread_tests
      only="-L threads"
      ;;
    # Golden files are written instead of compared; `git diff` is the review.
    --update-golden) export RIDGECRAFT_UPDATE_GOLDEN=1 ;;
    *) break ;;
  esac
  shift
done

more=
[ "$preset" = test ] || more=$here/tests/clang-packages.txt
sh "$here/cmake/install-packages.sh" "$here/cmake/packages.txt" "$here/tests/packages.txt" ${more:+"$more"}

jobs=$(nproc)
mkdir -p "$here/build"
log="$here/build/$preset.log"
. "$here/cmake/quietly.sh"
quietly cmake -S "$here" --preset "$preset"
echo "Building ($preset)" >&2
quietly cmake --build "$here/build/$preset" -j "$jobs" --target "$target"

# What libraries of others leave behind at the program's end is theirs.
export LSAN_OPTIONS="suppressions=$here/tests/leaks.supp:print_suppressions=0"
export ASAN_SYMBOLIZER_PATH=/usr/bin/llvm-symbolizer-22 TSAN_OPTIONS=external_symbolizer_path=/usr/bin/llvm-symbolizer-22

cd "$here/build/$preset"
# shellcheck disable=SC2086 # two words on purpose
ctest --output-on-failure -j "$jobs" $only "$@" && outcome=0 || outcome=$?
# Why tests were skipped, which ctest doesn't print.
sed -n 's/^ *skipped: /skipped: /p' Testing/Temporary/LastTest.log 2>/dev/null | sort | uniq -c >&2 || true
if [ "$only" = "-LE slow" ]; then
  echo "left out: $(ctest -N -L slow | sed -n 's/^Total Tests: *//p') slow tests, on real models and in all browsers; ./test.sh --all runs them" >&2
fi
exit "$outcome"
