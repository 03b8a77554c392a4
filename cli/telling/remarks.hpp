// SPDX-License-Identifier: GPL-3.0-or-later
// What a user may want to stop for, as sentences.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/arguments/options.hpp"
#include "export/sheet/paper.hpp"
#include "job/remark.hpp"
#include "prepare/prepared/options.hpp"

namespace ridgecraft::cli {

/// "this takes about 1200 pages; --size 14mm would take about 10". Expected pages are told in two digits,
/// counted ones all.
[[nodiscard]] std::string sentence(const job::Remark& remark);

/// What a model that is expected to take more pages than these, for its size or its bodies, is refused with;
/// nothing for others.
[[nodiscard]] std::optional<std::string> too_many_pages(const job::Remark& remark, std::uint64_t most_pages);

/// Where a size without a unit makes a tiny model: whoever wrote it may have meant centimetres.
[[nodiscard]] std::optional<std::string> assumed_unit_warning(const AskedSize& asked,
                                                              const prepare::SizeOptions& size);

/// Where the margin is narrower than most printers need.
[[nodiscard]] std::optional<std::string> narrow_margin_warning(const paper::Paper& paper);

}  // namespace ridgecraft::cli
