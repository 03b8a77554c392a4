// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/hull/pockets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/context.hpp"
#include "base/no_index.hpp"
#include "base/random.hpp"

namespace ridgecraft::segment {

double volume_per_length() {
  const double step = RayGrid(rays_a_side).step();
  return step * step;
}

std::vector<RaySpan> cast_rays(const Hull& hull, std::span<const Vec3> points) {
  const RayGrid grid(rays_a_side);
  std::vector<RaySpan> met;
  for (const auto& corners : hull.triangles) {
    const Vec3 a = points[corners[0]];
    const Vec3 b = points[corners[1]];
    const Vec3 c = points[corners[2]];
    grid.for_rays_near(a, b, c, [&](std::uint32_t ray, double u, double v) {
      if (u >= 0.0 && v >= 0.0 && u + v <= 1.0) {
        const auto z = static_cast<float>(u * a.z + v * b.z + (1.0 - u - v) * c.z);
        met.push_back({ray, z, z});
      }
    });
  }
  std::sort(met.begin(), met.end(), [](const RaySpan& s, const RaySpan& t) {
    return s.ray != t.ray ? s.ray < t.ray : s.low < t.low;
  });
  std::vector<RaySpan> spans;
  for (const RaySpan& s : met) {
    if (!spans.empty() && spans.back().ray == s.ray) {
      spans.back().high = s.low;
    } else {
      spans.push_back(s);
    }
  }
  return spans;
}

namespace {

constexpr std::size_t most_variables = 4;
using Numbers = std::array<double, most_variables>;

/// dot(a, x) <= b
struct Row {
  Numbers a{};
  double b = 0.0;
};

/// By how much a constraint may be broken: rounding of unit numbers after four substitutions.
constexpr double slack = 1e-12;
/// Coefficients below this are none: the constraint doesn't bind the variable.
constexpr double no_coefficient = 1e-13;

double dot_of(const Numbers& a, const Numbers& x, std::size_t d) {
  double sum = 0.0;
  for (std::size_t i = 0; i < d; ++i) {
    sum += a[i] * x[i];
  }
  return sum;
}

/// Removes variable k by way of a row that holds with equality.
Row substituted(const Row& row, const Row& equal, std::size_t k, std::size_t d) {
  Row out;
  const double factor = row.a[k] / equal.a[k];
  for (std::size_t i = 0, j = 0; i < d; ++i) {
    if (i != k) {
      out.a[j++] = row.a[i] - factor * equal.a[i];
    }
  }
  out.b = row.b - factor * equal.b;
  return out;
}

/// Greatest c x with all rows held, for a single variable; none when nothing holds them all.
std::optional<double> maximise_one(std::span<const Row> rows, double c) {
  double low = -INFINITY;
  double high = INFINITY;
  for (const Row& row : rows) {
    if (row.a[0] > no_coefficient) {
      high = std::min(high, row.b / row.a[0]);
    } else if (row.a[0] < -no_coefficient) {
      low = std::max(low, row.b / row.a[0]);
    } else if (row.b < -slack) {
      return std::nullopt;
    }
  }
  if (low > high + slack) {
    return std::nullopt;
  }
  return c > 0.0 ? high : low;
}

/// The rows as they are where `equal` holds with equality, without variable k. Bounds of the other variables
/// come first, two each.
void restrict_to(std::span<const Row> rows, const Row& equal, std::size_t k, std::size_t d,
                 std::vector<Row>& less) {
  less.clear();
  const auto take = [&](std::size_t n) { less.push_back(substituted(rows[n], equal, k, d)); };
  for (std::size_t i = 0; i < d; ++i) {
    if (i != k) {
      take(2 * i);
      take(2 * i + 1);
    }
  }
  take(2 * k);
  take(2 * k + 1);
  for (std::size_t n = 2 * d; n < rows.size(); ++n) {
    take(n);
  }
}

/// The variable whose coefficient is greatest, or none of d where all are too small.
std::size_t greatest_coefficient(const Row& row, std::size_t d) {
  std::size_t k = 0;
  for (std::size_t i = 1; i < d; ++i) {
    k = std::abs(row.a[i]) > std::abs(row.a[k]) ? i : k;
  }
  return std::abs(row.a[k]) < no_coefficient ? d : k;
}

/// Puts the variable k that was substituted back among the d - 1 others.
Numbers with_substituted(const Numbers& others, const Row& equal, std::size_t k, std::size_t d) {
  Numbers x{};
  for (std::size_t i = 0, j = 0; i < d; ++i) {
    if (i != k) {
      x[i] = others[j++];
    }
  }
  double rest = equal.b;
  for (std::size_t i = 0; i < d; ++i) {
    rest -= i != k ? equal.a[i] * x[i] : 0.0;
  }
  x[k] = rest / equal.a[k];
  return x;
}

/// Where dot(c, x) is greatest with all rows held; none when nothing holds them all. The first 2 d rows bound
/// the variables: rows 2 i and 2 i + 1 say x_i <= b and -x_i <= b.
std::optional<Numbers> maximise(std::span<const Row> rows, const Numbers& c, std::size_t d) {
  Numbers x{};
  if (d == 1) {
    const std::optional<double> most = maximise_one(rows, c[0]);
    x[0] = most.value_or(0.0);
    return most ? std::optional(x) : std::nullopt;
  }
  for (std::size_t i = 0; i < d; ++i) {
    x[i] = c[i] > 0.0 ? rows[2 * i].b : -rows[2 * i + 1].b;
  }
  std::vector<Row> less;
  for (std::size_t n = 2 * d; n < rows.size(); ++n) {
    const Row& row = rows[n];
    if (dot_of(row.a, x, d) <= row.b + slack) {
      continue;
    }
    // The optimum with this row lies on it.
    const std::size_t k = greatest_coefficient(row, d);
    if (k == d) {
      return std::nullopt;
    }
    restrict_to(rows.first(n), row, k, d, less);
    const auto others = maximise(less, substituted({c, 0.0}, row, k, d).a, d - 1);
    if (!others) {
      return std::nullopt;
    }
    x = with_substituted(*others, row, k, d);
  }
  return x;
}

}  // namespace

std::optional<DeepestPoint> deepest_point(std::span<const HalfSpace> half_spaces) {
  std::vector<Row> rows;
  rows.reserve(half_spaces.size() + 2 * most_variables);
  for (std::size_t i = 0; i < most_variables; ++i) {
    Row upper;
    Row lower;
    upper.a[i] = 1.0;
    lower.a[i] = -1.0;
    upper.b = 2.0;
    lower.b = i + 1 == most_variables ? 0.0 : 2.0;  // the depth isn't negative
    rows.push_back(upper);
    rows.push_back(lower);
  }
  for (const HalfSpace& h : half_spaces) {
    rows.push_back({{h.normal.x, h.normal.y, h.normal.z, 1.0}, h.offset});
  }
  // Any order gives the same answer up to rounding; a shuffled one is expected to be fast. A fixed shuffle,
  // as good as any, so that the function depends on the half spaces alone and no seed changes a promise.
  Random random(1);
  for (std::size_t i = rows.size(); i > 2 * most_variables + 1; --i) {
    const std::size_t j =
        2 * most_variables + random.below(static_cast<std::uint32_t>(i - 2 * most_variables));
    std::swap(rows[i - 1], rows[j]);
  }
  const auto x = maximise(rows, {0.0, 0.0, 0.0, 1.0}, most_variables);
  if (!x) {
    return std::nullopt;
  }
  return DeepestPoint{{(*x)[0], (*x)[1], (*x)[2]}, (*x)[3]};
}

/// Depth beyond the tolerance that is rounding, in radii of the ball.
constexpr double depth_rounding = 1e-9;
/// How far beside a facet air is looked for, in radii: far above the grid, far below any feature.
constexpr double beside = 1e-7;
/// Direction of rays, along no likely edge or face.
constexpr Vec3 ray{0.43201637, 0.28905123, 0.85429631};

PocketTest::PocketTest(const ScaledSurface& surface, double tolerance)
    : surface_(&surface), tolerance_(tolerance), air_(surface.facet_count(), -1) {}

bool PocketTest::encloses(const ScaledSurface& surface) {
  return std::all_of(surface.neighbors.begin(), surface.neighbors.end(), [](const auto& beside_facet) {
    return std::find(beside_facet.begin(), beside_facet.end(), no_index) == beside_facet.end();
  });
}

int PocketTest::winding(Vec3 point) const {
  int number = 0;
  const auto& points = surface_->points;
  for (const auto& [i, j, k] : surface_->corners) {
    const Vec3 a = points[i] - point;
    const Vec3 b = points[j] - point;
    const Vec3 c = points[k] - point;
    const double u = dot(ray, cross(b, c));
    const double v = dot(ray, cross(c, a));
    const double w = dot(ray, cross(a, b));
    const bool out = u > 0.0 && v > 0.0 && w > 0.0;
    const bool in = u < 0.0 && v < 0.0 && w < 0.0;
    if ((out || in) && dot(a, cross(b, c)) * (u + v + w) > 0.0) {
      number += out ? 1 : -1;
    }
  }
  return number;
}

void PocketTest::find_planes(const Hull& hull) {
  find_hull_planes(hull, surface_->points, hull_planes_);
  planes_.clear();
  for (const HullPlane& plane : hull_planes_) {
    planes_.push_back({plane.normal, plane.offset - tolerance_ - depth_rounding});
  }
}

/// Whether a facet has a point inside all planes. `last`: the plane that turned the facet before away.
bool PocketTest::reaches_in(std::uint32_t facet, std::size_t& last, Vec3& where) const {
  const auto& corners = surface_->corners[facet];
  const auto beyond = [&](const HalfSpace& plane) {
    return std::all_of(corners.begin(), corners.end(), [&](std::uint32_t v) {
      return dot(plane.normal, surface_->points[v]) >= plane.offset;
    });
  };
  if (beyond(planes_[last])) {
    return false;
  }
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    if (beyond(planes_[i])) {
      last = i;
      return false;
    }
  }
  std::vector<Vec3> polygon;
  for (const std::uint32_t v : corners) {
    polygon.push_back(surface_->points[v]);
  }
  std::vector<Vec3> cut;
  for (const HalfSpace& plane : planes_) {
    cut.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 p = polygon[i];
      const Vec3 q = polygon[(i + 1) % polygon.size()];
      const double at_p = dot(plane.normal, p) - plane.offset;
      const double at_q = dot(plane.normal, q) - plane.offset;
      if (at_p < 0.0) {
        cut.push_back(p);
      }
      if ((at_p < 0.0) != (at_q < 0.0)) {
        cut.push_back(p + (at_p / (at_p - at_q)) * (q - p));
      }
    }
    polygon.swap(cut);
    if (polygon.empty()) {
      return false;
    }
  }
  where = Vec3{};
  for (const Vec3 p : polygon) {
    where += p / static_cast<double>(polygon.size());
  }
  return true;
}

bool PocketTest::has_air_beside(std::uint32_t facet, Vec3 where) {
  std::int8_t& known = air_[facet];
  if (known < 0) {
    const Vec3 n = surface_->facet_normal(facet);
    known = n == Vec3{} ? std::int8_t{0}
                        : static_cast<std::int8_t>(winding(where + beside * n) == 0 ||
                                                   winding(where - beside * n) == 0);
  }
  return known == 1;
}

bool PocketTest::has_pocket(const Hull& hull) {
  if (hull.flat || hull.triangles.empty()) {
    return false;
  }
  find_planes(hull);
  const auto deepest = deepest_point(planes_);
  if (!deepest || deepest->depth <= 0.0) {
    return false;
  }
  if (winding(deepest->point) == 0) {
    return true;
  }
  std::size_t last = 0;
  Vec3 where;
  for (std::uint32_t f = 0; f < surface_->facet_count(); ++f) {
    if (air_[f] != 0 && reaches_in(f, last, where) && has_air_beside(f, where)) {
      return true;
    }
  }
  return false;
}

}  // namespace ridgecraft::segment
