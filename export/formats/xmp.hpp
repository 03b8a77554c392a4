// SPDX-License-Identifier: GPL-3.0-or-later
// What a PDF tells of itself in the form that cataloguing programs read: XMP (ISO 16684-1).
#pragma once

#include <string>

#include "export/sheet/mark.hpp"

namespace ridgecraft::paper {

/// The packet: title, program and keywords as in the document's information, and the settings as one JSON
/// text under a name of our own. Its dates are fixed, so that two runs give the same bytes.
[[nodiscard]] std::string xmp_packet(const Mark& mark);

}  // namespace ridgecraft::paper
