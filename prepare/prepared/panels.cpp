// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/prepared/panels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "base/disjoint_sets.hpp"
#include "base/elementary.hpp"
#include "base/order.hpp"

namespace ridgecraft::prepare {
namespace {

class Grower {
 public:
  Grower(const mesh::Surface& surface, const PanelTolerance& tolerance)
      : surface_(surface),
        cosine_(elementary::cos(tolerance.angle)),
        distance_(tolerance.distance * surface.bounds().diagonal()) {
    panels_.panel = IdVector<FaceId, PanelId>(surface.face_count());
  }

  Panels run() {
    // Areas that differ by rounding alone count as equal, so that turning the model doesn't change the seeds.
    std::vector<float> area(surface_.face_count());
    for (const FaceId f : ids<FaceId>(area.size())) {
      area[f.value()] = static_cast<float>(surface_.area(f));
    }
    const std::vector<std::uint32_t> order = descending_order(area);
    for (const std::uint32_t face : order) {
      const FaceId seed(face);
      if (!panels_.panel[seed].valid() && surface_.normal(seed) != Vec3{}) {
        grow(seed);
      }
    }
    adopt_flat_faces();
    renumber();
    return std::move(panels_);
  }

 private:
  [[nodiscard]] bool fits(FaceId f, Vec3 origin, Vec3 normal) const {
    const Vec3 own = surface_.normal(f);
    if (own == Vec3{} || dot(own, normal) < cosine_) {
      return false;
    }
    for (const VertexId v : surface_.vertices(f)) {
      if (std::abs(dot(surface_.point(v) - origin, normal)) > distance_) {
        return false;
      }
    }
    return true;
  }

  void grow(FaceId seed) {
    const PanelId id(count_++);
    const Vec3 origin = surface_.point(surface_.vertices(seed)[0]);
    const Vec3 normal = surface_.normal(seed);
    panels_.panel[seed] = id;
    stack_.assign(1, seed);
    while (!stack_.empty()) {
      const FaceId f = stack_.back();
      stack_.pop_back();
      for (unsigned k = 0; k < 3; ++k) {
        const FaceId g = surface_.neighbor(mesh::corner(f, k));
        if (g.valid() && !panels_.panel[g].valid() && fits(g, origin, normal)) {
          panels_.panel[g] = id;
          stack_.push_back(g);
        }
      }
    }
  }

  /// A face without area has no plane: it joins the neighbour across its longest side that has a panel, or
  /// has one of its own with those beside it where no neighbour has any.
  void adopt_flat_faces() {
    std::vector<FaceId> flat;
    for (const FaceId f : ids<FaceId>(surface_.face_count())) {
      if (!panels_.panel[f].valid()) {
        flat.push_back(f);
      }
    }
    // From those with a neighbour that has a panel outwards, breadth first.
    std::vector<FaceId> queue = flat;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      adopt(queue[i], queue);
    }
    for (const FaceId f : flat) {
      if (!panels_.panel[f].valid()) {
        panels_.panel[f] = PanelId(count_++);
        std::vector<FaceId> rest{f};
        for (std::size_t i = 0; i < rest.size(); ++i) {
          adopt(rest[i], rest);
        }
      }
    }
  }

  void adopt(FaceId f, std::vector<FaceId>& queue) {
    if (!panels_.panel[f].valid()) {
      double longest = -1.0;
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId c = mesh::corner(f, k);
        const FaceId g = surface_.neighbor(c);
        const double side = surface_.length(surface_.edge(c));
        if (g.valid() && panels_.panel[g].valid() && side > longest) {
          longest = side;
          panels_.panel[f] = panels_.panel[g];
        }
      }
    }
    if (panels_.panel[f].valid()) {
      for (unsigned k = 0; k < 3; ++k) {
        const FaceId g = surface_.neighbor(mesh::corner(f, k));
        if (g.valid() && !panels_.panel[g].valid() && surface_.normal(g) == Vec3{}) {
          queue.push_back(g);
        }
      }
    }
  }

  /// In the order of their smallest faces, so that the numbers follow the file and not the areas.
  void renumber() {
    std::vector<PanelId> number(count_);
    panels_.faces.reserve(count_);
    for (const FaceId f : ids<FaceId>(surface_.face_count())) {
      PanelId& id = number[panels_.panel[f].value()];
      if (!id.valid()) {
        id = panels_.faces.push_back({});
      }
      panels_.panel[f] = id;
      panels_.faces[id].push_back(f);
    }
  }

  const mesh::Surface& surface_;
  double cosine_;
  double distance_;
  std::size_t count_ = 0;
  std::vector<FaceId> stack_;
  Panels panels_;
};

}  // namespace

Panels find_panels(const mesh::Surface& surface, const PanelTolerance& tolerance) {
  return Grower(surface, tolerance).run();
}

Panels panels_of(const Panels& whole, const IdVector<FaceId, FaceId>& face) {
  Panels panels;
  panels.panel = IdVector<FaceId, PanelId>(face.size());
  std::map<PanelId, PanelId> number;
  for (const FaceId f : ids<FaceId>(face.size())) {
    const auto [at, fresh] = number.try_emplace(whole.panel[face[f]], PanelId(panels.faces.size()));
    if (fresh) {
      panels.faces.push_back({});
    }
    panels.panel[f] = at->second;
    panels.faces[at->second].push_back(f);
  }
  return panels;
}

namespace {

double side_length(const mesh::Surface& surface, FaceId f, unsigned k) {
  return surface.length(surface.edge(mesh::corner(f, k)));
}

}  // namespace

bool is_narrow(const mesh::Surface& surface, const Panels& panels, PanelId panel, double width) {
  double area = 0.0;
  double longest = 0.0;
  double highest = 0.0;
  for (const FaceId f : panels.faces[panel]) {
    double side = 0.0;
    for (unsigned k = 0; k < 3; ++k) {
      side = std::max(side, side_length(surface, f, k));
    }
    highest = std::max(highest, side > 0.0 ? 2.0 * surface.area(f) / side : 0.0);
    longest = std::max(longest, side);
    area += surface.area(f);
  }
  // Faces side by side may be narrow each and wide together.
  return highest < width && area < width * longest;
}

bool is_sliver(const mesh::Surface& surface, const Panels& panels, PanelId panel) {
  return is_narrow(surface, panels, panel, sliver_mm) && !is_narrow(surface, panels, panel, narrow_mm);
}

std::size_t count_slivers(const mesh::Surface& surface, const Panels& panels) {
  return count_narrow_faces(surface, panels, sliver_mm) - count_narrow_faces(surface, panels, narrow_mm);
}

std::size_t count_narrow_faces(const mesh::Surface& surface, const Panels& panels, double width) {
  std::size_t narrow = 0;
  for (const PanelId p : ids<PanelId>(panels.count())) {
    narrow += is_narrow(surface, panels, p, width) ? panels.faces[p].size() : 0;
  }
  return narrow;
}

Panels divided_by(const Panels& panels, const mesh::Surface& surface,
                  const IdVector<FaceId, std::uint32_t>& label) {
  DisjointSets sets(surface.face_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    for (unsigned k = 0; k < 3; ++k) {
      const FaceId g = surface.neighbor(mesh::corner(f, k));
      if (g.valid() && panels.panel[g] == panels.panel[f] && label[g] == label[f]) {
        sets.join(f.value(), g.value());
      }
    }
  }
  Panels result;
  result.panel = IdVector<FaceId, PanelId>(surface.face_count());
  std::map<std::uint32_t, PanelId> number;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [at, fresh] = number.try_emplace(sets.find(f.value()));
    if (fresh) {
      at->second = result.faces.push_back({});
    }
    result.panel[f] = at->second;
    result.faces[at->second].push_back(f);
  }
  return result;
}

}  // namespace ridgecraft::prepare
