// SPDX-License-Identifier: GPL-3.0-or-later
#include "random_edits.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace ridgecraft::bench {
namespace {

/// An edge that is used so, in either direction; none where none is found soon.
std::optional<session::Edge> any_edge(const session::Project& project, unfold::EdgeUse use, Random& random) {
  const mesh::Surface& surface = project.now.prepared.model.surface;
  const auto edges = static_cast<std::uint32_t>(surface.edge_count());
  for (std::uint32_t tries = 0; tries < 10 * edges; ++tries) {
    const EdgeId e(random.below(edges));
    if (project.now.nets.use[e] == use) {
      const CornerId side = surface.sides(e)[0];
      session::Edge edge{surface.vertex(side), surface.vertex(mesh::next(side))};
      if (random.below(2) == 0) {
        std::swap(edge.from, edge.to);
      }
      return edge;
    }
  }
  return std::nullopt;
}

FaceId any_face(const session::Project& project, PieceId piece, Random& random) {
  const auto& faces = project.now.nets.pieces[piece].faces;
  return faces[random.below(static_cast<std::uint32_t>(faces.size()))];
}

/// Of the pieces that are pinned, or of the others.
std::optional<FaceId> any_face(const session::Project& project, bool pinned, Random& random) {
  const session::State& state = project.state();
  std::vector<PieceId> pieces;
  for (const PieceId p : ids<PieceId>(project.now.nets.pieces.size())) {
    if (state.is_pinned(p) == pinned) {
      pieces.push_back(p);
    }
  }
  if (pieces.empty()) {
    return std::nullopt;
  }
  return any_face(project, pieces[random.below(static_cast<std::uint32_t>(pieces.size()))], random);
}

std::optional<session::Edit> any_place(const session::Project& project, Random& random) {
  const std::optional<FaceId> face = any_face(project, false, random);
  if (!face || !project.state().pages) {
    return std::nullopt;
  }
  const paper::Pages& pages = *project.state().pages;
  const paper::Placement& lies = pages.placements[project.now.nets.piece[*face]];
  const auto& corners = project.now.nets.flat[*face];
  const Vec2 from = lies(corners[0]);
  const Vec2 side = lies(corners[1]) - from;
  session::Place place;
  place.face = *face;
  const double degrees = std::atan2(side.y, side.x) * 180.0 / std::numbers::pi;
  const auto count = static_cast<std::uint32_t>(pages.count);
  if (random.below(4) != 0) {
    constexpr double reach_mm = 20.0;
    place.page = lies.page.value();
    place.at = from + Vec2{reach_mm * (2.0 * random.unit() - 1.0), reach_mm * (2.0 * random.unit() - 1.0)};
    place.degrees = random.below(2) == 0 ? degrees : degrees + 15.0 * (2.0 * random.unit() - 1.0);
  } else {
    place.page = random.below(count + 1);
    place.at = {pages.paper.size.x * random.unit(), pages.paper.size.y * random.unit()};
    place.degrees = degrees + 90.0 * random.below(4);
  }
  return place;
}

std::optional<session::Edit> any_pack(const session::Project& project, Random& random) {
  session::Pack pack;
  for (std::uint32_t pieces = random.below(4); pieces > 0; --pieces) {
    if (const std::optional<FaceId> face = any_face(project, false, random)) {
      pack.faces.push_back(*face);
    }
  }
  return pack;
}

}  // namespace

std::optional<session::Edit> random_edit(const session::Project& project, EditKind kind, Random& random) {
  using unfold::EdgeUse;
  const auto at_edge = [&](EdgeUse use, auto edit) -> std::optional<session::Edit> {
    if (const auto edge = any_edge(project, use, random)) {
      edit.edge = *edge;
      return edit;
    }
    return std::nullopt;
  };
  const auto at_piece = [&](bool pinned, auto edit) -> std::optional<session::Edit> {
    if (const auto face = any_face(project, pinned, random)) {
      edit.face = *face;
      return edit;
    }
    return std::nullopt;
  };
  switch (kind) {
    case EditKind::cut:
      return at_edge(EdgeUse::fold, session::Cut{});
    case EditKind::join:
      return at_edge(EdgeUse::cut, session::Join{});
    case EditKind::tab_from:
      return at_edge(EdgeUse::cut, session::TabFrom{});
    case EditKind::no_tab:
      return at_edge(EdgeUse::cut, session::NoTab{});
    case EditKind::place:
      return any_place(project, random);
    case EditKind::pin:
      if (3 * (project.state().pinned.size() + 1) > project.now.nets.pieces.size()) {
        return std::nullopt;
      }
      return at_piece(false, session::Pin{});
    case EditKind::unpin:
      return at_piece(true, session::Unpin{});
    case EditKind::retry: {
      session::Retry retry;
      retry.seed = 1 + random.below(1000);
      return at_piece(false, retry);
    }
    case EditKind::pack:
      return any_pack(project, random);
  }
  return std::nullopt;
}

}  // namespace ridgecraft::bench
