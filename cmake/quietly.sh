# SPDX-License-Identifier: GPL-3.0-or-later
# For scripts that build: . cmake/quietly.sh, after setting `log` to a file.
# quietly COMMAND...: chatter goes to the log, and is shown where the command fails; the script ends then.
quietly() {
  if ! "$@" >"$log" 2>&1 </dev/null; then
    cat "$log" >&2
    echo "The build failed; the log is $log" >&2
    exit 1
  fi
}
