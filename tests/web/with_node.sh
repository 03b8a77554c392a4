#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs a script with node; skipped where there is none, or no such script.
set -eu
skip() {
  echo "skipped: $1"
  exit 77
}
command -v node >/dev/null || skip "node is missing"
[ "$1" = --test ] || [ -e "$1" ] || skip "$1 is missing (tests/web/tools.sh fetches the tools)"
exec node "$@"
