// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/skin/meeting.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <span>

#include "base/disjoint_sets.hpp"
#include "base/elementary.hpp"
#include "base/geometry.hpp"
#include "base/order.hpp"
#include "prepare/skin/sight.hpp"

namespace ridgecraft::prepare {
namespace {

/// Pairs of triangles that meet: half a minute of work. Models that anybody would fold have a hundredth.
constexpr std::size_t most_pairs = 1'000'000;
/// A body counts as open when so many of 64 looks from a hidden face come out through its opening.
constexpr std::ptrdiff_t looks_that_count = 2;
/// A cap over a bent opening is right where most of it is in other bodies, as the back of a beam at a wall.
constexpr double little_seen = 0.4;

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

enum class Fate : std::uint8_t { hidden, kept, turned };

class Meeting {
 public:
  Meeting(const Bodies3& bodies, BodySoup soup, Arrangement arrangement, const Context& context)
      : bodies_(bodies),
        soup_(std::move(soup)),
        arranged_(std::move(arrangement)),
        context_(context),
        place_(first_at_place(soup_.points)) {}

  std::optional<OneSkin> run() {
    solid_ = soup_.solid;
    decide();
    OneSkin skin;
    if (guessed_bodies() || open_bodies()) {
      for (std::uint32_t b = 0; b < solid_.size(); ++b) {
        if (solid_[b] != soup_.solid[b]) {
          skin.not_solid.push_back(b);
        }
      }
      return skin;
    }
    skin.changed.assign(soup_.solid.size(), 0);
    skin.around.assign(soup_.solid.size(), 0);
    hide_enclosed();
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
  [[nodiscard]] std::span<const Source> sources(const Facet& facet) const {
    return std::span(arranged_.sources).subspan(facet.first_source, facet.last_source - facet.first_source);
  }
  [[nodiscard]] bool is_cap(std::uint32_t triangle) const { return bodies_.cap[triangle] != Bodies3::no_cap; }

  [[nodiscard]] bool inside(const std::vector<Winding>& windings,
                            const std::vector<std::uint8_t>& solid) const {
    std::int32_t sum = 0;
    for (const auto& [body, number] : windings) {
      sum += solid[body] != 0 ? number : 0;
    }
    return sum != 0;
  }

  /// With these bodies solid: has a facet no solid behind it, whichever side one looks from?
  [[nodiscard]] bool is_loose(const Facet& facet, const std::vector<std::uint8_t>& solid) const {
    const Patch& patch = arranged_.patches[facet.patch];
    return !inside(patch.front, solid) && !inside(patch.back, solid);
  }

  /// Of a facet, with these bodies solid.
  [[nodiscard]] Fate fate_with(const Facet& facet, const std::vector<std::uint8_t>& solid) const {
    const Patch& patch = arranged_.patches[facet.patch];
    const bool front = inside(patch.front, solid);
    const bool back = inside(patch.back, solid);
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
                                      [&](const Source& s) { return solid[soup_.body[s.triangle]] != 0; });
    const bool of_sheet = std::any_of(all.begin(), all.end(), [&](const Source& s) {
      return solid[soup_.body[s.triangle]] == 0 && real(s);
    });
    if (front != back && of_solid) {
      return front ? Fate::turned : Fate::kept;
    }
    return of_sheet && !(front && back) ? Fate::kept : Fate::hidden;
  }

  void decide() {
    fate_.clear();
    for (const Facet& facet : arranged_.facets) {
      fate_.push_back(fate_with(facet, solid_));
    }
  }

  /// The triangle that a kept facet shows: one that faces as it does, and no cap if there is another.
  [[nodiscard]] std::uint32_t shown(std::uint32_t f) const {
    std::uint32_t best = SkinFacet::none;
    int best_rank = 0;
    for (const Source& s : sources(arranged_.facets[f])) {
      const bool faces = s.same_side == (fate_[f] == Fate::kept);
      const int rank = (is_cap(s.triangle) ? 1 : 3) + (faces ? 1 : 0);
      if (rank > best_rank || (rank == best_rank && s.triangle < best)) {
        best = s.triangle;
        best_rank = rank;
      }
    }
    return best;
  }

  /// Is all that faces out here a cap? Then so is the facet, whatever it has behind it.
  [[nodiscard]] bool shows_cap(std::uint32_t f) const {
    if (fate_[f] == Fate::hidden) {
      return false;
    }
    return is_cap(shown(f));
  }

  [[nodiscard]] Vec3 normal_of(const Facet& facet) const {
    const Vec3 a = arranged_.points[facet.corners[0]];
    return cross(arranged_.points[facet.corners[1]] - a, arranged_.points[facet.corners[2]] - a);
  }

  // Looking in ----------------------------------------------------------------------------------------------

  /// Bodies of whose bent openings more than a little can be seen aren't solid: what closes them is a guess.
  /// True if there are.
  bool guessed_bodies() {
    struct Areas {
      double all = 0.0;
      double seen = 0.0;
      std::uint32_t body = 0;
    };
    std::map<std::uint32_t, Areas> caps;
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
      if (is_cap(t) && bodies_.bent[bodies_.cap[t]] != 0) {
        const auto& [a, b, c] = soup_.triangles[t];
        Areas& areas = caps[bodies_.cap[t]];
        areas.all += length(cross(soup_.points[b] - soup_.points[a], soup_.points[c] - soup_.points[a]));
        areas.body = soup_.body[t];
      }
    }
    for (std::uint32_t f = 0; f < arranged_.facets.size(); ++f) {
      if (shows_cap(f) && bodies_.bent[bodies_.cap[shown(f)]] != 0) {
        caps[bodies_.cap[shown(f)]].seen += length(normal_of(arranged_.facets[f]));
      } else if (fate_[f] != Fate::hidden && is_loose(arranged_.facets[f], solid_)) {
        // On a face of the body itself a cap closes nothing.
        for (const Source& s : sources(arranged_.facets[f])) {
          if (is_cap(s.triangle) && bodies_.bent[bodies_.cap[s.triangle]] != 0) {
            caps[bodies_.cap[s.triangle]].seen += length(normal_of(arranged_.facets[f]));
          }
        }
      }
    }
    bool any = false;
    for (const auto& [cap, areas] : caps) {
      if (areas.seen > little_seen * areas.all) {
        solid_[areas.body] = 0;
        any = true;
      }
    }
    return any;
  }

  /// Bodies through whose openings one sees something that would be dropped aren't solid. True if there are.
  bool open_bodies() {
    std::set<std::uint32_t> open_caps;
    const VisibleCaps caps = visible_caps();
    for (std::uint32_t f = 0; f < arranged_.facets.size(); ++f) {
      if (caps.opens[f] != 0) {
        const std::uint32_t cap = bodies_.cap[shown(f)];
        if (bodies_.on_ground[cap] == 0) {
          open_caps.insert(cap);
        }
      }
    }
    if (open_caps.empty()) {
      return false;
    }
    const std::vector<std::uint32_t> body_of_cap = bodies_of_caps();
    std::vector<std::uint8_t> without = solid_;
    for (const std::uint32_t cap : open_caps) {
      without[body_of_cap[cap]] = 0;
    }
    const Sight sight(screens(open_caps));
    bool any = false;
    for (const std::uint32_t f : samples(without)) {
      context_.check();
      const Facet& facet = arranged_.facets[f];
      const auto& c = facet.corners;
      const Vec3 middle = (arranged_.points[c[0]] + arranged_.points[c[1]] + arranged_.points[c[2]]) / 3.0;
      const Vec3 normal = normal_of(facet);
      const Patch& patch = arranged_.patches[facet.patch];
      for (const bool front : {true, false}) {
        if (inside(front ? patch.front : patch.back, without)) {
          continue;
        }
        const std::vector<std::uint32_t> seen = sight.openings_seen(middle, front ? normal : -1.0 * normal);
        for (const std::uint32_t cap : std::set<std::uint32_t>(seen.begin(), seen.end())) {
          const std::uint32_t body = body_of_cap[cap];
          if (solid_[body] != 0 && std::count(seen.begin(), seen.end(), cap) >= looks_that_count) {
            solid_[body] = 0;
            any = true;
          }
        }
      }
    }
    return any;
  }

  [[nodiscard]] std::vector<std::uint32_t> bodies_of_caps() const {
    std::vector<std::uint32_t> body(bodies_.on_ground.size(), 0);
    for (std::size_t t = 0; t < bodies_.cap.size(); ++t) {
      if (bodies_.cap[t] != Bodies3::no_cap) {
        body[bodies_.cap[t]] = soup_.body[t];
      }
    }
    return body;
  }

  /// Walls are all faces and the ground; caps that stay closed inside others are nothing.
  [[nodiscard]] std::vector<Screen> screens(const std::set<std::uint32_t>& open_caps) const {
    std::vector<Screen> all;
    for (std::size_t t = 0; t < soup_.triangles.size(); ++t) {
      const auto& c = soup_.triangles[t];
      const std::uint32_t cap = bodies_.cap[t];
      if (cap == Bodies3::no_cap || bodies_.on_ground[cap] != 0 || open_caps.contains(cap)) {
        all.push_back({{soup_.points[c[0]], soup_.points[c[1]], soup_.points[c[2]]},
                       cap == Bodies3::no_cap || bodies_.on_ground[cap] != 0 ? Screen::wall : cap});
      }
    }
    return all;
  }

  /// Facets that are hidden, but wouldn't be with fewer bodies solid: of each patch the largest one in each
  /// of six directions.
  [[nodiscard]] std::vector<std::uint32_t> samples(const std::vector<std::uint8_t>& without) const {
    std::map<std::pair<std::uint32_t, int>, std::uint32_t> largest;
    for (std::uint32_t f = 0; f < arranged_.facets.size(); ++f) {
      const Facet& facet = arranged_.facets[f];
      if (fate_[f] != Fate::hidden || fate_with(facet, without) == Fate::hidden || only_caps(facet)) {
        continue;
      }
      const Vec3 normal = normal_of(facet);
      const auto [at, fresh] = largest.try_emplace({facet.patch, direction_of(normal)}, f);
      if (!fresh && length(normal) > length(normal_of(arranged_.facets[at->second]))) {
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
  [[nodiscard]] bool only_caps(const Facet& facet) const {
    const auto all = sources(facet);
    return std::all_of(all.begin(), all.end(), [&](const Source& s) { return is_cap(s.triangle); });
  }

  // Caps ----------------------------------------------------------------------------------------------------

  /// Does it show, or hide, more than one triangle? A cap that lies on a face of its own body doesn't count.
  [[nodiscard]] bool is_shared(const Facet& facet) const {
    const auto all = sources(facet);
    return is_loose(facet, solid_) ? std::count_if(all.begin(), all.end(),
                                                   [&](const Source& s) { return !is_cap(s.triangle); }) > 1
                                   : all.size() > 1;
  }
  [[nodiscard]] bool nothing_hidden() const {
    for (std::uint32_t f = 0; f < arranged_.facets.size(); ++f) {
      const Facet& facet = arranged_.facets[f];
      if (!only_caps(facet) && (fate_[f] == Fate::hidden || is_shared(facet))) {
        return false;
      }
    }
    return true;
  }

  struct Side {
    std::uint32_t low;
    std::uint32_t high;
    std::uint32_t facet;
    bool forward;
  };
  [[nodiscard]] std::vector<Side> sides_of_kept() const {
    std::vector<Side> sides;
    for (std::uint32_t f = 0; f < arranged_.facets.size(); ++f) {
      if (fate_[f] != Fate::hidden) {
        const auto& c = arranged_.facets[f].corners;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t p = c[k];
          const std::uint32_t q = c[(k + 1) % 3];
          sides.push_back({std::min(p, q), std::max(p, q), f, (p < q) == (fate_[f] == Fate::kept)});
        }
      }
    }
    return in_edge_order(std::span<const Side>(sides));
  }
  template <class Visit>
  static void for_each_edge(const std::vector<Side>& sides, Visit visit) {
    for (std::size_t i = 0; i < sides.size();) {
      std::size_t j = i + 1;
      while (j < sides.size() && sides[j].low == sides[i].low && sides[j].high == sides[i].high) {
        ++j;
      }
      visit(std::span(sides).subspan(i, j - i));
      i = j;
    }
  }

  struct VisibleCaps {
    std::vector<std::uint8_t> opens;  ///< of each facet: 1 where it is of a cap that goes again
    std::size_t stay = 0;             ///< caps
  };
  /// Caps that can be seen go again, unless something but their own body and other caps is glued to them.
  [[nodiscard]] VisibleCaps visible_caps() const {
    const std::vector<Side> sides = sides_of_kept();
    DisjointSets together(arranged_.facets.size());
    std::vector<std::uint8_t> cap(arranged_.facets.size(), 0);
    for (std::uint32_t f = 0; f < arranged_.facets.size(); ++f) {
      cap[f] = shows_cap(f) ? 1 : 0;
    }
    for_each_edge(sides, [&](std::span<const Side> edge) {
      for (const Side& s : edge) {
        for (const Side& t : edge) {
          if (cap[s.facet] != 0 && cap[t.facet] != 0 &&
              bodies_.cap[shown(s.facet)] == bodies_.cap[shown(t.facet)]) {
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
        const std::uint32_t own = soup_.body[shown(s.facet)];
        const bool fine = std::all_of(edge.begin(), edge.end(), [&](const Side& t) {
          const auto all = sources(arranged_.facets[t.facet]);
          return cap[t.facet] != 0 || std::any_of(all.begin(), all.end(), [&](const Source& source) {
                   return soup_.body[source.triangle] == own;
                 });
        });
        if (!fine) {
          glued.insert(together.find(s.facet));
        }
      }
    });
    VisibleCaps caps{std::move(cap), glued.size()};
    for (std::uint32_t f = 0; f < arranged_.facets.size(); ++f) {
      if (glued.contains(together.find(f))) {
        caps.opens[f] = 0;
      }
    }
    return caps;
  }

  void drop_caps(OneSkin& skin) {
    const VisibleCaps caps = visible_caps();
    skin.rims_closed = caps.stay;
    for (std::uint32_t f = 0; f < arranged_.facets.size(); ++f) {
      if (caps.opens[f] != 0) {
        fate_[f] = Fate::hidden;
      }
    }
  }

  // Shells --------------------------------------------------------------------------------------------------

  /// Facets of solids that are kept and hang together.
  struct Shell {
    std::vector<std::array<Vec3, 3>> triangles;
    Box3 box;
    bool closed = true;
    double volume = 0.0;
  };

  /// What lies in a shell that is closed can't be seen: cavities, and what is in them. The ground closes, an
  /// opening elsewhere doesn't.
  void hide_enclosed() {
    const std::vector<Side> sides = sides_of_kept();
    DisjointSets together(arranged_.facets.size());
    for_each_edge(sides, [&](std::span<const Side> edge) {
      for (const Side& s : edge) {
        if (of_solid(s.facet) && of_solid(edge.front().facet)) {
          together.join(edge.front().facet, s.facet);
        }
      }
    });
    std::map<std::uint32_t, Shell> shells;
    for (std::uint32_t f = 0; f < arranged_.facets.size(); ++f) {
      if (fate_[f] != Fate::hidden && of_solid(f)) {
        add_to(shells[together.find(f)], f);
      }
    }
    const VisibleCaps caps = visible_caps();
    const auto is_open = [&](std::uint32_t f) {
      return caps.opens[f] != 0 && bodies_.on_ground[bodies_.cap[shown(f)]] == 0;
    };
    for_each_edge(sides, [&](std::span<const Side> edge) {
      std::ptrdiff_t balance = 0;
      for (const Side& s : edge) {
        balance += !of_solid(s.facet) || is_open(s.facet) ? 0 : s.forward ? 1 : -1;
      }
      for (const Side& s : edge) {
        if (balance != 0 && of_solid(s.facet)) {
          shells[together.find(s.facet)].closed = false;
        }
      }
    });
    std::set<std::uint32_t> enclosed;
    for (const auto& [outer, around] : shells) {
      for (const auto& [inner, shell] : shells) {
        if (outer != inner && around.closed && around.volume > 0.0 && contains(around, shell)) {
          enclosed.insert(inner);
        }
      }
    }
    for (std::uint32_t f = 0; f < arranged_.facets.size(); ++f) {
      if (fate_[f] != Fate::hidden && enclosed.contains(together.find(f))) {
        fate_[f] = Fate::hidden;
      }
    }
  }

  /// Is it a solid's, with this solid behind it?
  [[nodiscard]] bool of_solid(std::uint32_t f) const {
    const auto all = sources(arranged_.facets[f]);
    return !is_loose(arranged_.facets[f], solid_) &&
           std::any_of(all.begin(), all.end(),
                       [&](const Source& s) { return solid_[soup_.body[s.triangle]] != 0; });
  }

  void add_to(Shell& shell, std::uint32_t f) const {
    std::array<std::uint32_t, 3> c = arranged_.facets[f].corners;
    if (fate_[f] == Fate::turned) {
      std::swap(c[1], c[2]);
    }
    shell.triangles.push_back({arranged_.points[c[0]], arranged_.points[c[1]], arranged_.points[c[2]]});
    const auto& t = shell.triangles.back();
    std::for_each(t.begin(), t.end(), [&](Vec3 p) { shell.box.add(p); });
    const Vec3 origin = shell.triangles.front()[0];
    shell.volume += dot(t[0] - origin, cross(t[1] - origin, t[2] - origin)) / 6.0;
  }

  static bool contains(const Shell& outer, const Shell& inner) {
    const auto within = [](double low, double inner_low, double inner_high, double high) {
      return low <= inner_low && inner_high <= high;
    };
    if (!within(outer.box.low.x, inner.box.low.x, inner.box.high.x, outer.box.high.x) ||
        !within(outer.box.low.y, inner.box.low.y, inner.box.high.y, outer.box.high.y) ||
        !within(outer.box.low.z, inner.box.low.z, inner.box.high.z, outer.box.high.z)) {
      return false;
    }
    // Shells don't cross, so any point tells: the middle of a face.
    const auto& first = inner.triangles.front();
    const Vec3 p = (first[0] + first[1] + first[2]) / 3.0;
    double angle = 0.0;
    for (const auto& t : outer.triangles) {
      angle += solid_angle(t[0] - p, t[1] - p, t[2] - p);
    }
    return angle > 2.0 * std::numbers::pi;  // half of once around
  }

  // The skin ------------------------------------------------------------------------------------------------

  /// Bodies of which something is hidden or shown together with another's.
  void find_changed(OneSkin& skin) const {
    std::vector<std::uint8_t> left(soup_.triangles.size(), 0);
    for (std::uint32_t f = 0; f < arranged_.facets.size(); ++f) {
      const Facet& facet = arranged_.facets[f];
      if (fate_[f] == Fate::hidden && !only_caps(facet)) {
        for (const Winding& w : arranged_.patches[facet.patch].front) {
          skin.around[w.first] |= solid_[w.first];
        }
      }
      for (const Source& s : sources(facet)) {
        if (fate_[f] != Fate::hidden) {
          left[s.triangle] = 1;
        }
        if (is_cap(s.triangle)) {
          if (fate_[f] != Fate::hidden && !is_loose(facet, solid_)) {
            skin.changed[soup_.body[s.triangle]] = 1;
          }
        } else if (fate_[f] == Fate::hidden || is_shared(facet) || facet.corners != by_place(s.triangle)) {
          skin.changed[soup_.body[s.triangle]] = 1;
        }
      }
    }
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
      skin.faces_hidden += !is_cap(t) && left[t] == 0 && skin.changed[soup_.body[t]] != 0 ? 1U : 0U;
    }
  }
  [[nodiscard]] std::array<std::uint32_t, 3> by_place(std::uint32_t t) const {
    const auto& c = soup_.triangles[t];
    return {place_[c[0]], place_[c[1]], place_[c[2]]};
  }

  /// Facets of changed bodies in the order of their triangles.
  void collect(OneSkin& skin) const {
    std::vector<std::uint32_t> order;
    for (std::uint32_t f = 0; f < arranged_.facets.size(); ++f) {
      if (fate_[f] != Fate::hidden && skin.changed[soup_.body[shown(f)]] != 0) {
        order.push_back(f);
      }
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return shown(a) < shown(b); });
    // Points that are one when rounded are one.
    const std::vector<std::uint32_t> first = first_at_place(arranged_.points);
    std::vector<std::uint32_t> number(arranged_.points.size(), SkinFacet::none);
    for (const std::uint32_t f : order) {
      std::array<std::uint32_t, 3> corners = arranged_.facets[f].corners;
      for (std::uint32_t& c : corners) {
        c = first[c];
      }
      if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
        continue;
      }
      for (std::uint32_t& c : corners) {
        if (number[c] == SkinFacet::none) {
          number[c] = static_cast<std::uint32_t>(skin.points.size());
          skin.points.push_back(arranged_.points[c]);
        }
        c = number[c];
      }
      if (fate_[f] == Fate::turned) {
        std::swap(corners[1], corners[2]);
      }
      const std::uint32_t t = shown(f);
      skin.facets.push_back({corners, is_cap(t) ? SkinFacet::none : t});
    }
  }

  /// Nothing of solids crosses anything when its points are rounded.
  [[nodiscard]] bool is_sound(const OneSkin& skin) const {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const SkinFacet& facet : skin.facets) {
      if (facet.triangle == SkinFacet::none || solid_[soup_.body[facet.triangle]] != 0) {
        triangles.push_back(facet.corners);
      }
    }
    return !has_crossings(skin.points, triangles, context_);
  }

  const Bodies3& bodies_;
  BodySoup soup_;
  Arrangement arranged_;
  const Context& context_;
  std::vector<std::uint8_t> solid_;   ///< of each body: not looked into
  std::vector<Fate> fate_;            ///< of each facet
  std::vector<std::uint32_t> place_;  ///< of each point of the soup: the first one there
};

}  // namespace

std::optional<OneSkin> meet(const Bodies3& bodies, double diagonal, const Context& context) {
  BodySoup soup = bodies.soup;
  soup.points = on_grid(soup.points, snapped * diagonal);
  std::optional<Arrangement> arrangement = arrange(soup, most_pairs, context);
  if (!arrangement) {
    return std::nullopt;
  }
  return Meeting(bodies, std::move(soup), std::move(*arrangement), context).run();
}

}  // namespace ridgecraft::prepare
