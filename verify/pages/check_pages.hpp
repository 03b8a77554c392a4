// SPDX-License-Identifier: GPL-3.0-or-later
// What is printed against the nets.
#pragma once

#include <span>

#include "verify/pages/printed.hpp"
#include "verify/relations/case.hpp"
#include "verify/report/findings.hpp"

namespace ridgecraft::verify {

/// Promise 10. Each printed page against the page of the nets that it says it is (or, where it doesn't say
/// so, in the order given): size, outlines with their tabs, folds, bases of tabs, patterns, the scale bar.
/// Lines are compared as sets of points, so it doesn't matter how they are divided. Pages that aren't given
/// aren't missed, but for those of a file that has to be whole. O(n log n).
void check_pages(const Case& given, std::span<const PrintedFile> printed, Findings& findings);

}  // namespace ridgecraft::verify
