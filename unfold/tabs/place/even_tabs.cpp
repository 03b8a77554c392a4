// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/place/even_tabs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "unfold/net/equal_pieces.hpp"
#include "unfold/tabs/shape/shapes.hpp"

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

/// A piece of a kind: its sites, in the order of the first one's.
struct Member {
  Images sites;
  bool mirrored = false;
};

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

/// Without corners above the base at which the outline doesn't turn to the left: such a corner was on a
/// straight side until the base's end moved.
ConvexShape without_dents(const ConvexShape& shape) {
  std::vector<Vec2> corners(shape.begin(), shape.end());
  for (std::size_t i = 2; i < corners.size();) {
    const Vec2 next = corners[(i + 1) % corners.size()];
    if (corners.size() > 3 && cross(corners[i] - corners[i - 1], next - corners[i]) <= 0.0) {
      corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
      i = std::max<std::size_t>(i - 1, 2);
    } else {
      ++i;
    }
  }
  return ConvexShape(std::span<const Vec2>(corners));
}

/// The shape on an edge of another length, which differs by no more than pieces do that count as equal. The
/// base is that of the edge: a corner that was at its end is at the other's end.
ConvexShape fitted(const ConvexShape& shape, double before, double length) {
  ConvexShape result = shape;
  for (std::uint32_t i = 0; i < 2; ++i) {
    result[i].x = result[i].x >= before ? length : std::clamp(result[i].x, 0.0, length);
  }
  return length == before ? result : without_dents(result);
}

/// Which tabs of a piece its equals get.
enum class Copied : std::uint8_t {
  all,
  outward,  ///< those of joins with pieces of its kind stay as they are
};

class TabCopier {
 public:
  TabCopier(const std::vector<TabSite>& sites, const std::vector<std::vector<EqualPiece>>& kinds,
            std::size_t pieces, const TabOptions& options, std::span<const TabWish> wishes)
      : sites_(sites), kind_(pieces), options_(options), wishes_(wishes) {
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      for (const EqualPiece& equal : kinds[i]) {
        kind_[equal.piece] = i + 1;
      }
    }
  }

  /// The tabs of one piece on others; nothing where a join would lose its tab or get two, a tab would be in
  /// something's way, or one would be another than is wished. `from`: sites of the piece; `turned`: whether
  /// it is mirrored.
  [[nodiscard]] std::optional<Chosen> copied(const Chosen& chosen, const Images& from, bool turned,
                                             std::span<const Member> others, Copied which) const {
    Chosen result = chosen;
    std::vector<std::uint8_t> is_settled(chosen.size(), 0);
    for (const std::uint32_t site : from) {
      if (chosen[site / 2] && chosen[site / 2]->site == site) {
        is_settled[site / 2] = 1;
      }
    }
    for (const Member& other : others) {
      for (std::size_t i = 0; i < from.size(); ++i) {
        const std::uint32_t to = other.sites[i];
        const std::optional<ChosenTab>& tab = chosen[from[i] / 2];
        if (stays(from[i], which) != stays(to, which)) {
          return std::nullopt;  // one is glued to another of its kind there, the other isn't
        }
        if (!tab || tab->site != from[i] || stays(from[i], which)) {
          continue;
        }
        const ConvexShape shape = copy_of(tab->shape.outline, from[i], to, other.mirrored != turned);
        if (is_settled[to / 2] != 0 || !is_wished(from[i], to, chosen[to / 2]) ||
            !is_clear(sites_[to], shape)) {
          return std::nullopt;
        }
        is_settled[to / 2] = 1;
        result[to / 2] = ChosenTab{to, tab->shape};
        result[to / 2]->shape.outline = shape;
      }
    }
    for (const Member& other : others) {
      if (has_more(result, from, other.sites, which) || tabs_overlap(result, other.sites)) {
        return std::nullopt;
      }
    }
    return result;
  }

 private:
  /// Whether the tab of a site's join stays where it is.
  [[nodiscard]] bool stays(std::uint32_t site, Copied which) const {
    const PieceId own = sites_[site].piece;
    const PieceId other = sites_[site].target_piece;
    return which == Copied::outward && own != other && kind_[own] == kind_[other];
  }
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

  /// Whether a piece has a tab where the one that it is to be like has none. The join would have to lose it:
  /// no other piece gives it one.
  [[nodiscard]] bool has_more(const Chosen& chosen, const Images& from, const Images& to,
                              Copied which) const {
    for (std::size_t i = 0; i < from.size(); ++i) {
      const auto is_at = [&](std::uint32_t site) {
        return chosen[site / 2] && chosen[site / 2]->site == site;
      };
      if (is_at(to[i]) && !is_at(from[i]) && !stays(to[i], which)) {
        return true;
      }
    }
    return false;
  }
  [[nodiscard]] ConvexShape copy_of(const ConvexShape& shape, std::uint32_t from, std::uint32_t to,
                                    bool mirrored) const {
    const ConvexShape copy = fitted(shape, sites_[from].length, sites_[to].length);
    return mirrored ? turned_over(copy, sites_[to].length) : copy;
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
  IdVector<PieceId, std::size_t> kind_;  ///< 0 where there is no other of its kind
  const TabOptions& options_;
  std::span<const TabWish> wishes_;  // of each join, or none
};

struct Evened {
  Chosen chosen;
  std::size_t alike = 0;  ///< members that have the tabs of the one that is the model for them
};

/// Gives as many members as possible the tabs of one of them.
Evened like_member(const TabCopier& copier, const Chosen& chosen, const std::vector<Member>& members,
                   std::size_t index, Copied which) {
  const Member& model = members[index];
  std::vector<Member> others = members;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(index));
  // All at once: those that are joined to each other give and take tabs in a ring.
  if (auto copies = copier.copied(chosen, model.sites, model.mirrored, others, which)) {
    return {std::move(*copies), others.size()};
  }
  Evened evened{chosen, 0};
  for (const Member& other : others) {
    if (auto copy = copier.copied(evened.chosen, model.sites, model.mirrored, {&other, 1}, which)) {
      evened.chosen = std::move(*copy);
      ++evened.alike;
    }
  }
  return evened;
}

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
  const TabCopier copier(sites, kinds, nets.pieces.size(), options, wishes);
  for (const std::vector<EqualPiece>& kind : kinds) {
    std::vector<Member> members;
    for (const EqualPiece& equal : kind) {
      Images images = images_of(sites, of_piece[kind[0].piece], of_piece[equal.piece], equal);
      if (!images.empty()) {
        members.push_back({std::move(images), equal.mirrored});
      }
    }
    Evened best{chosen, 0};
    // Mirror images that are glued to each other can't be alike there: one gives what the other takes.
    for (const Copied which : {Copied::all, Copied::outward}) {
      for (std::size_t m = 0; m < std::min(members.size(), most_models) && best.alike + 1 < members.size();
           ++m) {
        Evened evened = like_member(copier, chosen, members, m, which);
        if (evened.alike > best.alike) {
          best = std::move(evened);
        }
      }
    }
    chosen = std::move(best.chosen);
  }
}

}  // namespace ridgecraft::unfold
