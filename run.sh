#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds Ridgecraft when needed (installing what is missing with apt) and runs it: ./run.sh MODEL [options]
set -eu
here=$(cd "$(dirname "$0")" && pwd)

sh "$here/cmake/install-packages.sh" "$here/cmake/packages.txt"

build="$here/build/release"
log="$here/build/release.log"
mkdir -p "$here/build"
# Chatter goes to a log, so that standard output is the program's alone.
. "$here/cmake/quietly.sh"
if [ ! -f "$build/build.ninja" ]; then
  echo "Building Ridgecraft; the first time takes a few minutes ($log tells how far it is)." >&2
  quietly cmake -S "$here" --preset release
fi
quietly cmake --build "$build"

exec "$build/ridgecraft" "$@"
