#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds libraries, program and fuzz targets with clang, sanitizers and the portable way of everything (preset clang), and
# holds some results against those of the program that GCC has built in build/test: the same bytes.
set -eu
cd "$(dirname "$0")/.."
sh cmake/install-packages.sh .ci/clang-packages.txt

log=build/clang.log
mkdir -p build
echo "Building (clang)" >&2
if ! { cmake -S . --preset clang && cmake --build build/clang -j "$(nproc)"; } >"$log" 2>&1 </dev/null; then
  cat "$log" >&2
  exit 1
fi

[ -x build/test/ridgecraft ] || exit 0
export ASAN_SYMBOLIZER_PATH=/usr/bin/llvm-symbolizer-22
export LSAN_OPTIONS="suppressions=$PWD/tests/leaks.supp:print_suppressions=0"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for model in whale.obj mug.obj torus.off; do
  for compiler in test clang; do
    "build/$compiler/ridgecraft" "samples/$model" --size 120mm -o "$work/$compiler.fold" -o "$work/$compiler.pdf" >/dev/null
    "build/$compiler/ridgecraft" hulls "samples/$model" -o "$work/$compiler.obj" >/dev/null
  done
  for suffix in fold pdf obj; do
    cmp "$work/test.$suffix" "$work/clang.$suffix" || {
      echo "$model: the $suffix file differs between GCC and clang" >&2
      exit 1
    }
  done
  rm -f "$work"/*
done
