// SPDX-License-Identifier: GPL-3.0-or-later
// Nets onto the pages of a job: in which order they come, and what stands above them.
#pragma once

#include <optional>
#include <variant>

#include "base/context.hpp"
#include "base/id.hpp"
#include "export/layout_around.hpp"
#include "export/sheet/pages.hpp"
#include "job/options.hpp"
#include "prepare/prepared/prepared.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::job {

/// The nets on pages, each of one label where that is wanted. The options have paper. Throws as
/// export_::layout().
[[nodiscard]] export_::Pages laid_out(const prepare::Prepared& model, const Options& options,
                                      const unfold::Nets& nets, const Context& context);

/// The same around pieces that lie somewhere already (export/layout_around.hpp).
[[nodiscard]] std::variant<export_::Pages, export_::NoPlace> laid_around(
    const prepare::Prepared& model, const Options& options, const unfold::Nets& nets,
    const IdVector<PieceId, std::optional<export_::KeptPlace>>& kept, const Context& context);

}  // namespace ridgecraft::job
