// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/skin/openings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "base/no_index.hpp"
#include "prepare/skin/sight.hpp"

namespace ridgecraft::prepare {
namespace {

/// A body counts as open when so many of 64 looks from a hidden face come out through its opening.
constexpr std::ptrdiff_t looks_that_count = 2;
/// A cap over a bent opening is right where most of it is in other bodies, as the back of a beam at a wall.
constexpr double little_seen = 0.4;

class OpenBodies {
 public:
  OpenBodies(Fates& fates, const Context& context) : fates_(fates), context_(context) {}

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

 private:
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

}  // namespace

bool find_open_bodies(Fates& fates, const Context& context) {
  OpenBodies bodies(fates, context);
  return bodies.guessed_bodies() || bodies.open_bodies();
}

}  // namespace ridgecraft::prepare
