#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Fetches what the tests of the page run on (package-lock.json) into a folder, where it isn't there yet.
#   tests/web/tools.sh FOLDER
set -eu
here=$(cd "$(dirname "$0")" && pwd)
folder=$1
skip() {
  echo "skipped: $1"
  exit 77
}
command -v npm >/dev/null || skip "npm is missing"
cmp -s "$here/package-lock.json" "$folder/package-lock.json" && [ -e "$folder/complete" ] && exit 0
mkdir -p "$folder"
rm -f "$folder/complete"
cp "$here/package.json" "$here/package-lock.json" "$folder/"
cd "$folder"
npm ci --no-audit --no-fund --ignore-scripts --loglevel=error >npm.log 2>&1 || {
  cat npm.log
  skip "npm couldn't fetch the tools"
}
touch complete
