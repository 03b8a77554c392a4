// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/run.hpp"

int main(int argc, char** argv) {
  return static_cast<int>(ridgecraft::cli::run({argv + 1, argv + argc}));
}
