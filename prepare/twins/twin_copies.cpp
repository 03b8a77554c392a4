// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/twins/twin_copies.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>

#include "mesh/repair/loose_faces.hpp"
#include "prepare/panels/remesh_panels.hpp"

namespace ridgecraft::prepare {
namespace {

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

}  // namespace

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

}  // namespace ridgecraft::prepare
