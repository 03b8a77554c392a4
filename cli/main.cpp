// SPDX-License-Identifier: GPL-3.0-or-later
#include <span>

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
  heed_signals(argc, argv, nullptr);
  return static_cast<int>(ridgecraft::cli::run({argv + 1, argv + argc}));
}
