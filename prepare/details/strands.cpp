// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/details/strands.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/model/faces_alone.hpp"
#include "prepare/symmetry/area_frame.hpp"

namespace ridgecraft::prepare {
namespace {

/// Strands are so many times as long as wide.
constexpr double slender = 8.0;
/// They have no more of the model's area together: less than all else, seen from afar.
constexpr double most_of_area = 0.5;
/// How far apart components may be that meet, as a share of what is narrow.
constexpr double meeting = 0.02;

struct Measures {
  double area = 0.0;
  double length = 0.0;
  double border = 0.0;

  /// Pressed flat. A strip has a border along both sides, and a tube twice its width around it.
  [[nodiscard]] double width() const { return area / (2.0 * length - std::min(0.5 * border, length)); }
};

Measures measured(const mesh::Surface& surface, const ComponentFaces& faces) {
  Measures m;
  m.length = strand_length(surface, faces);
  for (const FaceId f : faces) {
    m.area += surface.area(f);
    for (unsigned k = 0; k < 3; ++k) {
      const CornerId c = mesh::corner(f, k);
      if (!surface.twin(c).valid()) {
        m.border += length(surface.point(surface.vertex(mesh::next(c))) - surface.point(surface.vertex(c)));
      }
    }
  }
  return m;
}

}  // namespace

double strand_length(const mesh::Surface& surface, const ComponentFaces& strand) {
  const mesh::Surface alone = mesh::faces_alone(surface, strand);
  double longest = 0.0;
  for (const Vec3 axis : area_frame(alone).axes) {
    double low = INFINITY;
    double high = -INFINITY;
    for (const Vec3 p : alone.points()) {
      low = std::min(low, dot(p, axis));
      high = std::max(high, dot(p, axis));
    }
    longest = std::max(longest, high - low);
  }
  return longest;
}

std::vector<bool> are_strands(const mesh::Surface& surface, const std::vector<ComponentFaces>& components,
                              double narrow, const Context& context) {
  std::vector<bool> result(surface.component_count(), false);
  double all = 0.0;
  double of_strands = 0.0;
  for (const ComponentFaces& faces : components) {
    context.check();
    const Measures m = measured(surface, faces);
    const bool is = m.width() < narrow && m.length > slender * m.width();
    result[surface.component(faces.front()).value()] = is;
    all += m.area;
    of_strands += is ? m.area : 0.0;
  }
  if (of_strands == 0.0 || of_strands > most_of_area * all) {
    return std::vector<bool>(surface.component_count(), false);
  }
  const Neighbours neighbours(surface);
  const std::vector<bool> thin = result;
  for (const ComponentFaces& faces : components) {
    context.check();
    const std::size_t own = surface.component(faces.front()).value();
    result[own] = thin[own] && !neighbours.are_several(faces, meeting * narrow,
                                                       [&](ComponentId c) { return !thin[c.value()]; });
  }
  return result;
}

}  // namespace ridgecraft::prepare
