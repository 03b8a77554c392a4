// SPDX-License-Identifier: GPL-3.0-or-later
#include <limits>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include "cli/run.hpp"

int main(int argc, char** argv) {
#if defined(__GLIBC__)
  // Of a large model arrays of many megabytes come and go. Each would get fresh pages, which the system has
  // to clear: a tenth of all time. So what was freed is kept for the next ones.
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
  return static_cast<int>(ridgecraft::cli::run({argv + 1, argv + argc}));
}
