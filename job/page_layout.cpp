// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/page_layout.hpp"

#include <variant>

#include "export/export.hpp"
#include "export/sheet/fold_directions.hpp"
#include "job/page_labels.hpp"

namespace ridgecraft::job {

paper::Pages laid_out(const prepare::Prepared& model, const Options& options, const unfold::Nets& nets,
                      const Context& context) {
  const PageLabels labels = page_labels(model.model, options.page_by);
  paper::Pages pages = paper::layout(nets, *options.paper, context, labels_of_pieces(labels, nets),
                                     paper::fold_directions(model.model.surface, nets));
  pages.names = names_of_pages(labels, nets, pages);
  return pages;
}

std::variant<paper::Pages, paper::NoPlace> laid_around(
    const prepare::Prepared& model, const Options& options, const unfold::Nets& nets,
    const IdVector<PieceId, std::optional<paper::KeptPlace>>& kept, const Context& context) {
  const PageLabels labels = page_labels(model.model, options.page_by);
  auto pages = paper::layout_around(nets, *options.paper, kept, context, labels_of_pieces(labels, nets),
                                    paper::fold_directions(model.model.surface, nets));
  if (auto* const laid = std::get_if<paper::Pages>(&pages)) {
    laid->names = names_of_pages(labels, nets, *laid);
  }
  return pages;
}

}  // namespace ridgecraft::job
