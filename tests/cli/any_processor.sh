#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# any_processor.sh PROGRAM SAMPLES_FOLDER SHARED_FOLDER: glibc chooses its functions by what the processor can do. The program's files are
# the same where it is told that this one can do little.
set -eu
program=$1
samples=$2
helmet=$3/models/makers/knight_helmet.stl
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
models="$samples/fox_head.obj $samples/mug.obj"
if [ -f "$helmet" ]; then
  # One that came out otherwise, before.
  models="$models $helmet"
else
  echo "without $helmet, which isn't here"
fi
for model in $models; do
  name=$(basename "${model%.*}")
  mkdir "$work/$name-all" "$work/$name-few"
  "$program" "$model" -q --no-guide -o "$work/$name-all/$name.fold" -o "$work/$name-all/$name.svg"
  GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX,-AVX2,-AVX512F,-AVX_Usable,-AVX2_Usable,-FMA_Usable,-FMA4_Usable \
    "$program" "$model" -q --no-guide -o "$work/$name-few/$name.fold" -o "$work/$name-few/$name.svg"
  diff -r "$work/$name-all" "$work/$name-few"
done
