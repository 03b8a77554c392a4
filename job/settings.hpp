// SPDX-License-Identifier: GPL-3.0-or-later
// What a file of nets says of how it was made.
#pragma once

#include <cstdint>

#include "export/export.hpp"
#include "job/options.hpp"

namespace ridgecraft::job {

/// The options that shaped the result, for ridgecraft:settings (docs/reference/formats.md); with the seed
/// they give the same nets again.
[[nodiscard]] export_::Settings settings_of(Options options, const UsedOptions& used, std::uint64_t seed);

/// The settings of paper whose tabs or pages may have been changed since its nets were searched: what was
/// another then follows with "searched_" before its name.
[[nodiscard]] export_::Settings with_searched(export_::Settings now, const export_::Settings& searched);

}  // namespace ridgecraft::job
