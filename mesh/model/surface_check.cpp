// SPDX-License-Identifier: GPL-3.0-or-later
// Whether points and triangles of others are a surface as they stand.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/disjoint_sets.hpp"
#include "base/error.hpp"
#include "base/no_index.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::mesh {
namespace {

using Faces = std::span<const std::array<VertexId, 3>>;

template <typename... Values>
[[noreturn]] void refuse(fmt::format_string<Values...> sentence, Values&&... values) {
  throw Error(ErrorKind::unusable_mesh, fmt::format(sentence, std::forward<Values>(values)...));
}

void check_points(std::span<const Vec3> points) {
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Vec3 p = points[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      refuse("point {} has a coordinate that isn't a finite number", v);
    }
  }
}

void check_corners(std::size_t point_count, Faces faces) {
  std::vector<bool> named(point_count, false);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (const VertexId v : faces[f]) {
      if (!v.valid() || v.value() >= point_count) {
        refuse("face {} names a vertex that isn't there; there are {}", f, point_count);
      }
      named[v.value()] = true;
    }
    const auto [a, b, c] = faces[f];
    if (a == b || b == c || c == a) {
      refuse("face {} has a vertex twice", f);
    }
  }
  const auto alone = std::find(named.begin(), named.end(), false);
  if (alone != named.end()) {
    refuse("point {} is no corner of a face", alone - named.begin());
  }
}

/// A face's side, under the vertices that it runs between.
struct Side {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint32_t face = 0;
  std::uint32_t corner = 0;  ///< of the face, where it begins
};

std::vector<Side> sorted_sides(Faces faces) {
  std::vector<Side> sides;
  sides.reserve(3 * faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      sides.push_back({static_cast<std::uint32_t>(faces[f][k].value()),
                       static_cast<std::uint32_t>(faces[f][(k + 1) % 3].value()), f, k});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tuple(a.from, a.to, a.face) < std::tuple(b.from, b.to, b.face);
  });
  return sides;
}

/// Two faces at one edge run along it in opposite directions; of three, two would run in the same.
void check_edges(const std::vector<Side>& sides) {
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const Side& a = sides[i - 1];
    const Side& b = sides[i];
    if (a.from == b.from && a.to == b.to) {
      refuse("faces {} and {} both run from vertex {} to vertex {}", a.face, b.face, a.from, a.to);
    }
  }
}

/// Corners of neighbours at the same vertex belong together; all at a vertex do.
void check_fans(std::size_t point_count, Faces faces, const std::vector<Side>& sides) {
  DisjointSets fans(3 * faces.size());
  for (const Side& side : sides) {
    const auto twin = std::lower_bound(sides.begin(), sides.end(), side, [](const Side& a, const Side& b) {
      return std::tuple(a.from, a.to) < std::tuple(b.to, b.from);
    });
    if (twin != sides.end() && twin->from == side.to && twin->to == side.from) {
      fans.join(3 * side.face + side.corner, 3 * twin->face + (twin->corner + 1) % 3);
    }
  }
  std::vector<std::uint32_t> fan_at(point_count, no_index);
  for (const Side& side : sides) {
    const std::uint32_t fan = fans.find(3 * side.face + side.corner);
    if (fan_at[side.from] != no_index && fan_at[side.from] != fan) {
      refuse("the faces at vertex {} are several fans that only touch there", side.from);
    }
    fan_at[side.from] = fan;
  }
}

}  // namespace

void Surface::check(std::span<const Vec3> points, Faces faces) {
  check_points(points);
  check_corners(points.size(), faces);
  const std::vector<Side> sides = sorted_sides(faces);
  check_edges(sides);
  check_fans(points.size(), faces, sides);
}

}  // namespace ridgecraft::mesh
