// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/net/nets.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "unfold/net/options.hpp"

namespace ridgecraft::unfold {

std::string_view name(PieceReason reason) {
  switch (reason) {
    case PieceReason::part:
      return "part";
    case PieceReason::page:
      return "page";
    case PieceReason::overlap:
    case PieceReason::no_net:
      return "overlap";
    case PieceReason::tabs:
      return "tabs";
    case PieceReason::faces:
    case PieceReason::shape:
      return "faces";
    case PieceReason::time:
      return "time";
    case PieceReason::request:
    case PieceReason::folding:
      return "request";
    case PieceReason::component:
      return "component";
  }
  return "part";
}

std::string_view message_code(PieceReason reason) {
  switch (reason) {
    case PieceReason::part:
      return "piece_part";
    case PieceReason::page:
      return "piece_page";
    case PieceReason::overlap:
      return "piece_overlap";
    case PieceReason::no_net:
      return "piece_no_net";
    case PieceReason::tabs:
      return "piece_tabs";
    case PieceReason::faces:
      return "piece_faces";
    case PieceReason::time:
      return "piece_time";
    case PieceReason::request:
      return "piece_request";
    case PieceReason::component:
      return "piece_component";
    case PieceReason::folding:
      return "piece_folding";
    case PieceReason::shape:
      return "piece_shape";
  }
  return "piece_part";
}

std::string_view name(NoTab reason) {
  switch (reason) {
    case NoTab::has_tab:
      return "";
    case NoTab::edge_too_short:
      return "edge_too_short";
    case NoTab::no_room:
      return "no_room";
    case NoTab::target_too_small:
      return "target_too_small";
    case NoTab::too_little_paper:
      return "too_little_paper";
    case NoTab::beyond_sheet:
      return "beyond_sheet";
    case NoTab::not_wanted:
      return "not_wanted";
    case NoTab::time_up:
      return "time_up";
  }
  return "";
}

namespace {

/// The two pieces that meet at a cut, smaller first.
std::pair<PieceId, PieceId> pieces_at(const mesh::Surface& surface, const Nets& nets, EdgeId e) {
  const auto [c, d] = surface.sides(e);
  return std::minmax(nets.piece[mesh::face_of(c)], nets.piece[mesh::face_of(d)]);
}

class SeamWalk {
 public:
  SeamWalk(const mesh::Surface& surface, Nets& nets)
      : surface_(surface), nets_(nets), numbered_(surface.edge_count(), 0) {}

  void run() {
    // Pieces are in the order of their parts already, so cuts sorted by pieces are sorted by parts.
    std::vector<EdgeId> cuts;
    for (const EdgeId e : ids<EdgeId>(surface_.edge_count())) {
      if (nets_.use[e] == EdgeUse::cut) {
        cuts.push_back(e);
      }
    }
    std::stable_sort(cuts.begin(), cuts.end(), [&](EdgeId a, EdgeId b) {
      return pieces_at(surface_, nets_, a) < pieces_at(surface_, nets_, b);
    });
    for (const EdgeId e : cuts) {
      // Where seams run into themselves the way from an end may miss some of what led there.
      while (numbered_[e.value()] == 0) {
        walk(seam_end(e));
      }
    }
  }

 private:
  struct Step {
    EdgeId edge;
    VertexId at;  ///< the end that the walk goes on from
  };

  [[nodiscard]] VertexId other_end(EdgeId e, VertexId v) const {
    const CornerId c = surface_.sides(e)[0];
    return surface_.vertex(c) == v ? surface_.vertex(mesh::next(c)) : surface_.vertex(c);
  }

  /// The cut that goes on from v best: between the same pieces, then straightest; none when all are numbered.
  [[nodiscard]] EdgeId next_cut(const Step& from, bool same_pieces_only) const {
    const Vec3 along = normalized(surface_.point(from.at) - surface_.point(other_end(from.edge, from.at)));
    const auto pieces = pieces_at(surface_, nets_, from.edge);
    EdgeId best;
    std::pair<bool, double> best_score;
    for (const CornerId c : surface_.corners_at(from.at)) {
      for (const EdgeId e : {surface_.edge(c), surface_.edge(mesh::previous(c))}) {
        if (nets_.use[e] != EdgeUse::cut || numbered_[e.value()] != 0 || e == from.edge) {
          continue;
        }
        const bool same = pieces_at(surface_, nets_, e) == pieces;
        if (same_pieces_only && !same) {
          continue;
        }
        const Vec3 way = normalized(surface_.point(other_end(e, from.at)) - surface_.point(from.at));
        const std::pair score{same, dot(along, way)};
        if (!best.valid() || score > best_score || (score == best_score && e < best)) {
          best = e;
          best_score = score;
        }
      }
    }
    return best;
  }

  /// An end of the seam that e lies on: the walk begins there and not in the middle.
  [[nodiscard]] Step seam_end(EdgeId e) const {
    const CornerId c = surface_.sides(e)[0];
    Step step{e, surface_.vertex(c)};
    for (std::size_t count = 0; count < surface_.edge_count(); ++count) {
      const EdgeId next = next_cut(step, true);
      if (!next.valid() || next == e) {
        break;
      }
      step = {next, other_end(next, step.at)};
    }
    return {step.edge, other_end(step.edge, step.at)};
  }

  void number(EdgeId e) {
    numbered_[e.value()] = 1;
    Join join;
    join.edge = e;
    join.number = static_cast<std::uint32_t>(nets_.joins.size() + 1);
    nets_.joins.push_back(join);
  }

  /// Along the seams; at a dead end back to the last fork.
  void walk(Step start) {
    number(start.edge);
    std::vector<Step> trail{start};
    while (!trail.empty()) {
      const EdgeId next = next_cut(trail.back(), false);
      if (!next.valid()) {
        trail.pop_back();
        continue;
      }
      number(next);
      trail.push_back({next, other_end(next, trail.back().at)});
    }
  }

  const mesh::Surface& surface_;
  Nets& nets_;
  std::vector<std::uint8_t> numbered_;
};

}  // namespace

std::string piece_name(std::size_t number) {
  std::string name;
  for (std::size_t rest = number + 1; rest > 0; rest = (rest - 1) / 26) {
    name.insert(name.begin(), static_cast<char>('A' + (rest - 1) % 26));
  }
  return name;
}

void number_joins(const mesh::Surface& surface, Nets& nets) {
  nets.joins = {};
  SeamWalk(surface, nets).run();
}

}  // namespace ridgecraft::unfold
