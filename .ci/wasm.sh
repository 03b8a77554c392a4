#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds studio.html, and runs what is tested of it with the program that the stage gcc has built. Where Debian's sources of
# the libraries can't be had, nothing is built, which is said.
set -eu
cd "$(dirname "$0")/.."
sh cmake/install-packages.sh wasm/packages.txt
if ! sh wasm/sources.sh "$PWD/build/wasm/sources"; then
  echo "skipped: studio.html, as the sources of its libraries aren't to be had here" >&2
  exit 0
fi
wasm/build.sh
cd build/test
ctest --output-on-failure -L wasm --parallel "$(nproc)"
