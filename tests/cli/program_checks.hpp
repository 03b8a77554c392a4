// SPDX-License-Identifier: GPL-3.0-or-later
// What the tests of the finished program share: a small model, and how a refusal looks.
#pragma once

#include <string>

#include "support/program.hpp"
#include "support/temporary_folder.hpp"

namespace ridgecraft::test {

/// A house of 4 x 5 x 6: 10 points, 7 polygons.
extern const char* const house;

/// The program's working folder.
[[nodiscard]] RunOptions in(const TemporaryFolder& folder);

/// One sentence on standard error with this word in it, nothing on standard output.
void check_refusal(const Outcome& outcome, int code, const std::string& word);

}  // namespace ridgecraft::test
