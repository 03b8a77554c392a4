// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/page_layout.hpp"

#include <variant>

#include "export/export.hpp"
#include "export/sheet/pages.hpp"
#include "job/page_labels.hpp"

namespace ridgecraft::job {

export_::Pages laid_out(const prepare::Prepared& model, const Options& options, const unfold::Nets& nets,
                        const Context& context) {
  const PageLabels labels = page_labels(model.model, options.page_by);
  export_::Pages pages =
      export_::layout(nets, *options.paper, context,
                      {labels_of_pieces(labels, nets), export_::fold_directions(model.model.surface, nets)});
  pages.names = names_of_pages(labels, nets, pages);
  return pages;
}

std::variant<export_::Pages, export_::NoPlace> laid_around(
    const prepare::Prepared& model, const Options& options, const unfold::Nets& nets,
    const IdVector<PieceId, std::optional<export_::KeptPlace>>& kept, const Context& context) {
  const PageLabels labels = page_labels(model.model, options.page_by);
  auto pages = export_::layout_around(
      nets, *options.paper, kept, context,
      {labels_of_pieces(labels, nets), export_::fold_directions(model.model.surface, nets)});
  if (auto* const laid = std::get_if<export_::Pages>(&pages)) {
    laid->names = names_of_pages(labels, nets, *laid);
  }
  return pages;
}

}  // namespace ridgecraft::job
