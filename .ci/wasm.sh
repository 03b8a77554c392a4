#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds studio.html, and runs what is tested of it with the program that the stage gcc has built.
set -eu
cd "$(dirname "$0")/.."
wasm/build.sh
cd build/test
ctest --output-on-failure -L wasm
