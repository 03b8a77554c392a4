// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the contract's own checker, which shares no code with the program.
#pragma once

#include <string>
#include <string_view>

namespace ridgecraft::test {

struct CheckNets {
  bool ran = false;    ///< false where Python or the checker is missing; a WARN says so
  int exit_code = -1;  ///< 0: no fault, 1: faults, 2: not read
  std::string output;  ///< JSON with the figures and the faults
};

/// Writes the bytes to a temporary file and gives it to check_nets.py --json.
[[nodiscard]] CheckNets check_nets(std::string_view fold);

}  // namespace ridgecraft::test
