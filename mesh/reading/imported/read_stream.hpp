// SPDX-License-Identifier: GPL-3.0-or-later
// What ridgecraft-import found in a file, checked as if a stranger had sent it.
#pragma once

#include <string_view>

#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {

/// Fills a soup of `format` from the bytes of a stream (stream.hpp). `source` is the file that it was made
/// from: its name stands in messages, and pictures that the stream names lie in its folder. Throws
/// unreadable_input for a refusal and for what is no whole stream, unusable_mesh for coordinates that aren't
/// finite. O(n).
[[nodiscard]] Soup read_stream(std::string_view stream, FileFormat format, const Source& source);

}  // namespace ridgecraft::mesh
