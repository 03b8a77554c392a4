// SPDX-License-Identifier: GPL-3.0-or-later
// The form of a file as one table: which keys there are, and type, range and size of their values.
#pragma once

#include <string>
#include <vector>

#include "verify/file/json_text.hpp"

namespace ridgecraft::verify {

/// Checks every key, type, length and index range of sections 1 to 3 of the contract, so that a reader needs
/// no checks of its own. Throws NotInForm with the first fault. Returns what is no fault of the form, but one
/// in files of this program: keys of our namespace that are unknown (the first 20) or missing. O(size).
[[nodiscard]] std::vector<std::string> check_form(const Json& file);

}  // namespace ridgecraft::verify
