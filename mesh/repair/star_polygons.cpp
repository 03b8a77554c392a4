// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/star_polygons.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/geometry.hpp"
#include "base/vector.hpp"

namespace ridgecraft::mesh {
namespace {

/// Stars have fewer corners; larger polygons would take long.
constexpr std::size_t most_star_corners = 256;
/// Sides that meet nearer to their ends than this share of them touch there, and don't cross.
constexpr double at_end = 1e-9;

struct Crossing {
  double at;            ///< share of the side
  std::uint32_t point;  ///< index into the star's places
};

/// One flat polygon, its corners first, then its crossings.
class Star {
 public:
  explicit Star(std::vector<Vec2> corners)
      : corners_(corners.size()), places_(std::move(corners)), on_side_(corners_) {}

  /// False where no sides cross.
  bool find_crossings() {
    for (std::size_t i = 0; i < corners_; ++i) {
      for (std::size_t j = i + 2; j < corners_; ++j) {
        if (i > 0 || j + 1 < corners_) {
          cross_sides(i, j);
        }
      }
    }
    for (std::vector<Crossing>& side : on_side_) {
      std::sort(side.begin(), side.end(), [](const Crossing& a, const Crossing& b) { return a.at < b.at; });
    }
    return places_.size() > corners_;
  }

  /// Outlines of what it runs around, counterclockwise; nothing where it runs around a place clockwise, or
  /// where outlines touch.
  [[nodiscard]] std::optional<std::vector<std::vector<std::uint32_t>>> outlines() const {
    constexpr std::uint32_t none = Soup::none;
    std::vector<std::uint32_t> next(places_.size(), none);
    for (std::size_t i = 0; i < corners_; ++i) {
      auto from = static_cast<std::uint32_t>(i);
      for (std::size_t k = 0; k <= on_side_[i].size(); ++k) {
        const std::uint32_t to =
            k < on_side_[i].size() ? on_side_[i][k].point : static_cast<std::uint32_t>((i + 1) % corners_);
        const int right = windings_right_of(i, 0.5 * (places_[from] + places_[to]));
        if (right < 0 || (right == 0 && next[from] != none)) {
          return std::nullopt;
        }
        if (right == 0) {
          next[from] = to;
        }
        from = to;
      }
    }
    return loops(std::move(next));
  }

  [[nodiscard]] const std::vector<Vec2>& places() const { return places_; }
  /// On which side a crossing was found first, and where.
  [[nodiscard]] std::pair<std::size_t, double> origin(std::uint32_t point) const {
    for (std::size_t i = 0; i < corners_; ++i) {
      for (const Crossing& crossing : on_side_[i]) {
        if (crossing.point == point) {
          return {i, crossing.at};
        }
      }
    }
    return {point, 0.0};
  }

 private:
  [[nodiscard]] Vec2 end(std::size_t side) const { return places_[(side + 1) % corners_]; }

  void cross_sides(std::size_t i, std::size_t j) {
    const Vec2 along = end(i) - places_[i];
    const Vec2 other = end(j) - places_[j];
    const double turn = cross(along, other);
    if (turn == 0.0) {
      return;
    }
    const double s = cross(places_[j] - places_[i], other) / turn;
    const double t = cross(places_[j] - places_[i], along) / turn;
    if (s > at_end && s < 1.0 - at_end && t > at_end && t < 1.0 - at_end) {
      const auto point = static_cast<std::uint32_t>(places_.size());
      places_.push_back(places_[i] + s * along);
      on_side_[i].push_back({s, point});
      on_side_[j].push_back({t, point});
    }
  }

  /// How often the polygon runs around what is right of its side at a place: left of it, a ray to the left
  /// counts the other sides that it crosses, and here it is once less.
  [[nodiscard]] int windings_right_of(std::size_t side, Vec2 place) const {
    const Vec2 along = end(side) - places_[side];
    const Vec2 left{-along.y, along.x};
    int sum = -1;
    for (std::size_t i = 0; i < corners_; ++i) {
      const Vec2 a = places_[i] - place;
      const Vec2 b = end(i) - place;
      const double from = cross(left, a);
      const double to = cross(left, b);
      if (i != side && (from < 0.0) != (to < 0.0) && (cross(a, b) > 0.0) == (from < to)) {
        sum += from < to ? 1 : -1;
      }
    }
    return sum;
  }

  [[nodiscard]] static std::optional<std::vector<std::vector<std::uint32_t>>> loops(
      std::vector<std::uint32_t> next) {
    std::vector<std::vector<std::uint32_t>> found;
    for (std::uint32_t start = 0; start < next.size(); ++start) {
      std::vector<std::uint32_t> loop;
      std::uint32_t at = start;
      while (next[at] != Soup::none) {
        loop.push_back(at);
        at = std::exchange(next[at], Soup::none);
      }
      if (!loop.empty() && (at != start || loop.size() < 3)) {
        return std::nullopt;
      }
      if (!loop.empty()) {
        found.push_back(std::move(loop));
      }
    }
    return found;
  }

  std::size_t corners_;
  std::vector<Vec2> places_;
  std::vector<std::vector<Crossing>> on_side_;
};

/// Twice the vector area.
Vec3 normal_of(const PolygonList& list, std::span<const std::uint32_t> polygon) {
  Vec3 sum;
  const Vec3 first = list.points[polygon[0]];
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    sum += cross(list.points[polygon[k]] - first, list.points[polygon[k + 1]] - first);
  }
  return normalized(sum);
}

/// Its corners in its plane; nothing where it isn't flat, or has too few or too many corners.
std::optional<Star> star_of(const PolygonList& list, std::size_t i, double flat) {
  const auto polygon = list.polygon(i);
  const Vec3 normal = normal_of(list, polygon);
  if (polygon.size() < 5 || polygon.size() > most_star_corners || normal == Vec3{}) {
    return std::nullopt;
  }
  const PlaneFrame frame(list.points[polygon[0]], normal);
  std::vector<Vec2> corners;
  for (const std::uint32_t p : polygon) {
    if (std::abs(dot(list.points[p] - list.points[polygon[0]], normal)) > flat) {
      return std::nullopt;
    }
    corners.push_back(frame.flat(list.points[p]));
  }
  return Star(std::move(corners));
}

void add_polygon(PolygonList& to, const PolygonList& from, std::size_t i,
                 std::span<const std::uint32_t> points, std::span<const std::uint32_t> textures) {
  to.corners.insert(to.corners.end(), points.begin(), points.end());
  to.textures.insert(to.textures.end(), textures.begin(), textures.end());
  to.first.push_back(static_cast<std::uint32_t>(to.corners.size()));
  to.origin.push_back(from.origin[i]);
  to.two_sided.push_back(from.two_sided[i]);
}

/// Whether an outline's middle sees all of its sides from within.
bool sees_all(const std::vector<Vec2>& places, const std::vector<std::uint32_t>& outline) {
  Vec2 middle;
  for (const std::uint32_t p : outline) {
    middle = middle + places[p] / static_cast<double>(outline.size());
  }
  for (std::size_t k = 0; k < outline.size(); ++k) {
    if (!(cross(places[outline[k]] - middle, places[outline[(k + 1) % outline.size()]] - middle) > 0.0)) {
      return false;
    }
  }
  return true;
}

/// Triangles around the middle of an outline: where stars run through each other no side of a triangle of one
/// is a side of another's, as diagonals from crossing to crossing would be.
void add_fan(PolygonList& to, const PolygonList& from, std::size_t i,
             const std::vector<std::uint32_t>& outline) {
  Vec3 middle;
  for (const std::uint32_t p : outline) {
    middle = middle + to.points[p] / static_cast<double>(outline.size());
  }
  const auto point = static_cast<std::uint32_t>(to.points.size());
  to.points.push_back(middle);
  constexpr std::array none{Soup::none, Soup::none, Soup::none};
  for (std::size_t k = 0; k < outline.size(); ++k) {
    add_polygon(to, from, i, std::array{point, outline[k], outline[(k + 1) % outline.size()]}, none);
  }
}

/// What takes the place of polygon i; false where it stays.
bool add_outlines(PolygonList& to, const PolygonList& from, std::size_t i, double flat) {
  std::optional<Star> star = star_of(from, i, flat);
  if (!star || !star->find_crossings()) {
    return false;
  }
  const auto outlines = star->outlines();
  if (!outlines || outlines->empty()) {
    return false;
  }
  const auto polygon = from.polygon(i);
  std::vector<std::uint32_t> number(polygon.begin(), polygon.end());
  for (auto p = static_cast<std::uint32_t>(polygon.size()); p < star->places().size(); ++p) {
    const auto [side, share] = star->origin(p);
    const Vec3 a = to.points[polygon[side]];
    const Vec3 b = to.points[polygon[(side + 1) % polygon.size()]];
    number.push_back(static_cast<std::uint32_t>(to.points.size()));
    to.points.push_back(a + share * (b - a));
  }
  for (const std::vector<std::uint32_t>& outline : *outlines) {
    std::vector<std::uint32_t> points;
    for (const std::uint32_t p : outline) {
      points.push_back(number[p]);
    }
    if (sees_all(star->places(), outline)) {
      add_fan(to, from, i, points);
    } else {
      add_polygon(to, from, i, points, std::vector<std::uint32_t>(points.size(), Soup::none));
    }
  }
  return true;
}

}  // namespace

void outline_stars(PolygonList& list, double flat, RepairReport& report) {
  PolygonList made;
  std::optional<std::size_t> first;
  for (std::size_t i = 0; i < list.size() && !first; ++i) {
    if (list.polygon(i).size() >= 5) {
      first = i;
    }
  }
  if (!first) {
    return;
  }
  made.points = list.points;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list.polygon(i).size() >= 5 && add_outlines(made, list, i, flat)) {
      report.add(RepairKind::crossed_polygons_rebuilt, 1, first_polygon(list.origin[i]));
      continue;
    }
    const std::size_t begin = list.first[i];
    const std::size_t size = list.first[i + 1] - begin;
    add_polygon(made, list, i, std::span(list.corners).subspan(begin, size),
                std::span(list.textures).subspan(begin, size));
  }
  list = std::move(made);
}

}  // namespace ridgecraft::mesh
