// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/skin/skin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/boxes.hpp"
#include "base/disjoint_sets.hpp"
#include "base/no_index.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/skin/closing.hpp"
#include "prepare/skin/meeting.hpp"
#include "prepare/skin/sight.hpp"

namespace ridgecraft::prepare {
namespace {

using mesh::Soup;
using mesh::Surface;

/// How far the points of an opening may be from its plane, share of the model's diagonal.
constexpr double flat_rim = 1e-3;

struct Component {
  std::vector<FaceId> faces;
  Box3 box;
  bool closed = true;
};

std::vector<Component> components_of(const Surface& surface) {
  std::vector<Component> components(surface.component_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    Component& c = components[surface.component(f).value()];
    c.faces.push_back(f);
    for (unsigned k = 0; k < 3; ++k) {
      c.box.add(surface.point(surface.vertex(mesh::corner(f, k))));
      c.closed = c.closed && surface.twin(mesh::corner(f, k)).valid();
    }
  }
  return components;
}

/// The side on which a model stands: where the most openings lie at the bottom of its box. Files that don't
/// tell where up is have it in y or in z.
struct Ground {
  int axis = 1;
  double height = 0.0;
  double near = 0.0;

  [[nodiscard]] bool holds(const Surface& surface, const Cap& cap) const {
    return std::all_of(cap.triangles.begin(), cap.triangles.end(), [&](const auto& t) {
      return std::all_of(t.begin(), t.end(), [&](VertexId v) {
        return std::abs(along(surface.point(v), axis) - height) <= near;
      });
    });
  }
  static double along(Vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }
};

Ground ground_of(const mesh::Model& model, const std::vector<std::vector<Cap>>& caps) {
  const Box3& box = model.surface.bounds();
  const auto at_bottom = [&](int axis) {
    return Ground{axis, Ground::along(box.low, axis), flat_rim * box.diagonal()};
  };
  if (model.frame.up) {
    return at_bottom(static_cast<int>(*model.frame.up));
  }
  const auto openings = [&](const Ground& ground) {
    std::size_t count = 0;
    for (const std::vector<Cap>& of_component : caps) {
      count += static_cast<std::size_t>(
          std::count_if(of_component.begin(), of_component.end(),
                        [&](const Cap& cap) { return ground.holds(model.surface, cap); }));
    }
    return count;
  };
  const Ground y = at_bottom(1);
  const Ground z = at_bottom(2);
  return openings(z) > openings(y) ? z : y;
}

/// Sets of components whose boxes touch, more than one each.
std::vector<std::vector<std::uint32_t>> neighbourhoods(const std::vector<Component>& components,
                                                       double near) {
  std::vector<Box3> boxes;
  for (const Component& c : components) {
    const Vec3 margin{near, near, near};
    boxes.push_back({c.box.low - margin, c.box.high + margin});
  }
  DisjointSets sets(components.size());
  NearBoxes(boxes).for_pairs([&](std::uint32_t i, std::uint32_t j) { sets.join(i, j); });
  std::map<std::uint32_t, std::vector<std::uint32_t>> members;
  for (std::uint32_t i = 0; i < components.size(); ++i) {
    members[sets.find(i)].push_back(i);
  }
  std::vector<std::vector<std::uint32_t>> result;
  for (auto& [root, of_root] : members) {
    result.push_back(std::move(of_root));
  }
  return result;
}

double volume_of(const Surface& surface, const Component& component, const std::vector<Cap>& caps) {
  const Vec3 origin = component.box.low;
  double volume = 0.0;
  const auto add = [&](const std::array<VertexId, 3>& t) {
    volume +=
        dot(surface.point(t[0]) - origin, cross(surface.point(t[1]) - origin, surface.point(t[2]) - origin)) /
        6.0;
  };
  for (const FaceId f : component.faces) {
    add(surface.vertices(f));
  }
  for (const Cap& cap : caps) {
    for (const auto& t : cap.triangles) {
      add(t);
    }
  }
  return volume;
}

class Skin {
 public:
  Skin(mesh::Model& model, const Context& context) : model_(model), context_(context) {}

  SkinReport run() {
    const bool crosses = model_.repairs.count(mesh::RepairKind::self_intersections) > 0;
    if (model_.surface.component_count() < 2 && !crosses) {
      return {};
    }
    find_components();
    const Surface apart = model_.surface;
    if (close()) {
      find_components();
    }
    const Surface& surface = model_.surface;
    const double diagonal = surface.bounds().diagonal();
    ground_ = ground_of(model_, caps_);
    loose_ = mesh::take_apart(model_);
    gone_.assign(surface.face_count(), false);
    for (const std::vector<std::uint32_t>& members : neighbourhoods(components_, snapped * diagonal)) {
      const bool any_solid =
          std::any_of(members.begin(), members.end(), [&](std::uint32_t c) { return is_solid(c); });
      if (any_solid && (members.size() > 1 || crosses)) {
        unite(members);
      }
    }
    if (report_.united > 0) {
      finish();
    } else {
      model_.surface = apart;
      report_.gaps_closed = 0;
    }
    return report_;
  }

 private:
  void find_components() {
    const Surface& surface = model_.surface;
    components_ = components_of(surface);
    caps_.assign(components_.size(), {});
    for (std::size_t i = 0; i < components_.size(); ++i) {
      context_.check();
      if (!components_[i].closed) {
        caps_[i] = find_caps(surface, components_[i].faces, flat_rim * surface.bounds().diagonal());
      }
    }
  }

  /// Bodies that end just before others are moved so that they touch; whether there are any.
  bool close() {
    const Surface& surface = model_.surface;
    std::vector<bool> solid;
    for (std::uint32_t c = 0; c < components_.size(); ++c) {
      solid.push_back(is_solid(c));
    }
    const double diagonal = surface.bounds().diagonal();
    ClosedGaps closed = close_gaps(surface, solid, 2.0 * snapped * diagonal, touching * diagonal, context_);
    report_.gaps_closed = closed.moved;
    if (closed.moved == 0) {
      return false;
    }
    std::vector<std::array<VertexId, 3>> faces;
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      faces.push_back(surface.vertices(f));
    }
    model_.surface = Surface(std::move(closed.points), std::move(faces));
    return true;
  }

  [[nodiscard]] bool is_solid(std::uint32_t c) const { return components_[c].closed || !caps_[c].empty(); }

  void unite(const std::vector<std::uint32_t>& members) {
    // Each round but the last finds that something with openings is no solid; soon all guesses go.
    constexpr std::size_t rounds_with_guesses = 3;
    for (std::size_t round = 0;; ++round) {
      const CappedBodies bodies = bodies_of(members);
      const std::optional<UnitedSkin> skin = meet(bodies, model_.surface.bounds().diagonal(), context_);
      if (!skin) {
        report_.left_crossing += members.size();
        return;
      }
      if (skin->not_solid.empty()) {
        if (skin->any_change()) {
          take(members, bodies, *skin);
        }
        return;
      }
      for (const std::uint32_t b : skin->not_solid) {
        caps_[members[b]].clear();
      }
      for (const std::uint32_t c : members) {
        if (round + 1 >= rounds_with_guesses &&
            std::any_of(caps_[c].begin(), caps_[c].end(), [](const Cap& cap) { return cap.bent; })) {
          caps_[c].clear();
        }
      }
    }
  }

  [[nodiscard]] CappedBodies bodies_of(const std::vector<std::uint32_t>& members) const {
    const Surface& surface = model_.surface;
    CappedBodies bodies;
    std::map<VertexId, std::uint32_t> number;
    const auto vertex = [&](VertexId v) {
      const auto [at, fresh] = number.try_emplace(v, static_cast<std::uint32_t>(bodies.soup.points.size()));
      if (fresh) {
        bodies.soup.points.push_back(surface.point(v));
      }
      return at->second;
    };
    for (std::uint32_t b = 0; b < members.size(); ++b) {
      const Component& component = components_[members[b]];
      const std::vector<Cap>& caps = caps_[members[b]];
      const bool solid = is_solid(members[b]);
      bodies.soup.solid.push_back(solid ? 1 : 0);
      // Cavities stay inside out; a body with openings may be so by the file's mistake.
      const bool inside_out = !caps.empty() && volume_of(surface, component, caps) < 0.0;
      const auto add = [&](const std::array<VertexId, 3>& t, FaceId f, std::uint32_t cap) {
        std::array<std::uint32_t, 3> corners{vertex(t[0]), vertex(t[1]), vertex(t[2])};
        if (inside_out) {
          std::swap(corners[1], corners[2]);
        }
        bodies.soup.triangles.push_back(corners);
        bodies.soup.body.push_back(b);
        bodies.face.push_back(f);
        bodies.cap.push_back(cap);
      };
      for (const FaceId f : component.faces) {
        add(surface.vertices(f), f, no_index);
      }
      for (const Cap& cap : caps) {
        for (const auto& t : cap.triangles) {
          add(t, FaceId(), static_cast<std::uint32_t>(bodies.on_ground.size()));
        }
        bodies.on_ground.push_back(ground_.holds(surface, cap) ? 1 : 0);
        bodies.bent.push_back(cap.bent ? 1 : 0);
      }
    }
    return bodies;
  }

  /// The faces of bodies that changed are replaced.
  void take(const std::vector<std::uint32_t>& members, const CappedBodies& bodies, const UnitedSkin& skin) {
    for (std::uint32_t b = 0; b < members.size(); ++b) {
      if (skin.changed[b] == 0 && skin.around[b] == 0) {
        continue;
      }
      ++report_.united;
      unchanged_ += skin.changed[b] == 0 ? 1U : 0U;
      for (const FaceId f : components_[members[b]].faces) {
        area_before_ += model_.surface.area(f);
        area_after_ += skin.changed[b] == 0 ? model_.surface.area(f) : 0.0;
        gone_[f.value()] = skin.changed[b] != 0;
      }
    }
    report_.faces_hidden += skin.faces_hidden;
    report_.rims_closed += skin.rims_closed;
    const auto first = static_cast<std::uint32_t>(fresh_.points.size());
    fresh_.points.insert(fresh_.points.end(), skin.points.begin(), skin.points.end());
    for (const SkinFacet& facet : skin.facets) {
      const FaceId f = facet.triangle == no_index ? FaceId() : bodies.face[facet.triangle];
      const auto& c = facet.corners;
      fresh_.faces.push_back({first + c[0], first + c[1], first + c[2]});
      fresh_cap_.push_back(!f.valid());
      fresh_.polygon.push_back(f.valid() ? loose_.polygon[f.value()] : Soup::none);
      if (!loose_.material.empty()) {
        fresh_.material.push_back(f.valid() ? loose_.material[f.value()] : Soup::none);
      }
      if (!loose_.object.empty()) {
        fresh_.object.push_back(f.valid() ? loose_.object[f.value()] : Soup::none);
      }
    }
  }

  /// What stayed as it was comes first, in its order; then the new skins.
  void finish() {
    mesh::make_surface(fresh_, context_);
    mesh::LooseFaces all;
    all.points = std::move(loose_.points);
    for (std::size_t i = 0; i < loose_.faces.size(); ++i) {
      if (!gone_[i]) {
        all.add(loose_, i, loose_.faces[i]);
      }
    }
    const std::size_t stayed = all.faces.size();
    const auto first = static_cast<std::uint32_t>(all.points.size());
    all.points.insert(all.points.end(), fresh_.points.begin(), fresh_.points.end());
    for (std::size_t i = 0; i < fresh_.faces.size(); ++i) {
      const auto& [a, b, c] = fresh_.faces[i];
      all.add(fresh_, i, {first + a, first + b, first + c});
    }
    mesh::put_together(model_, std::move(all));
    std::set<ComponentId> made;
    for (std::size_t f = stayed; f < model_.surface.face_count(); ++f) {
      made.insert(model_.surface.component(FaceId(f)));
    }
    for (std::size_t f = stayed; f < model_.surface.face_count(); ++f) {
      area_after_ += fresh_cap_[f - stayed] ? 0.0 : model_.surface.area(FaceId(f));
    }
    name_caps(stayed);
    report_.united_into = made.size() + unchanged_;
    report_.hidden_fraction = std::max(0.0, 1.0 - area_after_ / area_before_);
  }

  /// What closes an opening is of no face of the file: it is called as the faces that it has most of its
  /// outline in common with. `first`: of the new faces.
  void name_caps(std::size_t first) {
    const Surface& surface = model_.surface;
    std::vector<bool> nameless(surface.face_count(), false);
    std::copy(fresh_cap_.begin(), fresh_cap_.end(), nameless.begin() + static_cast<std::ptrdiff_t>(first));
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      if (nameless[f.value()]) {
        name_cap(f, nameless);
      }
    }
  }

  /// The faces of caps that hang together with one.
  void name_cap(FaceId start, std::vector<bool>& nameless) {
    const Surface& surface = model_.surface;
    struct Beside {
      double length = 0.0;
      FaceId face;
    };
    std::map<std::array<std::uint32_t, 2>, Beside> beside;  // by object and material
    std::vector<FaceId> cap{start};
    nameless[start.value()] = false;
    std::set<FaceId> of_cap{start};
    for (std::size_t i = 0; i < cap.size(); ++i) {
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId corner = mesh::corner(cap[i], k);
        const CornerId twin = surface.twin(corner);
        const FaceId other = twin.valid() ? mesh::face_of(twin) : FaceId();
        if (!other.valid() || of_cap.contains(other)) {
          continue;
        }
        if (nameless[other.value()]) {
          nameless[other.value()] = false;
          of_cap.insert(other);
          cap.push_back(other);
          continue;
        }
        Beside& found = beside[{model_.object.empty() ? 0 : model_.object[other],
                                model_.material.empty() ? 0 : model_.material[other]}];
        found.length +=
            length(surface.point(surface.vertex(mesh::next(corner))) - surface.point(surface.vertex(corner)));
        found.face = other;
      }
    }
    const auto most = std::max_element(beside.begin(), beside.end(), [](const auto& a, const auto& b) {
      return a.second.length < b.second.length;
    });
    for (const FaceId f : cap) {
      if (most != beside.end() && !model_.object.empty()) {
        model_.object[f] = model_.object[most->second.face];
      }
      if (most != beside.end() && !model_.material.empty()) {
        model_.material[f] = model_.material[most->second.face];
      }
    }
  }

  mesh::Model& model_;
  const Context& context_;
  std::vector<Component> components_;
  std::vector<std::vector<Cap>> caps_;
  Ground ground_;
  mesh::LooseFaces loose_;
  mesh::LooseFaces fresh_;       ///< of the new skins
  std::vector<bool> fresh_cap_;  ///< of each of them: it closes an opening
  std::vector<bool> gone_;       ///< faces that these replace
  std::size_t unchanged_ = 0;    ///< components that others are hidden in
  double area_before_ = 0.0;     ///< of components that took part
  double area_after_ = 0.0;
  SkinReport report_;
};

}  // namespace

SkinReport unite_bodies(mesh::Model& model, const Context& context) {
  SkinReport report = Skin(model, context).run();
  report.unseen = leave_out_unseen(model, context);
  return report;
}

}  // namespace ridgecraft::prepare
