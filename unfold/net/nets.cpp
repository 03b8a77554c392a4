// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/net/nets.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "unfold/net/options.hpp"

namespace ridgecraft::unfold {

namespace {

struct ReasonNames {
  std::string_view contract;
  std::string_view message;
};

/// In the order of PieceReason.
constexpr std::array reason_names{
    ReasonNames{"part", "piece_part"},           ReasonNames{"page", "piece_page"},
    ReasonNames{"overlap", "piece_overlap"},     ReasonNames{"overlap", "piece_no_net"},
    ReasonNames{"tabs", "piece_tabs"},           ReasonNames{"faces", "piece_faces"},
    ReasonNames{"time", "piece_time"},           ReasonNames{"request", "piece_request"},
    ReasonNames{"component", "piece_component"}, ReasonNames{"request", "piece_folding"},
    ReasonNames{"faces", "piece_shape"}};
static_assert(reason_names.size() == static_cast<std::size_t>(PieceReason::shape) + 1);

}  // namespace

std::string_view name(PieceReason reason) {
  return reason_names[static_cast<std::size_t>(reason)].contract;
}

std::string_view message_code(PieceReason reason) {
  return reason_names[static_cast<std::size_t>(reason)].message;
}

std::string_view name(NoTab reason) {
  static constexpr std::array<std::string_view, 8> names{
      "",           "edge_too_short", "no_room", "target_too_small", "too_little_paper", "beyond_sheet",
      "not_wanted", "time_up"};
  static_assert(names.size() == static_cast<std::size_t>(NoTab::time_up) + 1);
  return names[static_cast<std::size_t>(reason)];
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
