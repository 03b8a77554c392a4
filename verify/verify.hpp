// SPDX-License-Identifier: GPL-3.0-or-later
// A .fold file becomes figures and faults. Shares no algorithm with unfold/ or export/: a mistake there must
// not be made again here. Read this header first; docs/reference/formats.md has the contract.
#pragma once

#include <span>
#include <string_view>

#include "base/context.hpp"
#include "verify/file/report.hpp"
#include "verify/pages/printed.hpp"

namespace ridgecraft::verify {

/// What nets can be held against besides themselves.
struct Against {
  const ModelSurface* model = nullptr;
  std::span<const PrintedFile> printed;
};

/// Checks the bytes of a .fold file against the promises of docs/reference/formats.md, those about model and
/// pages where they are given. Never throws for what the bytes hold: whatever isn't in the right form is one
/// fault of Promise::form. Throws Error(interrupted). O(n log n) plus the pairs that come near each other.
[[nodiscard]] Report verify(std::string_view bytes, const Options& options, const Context& context,
                            const Against& against = {});

}  // namespace ridgecraft::verify
