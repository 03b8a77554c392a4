// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/subdivide.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mesh/error.hpp"
#include "mesh/loose_faces.hpp"

namespace ridgecraft::mesh {
namespace {

/// More paper than anyone has.
constexpr std::size_t most_faces = 1'000'000;

double side_length(const Surface& surface, FaceId f, unsigned k) {
  return surface.length(surface.edge(corner(f, k)));
}

bool fits(const Surface& surface, FaceId f, Vec2 rectangle) {
  return fits_rectangle(side_length(surface, f, 0), side_length(surface, f, 1), side_length(surface, f, 2),
                        rectangle);
}

/// The longest edges of faces that don't fit, longest first, at most one for each face.
std::vector<EdgeId> edges_to_divide(const Surface& surface, Vec2 rectangle) {
  std::vector<EdgeId> wanted;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    if (!fits(surface, f, rectangle)) {
      unsigned longest = 0;
      for (unsigned k = 1; k < 3; ++k) {
        longest = side_length(surface, f, k) > side_length(surface, f, longest) ? k : longest;
      }
      wanted.push_back(surface.edge(corner(f, longest)));
    }
  }
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  std::stable_sort(wanted.begin(), wanted.end(),
                   [&](EdgeId d, EdgeId e) { return surface.length(d) > surface.length(e); });
  std::vector<bool> touched(surface.face_count(), false);
  std::vector<EdgeId> chosen;
  for (const EdgeId e : wanted) {
    const auto [c, d] = surface.sides(e);
    if (!touched[face_of(c).value()] && (!d.valid() || !touched[face_of(d).value()])) {
      chosen.push_back(e);
      touched[face_of(c).value()] = true;
      if (d.valid()) {
        touched[face_of(d).value()] = true;
      }
    }
  }
  return chosen;
}

void divide(Model& model, const std::vector<EdgeId>& edges) {
  const Surface& surface = model.surface;
  const LooseFaces old = take_apart(model);
  LooseFaces result;
  result.points = old.points;
  std::vector<CornerId> divided(old.faces.size());  // the side of each face that is divided
  std::vector<std::uint32_t> middle(old.faces.size(), 0);
  for (const EdgeId e : edges) {
    const auto m = static_cast<std::uint32_t>(result.points.size());
    const CornerId c = surface.sides(e)[0];
    result.points.push_back(0.5 *
                            (surface.point(surface.vertex(c)) + surface.point(surface.vertex(next(c)))));
    for (const CornerId side : surface.sides(e)) {
      if (side.valid()) {
        divided[face_of(side).value()] = side;
        middle[face_of(side).value()] = m;
      }
    }
  }
  for (std::size_t f = 0; f < old.faces.size(); ++f) {
    const std::array<Vec2, 3> places = old.texture.empty() ? std::array<Vec2, 3>{} : old.texture[f];
    if (!divided[f].valid()) {
      result.add(old, f, old.faces[f], places);
      continue;
    }
    const std::size_t k = divided[f].value() % 3;
    const auto& v = old.faces[f];
    const std::size_t l = (k + 1) % 3;
    const std::size_t n = (k + 2) % 3;
    const Vec2 place = 0.5 * (places[k] + places[l]);
    result.add(old, f, {v[k], middle[f], v[n]}, {places[k], place, places[n]});
    result.add(old, f, {middle[f], v[l], v[n]}, {place, places[l], places[n]});
  }
  put_together(model, std::move(result));
}

}  // namespace

bool fits_rectangle(double a, double b, double c, Vec2 rectangle) {
  const double longest = std::max({a, b, c});
  if (longest <= std::min(rectangle.x, rectangle.y)) {
    return true;
  }
  if (longest > length(rectangle)) {
    return false;
  }
  // The corner between b and c in the plane, with side a along the x axis.
  const double x = (a * a + c * c - b * b) / (2.0 * a);
  const double y = std::sqrt(std::max(0.0, c * c - x * x));
  for (int degree = 0; degree < 180; ++degree) {
    const double angle = degree * std::numbers::pi / 180.0;
    const Vec2 right{std::cos(angle), std::sin(angle)};
    Box2 box;
    for (const Vec2 p : {Vec2{0.0, 0.0}, Vec2{a, 0.0}, Vec2{x, y}}) {
      box.add({dot(p, right), cross(p, right)});
    }
    if (box.size().x <= rectangle.x && box.size().y <= rectangle.y) {
      return true;
    }
  }
  return false;
}

void subdivide(Model& model, Vec2 largest_face_mm, const Context& context) {
  for (;;) {
    context.check();
    const std::vector<EdgeId> edges = edges_to_divide(model.surface, largest_face_mm);
    if (edges.empty()) {
      return;
    }
    if (model.surface.face_count() + 2 * edges.size() > most_faces) {
      throw Error(ErrorKind::no_nets, "the model is far too large for this paper; choose a smaller size");
    }
    divide(model, edges);
  }
}

std::size_t count_narrow_faces(const Surface& surface, const Panels& panels, double width) {
  std::size_t narrow = 0;
  for (const PanelId p : ids<PanelId>(panels.count())) {
    double area = 0.0;
    double longest = 0.0;
    double highest = 0.0;
    for (const FaceId f : panels.faces[p]) {
      double side = 0.0;
      for (unsigned k = 0; k < 3; ++k) {
        side = std::max(side, side_length(surface, f, k));
      }
      highest = std::max(highest, side > 0.0 ? 2.0 * surface.area(f) / side : 0.0);
      longest = std::max(longest, side);
      area += surface.area(f);
    }
    // Faces side by side may be narrow each and wide together.
    if (highest < width && area < width * longest) {
      narrow += panels.faces[p].size();
    }
  }
  return narrow;
}

}  // namespace ridgecraft::mesh
