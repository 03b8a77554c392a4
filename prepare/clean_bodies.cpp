// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/clean_bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "base/boxes.hpp"
#include "base/context.hpp"
#include "base/elementary.hpp"
#include "mesh/model/model.hpp"
#include "mesh/model/surface.hpp"
#include "mesh/model/surface_distance.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/bodies/faces_met.hpp"
#include "prepare/bodies/loose_bodies.hpp"
#include "prepare/bodies/thin_walls.hpp"
#include "prepare/prepared/effort.hpp"
#include "prepare/prepared/prepared.hpp"
#include "prepare/symmetry/isometry.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {
namespace {

// What else is where a component of a surface is.

/// A component by its faces.
using ComponentFaces = std::vector<FaceId>;

class Neighbours {
 public:
  /// `surface` stays where it is. O(n log n).
  explicit Neighbours(const mesh::Surface& surface);

  /// Do faces of two other components, or of more, come as near as `reach`, as their boxes tell? Only those
  /// count that `counts` says so of, if it is given. O(log n) a face.
  [[nodiscard]] bool are_several(const ComponentFaces& faces, double reach,
                                 const std::function<bool(ComponentId)>& counts = {}) const;

 private:
  const mesh::Surface& surface_;
  BoxTree<Box3> tree_;
};

Neighbours::Neighbours(const mesh::Surface& surface)
    : surface_(surface),
      tree_(
          surface.face_count(), [&](std::uint32_t f) { return surface.bounds(FaceId(f)); },
          [&](std::uint32_t f) { return centre(surface.bounds(FaceId(f))); }) {}

bool Neighbours::are_several(const ComponentFaces& faces, double reach,
                             const std::function<bool(ComponentId)>& counts) const {
  const ComponentId own = surface_.component(faces.front());
  ComponentId other;
  bool several = false;
  for (const FaceId f : faces) {
    const Box3 box = grown(surface_.bounds(f), reach);
    tree_.search(
        [&](std::uint32_t node) { return !several && meet(box, tree_.box(node)); },
        [&](std::uint32_t at) {
          const FaceId near{tree_.order()[at]};
          const ComponentId c = surface_.component(near);
          if (c == own || c == other || !meet(box, surface_.bounds(near)) || (counts && !counts(c))) {
            return;
          }
          several = several || other.valid();
          other = c;
        });
  }
  return several;
}

// Bodies that hardly stand out of others.

/// How far apart components may be that meet, as a share of what is low.
constexpr double meeting_hair = 0.02;

/// Which of the `candidates` lie on the `ground` all over: no place of them is farther from its faces than
/// `height`, in the unit of the surface, inside it or outside. A window frame in a wall is such a relief. One
/// that meets several components may be what holds them together, and is none; whether they meet is told by
/// the boxes of their faces. O((n + m) log n) for n faces and m places, half of `height` apart.
std::vector<bool> are_reliefs(const mesh::Surface& surface, const std::vector<ComponentFaces>& candidates,
                              const std::vector<FaceId>& ground, double height, const Context& context) {
  std::vector<bool> result(candidates.size(), false);
  if (ground.empty()) {
    return result;
  }
  const Neighbours neighbours(surface);
  const mesh::Surface walls = mesh::faces_alone(surface, ground);
  const mesh::SurfaceTree near(walls, walls.bounds().largest_extent());
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    context.check();
    const mesh::Surface alone = mesh::faces_alone(surface, candidates[c]);
    const auto is_near = [&](Vec3 p) { return near.distance(p, height) <= height; };
    // Corners alone tell of most bodies that they stand out.
    const bool may_be = std::all_of(alone.points().begin(), alone.points().end(), is_near);
    const auto all_near = [&] {
      const mesh::SurfaceTree places(alone, 0.5 * height);
      return std::all_of(places.samples().begin(), places.samples().end(), is_near);
    };
    result[c] = may_be && all_near() && !neighbours.are_several(candidates[c], meeting_hair * height);
  }
  return result;
}

// Bodies that nobody could cut and hold are left out before others are united with them.

/// What is too small, and where that is worth leaving out.
struct DetailLimits {
  double narrow = 0.0;       ///< in the unit of the surface
  double least_faces = 0.0;  ///< the share of the model's faces that details have at least, else all stay
};

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
/// What a wall is larger than its faces, as a share of twice what is narrow.
constexpr double side_hair = 0.005;
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
    std::vector<FaceId> bodies;
    for (const Component& c : components_) {
      if (c.kind == Kind::body) {
        bodies.insert(bodies.end(), c.faces.begin(), c.faces.end());
      }
    }
    const FacesMet walls(surface_, std::move(bodies), side_hair);
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
  [[nodiscard]] bool lies_on(const Component& sheet, const FacesMet& walls) const {
    return std::all_of(sheet.faces.begin(), sheet.faces.end(), [&](FaceId f) {
      context_.check();
      const auto [v0, v1, v2] = surface_.vertices(f);
      const Vec3 p0 = surface_.point(v0);
      const Vec3 p1 = surface_.point(v1);
      const Vec3 p2 = surface_.point(v2);
      const std::array<Vec3, 7> places{
          p0, p1, p2, 0.5 * (p0 + p1), 0.5 * (p1 + p2), 0.5 * (p2 + p0), (p0 + p1 + p2) / 3.0};
      const Vec3 normal = surface_.normal(f);
      return std::all_of(places.begin(), places.end(), [&](Vec3 p) {
        return walls
            .find(p - limits_.narrow * normal, 2.0 * limits_.narrow * normal,
                  [&](FaceId wall) { return std::abs(dot(surface_.normal(wall), normal)) > steepest; })
            .has_value();
      });
    });
  }

  const mesh::Surface& surface_;
  DetailLimits limits_;
  const Context& context_;
  std::vector<Component> components_;
};

/// Leaves out four kinds of components, short ones: those with less area than a square
/// of twice `narrow`; strips narrower than `narrow` (window bars, wires); small flat sheets that are
/// everywhere nearer than that to another component (panes, painted stones); bodies that stand out of
/// large ones, or into them, by less than that all over (window frames, buttons). Extents are those along a
/// component's principal axes. Where the first three have more than a tenth of the model's area together,
/// they are what the model is made of, and all stay. O(n log n).
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

/// Details that are hard to fold go, too, where they have this share of the faces of a model with too many.
constexpr double over_detailed_fraction = 0.2;
/// A body whose hold was left out moves by no more than this share of the extent to find another one.
constexpr double most_moved = 0.06;

/// Whether a model of so many millimetres a unit is too much work for its number of faces.
bool has_too_many_faces(const mesh::Surface& surface, double mm, const SimplifyOptions& simplify) {
  const Work work = expected_work(surface, simplify, mm);
  return surface.face_count() > simplify.most_faces || minutes_of(work) > 60.0 * own_budget(simplify).hours;
}

/// How many millimetres a unit of the model becomes, as far as is known before it has its size.
double judged_mm_per_unit(const mesh::Model& model, const SizeOptions& size) {
  const double largest = model.surface.bounds().largest_extent();
  return size.judged_at_mm  ? *size.judged_at_mm / largest
         : size.mm_per_unit ? *size.mm_per_unit * model.file_scale
                            : size.largest_extent_mm / largest;
}

}  // namespace

Details leave_out_details(mesh::Model& model, const SizeOptions& size, const SimplifyOptions& simplify,
                          const Context& context) {
  const double mm = judged_mm_per_unit(model, size);
  if (simplify.mode == Simplification::keep || !(mm > 0.0)) {
    return {};
  }
  const mesh::Surface before = model.surface;
  // A relief that is lower than the shortest fold can't be built: what would be its face lies on the wall.
  // Where there is too much to be built, whole bodies that would be hard go before others are bent.
  Details left_out = leave_out_details(model, DetailLimits{simplify.tiny_edge_mm / mm, 0.0}, context);
  if (simplify.mode == Simplification::automatic && has_too_many_faces(model.surface, mm, simplify)) {
    left_out +=
        leave_out_details(model, DetailLimits{simplify.short_edge_mm / mm, over_detailed_fraction}, context);
  }
  if (left_out.count() > 0) {
    left_out.loose =
        hold_again(model, before, {holding_mm / mm, most_moved * before.bounds().largest_extent()}, context);
  }
  return left_out;
}

CleanupReport clean_bodies(mesh::Model& model, const SizeOptions& size, const SimplifyOptions& simplify,
                           const Context& context) {
  CleanupReport report;
  const double mm = judged_mm_per_unit(model, size);
  if (simplify.mode == Simplification::keep || !(mm > 0.0)) {
    return report;
  }
  report.thin_walls = merge_thin_walls(model, simplify.skins, simplify.tiny_edge_mm / mm, context);
  report.thin_walls.thickness_mm *= mm;
  report.left_out = leave_out_details(model, size, simplify, context);
  return report;
}

}  // namespace ridgecraft::prepare
