#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# run.sh FOLDER SECONDS [INPUTS]: each fuzz target in the folder for so long, from the corpus that is kept beside this file;
# as many at once as there are processors. With INPUTS it ends after so many, if the time allows, and these are the same
# in each run: so whoever has changed something isn't told of others' mistakes. An input that breaks one is left in
# FOLDER/found.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
cd "$1"
limits="-max_total_time=$2"
[ -z "${3:-}" ] || limits="$limits -runs=$3 -seed=1"
mkdir -p found
find . -maxdepth 1 -type f -name 'fuzz_*' -perm -u+x | sort | sed 's,^\./,,' |
  xargs -P "$(nproc)" -n 1 sh -c '
    corpus=$0/corpus/${2#fuzz_}
    [ -d "$corpus" ] || corpus=
    new=$(mktemp -d)
    outcome=0
    ./"$2" $1 -max_len=4096 -timeout=10 -rss_limit_mb=2048 -print_final_stats=1 \
      -artifact_prefix="found/$2-" "$new" $corpus >"$2.log" 2>&1 || outcome=1
    rm -rf "$new"
    if [ "$outcome" = 0 ]; then
      echo "$2: $(sed -n "s/^stat::number_of_executed_units: *//p" "$2.log") inputs" >&2
    else
      tail -n 60 "$2.log" >&2
      echo "$2 broke; its log is $PWD/$2.log, the input lies in $PWD/found" >&2
    fi
    exit "$outcome"' "$here" "$limits"
