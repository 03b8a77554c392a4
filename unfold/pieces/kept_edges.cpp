// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/kept_edges.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {
namespace {

class Keeper {
 public:
  Keeper(const mesh::Surface& surface, const prepare::Panels& panels, const EdgeWishes& wishes,
         const Room& room, double tolerance, const Context& context)
      : surface_(surface),
        panels_(panels),
        asked_(wishes),
        room_{room.sheet, room.strip, 0},
        tolerance_(tolerance),
        context_(context) {
    result_.wishes = wishes;
    for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
      const auto [c, d] = surface.sides(e);
      if (!d.valid() || panel(c) == panel(d)) {
        result_.wishes[e] = EdgeWish::none;
      } else if (wishes[e] == EdgeWish::keep || wishes[e] == EdgeWish::needle ||
                 wishes[e] == EdgeWish::band) {
        wanted_.push_back(e);
        result_.wishes[e] = EdgeWish::none;
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
      result_.wishes[e] = asked_[e];
    }
  }
  void refuse(const std::vector<EdgeId>& edges) {
    for (const EdgeId e : edges) {
      result_.wishes[e] = EdgeWish::none;
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
      result_.wishes[e] = asked_[e];
      if (!lies_well(both)) {
        result_.wishes[e] = EdgeWish::none;
        continue;
      }
      sets.join(a, b);
      faces[sets.find(a)] = std::move(both);
    }
  }

  /// Whether what frozen sides hold together is one net without overlap that fits the room.
  [[nodiscard]] bool lies_well(const std::vector<FaceId>& faces) const {
    constexpr std::size_t several = 2;  // the strip for tabs is kept free
    return lies_as_one(make_patch(surface_, panels_, faces, result_.wishes.items()), several, room_,
                       tolerance_);
  }

  [[nodiscard]] prepare::Panels groups() const {
    DisjointSets sets(panels_.count());
    for (const EdgeId e : wanted_) {
      if (result_.wishes[e] != EdgeWish::none) {
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
  const EdgeWishes& asked_;
  const Room room_;
  const double tolerance_;
  const Context& context_;
  std::vector<EdgeId> wanted_;
  KeptEdges result_;
};

}  // namespace

KeptEdges settle_wishes(const mesh::Surface& surface, const prepare::Panels& panels, const EdgeWishes& wishes,
                        const Room& room, double tolerance, const Context& context) {
  return Keeper(surface, panels, wishes, room, tolerance, context).run();
}

}  // namespace ridgecraft::unfold
