// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/needles.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "prepare/prepared/narrow_faces.hpp"

namespace ridgecraft::unfold {
namespace {

/// So many flat regions are kept together at most: where all are narrow, nothing would be left to choose.
constexpr std::uint32_t most_together = 6;
/// What lies beside a needle at its other side may hang on it where so much of the border between them lies
/// across from what the needle is kept with: both fold as at one edge. Elsewhere it would hang on a thread.
constexpr double least_across = 0.5;

/// A side of a flat region, and the one beyond it.
struct BorderSide {
  EdgeId edge;
  std::uint32_t neighbour = 0;
};

class Needles {
 public:
  Needles(const mesh::Surface& surface, const prepare::Panels& panels, const EdgeWishes& wishes)
      : surface_(surface),
        panels_(panels),
        asked_(wishes),
        result_(wishes),
        sets_(panels.count()),
        together_(panels.count(), 1) {}

  EdgeWishes run() {
    for (const PanelId p : ids<PanelId>(panels_.count())) {
      if (prepare::is_narrow(surface_, panels_, p, needle_mm)) {
        keep(p);
      }
    }
    return std::move(result_);
  }

 private:
  void keep(PanelId p) {
    const std::vector<BorderSide> sides = free_sides(p);
    const auto longest = std::max_element(sides.begin(), sides.end(), [&](const auto& a, const auto& b) {
      return surface_.length(a.edge) < surface_.length(b.edge);
    });
    if (longest == sides.end()) {
      return;
    }
    const std::uint32_t both = together_[sets_.find(p.value())] + together_[sets_.find(longest->neighbour)];
    if (both > most_together || !sets_.join(p.value(), longest->neighbour)) {
      return;
    }
    together_[sets_.find(p.value())] = both;
    wish(longest->edge, EdgeWish::needle);
    for (const BorderSide& side : sides) {
      if (side.neighbour != longest->neighbour && result_[side.edge] == EdgeWish::none &&
          !lies_across(side.edge, longest->edge)) {
        wish(side.edge, EdgeWish::cut);
      }
    }
  }

  /// Sides of a panel that nobody has a wish for.
  [[nodiscard]] std::vector<BorderSide> free_sides(PanelId p) const {
    std::vector<BorderSide> sides;
    for (const FaceId f : panels_.faces[p]) {
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId side = mesh::corner(f, k);
        const EdgeId e = surface_.edge(side);
        const FaceId beyond = surface_.neighbor(side);
        if (beyond.valid() && panels_.panel[beyond] != p && (asked_.empty() || asked_[e] == EdgeWish::none)) {
          sides.push_back({e, panels_.panel[beyond].value()});
        }
      }
    }
    return sides;
  }

  /// Along the kept edge, is most of the other one at its height?
  [[nodiscard]] bool lies_across(EdgeId other, EdgeId kept) const {
    const auto [start, end] = ends(kept);
    const double extent = surface_.length(kept);
    const Vec3 along = (end - start) / extent;
    const auto [a, b] = ends(other);
    const double at_a = dot(a - start, along);
    const double at_b = dot(b - start, along);
    const double shared = std::min(std::max(at_a, at_b), extent) - std::max(std::min(at_a, at_b), 0.0);
    return shared >= least_across * surface_.length(other);
  }

  [[nodiscard]] std::array<Vec3, 2> ends(EdgeId edge) const {
    const CornerId side = surface_.sides(edge)[0];
    return {surface_.point(surface_.vertex(side)), surface_.point(surface_.vertex(mesh::next(side)))};
  }

  void wish(EdgeId edge, EdgeWish what) {
    if (result_.empty()) {
      result_ = EdgeWishes(surface_.edge_count(), EdgeWish::none);
    }
    result_[edge] = what;
  }

  const mesh::Surface& surface_;
  const prepare::Panels& panels_;
  const EdgeWishes& asked_;
  EdgeWishes result_;
  DisjointSets sets_;
  std::vector<std::uint32_t> together_;  ///< of each set, at its first
};

}  // namespace

EdgeWishes with_needles_kept(const mesh::Surface& surface, const prepare::Panels& panels,
                             const EdgeWishes& wishes) {
  return Needles(surface, panels, wishes).run();
}

}  // namespace ridgecraft::unfold
