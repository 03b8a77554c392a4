#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the program for browsers: build/wasm/ridgecraft.js and ridgecraft.wasm, and, with the page around them,
# build/wasm/studio.html. What is missing is installed with apt (emscripten takes 1.2 GB). JOBS says how many compilers run
# at a time.
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
build="$here/build/wasm"

sh "$here/cmake/install-packages.sh" "$here/cmake/packages.txt" "$here/wasm/packages.txt"
sh "$here/wasm/sources.sh" "$build/sources"

# Debian's emscripten looks for its parser of JavaScript where Debian's node does; others must be told. Its glue asks
# whether there is `fetch`, which newer ones have and mustn't use.
NODE_PATH=${NODE_PATH:-/usr/share/nodejs}
export NODE_PATH

mkdir -p "$build"
log="$here/build/wasm.log"
. "$here/cmake/quietly.sh"
if [ ! -f "$build/build.ninja" ]; then
  echo "Building Ridgecraft for browsers; the first time takes some minutes ($log tells how far it is)." >&2
  cd "$here"
  quietly cmake --preset wasm
fi
quietly cmake --build "$build" -j "${JOBS:-$(nproc)}" --target ridgecraft_worker

frame="$build/studio-frame.html"
quietly sh "$here/web/bundle.sh" studio "$frame"
version=$(sed -n 's/^project(ridgecraft VERSION \([0-9.]*\).*/\1/p' "$here/CMakeLists.txt")
node "$here/wasm/studio.mjs" "$frame" "$build" "$here" "$version" "$build/studio.html"
echo "$build/studio.html" >&2
