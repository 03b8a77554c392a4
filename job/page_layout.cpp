// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/page_layout.hpp"

#include <map>
#include <utility>
#include <variant>

#include "export/export.hpp"
#include "export/sheet/pages.hpp"
#include "prepare/prepared/panels.hpp"

namespace ridgecraft::job {
namespace {

/// What a face has by which it is sorted: a number, and what people call it.
std::pair<std::uint32_t, std::string> key_of(const mesh::Model& model, FaceId f, PageBy by) {
  if (by == PageBy::object) {
    const std::string name = model.object_name(f);
    return {model.object.empty() ? mesh::Soup::none : model.object[f], name.empty() ? "no name" : name};
  }
  const std::uint32_t material = model.material.empty() ? mesh::Soup::none : model.material[f];
  return {material, material == mesh::Soup::none             ? "no material"
                    : model.materials[material].name.empty() ? "material " + std::to_string(material + 1)
                                                             : model.materials[material].name};
}

}  // namespace

PageLabels page_labels(const mesh::Model& model, PageBy by) {
  PageLabels labels;
  if (by == PageBy::any) {
    return labels;
  }
  // In the file's order; what has none comes last.
  std::map<std::uint32_t, std::string> names;
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    names.insert(key_of(model, f, by));
  }
  std::map<std::uint32_t, std::uint32_t> number;
  for (auto& [key, name] : names) {
    number.emplace(key, static_cast<std::uint32_t>(labels.name.size()));
    labels.name.push_back(std::move(name));
  }
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    labels.of_face.push_back(number.at(key_of(model, f, by).first));
  }
  return labels;
}

void part_by_labels(const PageLabels& labels, prepare::Prepared& prepared,
                    unfold::EdgeConstraints& constraints) {
  if (!labels.any()) {
    return;
  }
  const mesh::Surface& surface = prepared.model.surface;
  prepared.twins.clear();
  prepared.panels = prepare::divided_by(prepared.panels, surface, labels.of_face);
  if (constraints.empty()) {
    constraints = unfold::EdgeConstraints(surface.edge_count(), unfold::EdgeConstraint::none);
  }
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [c, d] = surface.sides(e);
    if (d.valid() && labels.of_face[mesh::face_of(c)] != labels.of_face[mesh::face_of(d)]) {
      constraints[e] = unfold::EdgeConstraint::cut;
    }
  }
}

IdVector<PieceId, std::uint32_t> labels_of_pieces(const PageLabels& labels, const unfold::Nets& nets) {
  IdVector<PieceId, std::uint32_t> of_piece;
  for (const unfold::Piece& piece : nets.pieces) {
    of_piece.push_back(labels.any() ? labels.of_face[piece.faces.front()] : 0);
  }
  return of_piece;
}

std::vector<std::string> names_of_pages(const PageLabels& labels, const unfold::Nets& nets,
                                        const export_::Pages& pages) {
  if (!labels.any()) {
    return {};
  }
  std::vector<std::string> names(pages.count);
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    names[pages.placements[p].page.value()] = labels.name[labels.of_face[nets.pieces[p].faces.front()]];
  }
  return names;
}

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
