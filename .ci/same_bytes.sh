#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Holds some results of the program that clang has built with the portable way of everything and sanitizers (build/clang)
# against those of the one that GCC has built (build/test): the same bytes.
set -eu
cd "$(dirname "$0")/.."
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
