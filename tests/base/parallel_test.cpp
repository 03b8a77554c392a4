// SPDX-License-Identifier: GPL-3.0-or-later
// Tasks on several threads: each is done once, and what one throws ends them all.
#include "base/parallel.hpp"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <numeric>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

#include "base/error.hpp"

using namespace ridgecraft;

TEST_CASE("each task is done once, and told when it is done", "[base][threads]") {
  for (const unsigned threads : {0U, 1U, 2U, 5U}) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{3}, std::size_t{1000}}) {
      Context context;
      context.threads = threads;
      std::vector<int> done(count, 0);
      std::vector<std::size_t> told;
      std::atomic<bool> has_threads = true;
      do_in_parallel(
          count, context,
          [&](std::size_t i, const Context& own) {
            ++done[i];
            has_threads = has_threads && own.threads >= 1;
          },
          [&](std::size_t so_far) { told.push_back(so_far); });
      CHECK(done == std::vector<int>(count, 1));
      std::vector<std::size_t> in_order(count);
      std::iota(in_order.begin(), in_order.end(), std::size_t{1});
      CHECK(told == in_order);
      CHECK(has_threads);
    }
  }
}

TEST_CASE("a task has the threads that the others leave", "[base][threads]") {
  Context context;
  context.threads = 8;
  std::vector<unsigned> own_threads(2, 0);
  do_in_parallel(2, context, [&](std::size_t i, const Context& own) { own_threads[i] = own.threads; });
  CHECK(own_threads == std::vector<unsigned>{4, 4});
}

TEST_CASE("the first error ends the others and comes back", "[base][threads]") {
  const std::size_t count = 10000;
  for (const unsigned threads : {1U, 4U}) {
    Context context;
    context.threads = threads;
    std::atomic<std::size_t> begun = 0;
    CHECK_THROWS_AS(do_in_parallel(count, context,
                                   [&](std::size_t i, const Context&) {
                                     ++begun;
                                     if (i == 10) {
                                       throw Error(ErrorKind::no_nets, "the tenth");
                                     }
                                     if (i > 10) {
                                       // On a busy machine the thread that threw may have to wait for its
                                       // turn, while the others would be done with all.
                                       std::this_thread::sleep_for(std::chrono::milliseconds(1));
                                     }
                                   }),
                    Error);
    CHECK(begun < count);
  }
}
