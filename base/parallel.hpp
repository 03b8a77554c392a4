// SPDX-License-Identifier: GPL-3.0-or-later
// Independent tasks on several threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "base/context.hpp"

namespace ridgecraft {

/// Calls work(i, own) for each i < count on as many threads as the context allows, and afterwards
/// finished(how many are done) under a lock. `own` is the context with the threads that a task may use by
/// itself. Each i has its own slot to write to, so the number of threads changes nothing. The first error
/// that a task throws ends all and is thrown again.
template <class Work, class Finished>
void do_in_parallel(std::size_t count, const Context& context, Work work, Finished finished) {
  std::atomic<std::size_t> next{0};
  const std::size_t workers =
      std::min<std::size_t>(std::max(context.threads, 1U), std::max<std::size_t>(count, 1));
  // Threads that have no task of their own help where a task can use them.
  Context own = context;
  own.threads = static_cast<unsigned>(std::max<std::size_t>(context.threads / workers, 1));
  std::size_t done = 0;
  std::exception_ptr failure;
  std::mutex mutex;
  const auto take_turns = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i, own);
        const std::lock_guard lock(mutex);
        finished(++done);
      } catch (...) {
        const std::lock_guard lock(mutex);
        failure = failure ? failure : std::current_exception();
        next = count;
        return;
      }
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t t = 1; t < workers; ++t) {
      try {
        others.emplace_back(take_turns);
      } catch (const std::system_error&) {
        break;  // no more threads to be had: those there are do it all
      }
    }
    take_turns();
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
}

/// The same without a word about what is done.
template <class Work>
void do_in_parallel(std::size_t count, const Context& context, Work work) {
  do_in_parallel(count, context, work, [](std::size_t) {});
}

}  // namespace ridgecraft
