// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/kept_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/pieces/bands.hpp"
#include "unfold/pieces/symmetry.hpp"

namespace ridgecraft::unfold {
namespace {

class Keeper {
 public:
  Keeper(const mesh::Surface& surface, const prepare::Panels& panels, const EdgeConstraints& constraints,
         const Room& room, const Context& context)
      : surface_(surface),
        panels_(panels),
        asked_(constraints),
        room_{room.sheet, room.strip, 0},
        tolerance_(net_tolerance(surface.bounds().largest_extent())),
        context_(context) {
    result_.constraints = constraints;
    for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
      const auto [c, d] = surface.sides(e);
      if (!d.valid() || panel(c) == panel(d)) {
        result_.constraints[e] = EdgeConstraint::none;
      } else if (constraints[e] == EdgeConstraint::keep || constraints[e] == EdgeConstraint::band) {
        wanted_.push_back(e);
        result_.constraints[e] = EdgeConstraint::none;
      }
    }
    std::stable_sort(wanted_.begin(), wanted_.end(),
                     [&](EdgeId a, EdgeId b) { return surface.length(a) > surface.length(b); });
  }

  KeptEdges run() {
    DisjointSets sets(panels_.count());
    std::vector<EdgeId> tree;
    for (const EdgeId e : wanted_) {
      const auto [c, d] = surface_.sides(e);
      if (sets.join(panel(c), panel(d))) {  // others would close a loop
        tree.push_back(e);
      }
    }
    for (const auto& [edges, faces] : groups_of(tree, sets)) {
      grant(edges);
      if (!lies_well(faces)) {
        refuse(edges);
        keep_singly(edges);
      }
    }
    result_.groups = groups();
    return std::move(result_);
  }

 private:
  struct Group {
    std::vector<EdgeId> edges;
    std::vector<FaceId> faces;  ///< ascending
  };

  [[nodiscard]] std::uint32_t panel(CornerId c) const { return panels_.panel[mesh::face_of(c)].value(); }

  /// The sets that edges join, with their faces.
  [[nodiscard]] std::vector<Group> groups_of(const std::vector<EdgeId>& edges, DisjointSets& sets) const {
    std::vector<Group> all(panels_.count());
    for (const EdgeId e : edges) {
      all[sets.find(panel(surface_.sides(e)[0]))].edges.push_back(e);
    }
    for (const PanelId p : ids<PanelId>(panels_.count())) {
      Group& group = all[sets.find(p.value())];
      if (!group.edges.empty()) {
        group.faces.insert(group.faces.end(), panels_.faces[p].begin(), panels_.faces[p].end());
      }
    }
    std::erase_if(all, [](const Group& g) { return g.edges.empty(); });
    for (Group& group : all) {
      std::sort(group.faces.begin(), group.faces.end());
    }
    return all;
  }

  void grant(const std::vector<EdgeId>& edges) {
    for (const EdgeId e : edges) {
      result_.constraints[e] = asked_[e];
    }
  }
  void refuse(const std::vector<EdgeId>& edges) {
    for (const EdgeId e : edges) {
      result_.constraints[e] = EdgeConstraint::none;
    }
  }

  /// One edge after the other, as long as what hangs together lies well.
  void keep_singly(const std::vector<EdgeId>& edges) {
    std::vector<std::vector<FaceId>> faces(panels_.faces.items());
    DisjointSets sets(panels_.count());
    for (const EdgeId e : edges) {
      context_.check();
      if (context_.out_of_time()) {
        return;
      }
      const auto [c, d] = surface_.sides(e);
      const std::uint32_t a = sets.find(panel(c));
      const std::uint32_t b = sets.find(panel(d));
      std::vector<FaceId> both;
      std::merge(faces[a].begin(), faces[a].end(), faces[b].begin(), faces[b].end(),
                 std::back_inserter(both));
      result_.constraints[e] = asked_[e];
      if (!lies_well(both)) {
        result_.constraints[e] = EdgeConstraint::none;
        continue;
      }
      sets.join(a, b);
      faces[sets.find(a)] = std::move(both);
    }
  }

  /// Whether what frozen sides hold together is one net without overlap that fits the room.
  [[nodiscard]] bool lies_well(const std::vector<FaceId>& faces) const {
    constexpr std::size_t several = 2;  // the strip for tabs is kept free
    return lies_as_one(make_patch(surface_, panels_, faces, result_.constraints.items()), several, room_,
                       tolerance_);
  }

  [[nodiscard]] prepare::Panels groups() const {
    DisjointSets sets(panels_.count());
    for (const EdgeId e : wanted_) {
      if (result_.constraints[e] != EdgeConstraint::none) {
        sets.join(panel(surface_.sides(e)[0]), panel(surface_.sides(e)[1]));
      }
    }
    prepare::Panels merged;
    merged.panel = IdVector<FaceId, PanelId>(surface_.face_count());
    std::vector<PanelId> number(panels_.count());
    for (const FaceId f : ids<FaceId>(surface_.face_count())) {
      PanelId& id = number[sets.find(panels_.panel[f].value())];
      if (!id.valid()) {
        id = merged.faces.push_back({});
      }
      merged.panel[f] = id;
      merged.faces[id].push_back(f);
    }
    return merged;
  }

  const mesh::Surface& surface_;
  const prepare::Panels& panels_;
  const EdgeConstraints& asked_;
  const Room room_;
  const double tolerance_;
  const Context& context_;
  std::vector<EdgeId> wanted_;
  KeptEdges result_;
};

}  // namespace

KeptEdges settle_constraints(const mesh::Surface& surface, const prepare::Panels& panels,
                             const EdgeConstraints& constraints, const Room& room, const Context& context) {
  return Keeper(surface, panels, constraints, room, context).run();
}

namespace {

/// A wall that stays a strip: its rungs, which may be several edges each.
struct Wall {
  std::vector<EdgeId> rungs;
  bool closed = false;
};

PanelId panel_of(const prepare::Panels& panels, CornerId side) {
  return panels.panel[mesh::face_of(side)];
}

/// The bands that are rolled, in the order of their numbers.
std::vector<Wall> rolled_walls(const UnfoldProblem& problem) {
  std::map<RollId, Wall> walls;
  for (const EdgeId e : ids<EdgeId>(problem.options.rolls.size())) {
    if (problem.options.rolls[e].valid()) {
      walls[problem.options.rolls[e]].rungs.push_back(e);
    }
  }
  std::vector<Wall> result;
  for (auto& [roll, wall] : walls) {
    std::set<PanelId> regions;
    for (const EdgeId e : wall.rungs) {
      for (const CornerId side : problem.surface.sides(e)) {
        regions.insert(panel_of(problem.panels, side));
      }
    }
    wall.closed = regions.size() == wall.rungs.size();
    result.push_back(std::move(wall));
  }
  return result;
}

/// The mean rung of a band that stays a strip, of what its regions have of a rim.
constexpr double least_rung_to_rim = 1.1;

/// The wide ones of those that go round.
std::vector<Wall> wide_walls(const mesh::Surface& surface, const Patch& patch) {
  std::vector<Wall> walls;
  for (const Band& band : find_bands(patch)) {
    if (band.mean_rung_mm >= least_rung_to_rim * band.mean_rim_mm) {
      Wall& wall = walls.emplace_back();
      wall.closed = band.closed;
      for (const std::uint32_t side : band.rungs) {
        wall.rungs.push_back(edge_of(surface, patch, side));
      }
    }
  }
  return walls;
}

class Seams {
 public:
  Seams(const mesh::Surface& surface, const Symmetry& symmetry)
      : surface_(surface), symmetry_(symmetry), chosen_(surface.edge_count(), 0) {}

  /// The rung at which a band is cut: the image of the one at which its mirror image is, else the nearest to
  /// the plane. (Of rungs equally near, the farthest along two odd directions: which it is depends on nothing
  /// but the place.)
  EdgeId of(const std::vector<EdgeId>& rungs) {
    auto seam = std::find_if(rungs.begin(), rungs.end(), [&](EdgeId e) {
      const EdgeId image = image_of(e);
      return image.valid() && chosen_[image] != 0;
    });
    if (seam == rungs.end()) {
      seam = std::min_element(rungs.begin(), rungs.end(),
                              [&](EdgeId a, EdgeId b) { return place(a) < place(b); });
    }
    chosen_[*seam] = 1;
    return *seam;
  }

 private:
  [[nodiscard]] EdgeId image_of(EdgeId e) const {
    return symmetry_.plane ? symmetry_.images.front().edge[e] : EdgeId();
  }

  /// Smaller is better.
  [[nodiscard]] std::tuple<double, double, EdgeId> place(EdgeId e) const {
    const CornerId c = surface_.sides(e)[0];
    const Vec3 middle =
        0.5 * (surface_.point(surface_.vertex(c)) + surface_.point(surface_.vertex(mesh::next(c))));
    // Equal but for rounding is equal.
    const double unit = 1e-6 * surface_.bounds().largest_extent();
    const double off = symmetry_.plane ? std::abs(symmetry_.plane->height(middle)) : 0.0;
    return {std::round(off / unit), std::round(-(middle.y + 0.01 * middle.x) / unit), e};
  }

  const mesh::Surface& surface_;
  const Symmetry& symmetry_;
  IdVector<EdgeId, std::uint8_t> chosen_;
};

}  // namespace

EdgeConstraints with_bands_kept(const UnfoldProblem& problem, const Symmetry& symmetry) {
  const mesh::Surface& surface = problem.surface;
  const prepare::Panels& panels = problem.panels;
  const EdgeConstraints& constraints = problem.options.constraints;
  std::vector<Wall> walls = rolled_walls(problem);
  const std::size_t rolls = walls.size();
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faces.push_back(f);
  }
  const Patch patch = make_patch(surface, panels, faces, constraints.items(), problem.options.labels.items());
  if (problem.options.pieces.mode != PieceMode::few) {
    for (Wall& wall : wide_walls(surface, patch)) {
      walls.push_back(std::move(wall));
    }
  }
  // The edges of a rung lie between the same two flat regions.
  const auto beside = [&](EdgeId e) -> std::pair<PanelId, PanelId> {
    const auto [c, d] = surface.sides(e);
    return std::minmax({panel_of(panels, c), panel_of(panels, d)});
  };
  Seams seams(surface, symmetry);
  EdgeConstraints result =
      constraints.empty() ? EdgeConstraints(surface.edge_count(), EdgeConstraint::none) : constraints;
  // What crosses a rolled band would fold it.
  IdVector<PanelId, std::uint8_t> rolled(panels.count(), 0);
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const Wall& wall = walls[i];
    const bool is_rolled = i < rolls;
    // Paper of two colours is rolled as well as any; a fold between them may better be a seam.
    const bool free = std::none_of(wall.rungs.begin(), wall.rungs.end(), [&](EdgeId e) {
      const auto [one, other] = beside(e);
      return result[e] != EdgeConstraint::none || rolled[one] != 0 || rolled[other] != 0 ||
             (!is_rolled && is_border_of_labels(patch, surface.sides(e)[0].value()));
    });
    if (!free) {
      continue;
    }
    for (const EdgeId e : wall.rungs) {
      const auto [one, other] = beside(e);
      rolled[one] = rolled[other] = is_rolled ? 1 : 0;
      result[e] = EdgeConstraint::band;
    }
    if (wall.closed) {
      const std::pair<PanelId, PanelId> seam = beside(seams.of(wall.rungs));
      for (const EdgeId e : wall.rungs) {
        result[e] = beside(e) == seam ? EdgeConstraint::none : EdgeConstraint::band;
      }
    }
  }
  return result;
}

}  // namespace ridgecraft::unfold
