// SPDX-License-Identifier: GPL-3.0-or-later
// Golden files: what the program wrote when somebody last looked at it, kept beside the tests in
// tests/golden.
#pragma once

#include <string>

namespace ridgecraft::test {

/// Compares with tests/golden/NAME; one CHECK, which tells the first line that differs. With
/// RIDGECRAFT_UPDATE_GOLDEN=1 in the environment the file is written anew first, and `git diff` is the
/// review. "ridgecraft 0.1.0" stands there as "ridgecraft VERSION", so that a release changes none of them.
void check_golden(const std::string& name, std::string text);

}  // namespace ridgecraft::test
