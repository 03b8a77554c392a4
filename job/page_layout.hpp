// SPDX-License-Identifier: GPL-3.0-or-later
// Pages of one material or of one object each, for paper in several colours.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/context.hpp"
#include "base/id.hpp"
#include "export/layout_around.hpp"
#include "export/sheet/pages.hpp"
#include "job/options.hpp"
#include "prepare/prepared/prepared.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"

namespace ridgecraft::job {

/// Of each face what decides on its pages; faces without a material or name have a label, too.
struct PageLabels {
  IdVector<FaceId, std::uint32_t> of_face;
  std::vector<std::string> name;  ///< of each label; fit for people

  [[nodiscard]] bool any() const { return name.size() > 1; }
};

/// No labels where pages may hold anything, or all faces have one label. O(n).
[[nodiscard]] PageLabels page_labels(const mesh::Model& model, PageBy by);

/// Flat regions end where labels do, and every edge there is to be cut, so that each piece has one label.
/// Equal bodies count as different ones: they may differ by their labels. O(n log n).
void part_by_labels(const PageLabels& labels, prepare::Prepared& prepared,
                    unfold::EdgeConstraints& constraints);

/// Of each piece.
[[nodiscard]] IdVector<PieceId, std::uint32_t> labels_of_pieces(const PageLabels& labels,
                                                                const unfold::Nets& nets);

/// What the pieces of each page have in common.
[[nodiscard]] std::vector<std::string> names_of_pages(const PageLabels& labels, const unfold::Nets& nets,
                                                      const export_::Pages& pages);

// Nets onto the pages of a job: in which order they come, and what stands above them.

/// The nets on pages, each of one label where that is wanted. The options have paper. Throws as
/// export_::layout().
[[nodiscard]] export_::Pages laid_out(const prepare::Prepared& model, const Options& options,
                                      const unfold::Nets& nets, const Context& context);

/// The same around pieces that lie somewhere already (export/layout_around.hpp).
[[nodiscard]] std::variant<export_::Pages, export_::NoPlace> laid_around(
    const prepare::Prepared& model, const Options& options, const unfold::Nets& nets,
    const IdVector<PieceId, std::optional<export_::KeptPlace>>& kept, const Context& context);

}  // namespace ridgecraft::job
