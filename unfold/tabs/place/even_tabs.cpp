// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/place/even_tabs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "unfold/net/equal_pieces.hpp"
#include "unfold/tabs/shape/trimming.hpp"

namespace ridgecraft::unfold {
namespace {

using Chosen = std::vector<std::optional<ChosenTab>>;

/// Pieces of a kind that are tried as the model for the others.
constexpr std::size_t most_models = 6;

/// What was cut back to the clearance on one piece keeps it but for rounding on the other, mm.
constexpr double equal_clearance_mm = 1e-6;

/// Tabs that touch on one piece may overlap so much on another, mm: a fifth of what counts as a fault.
constexpr double most_overlap_mm = 2e-4;

/// For each site of the first piece of a kind the same place on another: empty where there isn't exactly one.
using Images = std::vector<std::uint32_t>;

Vec2 middle_of(const TabSite& site) {
  return site.own.out(Vec2{0.5 * site.length, 0.0});
}

Images images_of(const std::vector<TabSite>& sites, const std::vector<std::uint32_t>& first,
                 const std::vector<std::uint32_t>& other, const EqualPiece& equal) {
  std::vector<std::pair<double, std::uint32_t>> by_x;
  for (const std::uint32_t s : other) {
    by_x.emplace_back(middle_of(sites[s]).x, s);
  }
  std::sort(by_x.begin(), by_x.end());
  Images images;
  for (const std::uint32_t s : first) {
    Vec2 p = middle_of(sites[s]);
    p = equal.motion(equal.mirrored ? Vec2{-p.x, p.y} : p);
    // Two sides of a slit that is closed lie in one place: they run against each other.
    Vec2 axis = sites[s].own.axis;
    axis = equal.motion.turn(equal.mirrored ? Vec2{axis.x, -axis.y} : axis);
    std::uint32_t found = 0;
    std::size_t count = 0;
    for (auto at = std::lower_bound(by_x.begin(), by_x.end(), std::pair(p.x - 2.0 * equal_pieces_mm, 0U));
         at != by_x.end() && at->first <= p.x + 2.0 * equal_pieces_mm; ++at) {
      const TabSite& site = sites[at->second];
      if (length(middle_of(site) - p) <= 2.0 * equal_pieces_mm && dot(site.own.axis, axis) > 0.9 &&
          std::abs(site.length - sites[s].length) <= 2.0 * equal_pieces_mm) {
        found = at->second;
        ++count;
      }
    }
    if (count != 1) {
      return {};
    }
    images.push_back(found);
  }
  return images;
}

/// The shape on an edge of another length, which differs by no more than pieces do that count as equal. The
/// base is that of the edge: a corner that was at its end is at the other's end.
ConvexShape fitted(const ConvexShape& shape, double before, double length) {
  ConvexShape result = shape;
  for (std::uint32_t i = 0; i < 2; ++i) {
    result[i].x = result[i].x >= before ? length : std::clamp(result[i].x, 0.0, length);
  }
  return result;
}

class TabCopier {
 public:
  TabCopier(const std::vector<TabSite>& sites, const TabOptions& options, std::span<const TabWish> wishes)
      : sites_(sites), options_(options), wishes_(wishes) {}

  /// The tabs of one piece on another; nothing where a join would lose its tab, a tab would be in something's
  /// way, or one would be another than is wished. `from`, `to`: sites of either that belong together.
  [[nodiscard]] std::optional<Chosen> copied(const Chosen& chosen, const Images& from, const Images& to,
                                             bool mirrored) const {
    Chosen result = chosen;
    for (std::size_t i = 0; i < from.size(); ++i) {
      const std::optional<ChosenTab>& tab = chosen[from[i] / 2];
      std::optional<ChosenTab>& own = result[to[i] / 2];
      if (tab && tab->site == from[i]) {
        ChosenTab copy{to[i], tab->shape};
        copy.shape.outline = fitted(copy.shape.outline, sites_[from[i]].length, sites_[to[i]].length);
        if (mirrored) {
          copy.shape.outline = turned_over(copy.shape.outline, sites_[to[i]].length);
        }
        if (!is_wished(from[i], to[i], own) || !is_clear(sites_[to[i]], copy.shape.outline)) {
          return std::nullopt;
        }
        own = copy;
      } else if (const std::optional<ChosenTab>& before = chosen[to[i] / 2];
                 before && before->site == to[i] && !gets_another(chosen, from[i])) {
        return std::nullopt;
      }
    }
    return tabs_overlap(result, to) ? std::nullopt : std::optional(std::move(result));
  }

 private:
  /// Pieces are equal but for a hundredth of a millimetre: tabs that touched on one may overlap on the other.
  [[nodiscard]] bool tabs_overlap(const Chosen& chosen, const Images& sites) const {
    struct Placed {
      double low = 0.0, high = 0.0;  ///< in x
      ConvexShape shape;
    };
    std::vector<Placed> tabs;
    for (const std::uint32_t site : sites) {
      if (chosen[site / 2] && chosen[site / 2]->site == site) {
        Placed tab{INFINITY, -INFINITY, sites_[site].own.out(chosen[site / 2]->shape.outline)};
        for (const Vec2 p : tab.shape) {
          tab.low = std::min(tab.low, p.x);
          tab.high = std::max(tab.high, p.x);
        }
        tabs.push_back(tab);
      }
    }
    std::sort(tabs.begin(), tabs.end(), [](const Placed& a, const Placed& b) { return a.low < b.low; });
    for (std::size_t i = 0; i < tabs.size(); ++i) {
      for (std::size_t j = i + 1; j < tabs.size() && tabs[j].low <= tabs[i].high; ++j) {
        if (separation(tabs[i].shape, tabs[j].shape) < -most_overlap_mm) {
          return true;
        }
      }
    }
    return false;
  }

  /// Whether the join of a site has its tab at its other side, and both sides belong to one piece.
  [[nodiscard]] bool gets_another(const Chosen& chosen, std::uint32_t site) const {
    return chosen[site / 2] && sites_[site].piece == sites_[site].target_piece;
  }
  /// Whether what is wished of one site is wished of the other, too, where now `own` is the tab of the join.
  [[nodiscard]] bool is_wished(std::uint32_t from, std::uint32_t to,
                               const std::optional<ChosenTab>& own) const {
    if (wishes_.empty()) {
      return true;
    }
    const TabWish& there = wishes_[from / 2];
    const TabWish& wish = wishes_[to / 2];
    const bool at_its_side = !wish.side || *wish.side == to % 2 || (own && own->site == to);
    return wish.wanted && at_its_side && wish.options.height_mm == there.options.height_mm &&
           wish.options.angle == there.options.angle;
  }
  [[nodiscard]] bool is_clear(const TabSite& site, const ConvexShape& shape) const {
    return std::all_of(site.obstacles.begin(), site.obstacles.end(), [&](const Obstacle& obstacle) {
      return clear_of(shape, obstacle, options_.clearance_mm - equal_clearance_mm);
    });
  }

  const std::vector<TabSite>& sites_;
  const TabOptions& options_;
  std::span<const TabWish> wishes_;  // of each join, or none
};

}  // namespace

ConvexShape turned_over(const ConvexShape& shape, double length) {
  ConvexShape result;
  for (std::uint32_t i = 0; i < shape.size(); ++i) {
    // The corners stay counterclockwise, and the first two on the base.
    const Vec2 p = shape[(shape.size() + 1 - i) % shape.size()];
    result.push_back({length - p.x, p.y});
  }
  return result;
}

void even_tabs(const mesh::Surface& surface, const Nets& nets, const std::vector<TabSite>& sites,
               const TabOptions& options, std::span<const TabWish> wishes,
               std::vector<std::optional<ChosenTab>>& chosen) {
  std::size_t faces = 0;
  for (const Piece& piece : nets.pieces) {
    faces += piece.faces.size();
  }
  if (faces < nets.piece.size()) {
    return;  // a few pieces of a search
  }
  const std::vector<std::vector<EqualPiece>> kinds = find_equal_pieces(surface, nets);
  if (kinds.empty()) {
    return;
  }
  IdVector<PieceId, std::vector<std::uint32_t>> of_piece(nets.pieces.size());
  for (std::uint32_t s = 0; s < sites.size(); ++s) {
    of_piece[sites[s].piece].push_back(s);
  }
  const TabCopier copier(sites, options, wishes);
  for (const std::vector<EqualPiece>& kind : kinds) {
    std::vector<std::pair<Images, bool>> members;  // in the order of the first one's sites, mirrored
    for (const EqualPiece& equal : kind) {
      Images images = images_of(sites, of_piece[kind[0].piece], of_piece[equal.piece], equal);
      if (!images.empty()) {
        members.emplace_back(std::move(images), equal.mirrored);
      }
    }
    Chosen best = chosen;
    std::size_t most = 0;
    for (std::size_t m = 0; m < std::min(members.size(), most_models) && most + 1 < members.size(); ++m) {
      Chosen evened = chosen;
      std::size_t alike = 0;
      for (std::size_t i = 0; i < members.size(); ++i) {
        if (i == m) {
          continue;
        }
        const bool mirrored = members[i].second != members[m].second;
        if (auto copy = copier.copied(evened, members[m].first, members[i].first, mirrored)) {
          evened = std::move(*copy);
          ++alike;
        }
      }
      if (alike > most) {
        most = alike;
        best = std::move(evened);
      }
    }
    chosen = std::move(best);
  }
}

}  // namespace ridgecraft::unfold
