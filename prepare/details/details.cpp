// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/details/details.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "base/near_boxes.hpp"
#include "mesh/model/surface_distance.hpp"
#include "mesh/repair/loose_faces.hpp"
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
/// Sheets are flat within this share of the width that counts as narrow.
constexpr double flat = 0.1;
/// Details have no more of the model's area together.
constexpr double most_area = 0.1;

/// Of a part of a surface along its principal axes, ascending.
std::array<double, 3> extents(const mesh::Surface& surface, const std::vector<FaceId>& faces) {
  std::map<VertexId, VertexId> number;
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> corners;
  for (const FaceId f : faces) {
    std::array<VertexId, 3> own = surface.vertices(f);
    for (VertexId& v : own) {
      const auto [at, fresh] = number.try_emplace(v, static_cast<std::uint32_t>(points.size()));
      if (fresh) {
        points.push_back(surface.point(v));
      }
      v = at->second;
    }
    corners.push_back(own);
  }
  const AreaFrame frame = area_frame(mesh::Surface(points, std::move(corners)));
  std::array<double, 3> result{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = INFINITY;
    double high = -INFINITY;
    for (const Vec3 p : points) {
      low = std::min(low, dot(p, frame.axes[axis]));
      high = std::max(high, dot(p, frame.axes[axis]));
    }
    result[axis] = high - low;
  }
  std::sort(result.begin(), result.end());
  return result;
}

enum class Kind { body, small, sheet };

struct Component {
  std::vector<FaceId> faces;
  double area = 0.0;
  Box3 box;
  Kind kind = Kind::body;
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
    double all = 0.0;
    double details = 0.0;
    std::size_t faces = 0;
    std::vector<Kind> result;
    for (const Component& c : components_) {
      all += c.area;
      details += c.kind == Kind::body ? 0.0 : c.area;
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
    // A component whose box is large in two directions needs no closer look.
    const Vec3 size = c.box.size();
    if (std::max({size.x, size.y, size.z}) > std::max(short_strip, small_sheet) * model) {
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
    std::vector<Box3> boxes;
    const Vec3 margin{limits_.narrow, limits_.narrow, limits_.narrow};
    for (const Component& c : components_) {
      boxes.push_back({c.box.low - margin, c.box.high + margin});
    }
    std::vector<std::vector<FaceId>> around(components_.size());
    NearBoxes(boxes).for_pairs([&](std::uint32_t i, std::uint32_t j) {
      for (const auto& [sheet, other] : {std::pair{i, j}, std::pair{j, i}}) {
        if (components_[sheet].kind == Kind::sheet && components_[other].kind == Kind::body) {
          const std::vector<FaceId>& faces = components_[other].faces;
          around[sheet].insert(around[sheet].end(), faces.begin(), faces.end());
        }
      }
    });
    for (std::size_t c = 0; c < components_.size(); ++c) {
      if (components_[c].kind == Kind::sheet && !lies_on(components_[c], around[c])) {
        components_[c].kind = Kind::body;
      }
    }
  }

  [[nodiscard]] bool lies_on(const Component& sheet, const std::vector<FaceId>& others) const {
    context_.check();
    const double near = limits_.narrow * limits_.narrow;
    return std::all_of(sheet.faces.begin(), sheet.faces.end(), [&](FaceId f) {
      const auto [v0, v1, v2] = surface_.vertices(f);
      const Vec3 p0 = surface_.point(v0);
      const Vec3 p1 = surface_.point(v1);
      const Vec3 p2 = surface_.point(v2);
      // A pane that fills a hole has its corners on the wall around, but nothing behind its middle.
      const std::array<Vec3, 7> places{
          p0, p1, p2, 0.5 * (p0 + p1), 0.5 * (p1 + p2), 0.5 * (p2 + p0), (p0 + p1 + p2) / 3.0};
      return std::all_of(places.begin(), places.end(), [&](Vec3 p) {
        return std::any_of(others.begin(), others.end(), [&](FaceId other) {
          const auto [a, b, c] = surface_.vertices(other);
          return mesh::squared_distance(surface_.point(a), surface_.point(b), surface_.point(c), p) <= near;
        });
      });
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
  const std::vector<Kind> kinds = DetailSearch(surface, limits, context).kinds();
  Details details;
  details.small = static_cast<std::size_t>(std::count(kinds.begin(), kinds.end(), Kind::small));
  details.flat = static_cast<std::size_t>(std::count(kinds.begin(), kinds.end(), Kind::sheet));
  if (details.count() == 0) {
    return details;
  }
  const mesh::LooseFaces all = mesh::take_apart(model);
  mesh::LooseFaces kept;
  kept.points = all.points;
  for (std::size_t f = 0; f < all.faces.size(); ++f) {
    if (kinds[surface.component(FaceId(f)).value()] == Kind::body) {
      kept.add(all, f, all.faces[f], all.texture.empty() ? std::array<Vec2, 3>{} : all.texture[f]);
    }
  }
  mesh::put_together(model, std::move(kept));
  return details;
}

}  // namespace ridgecraft::prepare
