// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/details/details.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "base/boxes.hpp"
#include "base/elementary.hpp"
#include "mesh/model/surface.hpp"
#include "mesh/model/surface_distance.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/details/reliefs.hpp"
#include "prepare/symmetry/area_frame.hpp"

namespace ridgecraft::prepare {
namespace {

/// A strip is a detail if its length is no more than this share of the model's; longer ones are wires, legs
/// and rails, which somebody would miss.
constexpr double short_strip = 0.2;
/// A component of less area is a crumb: six millimetres square, where what is below three is narrow.
constexpr double tiny_area = 4.0;
/// The same as for strips, of a flat sheet on a wall.
constexpr double small_sheet = 0.25;
/// The same as for strips, of a body that hardly stands out of another.
constexpr double short_relief = 0.25;
/// A body with no more faces is no trouble, however little it stands out.
constexpr std::size_t faces_of_box = 12;
/// Sheets are flat within this share of the width that counts as narrow.
constexpr double flat = 0.1;
/// A sheet doesn't lie on what is steeper against it (the cosine of their normals).
constexpr double steepest = 0.1;
/// What a wall is larger than its faces, as a share of what is narrow.
constexpr double side_hair = 0.01;
/// Details have no more of the model's area together.
constexpr double most_area = 0.1;

/// Turns that are tried about the longest axis.
constexpr int turns = 24;

/// Of a part of a surface, ascending: along the principal axis with the largest one, and across it as the
/// body is narrowest. Principal axes alone would be any two of a square bar's.
std::array<double, 3> extents(const mesh::Surface& surface, const std::vector<FaceId>& faces) {
  const mesh::Surface alone = mesh::faces_alone(surface, faces);
  const auto extent = [&](Vec3 axis) {
    double low = INFINITY;
    double high = -INFINITY;
    for (const Vec3 p : alone.points()) {
      low = std::min(low, dot(p, axis));
      high = std::max(high, dot(p, axis));
    }
    return high - low;
  };
  const std::array<Vec3, 3> axes = area_frame(alone).axes;
  std::size_t longest = 0;
  for (std::size_t k = 1; k < axes.size(); ++k) {
    longest = extent(axes[k]) > extent(axes[longest]) ? k : longest;
  }
  const Vec3 u = axes[(longest + 1) % 3];
  const Vec3 v = axes[(longest + 2) % 3];
  std::array<double, 3> result{INFINITY, INFINITY, extent(axes[longest])};
  for (int turn = 0; turn < turns; ++turn) {
    const double angle = 0.5 * std::numbers::pi * turn / turns;
    const double one = extent(elementary::cos(angle) * u + elementary::sin(angle) * v);
    const double other = extent(elementary::cos(angle) * v - elementary::sin(angle) * u);
    if (std::min(one, other) < result[0]) {
      result[0] = std::min(one, other);
      result[1] = std::max(one, other);
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

enum class Kind { body, small, sheet, relief };

struct Component {
  std::vector<FaceId> faces;
  double area = 0.0;
  Box3 box;
  Kind kind = Kind::body;
};

/// What sheets may lie on.
class Walls {
 public:
  Walls(const mesh::Surface& surface, const std::vector<Component>& components)
      : surface_(surface),
        faces_(of_bodies(components)),
        tree_(
            faces_.size(), [&](std::uint32_t i) { return surface.bounds(faces_[i]); },
            [&](std::uint32_t i) { return centre(surface.bounds(faces_[i])); }) {}

  /// Is there a wall between p - way and p + way?
  [[nodiscard]] bool is_before(Vec3 p, Vec3 way) const {
    const double hair = side_hair * length(way);
    Box3 ends;
    ends.add(p - way);
    ends.add(p + way);
    const Box3 box = grown(ends, hair);
    bool found = false;
    tree_.search([&](std::uint32_t node) { return !found && meet(box, tree_.box(node)); },
                 [&](std::uint32_t at) { found = found || meets(faces_[tree_.order()[at]], p, way); });
    return found;
  }

 private:
  static std::vector<FaceId> of_bodies(const std::vector<Component>& components) {
    std::vector<FaceId> faces;
    for (const Component& c : components) {
      if (c.kind == Kind::body) {
        faces.insert(faces.end(), c.faces.begin(), c.faces.end());
      }
    }
    return faces;
  }

  /// The sides of a face belong to it, with a hair around them.
  [[nodiscard]] bool meets(FaceId f, Vec3 p, Vec3 way) const {
    const auto [v0, v1, v2] = surface_.vertices(f);
    const Vec3 a = surface_.point(v0);
    const Vec3 normal = surface_.normal(f);
    const double along = dot(normal, way);
    const double off = dot(normal, a - p);
    if (std::abs(along) <= steepest * length(way) || std::abs(off) > std::abs(along)) {
      return false;
    }
    const Vec3 q = p + (off / along) * way;
    const double hair = side_hair * length(way);
    return mesh::squared_distance(a, surface_.point(v1), surface_.point(v2), q) <= hair * hair;
  }

  const mesh::Surface& surface_;
  std::vector<FaceId> faces_;
  BoxTree<Box3> tree_;
};

class DetailSearch {
 public:
  DetailSearch(const mesh::Surface& surface, const DetailLimits& limits, const Context& context)
      : surface_(surface), limits_(limits), context_(context), components_(surface.component_count()) {
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      Component& c = components_[surface.component(f).value()];
      c.faces.push_back(f);
      c.area += surface.area(f);
      for (const VertexId v : surface.vertices(f)) {
        c.box.add(surface.point(v));
      }
    }
  }

  [[nodiscard]] std::vector<Kind> kinds() {
    for (Component& c : components_) {
      context_.check();
      c.kind = kind_of(c);
    }
    drop_sheets_in_the_air();
    find_reliefs();
    double all = 0.0;
    double details = 0.0;
    std::size_t faces = 0;
    std::vector<Kind> result;
    for (const Component& c : components_) {
      all += c.area;
      // Reliefs leave the walls behind them.
      details += c.kind == Kind::small || c.kind == Kind::sheet ? c.area : 0.0;
      faces += c.kind == Kind::body ? 0 : c.faces.size();
      result.push_back(c.kind);
    }
    const double of_faces = static_cast<double>(faces) / static_cast<double>(surface_.face_count());
    if (details > most_area * all || of_faces < limits_.least_faces) {
      std::fill(result.begin(), result.end(), Kind::body);
    }
    return result;
  }

 private:
  [[nodiscard]] Kind kind_of(const Component& c) const {
    const double model = surface_.bounds().largest_extent();
    // What is too long needs no closer look.
    if (c.box.largest_extent() > std::max(short_strip, small_sheet) * model) {
      return Kind::body;
    }
    const std::array<double, 3> extent = extents(surface_, c.faces);
    const bool is_crumb = c.area < tiny_area * limits_.narrow * limits_.narrow;
    if ((is_crumb || extent[1] < limits_.narrow) && extent[2] <= short_strip * model) {
      return Kind::small;
    }
    return extent[0] < flat * limits_.narrow && extent[2] <= small_sheet * model ? Kind::sheet : Kind::body;
  }

  /// Of the flat sheets only those stay details that lie on something that stays.
  void drop_sheets_in_the_air() {
    const auto is_sheet = [](const Component& c) { return c.kind == Kind::sheet; };
    if (std::none_of(components_.begin(), components_.end(), is_sheet)) {
      return;
    }
    const Walls walls(surface_, components_);
    for (Component& c : components_) {
      if (c.kind == Kind::sheet && !lies_on(c, walls)) {
        c.kind = Kind::body;
      }
    }
  }

  /// What is neither long nor a detail by itself may be one by where it lies.
  void find_reliefs() {
    std::vector<ComponentFaces> candidates;
    std::vector<std::size_t> number;
    std::vector<FaceId> ground;
    for (std::size_t i = 0; i < components_.size(); ++i) {
      const Component& c = components_[i];
      if (c.kind != Kind::body) {
        continue;
      }
      if (c.box.largest_extent() > short_relief * surface_.bounds().largest_extent()) {
        ground.insert(ground.end(), c.faces.begin(), c.faces.end());
      } else if (c.faces.size() > faces_of_box) {
        candidates.push_back(c.faces);
        number.push_back(i);
      }
    }
    const std::vector<bool> are = are_reliefs(surface_, candidates, ground, limits_.narrow, context_);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      components_[number[i]].kind = are[i] ? Kind::relief : Kind::body;
    }
  }

  /// A pane that fills a hole has a wall all round, but none right behind it.
  [[nodiscard]] bool lies_on(const Component& sheet, const Walls& walls) const {
    return std::all_of(sheet.faces.begin(), sheet.faces.end(), [&](FaceId f) {
      context_.check();
      const auto [v0, v1, v2] = surface_.vertices(f);
      const Vec3 p0 = surface_.point(v0);
      const Vec3 p1 = surface_.point(v1);
      const Vec3 p2 = surface_.point(v2);
      const std::array<Vec3, 7> places{
          p0, p1, p2, 0.5 * (p0 + p1), 0.5 * (p1 + p2), 0.5 * (p2 + p0), (p0 + p1 + p2) / 3.0};
      return std::all_of(places.begin(), places.end(),
                         [&](Vec3 p) { return walls.is_before(p, limits_.narrow * surface_.normal(f)); });
    });
  }

  const mesh::Surface& surface_;
  DetailLimits limits_;
  const Context& context_;
  std::vector<Component> components_;
};

}  // namespace

Details leave_out_details(mesh::Model& model, const DetailLimits& limits, const Context& context) {
  const mesh::Surface& surface = model.surface;
  if (surface.component_count() < 2) {
    return {};
  }
  DetailSearch search(surface, limits, context);
  const std::vector<Kind> kinds = search.kinds();
  Details details;
  details.small = static_cast<std::size_t>(std::count(kinds.begin(), kinds.end(), Kind::small));
  details.flat = static_cast<std::size_t>(std::count(kinds.begin(), kinds.end(), Kind::sheet));
  details.low = static_cast<std::size_t>(std::count(kinds.begin(), kinds.end(), Kind::relief));
  if (details.count() == 0) {
    return details;
  }
  std::vector<bool> kept;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    kept.push_back(kinds[surface.component(f).value()] == Kind::body);
  }
  mesh::keep_faces(model, kept);
  return details;
}

}  // namespace ridgecraft::prepare
