// SPDX-License-Identifier: GPL-3.0-or-later
// The lists of our own namespace: pages, pieces, joins, tabs, and what each face belongs to.
#pragma once

#include "verify/file/json_text.hpp"

namespace ridgecraft::verify {

/// Reads every "ridgecraft:" list of the top frame into the file, whose model, faces and edges are read
/// already. Throws NotInForm.
void read_lists(const Json& json, File& file);

/// The number of a part: whole, and such that every reader of JSON keeps it (below 2^53 in size).
[[nodiscard]] std::int64_t part_number(const Json& value, const Spot& spot);

}  // namespace ridgecraft::verify
