// SPDX-License-Identifier: GPL-3.0-or-later
#include <limits>
#include <span>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include "cli/early_end.hpp"
#include "cli/run.hpp"

namespace {

void heed_signals(int argc, char** argv, char** /*environment*/) {
  ridgecraft::cli::end_at_signals(ridgecraft::cli::asks_for_json(std::span(argv, argv + argc)));
}

// The libraries take about a millisecond to set themselves up before main() begins: by then signals are
// heeded, too, where the C library calls functions before that. Sanitizers can't be used so early.
#if defined(__GLIBC__) && !defined(RIDGECRAFT_SANITIZED)
[[gnu::section(".preinit_array"), gnu::used]] void (*const before_libraries)(int, char**,
                                                                             char**) = heed_signals;
#endif

}  // namespace

int main(int argc, char** argv) {
#if defined(__GLIBC__)
  // Of a large model arrays of many megabytes come and go. Each would get fresh pages, which the system has
  // to clear: a tenth of all time. So what was freed is kept for the next ones.
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
  heed_signals(argc, argv, nullptr);
  return static_cast<int>(ridgecraft::cli::run({argv + 1, argv + argc}));
}
