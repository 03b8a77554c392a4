// SPDX-License-Identifier: GPL-3.0-or-later
// The program's exit codes: documented in docs/reference/exit-codes.md and `ridgecraft --help`, and never
// changed.
#pragma once

#include "base/error.hpp"

namespace ridgecraft::cli {

enum class ExitCode : int {
  ok = 0,
  internal = 1,
  usage = 2,
  unreadable_input = 3,
  unusable_mesh = 4,
  no_nets = 5,
  faults_found = 6,  ///< `verify` found faults
  cant_write = 7,
  untold = 8,       ///< all was done and written, but standard output didn't take the summary
  unbuildable = 9,  ///< --strict: nobody could build it at this size
  interrupted = 130,
};

[[nodiscard]] ExitCode exit_code(ErrorKind kind);

}  // namespace ridgecraft::cli
