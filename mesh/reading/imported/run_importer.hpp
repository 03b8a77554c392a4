// SPDX-License-Identifier: GPL-3.0-or-later
// Formats that a library of others reads: in a process of its own, which may crash or grow without harm.
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

}  // namespace ridgecraft::mesh
