// SPDX-License-Identifier: GPL-3.0-or-later
// The options that shaped a result, for `ridgecraft:settings` in its FOLD file: whoever has the model and
// these can make it again. No threads, times and paths: two runs of one job give the same bytes.
#pragma once

#include "cli/arguments/edge_options.hpp"
#include "cli/arguments/options.hpp"
#include "export/export.hpp"

namespace ridgecraft::cli {

/// `size` is the one that was used: a model whose edges were marked or named keeps its faces. Files that name
/// edges are told by the digests of their bytes.
[[nodiscard]] paper::Settings settings_of(const PaperJob& job, const SizeArguments& size,
                                          const EdgeFiles& edges);
[[nodiscard]] paper::Settings settings_of(const UnfoldJob& job, const SizeArguments& size,
                                          const EdgeFiles& edges);

}  // namespace ridgecraft::cli
