// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/skin/meeting.hpp"

#include <algorithm>
#include <cmath>

#include "base/elementary.hpp"
#include "base/no_index.hpp"
#include "base/order.hpp"
#include "prepare/skin/arrangement.hpp"
#include "prepare/skin/contacts.hpp"
#include "prepare/skin/openings.hpp"

namespace ridgecraft::prepare {
namespace {

/// Pairs of triangles that meet: half a minute of work. Models that anybody would fold have a hundredth.
constexpr std::size_t most_pairs = 1'000'000;

std::vector<Vec3> on_grid(const std::vector<Vec3>& points, double share) {
  const double unit = elementary::exp2(std::floor(elementary::log2(share)));
  std::vector<Vec3> result;
  result.reserve(points.size());
  for (const Vec3 p : points) {
    result.push_back(
        {unit * std::round(p.x / unit), unit * std::round(p.y / unit), unit * std::round(p.z / unit)});
  }
  return result;
}

class Meeting {
 public:
  Meeting(Fates fates, const Context& context)
      : fates_(std::move(fates)), context_(context), place_(first_at_place(fates_.soup.points)) {
    fates_.solid = fates_.soup.solid;
  }

  std::optional<UnitedSkin> run() {
    fates_.decide();
    UnitedSkin skin;
    if (find_open_bodies(fates_, context_)) {
      for (std::uint32_t b = 0; b < fates_.solid.size(); ++b) {
        if (fates_.solid[b] != fates_.soup.solid[b]) {
          skin.not_solid.push_back(b);
        }
      }
      return skin;
    }
    skin.changed.assign(fates_.soup.solid.size(), 0);
    skin.around.assign(fates_.soup.solid.size(), 0);
    drop_caps(skin);
    if (nothing_hidden()) {
      skin.rims_closed = 0;
      return skin;
    }
    find_changed(skin);
    collect(skin);
    if (!is_sound(skin)) {
      return std::nullopt;
    }
    return skin;
  }

 private:
  [[nodiscard]] bool nothing_hidden() const {
    for (std::uint32_t f = 0; f < fates_.arranged.facets.size(); ++f) {
      const Facet& facet = fates_.arranged.facets[f];
      if (!fates_.only_caps(facet) && (fates_.fate[f] == Fate::hidden || fates_.is_shared(facet))) {
        return false;
      }
    }
    return true;
  }

  void drop_caps(UnitedSkin& skin) {
    const Fates::VisibleCaps caps = fates_.visible_caps();
    skin.rims_closed = caps.stay;
    for (std::uint32_t f = 0; f < fates_.arranged.facets.size(); ++f) {
      if (caps.opens[f] != 0) {
        fates_.fate[f] = Fate::hidden;
      }
    }
  }

  /// Bodies of which something is hidden or shown together with another's.
  void find_changed(UnitedSkin& skin) const {
    std::vector<std::uint8_t> left(fates_.soup.triangles.size(), 0);
    for (std::uint32_t f = 0; f < fates_.arranged.facets.size(); ++f) {
      const Facet& facet = fates_.arranged.facets[f];
      if (fates_.fate[f] == Fate::hidden && !fates_.only_caps(facet)) {
        for (const Winding& w : fates_.arranged.patches[facet.patch].front) {
          skin.around[w.first] |= fates_.solid[w.first];
        }
      }
      for (const Source& s : fates_.sources(facet)) {
        if (fates_.fate[f] != Fate::hidden) {
          left[s.triangle] = 1;
        }
        if (fates_.is_cap(s.triangle)) {
          if (fates_.fate[f] != Fate::hidden && !fates_.is_loose(facet, fates_.solid)) {
            skin.changed[fates_.soup.body[s.triangle]] = 1;
          }
        } else if (fates_.fate[f] == Fate::hidden || fates_.is_shared(facet) ||
                   facet.corners != by_place(s.triangle)) {
          skin.changed[fates_.soup.body[s.triangle]] = 1;
        }
      }
    }
    for (std::uint32_t t = 0; t < fates_.soup.triangles.size(); ++t) {
      skin.faces_hidden +=
          !fates_.is_cap(t) && left[t] == 0 && skin.changed[fates_.soup.body[t]] != 0 ? 1U : 0U;
    }
  }
  [[nodiscard]] std::array<std::uint32_t, 3> by_place(std::uint32_t t) const {
    const auto& c = fates_.soup.triangles[t];
    return {place_[c[0]], place_[c[1]], place_[c[2]]};
  }

  /// Facets of changed bodies in the order of their triangles.
  void collect(UnitedSkin& skin) const {
    std::vector<std::uint32_t> order;
    for (std::uint32_t f = 0; f < fates_.arranged.facets.size(); ++f) {
      if (fates_.fate[f] != Fate::hidden && skin.changed[fates_.soup.body[fates_.shown(f)]] != 0) {
        order.push_back(f);
      }
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return fates_.shown(a) < fates_.shown(b); });
    // Points that are one when rounded are one.
    const std::vector<std::uint32_t> first = first_at_place(fates_.arranged.points);
    std::vector<std::uint32_t> number(fates_.arranged.points.size(), no_index);
    for (const std::uint32_t f : order) {
      std::array<std::uint32_t, 3> corners = fates_.arranged.facets[f].corners;
      for (std::uint32_t& c : corners) {
        c = first[c];
      }
      if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
        continue;
      }
      for (std::uint32_t& c : corners) {
        if (number[c] == no_index) {
          number[c] = static_cast<std::uint32_t>(skin.points.size());
          skin.points.push_back(fates_.arranged.points[c]);
        }
        c = number[c];
      }
      if (fates_.fate[f] == Fate::turned) {
        std::swap(corners[1], corners[2]);
      }
      const std::uint32_t t = fates_.shown(f);
      skin.facets.push_back({corners, fates_.is_cap(t) ? no_index : t});
    }
  }

  /// Nothing of solids crosses anything when its points are rounded.
  [[nodiscard]] bool is_sound(const UnitedSkin& skin) const {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const SkinFacet& facet : skin.facets) {
      if (facet.triangle == no_index || fates_.solid[fates_.soup.body[facet.triangle]] != 0) {
        triangles.push_back(facet.corners);
      }
    }
    return !has_crossings(skin.points, triangles, context_);
  }

  Fates fates_;
  const Context& context_;
  std::vector<std::uint32_t> place_;  ///< of each point of the soup: the first one there
};

}  // namespace

std::optional<UnitedSkin> meet(const CappedBodies& bodies, double diagonal, const Context& context) {
  BodySoup soup = bodies.soup;
  soup.points = on_grid(soup.points, snapped * diagonal);
  std::optional<Arrangement> arrangement = arrange(soup, most_pairs, context);
  if (!arrangement) {
    return std::nullopt;
  }
  return Meeting({bodies, std::move(soup), std::move(*arrangement), {}, {}}, context).run();
}

}  // namespace ridgecraft::prepare
