// SPDX-License-Identifier: GPL-3.0-or-later
// Long work beside the interpreter: other threads of Python run meanwhile, Ctrl-C ends it, progress is told.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include <pybind11/pybind11.h>

#include "base/context.hpp"

namespace ridgecraft::python {

/// What every function of the module takes besides its input.
struct RunSettings {
  unsigned threads = 0;  ///< 0: as many as the machine has
  std::uint64_t seed = 1;
  std::optional<double> time_limit_s;
  pybind11::object progress;  ///< called with the stage's name and the share done, from the caller's thread
};

/// From threads, seed, time limit (or None) and progress, as Python's functions pass them. Throws
/// Error(usage) with a sentence about the one that can't be: an argument of a wrong type would be told of
/// with all arguments, the mesh among them.
[[nodiscard]] RunSettings run_settings(const pybind11::tuple& run);

/// Does the work on a thread of its own and waits for it without the interpreter's lock. Signals that Python
/// has a handler for, Ctrl-C first of all, are looked for every few milliseconds: what the handler raises
/// stops the work, as does what `progress` raises. Work that doesn't stop at once (a library may be in the
/// middle of something) is left behind: it ends by itself, and its result with it. `work` must own all that
/// it uses, and know nothing of Python.
void run_in_background(std::function<void(const Context&)> work, const RunSettings& settings);

/// The same for work that gives a value.
template <class Work>
auto result_in_background(Work work, const RunSettings& settings) {
  using Result = decltype(work(std::declval<const Context&>()));
  const auto result = std::make_shared<std::optional<Result>>();
  run_in_background(
      [result, work = std::move(work)](const Context& context) mutable { *result = work(context); },
      settings);
  return std::move(**result);
}

/// Work that was left behind is waited for before the interpreter ends.
void wait_for_left_work_at_exit();

}  // namespace ridgecraft::python
