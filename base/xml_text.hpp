// SPDX-License-Identifier: GPL-3.0-or-later
// Text inside XML documents (SVG, URDF).
#pragma once

#include <string>
#include <string_view>

namespace ridgecraft {

/// The text with &, <, > and double quotes as entities, fit for content and attributes. The bytes are
/// otherwise taken as they are: valid UTF-8 without control characters is the caller's duty
/// (base/printable.hpp). O(n).
[[nodiscard]] std::string xml_escaped(std::string_view text);

}  // namespace ridgecraft
