// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/shares/take_out.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/elementary.hpp"

namespace ridgecraft::prepare {
namespace {

constexpr std::uint32_t no_vertex = 0xffffffffU;
/// A face may lean by this much (0.1 degrees, as within a panel).
const double leaning_cosine = elementary::cos(0.1 * 3.14159265358979323846 / 180.0);
/// Height over longest side below which a face is nothing but rounding.
constexpr double thin_as_rounding = 1e-6;

using Face = std::array<std::uint32_t, 3>;

class Taker {
 public:
  explicit Taker(mesh::LooseFaces& faces) : faces_(faces), around_(faces.points.size()) {
    for (std::uint32_t f = 0; f < faces.faces.size(); ++f) {
      for (const std::uint32_t v : faces.faces[f]) {
        around_[v].push_back(f);
      }
    }
    gone_.assign(faces.faces.size(), false);
  }

  /// Whether it could be done.
  bool merge(std::uint32_t v, std::uint32_t into) {
    std::vector<std::uint32_t> shared;
    std::vector<std::uint32_t> others;
    for (const std::uint32_t f : around_[v]) {
      (has(f, into) ? shared : others).push_back(f);
    }
    if (shared.empty() || common_neighbours(v, into) != shared.size()) {
      return false;
    }
    if (!std::all_of(others.begin(), others.end(),
                     [&](std::uint32_t f) { return keeps_plane(f, v, into); })) {
      return false;
    }
    for (const std::uint32_t f : shared) {
      remove(f);
    }
    for (const std::uint32_t f : others) {
      std::replace(faces_.faces[f].begin(), faces_.faces[f].end(), v, into);
      around_[into].push_back(f);
    }
    around_[v].clear();
    return true;
  }

  void finish() {
    mesh::LooseFaces kept;
    kept.points = faces_.points;
    for (std::size_t f = 0; f < faces_.faces.size(); ++f) {
      if (!gone_[f]) {
        kept.add(faces_, f, faces_.faces[f]);
      }
    }
    faces_ = std::move(kept);
  }

 private:
  [[nodiscard]] bool has(std::uint32_t f, std::uint32_t v) const {
    return std::find(faces_.faces[f].begin(), faces_.faces[f].end(), v) != faces_.faces[f].end();
  }

  [[nodiscard]] std::vector<std::uint32_t> neighbours(std::uint32_t v) const {
    std::vector<std::uint32_t> result;
    for (const std::uint32_t f : around_[v]) {
      for (const std::uint32_t w : faces_.faces[f]) {
        if (w != v) {
          result.push_back(w);
        }
      }
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  [[nodiscard]] std::size_t common_neighbours(std::uint32_t v, std::uint32_t w) const {
    const std::vector<std::uint32_t> a = neighbours(v);
    const std::vector<std::uint32_t> b = neighbours(w);
    std::vector<std::uint32_t> common;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
    return common.size();
  }

  struct Shape {
    Vec3 doubled;
    double longest = 0.0;
  };
  [[nodiscard]] Shape shape(const Face& face) const {
    const Vec3 a = faces_.points[face[0]];
    const Vec3 b = faces_.points[face[1]];
    const Vec3 c = faces_.points[face[2]];
    return {cross(b - a, c - a), std::max({length(b - a), length(c - b), length(a - c)})};
  }

  [[nodiscard]] bool keeps_plane(std::uint32_t f, std::uint32_t v, std::uint32_t into) const {
    const auto [before, long_before] = shape(faces_.faces[f]);
    Face face = faces_.faces[f];
    std::replace(face.begin(), face.end(), v, into);
    const auto [after, long_after] = shape(face);
    if (faces_.points[v] == faces_.points[into]) {
      return true;
    }
    return length(after) > thin_as_rounding * long_after * long_after &&
           (length(before) <= thin_as_rounding * long_before * long_before ||
            dot(before, after) >= leaning_cosine * length(before) * length(after));
  }

  void remove(std::uint32_t f) {
    gone_[f] = true;
    for (const std::uint32_t v : faces_.faces[f]) {
      std::erase(around_[v], f);
    }
  }

  mesh::LooseFaces& faces_;
  std::vector<std::vector<std::uint32_t>> around_;  ///< faces at each point
  std::vector<bool> gone_;
};

}  // namespace

void take_out(mesh::LooseFaces& faces, const std::vector<Between>& points) {
  Taker taker(faces);
  std::vector<Between> left = points;
  for (std::size_t before = no_vertex; left.size() < before;) {
    before = left.size();
    std::erase_if(left, [&](const Between& b) { return taker.merge(b.point, b.to); });
  }
  taker.finish();
}

}  // namespace ridgecraft::prepare
