// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/net/chains.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace ridgecraft::unfold {
namespace {

/// Cuts in a row: of each the side on the left of the way.
using CutRow = std::vector<CornerId>;

Vec3 direction(const mesh::Surface& surface, CornerId side) {
  return normalized(surface.point(surface.vertex(mesh::next(side))) - surface.point(surface.vertex(side)));
}

/// The same cuts, the other way.
CutRow turned(const mesh::Surface& surface, CutRow row) {
  std::reverse(row.begin(), row.end());
  for (CornerId& side : row) {
    side = surface.twin(side);
  }
  return row;
}

/// The vertex of a ring at half its length from one of them, or the nearest to that: its place in the ring.
std::size_t half_way(const mesh::Surface& surface, const CutRow& ring) {
  double all = 0.0;
  for (const CornerId side : ring) {
    all += surface.length(surface.edge(side));
  }
  double at = surface.length(surface.edge(ring[0]));
  std::size_t best = 1;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const double next = at + surface.length(surface.edge(ring[i]));
    if (std::abs(next - 0.5 * all) >= std::abs(at - 0.5 * all)) {
      break;
    }
    at = next;
    best = i + 1;
  }
  return best;
}

/// A ring as two rows.
std::array<CutRow, 2> halves(const mesh::Surface& surface, CutRow ring) {
  const auto straightness = [&](std::size_t i) {
    return dot(direction(surface, ring[(i + ring.size() - 1) % ring.size()]), direction(surface, ring[i]));
  };
  std::size_t sharpest = 0;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    sharpest = straightness(i) < straightness(sharpest) ? i : sharpest;
  }
  std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(sharpest), ring.end());
  const auto half = ring.begin() + static_cast<std::ptrdiff_t>(half_way(surface, ring));
  return {CutRow(ring.begin(), half), CutRow(half, ring.end())};
}

/// Follows cuts through vertices where nothing else is cut: there the same two pieces go on on both sides.
class CutRows {
 public:
  /// `join`: of each edge, or none where they have no numbers yet.
  CutRows(const mesh::Surface& surface, const Nets& nets, const IdVector<EdgeId, JoinId>& join)
      : surface_(surface),
        nets_(nets),
        join_(join),
        cuts_at_(surface.vertex_count()),
        visited_(surface.edge_count(), 0) {}

  std::vector<CutRow> find() {
    for (const EdgeId e : ids<EdgeId>(surface_.edge_count())) {
      if (nets_.use[e] != EdgeUse::fold) {
        const CornerId side = surface_.sides(e)[0];
        for (const VertexId v : {surface_.vertex(side), surface_.vertex(mesh::next(side))}) {
          cuts_at_[v].add(e, nets_.use[e] == EdgeUse::border);
        }
      }
    }
    std::vector<CutRow> rows;
    for (const EdgeId e : ids<EdgeId>(surface_.edge_count())) {
      if (nets_.use[e] == EdgeUse::cut && visited_[e.value()] == 0) {
        add_row(surface_.sides(e)[0], rows);
      }
    }
    return rows;
  }

 private:
  struct CutsAt {
    std::uint32_t count = 0;
    std::uint32_t both = 0;  ///< the numbers of two edges, exclusive or: each tells the other
    bool border = false;
    void add(EdgeId e, bool is_border) {
      ++count;
      both ^= e.value();
      border = border || is_border;
    }
  };

  void add_row(CornerId side, std::vector<CutRow>& rows) {
    CutRow row = onward(side);
    // Back from where it began, unless it came round to there.
    const bool ring = follower(row.back()) == side;
    if (!ring) {
      CutRow whole = turned(surface_, onward(surface_.twin(side)));
      whole.insert(whole.end(), row.begin() + 1, row.end());
      rows.push_back(std::move(whole));
    } else {
      for (CutRow& half : halves(surface_, std::move(row))) {
        rows.push_back(std::move(half));
      }
    }
  }

  /// From a side on until nothing follows or the next one has been visited.
  CutRow onward(CornerId side) {
    CutRow row{side};
    visited_[surface_.edge(side).value()] = 1;
    for (CornerId next = follower(side); next.valid() && visited_[surface_.edge(next).value()] == 0;
         next = follower(next)) {
      visited_[surface_.edge(next).value()] = 1;
      row.push_back(next);
    }
    return row;
  }

  [[nodiscard]] std::uint32_t number(EdgeId e) const {
    return join_.empty() ? 0 : nets_.joins[join_[e]].number;
  }

  /// The side that goes on where this one ends, if it is of the same chain.
  [[nodiscard]] CornerId follower(CornerId side) const {
    const VertexId v = surface_.vertex(mesh::next(side));
    const CutsAt& cuts = cuts_at_[v];
    const EdgeId edge = surface_.edge(side);
    if (cuts.count != 2 || cuts.border) {
      return {};
    }
    const EdgeId other(cuts.both ^ edge.value());
    if (number(other) != number(edge)) {
      return {};
    }
    const auto [c, d] = surface_.sides(other);
    return surface_.vertex(c) == v ? c : d;
  }

  const mesh::Surface& surface_;
  const Nets& nets_;
  const IdVector<EdgeId, JoinId>& join_;
  IdVector<VertexId, CutsAt> cuts_at_;
  std::vector<std::uint8_t> visited_;
};

/// Numbers rows in an order that a person can follow.
class SeamWalk {
 public:
  SeamWalk(const mesh::Surface& surface, Nets& nets)
      : surface_(surface),
        nets_(nets),
        rows_(CutRows(surface, nets, {}).find()),
        numbered_(rows_.size(), 0),
        ends_at_(surface.vertex_count()) {}

  void run() {
    std::vector<std::uint32_t> order;
    for (std::uint32_t r = 0; r < rows_.size(); ++r) {
      order.push_back(r);
      ends_at_[start({r, false})].push_back({r, false});
      ends_at_[start({r, true})].push_back({r, true});
    }
    // Pieces are in the order of their parts already, so what is sorted by pieces is sorted by parts.
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return pieces_at(a) < pieces_at(b); });
    for (const std::uint32_t r : order) {
      // Where seams run into themselves the way from an end may miss some of what led there.
      while (numbered_[r] == 0) {
        walk(seam_end(r));
      }
    }
  }

 private:
  /// A row with a way to go.
  struct Step {
    std::uint32_t row;
    bool back;
  };

  [[nodiscard]] CornerId first(Step step) const {
    return step.back ? surface_.twin(rows_[step.row].back()) : rows_[step.row].front();
  }
  [[nodiscard]] VertexId start(Step step) const { return surface_.vertex(first(step)); }
  [[nodiscard]] static Step turned(Step step) { return {step.row, !step.back}; }

  /// The two pieces that meet at a row, smaller first.
  [[nodiscard]] std::pair<PieceId, PieceId> pieces_at(std::uint32_t row) const {
    const CornerId side = rows_[row].front();
    return std::minmax(nets_.piece[mesh::face_of(side)], nets_.piece[mesh::face_of(surface_.twin(side))]);
  }

  /// What goes on best where a row ends: between the same pieces, then straightest; none when all are
  /// numbered.
  [[nodiscard]] std::optional<Step> onward(Step from, bool same_pieces_only) const {
    const auto pieces = pieces_at(from.row);
    const CornerId last = first(turned(from));  // it leads back
    std::optional<Step> best;
    std::pair<bool, double> best_score;
    for (const Step next : ends_at_[surface_.vertex(last)]) {
      if (numbered_[next.row] != 0 || next.row == from.row) {
        continue;
      }
      const bool same = pieces_at(next.row) == pieces;
      if (same_pieces_only && !same) {
        continue;
      }
      const std::pair score{same, -dot(direction(surface_, last), direction(surface_, first(next)))};
      if (!best || score > best_score) {
        best = next;
        best_score = score;
      }
    }
    return best;
  }

  /// An end of the seam that a row lies on: the walk begins there and not in the middle.
  [[nodiscard]] Step seam_end(std::uint32_t row) const {
    Step step{row, true};
    for (std::size_t count = 0; count < rows_.size(); ++count) {
      const std::optional<Step> next = onward(step, true);
      if (!next || next->row == row) {
        break;
      }
      step = *next;
    }
    return turned(step);
  }

  void number(Step step) {
    numbered_[step.row] = 1;
    ++last_;
    const CutRow& row = rows_[step.row];
    for (std::size_t i = 0; i < row.size(); ++i) {
      Join join;
      join.edge = surface_.edge(step.back ? row[row.size() - 1 - i] : row[i]);
      join.number = last_;
      nets_.joins.push_back(join);
    }
  }

  /// Along the seams; at a dead end back to the last fork.
  void walk(Step from) {
    number(from);
    std::vector<Step> trail{from};
    while (!trail.empty()) {
      const std::optional<Step> next = onward(trail.back(), false);
      if (!next) {
        trail.pop_back();
        continue;
      }
      number(*next);
      trail.push_back(*next);
    }
  }

  const mesh::Surface& surface_;
  Nets& nets_;
  std::vector<CutRow> rows_;
  std::vector<std::uint8_t> numbered_;
  IdVector<VertexId, std::vector<Step>> ends_at_;  ///< of each vertex the ways that begin there
  std::uint32_t last_ = 0;
};

}  // namespace

std::vector<Chain> chains_of(const mesh::Surface& surface, const Nets& nets) {
  IdVector<EdgeId, JoinId> join(surface.edge_count());
  for (const JoinId j : ids<JoinId>(nets.joins.size())) {
    join[nets.joins[j].edge] = j;
  }
  std::vector<Chain> chains;
  for (CutRow& row : CutRows(surface, nets, join).find()) {
    if (join[surface.edge(row.back())] < join[surface.edge(row.front())]) {
      row = turned(surface, std::move(row));
    }
    Chain chain;
    const CornerId side = row.front();
    chain.number = nets.joins[join[surface.edge(side)]].number;
    chain.pieces = {nets.piece[mesh::face_of(side)], nets.piece[mesh::face_of(surface.twin(side))]};
    for (const CornerId c : row) {
      chain.joins.push_back(join[surface.edge(c)]);
    }
    chain.sides = std::move(row);
    chains.push_back(std::move(chain));
  }
  std::stable_sort(chains.begin(), chains.end(),
                   [](const Chain& a, const Chain& b) { return a.number < b.number; });
  return chains;
}

void number_joins(const mesh::Surface& surface, Nets& nets) {
  nets.joins = {};
  SeamWalk(surface, nets).run();
}

}  // namespace ridgecraft::unfold
