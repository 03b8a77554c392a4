#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Whether clang-format (14, Debian 12's) would leave all C++ as it stands; `git ls-files '*.[ch]pp' | xargs clang-format -i`
# mends it.
set -eu
cd "$(dirname "$0")/.."
git ls-files '*.cpp' '*.hpp' | xargs -P "$(nproc)" -n 50 clang-format --dry-run -Werror
