// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/skin/fates.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/order.hpp"

namespace ridgecraft::prepare {

bool Fates::inside(const std::vector<Winding>& windings, const std::vector<std::uint8_t>& solids) const {
  std::int32_t sum = 0;
  for (const auto& [body, number] : windings) {
    sum += solids[body] != 0 ? number : 0;
  }
  return sum != 0;
}

bool Fates::is_loose(const Facet& facet, const std::vector<std::uint8_t>& solids) const {
  const Patch& patch = arranged.patches[facet.patch];
  return !inside(patch.front, solids) && !inside(patch.back, solids);
}

Fate Fates::fate_with(const Facet& facet, const std::vector<std::uint8_t>& solids) const {
  const Patch& patch = arranged.patches[facet.patch];
  const bool front = inside(patch.front, solids);
  const bool back = inside(patch.back, solids);
  const auto all = sources(facet);
  const auto real = [&](const Source& s) { return !is_cap(s.triangle); };
  if (!front && !back) {
    // If it is of a solid, this one's own cap lies on it, as on the brim of a hat.
    const bool kept = std::any_of(all.begin(), all.end(), real);
    const bool ahead =
        std::any_of(all.begin(), all.end(), [&](const Source& s) { return real(s) && s.same_side; });
    return !kept ? Fate::hidden : ahead ? Fate::kept : Fate::turned;
  }
  const bool of_solid = std::any_of(all.begin(), all.end(),
                                    [&](const Source& s) { return solids[soup.body[s.triangle]] != 0; });
  const bool of_sheet = std::any_of(
      all.begin(), all.end(), [&](const Source& s) { return solids[soup.body[s.triangle]] == 0 && real(s); });
  if (front != back && of_solid) {
    return front ? Fate::turned : Fate::kept;
  }
  return of_sheet && !(front && back) ? Fate::kept : Fate::hidden;
}

void Fates::decide() {
  fate.clear();
  for (const Facet& facet : arranged.facets) {
    fate.push_back(fate_with(facet, solid));
  }
}

std::uint32_t Fates::shown(std::uint32_t f) const {
  std::uint32_t best = sources(arranged.facets[f]).front().triangle;
  int best_rank = 0;
  for (const Source& s : sources(arranged.facets[f])) {
    const bool faces = s.same_side == (fate[f] == Fate::kept);
    const int rank = (is_cap(s.triangle) ? 1 : 3) + (faces ? 1 : 0);
    if (rank > best_rank || (rank == best_rank && s.triangle < best)) {
      best = s.triangle;
      best_rank = rank;
    }
  }
  return best;
}

bool Fates::shows_cap(std::uint32_t f) const {
  if (fate[f] == Fate::hidden) {
    return false;
  }
  return is_cap(shown(f));
}

Vec3 Fates::normal_of(const Facet& facet) const {
  const Vec3 a = arranged.points[facet.corners[0]];
  return cross(arranged.points[facet.corners[1]] - a, arranged.points[facet.corners[2]] - a);
}

bool Fates::only_caps(const Facet& facet) const {
  const auto all = sources(facet);
  return std::all_of(all.begin(), all.end(), [&](const Source& s) { return is_cap(s.triangle); });
}

bool Fates::is_shared(const Facet& facet) const {
  const auto all = sources(facet);
  return is_loose(facet, solid)
             ? std::count_if(all.begin(), all.end(), [&](const Source& s) { return !is_cap(s.triangle); }) > 1
             : all.size() > 1;
}

namespace {

/// A side of a facet that is kept, by the numbers of its ends.
struct Side {
  std::uint32_t low;
  std::uint32_t high;
  std::uint32_t facet;
};

std::vector<Side> sides_of_kept(const Fates& fates) {
  std::vector<Side> sides;
  for (std::uint32_t f = 0; f < fates.arranged.facets.size(); ++f) {
    if (fates.fate[f] != Fate::hidden) {
      const auto& c = fates.arranged.facets[f].corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(c[k], c[(k + 1) % 3]);
        sides.push_back({low, high, f});
      }
    }
  }
  return in_edge_order(std::span<const Side>(sides));
}

/// Calls visit(sides) for each edge with all sides there.
template <class Visit>
void for_each_edge(const std::vector<Side>& sides, Visit visit) {
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t j = i + 1;
    while (j < sides.size() && sides[j].low == sides[i].low && sides[j].high == sides[i].high) {
      ++j;
    }
    visit(std::span(sides).subspan(i, j - i));
    i = j;
  }
}

}  // namespace

Fates::VisibleCaps Fates::visible_caps() const {
  const std::vector<Side> sides = sides_of_kept(*this);
  DisjointSets together(arranged.facets.size());
  std::vector<std::uint8_t> cap(arranged.facets.size(), 0);
  for (std::uint32_t f = 0; f < arranged.facets.size(); ++f) {
    cap[f] = shows_cap(f) ? 1 : 0;
  }
  for_each_edge(sides, [&](std::span<const Side> edge) {
    for (const Side& s : edge) {
      for (const Side& t : edge) {
        if (cap[s.facet] != 0 && cap[t.facet] != 0 &&
            bodies.cap[shown(s.facet)] == bodies.cap[shown(t.facet)]) {
          together.join(s.facet, t.facet);
        }
      }
    }
  });
  std::set<std::uint32_t> glued;
  for_each_edge(sides, [&](std::span<const Side> edge) {
    for (const Side& s : edge) {
      if (cap[s.facet] == 0) {
        continue;
      }
      const std::uint32_t own = soup.body[shown(s.facet)];
      const bool fine = std::all_of(edge.begin(), edge.end(), [&](const Side& t) {
        const auto all = sources(arranged.facets[t.facet]);
        return cap[t.facet] != 0 || std::any_of(all.begin(), all.end(), [&](const Source& source) {
                 return soup.body[source.triangle] == own;
               });
      });
      if (!fine) {
        glued.insert(together.find(s.facet));
      }
    }
  });
  VisibleCaps caps{std::move(cap), glued.size()};
  for (std::uint32_t f = 0; f < arranged.facets.size(); ++f) {
    if (glued.contains(together.find(f))) {
      caps.opens[f] = 0;
    }
  }
  return caps;
}

}  // namespace ridgecraft::prepare
