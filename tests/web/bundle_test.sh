#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The modules of the page become one file, and what would make it another program than they are is refused.
#   tests/web/bundle_test.sh CMAKE WEB
set -eu
cmake=$1
web=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bundle() {
  "$cmake" -D HTML="$work/page.html" -P "$work/web/bundle.cmake" >"$work/log" 2>&1
}
fresh() {
  rm -rf "$work/web" "$work/page.html"
  cp -r "$web" "$work/web"
}
refused() {
  if bundle; then
    echo "not refused: $1"
    exit 1
  fi
  grep -q "$2" "$work/log" || {
    cat "$work/log"
    echo "refused for another reason than $1"
    exit 1
  }
  fresh
}
fresh
bundle || {
  cat "$work/log"
  exit 1
}
cp "$work/page.html" "$work/first.html"
bundle
cmp "$work/first.html" "$work/page.html"
if grep -Eq '^(import|export) ' "$work/page.html"; then
  echo "the bundle still imports or exports"
  exit 1
fi
echo 'const readNets = 1;' >>"$work/web/app.js"
refused "a name twice" "is a name of another module"
echo 'import {say as tell} from "./words.js";' >>"$work/web/app.js"
refused "another name for an import" "under another name"
echo 'export default 1;' >>"$work/web/app.js"
refused "a default" "can't be bundled"
echo 'const closing = "<" + "/script>" + "</script>";' >>"$work/web/app.js"
refused "the end of the script" "which ends it"
echo 'const list = "one, two";' >>"$work/web/app.js"
refused "a text outside words.js" "stand in words.js"
