// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/skin/meeting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/elementary.hpp"
#include "base/id.hpp"
#include "base/no_index.hpp"
#include "base/order.hpp"
#include "base/vector.hpp"
#include "prepare/skin/arrangement.hpp"
#include "prepare/skin/contacts.hpp"
#include "prepare/skin/sight.hpp"

namespace ridgecraft::prepare {
namespace {

// Which facets of an arrangement of bodies are seen from outside.

enum class Fate : std::uint8_t { hidden, kept, turned };

/// What becomes of each facet while some bodies are solid. Facets and triangles are named by number.
struct Fates {
  struct VisibleCaps {
    std::vector<std::uint8_t> opens;  ///< of each facet: 1 where it is of a cap that goes again
    std::size_t stay = 0;             ///< caps
  };
  const CappedBodies& bodies;
  BodySoup soup;
  Arrangement arranged;
  std::vector<std::uint8_t> solid;  ///< of each body: not looked into
  std::vector<Fate> fate;           ///< of each facet

  [[nodiscard]] std::span<const Source> sources(const Facet& facet) const {
    return std::span(arranged.sources).subspan(facet.first_source, facet.last_source - facet.first_source);
  }
  [[nodiscard]] bool is_cap(std::uint32_t triangle) const { return bodies.cap[triangle] != no_index; }

  [[nodiscard]] bool inside(const std::vector<Winding>& windings,
                            const std::vector<std::uint8_t>& solids) const;
  /// With these bodies solid: has a facet no solid behind it, whichever side one looks from?
  [[nodiscard]] bool is_loose(const Facet& facet, const std::vector<std::uint8_t>& solids) const;
  /// Of a facet, with these bodies solid.
  [[nodiscard]] Fate fate_with(const Facet& facet, const std::vector<std::uint8_t>& solids) const;
  void decide();
  /// The triangle that a kept facet shows: one that faces as it does, and no cap if there is another.
  [[nodiscard]] std::uint32_t shown(std::uint32_t f) const;
  /// Is all that faces out here a cap? Then so is the facet, whatever it has behind it.
  [[nodiscard]] bool shows_cap(std::uint32_t f) const;
  [[nodiscard]] Vec3 normal_of(const Facet& facet) const;
  [[nodiscard]] bool only_caps(const Facet& facet) const;
  /// Does it show, or hide, more than one triangle? A cap that lies on a face of its own body doesn't count.
  [[nodiscard]] bool is_shared(const Facet& facet) const;
  /// Caps that can be seen go again, unless something but their own body and other caps is glued to them.
  [[nodiscard]] VisibleCaps visible_caps() const;
};

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

// Bodies that one can look into.

/// A body counts as open when so many of 64 looks from a hidden face come out through its opening.
constexpr std::ptrdiff_t looks_that_count = 2;
/// A cap over a bent opening is right where most of it is in other bodies, as the back of a beam at a wall.
constexpr double little_seen = 0.4;

class OpenBodies {
 public:
  OpenBodies(Fates& fates, const Context& context) : fates_(fates), context_(context) {}

  /// Takes bodies out of `solid` that have a bent opening of which more than a little is seen, since what
  /// closes it is a guess, or else those through whose openings one sees what would be dropped. Whether there
  /// were any; fates stay as they were.
  bool find() { return guessed_bodies() || open_bodies(); }

 private:
  /// Bodies of whose bent openings more than a little can be seen aren't solid: what closes them is a guess.
  /// True if there are.
  bool guessed_bodies() {
    struct Areas {
      double all = 0.0;
      double seen = 0.0;
      std::uint32_t body = 0;
    };
    std::map<std::uint32_t, Areas> caps;
    for (std::uint32_t t = 0; t < fates_.soup.triangles.size(); ++t) {
      if (fates_.is_cap(t) && fates_.bodies.bent[fates_.bodies.cap[t]] != 0) {
        const auto& [a, b, c] = fates_.soup.triangles[t];
        Areas& areas = caps[fates_.bodies.cap[t]];
        areas.all += length(cross(fates_.soup.points[b] - fates_.soup.points[a],
                                  fates_.soup.points[c] - fates_.soup.points[a]));
        areas.body = fates_.soup.body[t];
      }
    }
    for (std::uint32_t f = 0; f < fates_.arranged.facets.size(); ++f) {
      if (fates_.shows_cap(f) && fates_.bodies.bent[fates_.bodies.cap[fates_.shown(f)]] != 0) {
        caps[fates_.bodies.cap[fates_.shown(f)]].seen += length(fates_.normal_of(fates_.arranged.facets[f]));
      } else if (fates_.fate[f] != Fate::hidden && fates_.is_loose(fates_.arranged.facets[f], fates_.solid)) {
        // On a face of the body itself a cap closes nothing.
        for (const Source& s : fates_.sources(fates_.arranged.facets[f])) {
          if (fates_.is_cap(s.triangle) && fates_.bodies.bent[fates_.bodies.cap[s.triangle]] != 0) {
            caps[fates_.bodies.cap[s.triangle]].seen += length(fates_.normal_of(fates_.arranged.facets[f]));
          }
        }
      }
    }
    bool any = false;
    for (const auto& [cap, areas] : caps) {
      if (areas.seen > little_seen * areas.all) {
        fates_.solid[areas.body] = 0;
        any = true;
      }
    }
    return any;
  }

  /// Bodies through whose openings one sees something that would be dropped aren't solid. True if there are.
  bool open_bodies() {
    std::set<std::uint32_t> open_caps;
    const Fates::VisibleCaps caps = fates_.visible_caps();
    for (std::uint32_t f = 0; f < fates_.arranged.facets.size(); ++f) {
      if (caps.opens[f] != 0) {
        const std::uint32_t cap = fates_.bodies.cap[fates_.shown(f)];
        if (fates_.bodies.on_ground[cap] == 0) {
          open_caps.insert(cap);
        }
      }
    }
    if (open_caps.empty()) {
      return false;
    }
    const std::vector<std::uint32_t> body_of_cap = bodies_of_caps();
    std::vector<std::uint8_t> without = fates_.solid;
    for (const std::uint32_t cap : open_caps) {
      without[body_of_cap[cap]] = 0;
    }
    const Sight sight(screens(open_caps));
    bool any = false;
    for (const std::uint32_t f : samples(without)) {
      context_.check();
      const Facet& facet = fates_.arranged.facets[f];
      const auto& c = facet.corners;
      const Vec3 middle =
          (fates_.arranged.points[c[0]] + fates_.arranged.points[c[1]] + fates_.arranged.points[c[2]]) / 3.0;
      const Vec3 normal = fates_.normal_of(facet);
      const Patch& patch = fates_.arranged.patches[facet.patch];
      for (const bool front : {true, false}) {
        if (fates_.inside(front ? patch.front : patch.back, without)) {
          continue;
        }
        const std::vector<std::uint32_t> seen = sight.openings_seen(middle, front ? normal : -1.0 * normal);
        for (const std::uint32_t cap : std::set<std::uint32_t>(seen.begin(), seen.end())) {
          const std::uint32_t body = body_of_cap[cap];
          if (fates_.solid[body] != 0 && std::count(seen.begin(), seen.end(), cap) >= looks_that_count) {
            fates_.solid[body] = 0;
            any = true;
          }
        }
      }
    }
    return any;
  }

  [[nodiscard]] std::vector<std::uint32_t> bodies_of_caps() const {
    std::vector<std::uint32_t> body(fates_.bodies.on_ground.size(), 0);
    for (std::size_t t = 0; t < fates_.bodies.cap.size(); ++t) {
      if (fates_.bodies.cap[t] != no_index) {
        body[fates_.bodies.cap[t]] = fates_.soup.body[t];
      }
    }
    return body;
  }

  /// Walls are all faces and the ground; caps that stay closed inside others are nothing.
  [[nodiscard]] std::vector<Screen> screens(const std::set<std::uint32_t>& open_caps) const {
    std::vector<Screen> all;
    for (std::size_t t = 0; t < fates_.soup.triangles.size(); ++t) {
      const auto& c = fates_.soup.triangles[t];
      const std::uint32_t cap = fates_.bodies.cap[t];
      if (cap == no_index || fates_.bodies.on_ground[cap] != 0 || open_caps.contains(cap)) {
        all.push_back({{fates_.soup.points[c[0]], fates_.soup.points[c[1]], fates_.soup.points[c[2]]},
                       cap == no_index || fates_.bodies.on_ground[cap] != 0 ? Screen::wall : cap});
      }
    }
    return all;
  }

  /// Facets that are hidden, but wouldn't be with fewer bodies solid: of each patch the largest one in each
  /// of six directions.
  [[nodiscard]] std::vector<std::uint32_t> samples(const std::vector<std::uint8_t>& without) const {
    std::map<std::pair<std::uint32_t, int>, std::uint32_t> largest;
    for (std::uint32_t f = 0; f < fates_.arranged.facets.size(); ++f) {
      const Facet& facet = fates_.arranged.facets[f];
      if (fates_.fate[f] != Fate::hidden || fates_.fate_with(facet, without) == Fate::hidden ||
          fates_.only_caps(facet)) {
        continue;
      }
      const Vec3 normal = fates_.normal_of(facet);
      const auto [at, fresh] = largest.try_emplace({facet.patch, direction_of(normal)}, f);
      if (!fresh && length(normal) > length(fates_.normal_of(fates_.arranged.facets[at->second]))) {
        at->second = f;
      }
    }
    std::vector<std::uint32_t> result;
    for (const auto& [patch, f] : largest) {
      result.push_back(f);
    }
    return result;
  }
  /// The axis along which it is longest, and which way.
  static int direction_of(Vec3 normal) {
    const std::array<double, 3> n{normal.x, normal.y, normal.z};
    const auto longest =
        std::max_element(n.begin(), n.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    return static_cast<int>(2 * (longest - n.begin())) + (*longest < 0.0 ? 1 : 0);
  }

  Fates& fates_;
  const Context& context_;
};

// The skin.

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
    if (OpenBodies(fates_, context_).find()) {
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
