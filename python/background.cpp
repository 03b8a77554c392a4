// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/background.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <limits>
#include <mutex>
#include <string>
#include <thread>

#include <fmt/format.h>

#include "base/error.hpp"

namespace ridgecraft::python {
namespace {

namespace py = pybind11;
using namespace std::chrono_literals;

/// How often signals are looked for, and at most how often progress is told.
constexpr auto look_every = 20ms;
/// How long work has to end after it was asked to stop, before it is left behind: with the time above it is
/// less than the fifth of a second within which a person takes an answer for immediate.
constexpr auto patience = 100ms;

/// What the caller's thread and the working one share; it lives as long as either needs it.
struct Shared {
  std::mutex mutex;
  std::condition_variable changed;
  bool done = false;
  std::exception_ptr failure;
  std::string stage;
  double share = 0.0;
  bool told = true;  ///< the caller has told of stage and share
  StopSource stop;
};

/// How many workers there are, those that were left behind among them: nothing else knows of these any more.
std::atomic<int>& workers() {
  static std::atomic<int> count{0};
  return count;
}

/// A whole number from 0 to `most`.
template <class Number>
Number whole_number(const char* name, const py::handle& value, Number most) {
  try {
    const auto number = py::cast<Number>(value);
    if (number <= most) {
      return number;
    }
  } catch (const py::cast_error&) {
    // What follows says it.
  }
  throw Error(ErrorKind::usage, fmt::format("{} is a whole number from 0 to {}", name, most));
}

Context context_of(const std::shared_ptr<Shared>& shared, const RunSettings& settings) {
  constexpr double longest_s = 1e9;
  if (settings.time_limit_s && !(*settings.time_limit_s > 0.0 && *settings.time_limit_s <= longest_s)) {
    throw Error(ErrorKind::usage, "time_limit is a number of seconds above 0");
  }
  Context context;
  constexpr unsigned most_threads = 256;
  context.threads = settings.threads > 0 ? std::min(settings.threads, most_threads)
                                         : std::max(1U, std::thread::hardware_concurrency());
  context.seed = settings.seed;
  context.stop = shared->stop.get_token();
  if (settings.time_limit_s) {
    // What completes a result (tabs, numbers on pages) may take a tenth longer.
    constexpr double finishing_share = 0.1;
    context.deadline = Deadline::in(*settings.time_limit_s);
    context.grace_s = finishing_share * *settings.time_limit_s;
  }
  context.progress = [shared](std::string_view stage, double share) {
    const std::lock_guard lock(shared->mutex);
    shared->told = shared->told && stage == shared->stage && share == shared->share;
    shared->stage = stage;
    shared->share = share;
  };
  return context;
}

/// Waits without the interpreter's lock. True when the work is done.
bool wait(Shared& shared, std::chrono::milliseconds time) {
  const py::gil_scoped_release unlocked;
  std::unique_lock lock(shared.mutex);
  return shared.changed.wait_for(lock, time, [&] { return shared.done; });
}

void tell(Shared& shared, const py::object& progress) {
  if (progress.is_none()) {
    return;
  }
  std::string stage;
  double share = 0.0;
  {
    const py::gil_scoped_release unlocked;
    const std::lock_guard lock(shared.mutex);
    if (shared.told) {
      return;
    }
    shared.told = true;
    stage = shared.stage;
    share = shared.share;
  }
  progress(stage, share);
}

void end_or_leave(std::thread& worker, const std::shared_ptr<Shared>& shared) {
  shared->stop.request_stop();
  if (wait(*shared, patience)) {
    worker.join();
  } else {
    worker.detach();
  }
}

}  // namespace

RunSettings run_settings(const py::tuple& run) {
  RunSettings settings;
  settings.threads = whole_number<unsigned>("threads", run[0], std::numeric_limits<unsigned>::max());
  settings.seed = whole_number<std::uint64_t>("seed", run[1], std::numeric_limits<std::uint64_t>::max());
  if (!run[2].is_none()) {
    try {
      settings.time_limit_s = py::cast<double>(run[2]);
    } catch (const py::cast_error&) {
      throw Error(ErrorKind::usage, "time_limit is a number of seconds above 0");
    }
  }
  settings.progress = run[3];
  return settings;
}

void run_in_background(std::function<void(const Context&)> work, const RunSettings& settings) {
  const auto shared = std::make_shared<Shared>();
  const Context context = context_of(shared, settings);
  ++workers();
  std::thread worker([shared, context, work = std::move(work)]() mutable {
    std::exception_ptr failure;
    try {
      work(context);
    } catch (...) {
      failure = std::current_exception();
    }
    work = nullptr;
    {
      const std::lock_guard lock(shared->mutex);
      shared->failure = failure;
      shared->done = true;
    }
    shared->changed.notify_all();
    --workers();
  });
  try {
    while (!wait(*shared, look_every)) {
      if (PyErr_CheckSignals() != 0) {
        throw py::error_already_set();
      }
      tell(*shared, settings.progress);
    }
  } catch (...) {
    end_or_leave(worker, shared);
    throw;
  }
  worker.join();
  if (shared->failure) {
    std::rethrow_exception(shared->failure);
  }
  tell(*shared, settings.progress);
}

void wait_for_left_work_at_exit() {
  py::module_::import("atexit").attr("register")(py::cpp_function([] {
    while (workers() > 0) {
      {
        const py::gil_scoped_release unlocked;
        std::this_thread::sleep_for(look_every);
      }
      // Ctrl-C once more: whoever is that impatient gets an end in the middle of the work.
      if (PyErr_CheckSignals() != 0) {
        throw py::error_already_set();
      }
    }
  }));
}

}  // namespace ridgecraft::python
