// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/telling/exit_code.hpp"

namespace ridgecraft::cli {

ExitCode exit_code(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::internal:
      return ExitCode::internal;
    case ErrorKind::usage:
      return ExitCode::usage;
    case ErrorKind::unreadable_input:
      return ExitCode::unreadable_input;
    case ErrorKind::unusable_mesh:
      return ExitCode::unusable_mesh;
    case ErrorKind::no_nets:
      return ExitCode::no_nets;
    case ErrorKind::unbuildable:
      return ExitCode::unbuildable;
    case ErrorKind::cant_write:
      return ExitCode::cant_write;
    case ErrorKind::interrupted:
    case ErrorKind::out_of_time:
      return ExitCode::interrupted;
  }
  return ExitCode::internal;
}

}  // namespace ridgecraft::cli
