#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds a wheel of the Python module, and leaves it in build/wheel, or in the folder that is named; what is missing is
# installed with apt.
# CMAKE_ARGS holds further options for CMake.
#   python/build_wheel.sh && /usr/bin/python3 -m venv --system-site-packages env && env/bin/pip install build/wheel/*.whl
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(dirname "$here")
mkdir -p "${1:-$root/build/wheel}"
wheels=$(cd "${1:-$root/build/wheel}" && pwd)

sh "$root/cmake/install-packages.sh" "$root/cmake/packages.txt" "$here/packages.txt"

# Setuptools leaves its folders where it runs: not in the sources. The packages are those of Debian's own Python; PYTHON
# names another.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$here"
"${PYTHON:-/usr/bin/python3}" setup.py -q egg_info --egg-base "$work" build --build-base "$work/build" bdist_wheel \
  --bdist-dir "$work/wheel" --dist-dir "$wheels"
ls "$wheels"/*.whl
