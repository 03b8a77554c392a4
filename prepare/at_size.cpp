// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/at_size.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "base/error.hpp"
#include "mesh/mesh.hpp"
#include "mesh/model/model.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/bodies/attached_bodies.hpp"
#include "prepare/bodies/loose_bodies.hpp"
#include "prepare/panels/divide_panels.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/prepared/effort.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/prepared/prepared.hpp"
#include "prepare/simplify/simplify.hpp"
#include "prepare/symmetry/twins.hpp"

namespace ridgecraft::prepare {
namespace {

/// A speck; nothing of it could be cut.
constexpr double smallest_size_mm = 0.1;

}  // namespace

Resized resize(mesh::Model& model, const SizeOptions& size) {
  const Box3& box = model.surface.bounds();
  const double largest = box.largest_extent();
  const double factor =
      size.mm_per_unit ? *size.mm_per_unit * model.file_scale : size.largest_extent_mm / largest;
  const double result = factor * largest;
  if (!std::isfinite(result) || result > largest_size_mm) {
    throw Error(ErrorKind::no_nets, Message("larger_than_100_m"));
  }
  if (!(result >= smallest_size_mm)) {
    throw Error(ErrorKind::no_nets, Message("smaller_than_100_um"));
  }
  const Vec3 centre = 0.5 * box.low + 0.5 * box.high;
  std::vector<Vec3> points(model.surface.points().begin(), model.surface.points().end());
  const auto move = [&](Vec3& p) { p = factor * (p - centre); };
  std::for_each(points.begin(), points.end(), move);
  std::for_each(model.file_points.begin(), model.file_points.end(), move);
  for (auto& line : model.lines) {
    std::for_each(line.begin(), line.end(), move);
  }
  std::vector<std::array<VertexId, 3>> faces;
  faces.reserve(model.surface.face_count());
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    faces.push_back(model.surface.vertices(f));
  }
  model.surface = mesh::Surface(std::move(points), std::move(faces));
  const double mm_per_unit = size.mm_per_unit ? *size.mm_per_unit : factor / model.file_scale;
  model.file_scale = 1.0;
  return {mm_per_unit, factor, centre};
}

namespace {

// Equal bodies become copies of one of them, corner by corner and triangle by triangle, so that what is done
// with one can be done with all.

/// Bodies that are equal but for a motion: the same corners and the same flat regions. Within these the
/// triangles may differ.
struct EqualBodies {
  std::vector<std::vector<FaceId>> bodies;  ///< faces of each component of the surface
  std::vector<std::vector<Twin>> kinds;     ///< indices into it; two or more of each kind
  double farthest = 0.0;  ///< greatest distance of a corner from where it would be, the surface's unit
};

/// Edges of a body where it isn't flat: between two panels, or with one face.
bool is_crease(const mesh::Surface& surface, const Panels& panels, EdgeId e) {
  const auto [c, d] = surface.sides(e);
  return !d.valid() || panels.panel[mesh::face_of(c)] != panels.panel[mesh::face_of(d)];
}

std::size_t count_creases(const mesh::Surface& surface, const Panels& panels,
                          const std::vector<FaceId>& body) {
  std::size_t ends = 0;
  for (const FaceId f : body) {
    for (unsigned k = 0; k < 3; ++k) {
      const EdgeId e = surface.edge(mesh::corner(f, k));
      if (is_crease(surface, panels, e)) {
        ends += surface.is_border(e) ? 2U : 1U;
      }
    }
  }
  return ends / 2;
}

/// Whether the two differ in nothing but how their flat regions are divided into triangles.
bool have_equal_panels(const mesh::Surface& surface, const Panels& panels, const std::vector<FaceId>& first,
                       const std::vector<FaceId>& other, const Twin& twin) {
  if (first.size() != other.size()) {
    return false;
  }
  std::size_t shared = 0;
  for (const auto& [e, image] : twin.edges) {
    const bool crease = is_crease(surface, panels, e);
    if (crease != is_crease(surface, panels, image) || surface.is_border(e) != surface.is_border(image)) {
      return false;
    }
    shared += crease ? 1U : 0U;
  }
  return shared == count_creases(surface, panels, first) && shared == count_creases(surface, panels, other);
}

/// Takes the place of one body.
class Copier {
 public:
  Copier(const mesh::Surface& surface, const mesh::LooseFaces& old, const std::vector<FaceId>& first,
         const std::vector<FaceId>& body, const Twin& twin)
      : surface_(surface), old_(old), first_(first), body_(body), twin_(twin) {}

  void write(mesh::LooseFaces& faces) const {
    const TwinFaces partner_of(surface_, twin_, body_);
    std::map<std::uint32_t, std::uint32_t> image;  // of points of the first body
    for (std::size_t i = 0; i < first_.size(); ++i) {
      std::array<std::uint32_t, 3> corners{};
      for (unsigned k = 0; k < 3; ++k) {
        const std::uint32_t v = old_.faces[first_[i].value()][k];
        const auto [at, fresh] = image.try_emplace(v, static_cast<std::uint32_t>(faces.points.size()));
        if (fresh) {
          faces.points.push_back(twin_.motion(old_.points[v]));
        }
        corners[twin_corner(FaceId(0), k, twin_.motion.mirrors).value()] = at->second;
      }
      const std::uint32_t to = body_[i].value();
      const FaceId from = partner_of(first_[i]);
      faces.faces[to] = corners;
      faces.polygon[to] = old_.polygon[from.value()];
      if (!old_.material.empty()) {
        faces.material[to] = old_.material[from.value()];
      }
      if (!old_.object.empty()) {
        faces.object[to] = old_.object[from.value()];
      }
    }
  }

 private:
  const mesh::Surface& surface_;
  const mesh::LooseFaces& old_;
  const std::vector<FaceId>& first_;
  const std::vector<FaceId>& body_;
  const Twin& twin_;
};

/// Components whose corners lie within `allowed` (the surface's unit) and twin_tolerance of where they would
/// as copies of the first of their kind. O(n log n).
EqualBodies find_equal_bodies(const mesh::Model& model, const Panels& panels, double allowed,
                              const Context& context) {
  EqualBodies equal;
  if (model.surface.component_count() < 2) {
    return equal;
  }
  equal.bodies = components(model.surface);
  for (std::vector<Twin>& kind : find_twins(model.surface, equal.bodies, context)) {
    const std::vector<FaceId>& first = equal.bodies[kind[0].body];
    std::erase_if(kind, [&](const Twin& twin) {
      return twin.deviation > allowed ||
             !have_equal_panels(model.surface, panels, first, equal.bodies[twin.body], twin);
    });
    if (kind.size() > 1) {
      for (const Twin& twin : kind) {
        equal.farthest = std::max(equal.farthest, twin.deviation);
      }
      equal.kinds.push_back(std::move(kind));
    }
  }
  return equal;
}

/// Gives each body but the first of its kind the points and triangles of that one, moved. Faces keep their
/// numbers as a set, and their polygons and materials by where they lie. Linear but for
/// faces that have no partner. What is whose copy then.
TwinBodies make_copies(mesh::Model& model, const EqualBodies& equal) {
  TwinBodies result;
  if (equal.kinds.empty()) {
    return result;
  }
  const mesh::LooseFaces old = mesh::take_apart(model);
  mesh::LooseFaces faces = old;
  for (const std::vector<Twin>& kind : equal.kinds) {
    const std::vector<FaceId>& first = equal.bodies[kind[0].body];
    std::vector<TwinBody>& bodies = result.emplace_back();
    for (const Twin& twin : kind) {
      const std::vector<FaceId>& body = equal.bodies[twin.body];
      bodies.push_back({twin.motion.mirrors, body});
      if (&twin != &kind.front()) {
        Copier(model.surface, old, first, body, twin).write(faces);
      }
    }
  }
  mesh::put_together(model, std::move(faces));
  return result;
}

/// Gives copies the flat regions of the first of their kind. Linear.
void copy_panels(const TwinBodies& twins, Panels& panels) {
  if (twins.empty()) {
    return;
  }
  std::vector<std::uint32_t> label;
  for (const PanelId p : panels.panel) {
    label.push_back(p.value());
  }
  auto next = static_cast<std::uint32_t>(panels.count());
  for (const std::vector<TwinBody>& kind : twins) {
    for (std::size_t b = 1; b < kind.size(); ++b) {
      std::map<std::uint32_t, std::uint32_t> image;
      for (std::size_t i = 0; i < kind[b].faces.size(); ++i) {
        const auto [at, fresh] = image.try_emplace(label[kind[0].faces[i].value()], next);
        next += fresh ? 1U : 0U;
        label[kind[b].faces[i].value()] = at->second;
      }
    }
  }
  panels = panels_by_label(label);
}

// From a model in the file's unit to one that can be made of paper.

/// Where all faces are kept, what makes equal bodies copies of each other moves no point by more than this
/// share of the model's largest extent: less than what verify/ allows, and more than files with six digits
/// are off.
constexpr double kept_fraction = 4e-5;

void add_to_way(Prepared& prepared, const Resized& resized) {
  prepared.from_model.factor *= resized.factor;
  prepared.from_model.shift = resized.factor * (prepared.from_model.shift - resized.centre);
}

/// Equal bodies become copies of one. The model stays of its size.
void copy_equal_bodies(Prepared& prepared, const SizeOptions& size, bool keeps_faces,
                       const Context& context) {
  mesh::Model& model = prepared.model;
  const double extent = model.surface.bounds().largest_extent();
  prepared.panels = find_panels(model.surface);
  const EqualBodies equal =
      find_equal_bodies(model, prepared.panels, keeps_faces ? kept_fraction * extent : extent, context);
  if (equal.kinds.empty()) {
    return;
  }
  prepared.twins = make_copies(model, equal);
  if (model.surface.bounds().largest_extent() != extent && !size.mm_per_unit) {
    const Resized resized = resize(model, size);
    prepared.mm_per_unit *= resized.mm_per_unit;
    add_to_way(prepared, resized);
  }
  prepared.panels = find_panels(model.surface);
  copy_panels(prepared.twins, prepared.panels);
}

/// Division of panels gives a body points that its twin may not have got, or at other places: bodies that are
/// no copies any more are none.
void renew_copies(Prepared& prepared, const Context& context) {
  const double extent = prepared.model.surface.bounds().largest_extent();
  prepared.twins = make_copies(
      prepared.model, find_equal_bodies(prepared.model, prepared.panels, kept_fraction * extent, context));
  copy_panels(prepared.twins, prepared.panels);
}

}  // namespace

Prepared prepare_at_size(mesh::Model model, const SizeOptions& size, const SimplifyOptions& simplify,
                         const PanelRoom& room, const Context& context) {
  context.report("preparing", 0.0);
  Prepared prepared;
  prepared.model = std::move(model);
  const Resized to_size = resize(prepared.model, size);
  prepared.mm_per_unit = to_size.mm_per_unit;
  add_to_way(prepared, to_size);
  const std::size_t faces_before = prepared.model.surface.face_count();
  const mesh::Surface before = prepared.model.surface;
  prepared.simplified = prepare::simplify(prepared.model, simplify, context);
  prepared.simplified.faces_before = faces_before;
  if (prepared.simplified.at_its_size) {
    prepared.loose = hold_again(prepared.model, before, {holding_mm, 0.0}, context);
    prepared.loose += leave_out_crumbs(prepared.model, holding_mm, context);
    prepared.simplified.faces_after = prepared.model.surface.face_count();
  }
  if ((prepared.simplified.at_its_size || prepared.simplified.deviation_mm > 0.0) && !size.mm_per_unit) {
    // Collapses and rolled walls move the outermost points, too; the size that was asked for is the finished
    // model's.
    const Resized resized = resize(prepared.model, size);
    const double factor = resized.mm_per_unit;
    add_to_way(prepared, resized);
    prepared.mm_per_unit *= factor;
    prepared.simplified.deviation_mm *= factor;
    prepared.simplified.asymmetry_mm *= factor;
  }
  if (simplify.part_attached) {
    prepared.attached = part_attached_bodies(prepared.model, context);
  }
  copy_equal_bodies(prepared, size, simplify.mode == Simplification::keep, context);
  prepared.divided_panels = divide_panels(prepared.model, prepared.panels, room, context);
  if (prepared.divided_panels > 0 && !prepared.twins.empty()) {
    renew_copies(prepared, context);
  }
  const mesh::Surface& surface = prepared.model.surface;
  if (count_narrow_faces(surface, prepared.panels, nothing_mm) == surface.face_count()) {
    throw Error(ErrorKind::no_nets, Message("all_too_narrow"));
  }
  prepared.sliver_fraction = static_cast<double>(count_narrow_faces(surface, prepared.panels, sliver_mm)) /
                             static_cast<double>(surface.face_count());
  prepared.model.repairs.add(mesh::RepairKind::narrow_faces,
                             count_narrow_faces(surface, prepared.panels, narrow_mm));
  prepared.rolls = find_rolls(surface, prepared.panels, simplify.rolls);
  prepared.work = expected_work(surface, prepared.panels, prepared.rolls, simplify.hidden_fold_angle);
  return prepared;
}

}  // namespace ridgecraft::prepare
