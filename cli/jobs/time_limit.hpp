// SPDX-License-Identifier: GPL-3.0-or-later
// --time-limit: how each stage ends when the time is up.
#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <type_traits>

#include "base/context.hpp"
#include "base/error.hpp"

namespace ridgecraft::cli {

/// Segmentation may take this share of the time limit, so that some is left for unfolding.
inline constexpr double segmentation_share = 0.5;

/// What the stages of a job get. Without a time limit all three are the same.
struct RunContext {
  /// Ends when the user says so; searches end at the deadline with the best they have.
  Context patient;
  /// Set by the user, or when the time limit has passed.
  std::stop_token time_up;
  /// Set by the user, or when the segmentation's share of it has.
  std::stop_token segmentation_up;
};

/// Runs a stage that has no result before its end, stage(context). Nothing if time was up before; throws
/// Error(interrupted) where the user stopped it.
template <class Stage>
auto if_in_time(const RunContext& run, const std::stop_token& up, const Stage& stage)
    -> std::optional<std::invoke_result_t<Stage, const Context&>> {
  Context strict = run.patient;
  strict.stop = up;
  try {
    return stage(strict);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::interrupted && !run.patient.stop.stop_requested()) {
      return std::nullopt;
    }
    throw;
  }
}

/// The same for what nothing can replace: throws Error(interrupted) with a sentence when the time is up.
template <class Stage>
auto in_time(const RunContext& run, const std::string& doing, const Stage& stage) {
  auto result = if_in_time(run, run.time_up, stage);
  if (!result) {
    throw Error(ErrorKind::interrupted, "--time-limit passed while " + doing + "; nothing was written");
  }
  return std::move(*result);
}

}  // namespace ridgecraft::cli
