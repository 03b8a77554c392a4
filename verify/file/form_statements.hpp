// SPDX-License-Identifier: GPL-3.0-or-later
// What a file says besides its nets: how it was made, from what, in which order it is folded.
#pragma once

#include "verify/file/json_text.hpp"

namespace ridgecraft::verify {

/// Reads settings, digest and fold order, and notes keys of our namespace that nobody knows. Pieces and edges
/// are read already. Throws NotInForm. O(size).
void read_statements(const Json& json, File& file);

}  // namespace ridgecraft::verify
