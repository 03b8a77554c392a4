// SPDX-License-Identifier: GPL-3.0-or-later
// --time-limit: how a stage ends that has nothing when the time is up.
#pragma once

#include <string>

#include "base/context.hpp"
#include "base/error.hpp"

namespace ridgecraft::cli {

/// What completes a result (tabs, numbers on pages) may go on for this share of the time limit beyond it: a
/// model of ordinary size gets all of them.
inline constexpr double finishing_share = 0.1;

/// Runs stage(context that is given up at the deadline). Throws Error(out_of_time) with a sentence for users
/// when the time is up before its end.
template <class Stage>
auto in_time(const Context& context, const std::string& doing, const Stage& stage) {
  try {
    return stage(until_deadline(context));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::out_of_time) {
      throw;
    }
    throw Error(ErrorKind::out_of_time, "--time-limit passed while " + doing + "; nothing was written");
  }
}

}  // namespace ridgecraft::cli
