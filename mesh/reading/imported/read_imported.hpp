// SPDX-License-Identifier: GPL-3.0-or-later
// Formats that a library of others reads: in a process of its own (import/), which may crash or grow without
// harm, and whose findings are checked as if a stranger had sent them.
#pragma once

#include <string>
#include <string_view>

#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {

/// Hands the source's bytes to its importer (Source::importer), which must be there, and returns what that
/// says (stream.hpp). The process opens no files; it has a minute of processor time and 2 GiB of memory, and
/// ends when this one is asked to stop. Throws unreadable_input where it breaks down, interrupted,
/// out_of_time.
[[nodiscard]] std::string run_importer(FileFormat format, const Source& source);

/// Fills a soup of `format` from the bytes of a stream (stream.hpp). `source` is the file that it was made
/// from: its name stands in messages, and pictures that the stream names lie in its folder. Throws
/// unreadable_input for a refusal and for what is no whole stream, unusable_mesh for coordinates that aren't
/// finite. O(n).
[[nodiscard]] Soup read_stream(std::string_view stream, FileFormat format, const Source& source);

}  // namespace ridgecraft::mesh
