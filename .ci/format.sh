#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Whether clang-format (14, Debian 12's) would leave all C++ as it stands; `git ls-files '*.[ch]pp' | xargs clang-format -i`
# corrects it.
set -eu
cd "$(dirname "$0")/.."
# Not in a pipe, which would hide git's failure: then nothing would be looked at.
files=$(git ls-files '*.cpp' '*.hpp')
[ -n "$files" ] || {
  echo "format: git names no files" >&2
  exit 1
}
printf '%s\n' "$files" | xargs -P "$(nproc)" -n 50 clang-format --dry-run -Werror
