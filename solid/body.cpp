// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/body.hpp"

namespace ridgecraft::solid {
namespace {

/// Volume, first and second moments about the origin.
struct Moments {
  double volume = 0.0;
  Vec3 first{0.0, 0.0, 0.0};
  std::array<double, 6> second{};  ///< xx, yy, zz, xy, xz, yz
};

void add(Moments& sum, const Body& body) {
  for (const auto& [i, j, k] : body.triangles) {
    const Vec3 a = body.points[i];
    const Vec3 b = body.points[j];
    const Vec3 c = body.points[k];
    const double volume = dot(a, cross(b, c)) / 6.0;
    const Vec3 s = a + b + c;
    sum.volume += volume;
    sum.first = sum.first + (0.25 * volume) * s;
    // Integral of x_i x_j over the tetrahedron of the origin, a, b, c.
    const auto moment = [&](double ai, double bi, double ci, double si, double aj, double bj, double cj,
                            double sj) { return volume / 20.0 * (ai * aj + bi * bj + ci * cj + si * sj); };
    sum.second[0] += moment(a.x, b.x, c.x, s.x, a.x, b.x, c.x, s.x);
    sum.second[1] += moment(a.y, b.y, c.y, s.y, a.y, b.y, c.y, s.y);
    sum.second[2] += moment(a.z, b.z, c.z, s.z, a.z, b.z, c.z, s.z);
    sum.second[3] += moment(a.x, b.x, c.x, s.x, a.y, b.y, c.y, s.y);
    sum.second[4] += moment(a.x, b.x, c.x, s.x, a.z, b.z, c.z, s.z);
    sum.second[5] += moment(a.y, b.y, c.y, s.y, a.z, b.z, c.z, s.z);
  }
}

MassProperties from_moments(const Moments& m) {
  MassProperties result;
  result.volume = m.volume;
  if (!(m.volume > 0.0)) {
    return result;
  }
  const Vec3 c = (1.0 / m.volume) * m.first;
  const double xx = m.second[0] - m.volume * c.x * c.x;
  const double yy = m.second[1] - m.volume * c.y * c.y;
  const double zz = m.second[2] - m.volume * c.z * c.z;
  result.center = c;
  result.inertia = {yy + zz,
                    xx + zz,
                    xx + yy,
                    m.volume * c.x * c.y - m.second[3],
                    m.volume * c.x * c.z - m.second[4],
                    m.volume * c.y * c.z - m.second[5]};
  return result;
}

}  // namespace

MassProperties mass_properties(const Body& body) {
  return mass_properties(std::span(&body, 1));
}

MassProperties mass_properties(std::span<const Body> bodies) {
  Moments sum;
  for (const Body& body : bodies) {
    add(sum, body);
  }
  return from_moments(sum);
}

}  // namespace ridgecraft::solid
