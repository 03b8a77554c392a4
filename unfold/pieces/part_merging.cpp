// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/part_merging.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "unfold/energy/piece_cost.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/search/net_search.hpp"

namespace ridgecraft::unfold {

std::vector<PieceBorder> piece_borders(const Patch& patch, std::span<const std::uint32_t> piece) {
  std::vector<double> area;
  for (std::uint32_t f = 0; f < patch.size(); ++f) {
    area.resize(std::max<std::size_t>(area.size(), piece[f] + 1), 0.0);
    area[piece[f]] += area_of(patch.shape[f]);
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> length;
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (patch.twin[side] != nothing && piece[side / 3] < piece[patch.twin[side] / 3]) {
      length[{piece[side / 3], piece[patch.twin[side] / 3]}] += patch.length[side];
    }
  }
  std::vector<PieceBorder> borders;
  for (const auto& [ends, mm] : length) {
    const auto [a, b] = ends;
    borders.push_back({a, b, mm, std::min(area[a], area[b])});
  }
  std::stable_sort(borders.begin(), borders.end(), [](const PieceBorder& s, const PieceBorder& t) {
    return s.smaller_area != t.smaller_area ? s.smaller_area < t.smaller_area : s.length > t.length;
  });
  return borders;
}

namespace {

struct NetsToJoin {
  std::size_t parts = 1;                                       ///< of how many parts the two have faces
  double tolerance = 0.0;                                      ///< mm
  double most_cost = std::numeric_limits<double>::infinity();  ///< what the one may cost (piece_cost.hpp)
};

/// Cuts at which two pieces are tried to be joined.
constexpr std::size_t shared_cuts_tried = 24;

/// The cuts between two trees: those inside flat regions first, then long ones.
std::vector<std::uint32_t> shared_cuts(const Patch& both, const Folds& apart) {
  const Layout layout = lay_out(both, apart);
  std::vector<std::uint32_t> cuts;
  for (std::uint32_t side = 0; side < both.twin.size(); ++side) {
    const std::uint32_t twin = both.twin[side];
    if (twin != nothing && side < twin && layout.piece[side / 3] != layout.piece[twin / 3]) {
      cuts.push_back(side);
    }
  }
  std::stable_sort(cuts.begin(), cuts.end(), [&](std::uint32_t s, std::uint32_t t) {
    return both.frozen[s] != both.frozen[t] ? both.frozen[s] > both.frozen[t]
                                            : both.length[s] > both.length[t];
  });
  cuts.resize(std::min(cuts.size(), shared_cuts_tried));
  return cuts;
}

/// The patch of two pieces and its two trees: the tree that a fold over one of the longest cuts between them
/// makes, without overlap and such that it fits the room, the cheapest of those below most_cost. `work` is
/// the number of faces that may be laid flat, and is taken down by those that were.
std::optional<Folds> join_as_they_are(const Patch& both, const Folds& apart, const Room& room,
                                      const Weights& weights, const NetsToJoin& rules, std::size_t& work) {
  double limit = rules.most_cost;
  std::optional<Folds> best;
  for (const std::uint32_t side : shared_cuts(both, apart)) {
    if (work < both.size()) {
      break;
    }
    work -= both.size();
    Folds trial = apart;
    set_fold(both, trial, side, true);
    if (!all_fit(both, trial, room)) {
      continue;
    }
    const double cost = cost_of_piece(both, trial, rules.parts, weights);
    if (cost < limit && find_overlaps(lay_out(both, trial), rules.tolerance).empty()) {
      limit = cost;
      best = std::move(trial);
    }
  }
  return best;
}

/// Faces times iterations of all unions that are unfolded afresh, and faces of all that are joined as they
/// are: about two seconds each.
constexpr std::uint64_t fresh_budget = 8'000'000;
constexpr std::size_t join_budget = 1'000'000;
/// Larger unions take too long.
constexpr std::size_t most_merged_faces = 1500;

using Faces = std::vector<std::uint32_t>;

struct GrowingPiece {
  Faces faces;  ///< ascending
  double cost = 0.0;
  std::size_t parts = 1;
  bool merged = false;
};

class PartMerger {
 public:
  PartMerger(const NetProblem& problem, const Folds& folds, const Context& context)
      : patch_(problem.patch),
        part_(problem.part),
        folds_(folds),
        room_(problem.room),
        weights_(problem.weights()),
        random_(context.seed),
        context_(context) {
    search_.tolerance = problem.tolerance();
    search_.starts = 2;
    for (Faces& faces : lay_out(patch_, folds).faces) {
      std::sort(faces.begin(), faces.end());
      GrowingPiece& piece = pieces_.emplace_back();
      piece.faces = std::move(faces);
      renew(piece);
    }
  }

  Folds run() {
    for (bool again = true; again;) {
      again = false;
      for (const PieceBorder& border : borders()) {
        context_.check();
        if (context_.out_of_time()) {
          return std::move(folds_);
        }
        if (merge(border)) {
          again = true;
          break;
        }
      }
    }
    return std::move(folds_);
  }

 private:
  [[nodiscard]] std::size_t count_parts(const Faces& faces) const {
    std::set<PartId> parts;
    for (const std::uint32_t f : faces) {
      parts.insert(part_[f]);
    }
    return parts.size();
  }

  void renew(GrowingPiece& piece) {
    piece.parts = count_parts(piece.faces);
    piece.cost = cost_of_piece(sub_patch(patch_, piece.faces), sub_folds(patch_, folds_, piece.faces),
                               piece.parts, weights_);
  }

  [[nodiscard]] std::vector<PieceBorder> borders() const {
    std::vector<std::uint32_t> piece(patch_.size(), 0);
    for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
      for (const std::uint32_t f : pieces_[p].faces) {
        piece[f] = p;
      }
    }
    return piece_borders(patch_, piece);
  }

  bool merge(const PieceBorder& border) {
    GrowingPiece& a = pieces_[border.a];
    GrowingPiece& b = pieces_[border.b];
    GrowingPiece both;
    std::merge(a.faces.begin(), a.faces.end(), b.faces.begin(), b.faces.end(),
               std::back_inserter(both.faces));
    if (both.faces.size() > most_merged_faces || failed_.contains(both.faces)) {
      return false;
    }
    const double limit = a.cost + b.cost;
    const Patch patch = sub_patch(patch_, both.faces);
    const std::size_t parts = count_parts(both.faces);
    std::optional<Folds> tree;
    if (least_pieces(patch, room_) == 1 && least_cost_of_piece(patch, parts, weights_) < limit) {
      tree = join_as_they_are(patch, sub_folds(patch_, folds_, both.faces), room_, weights_,
                              {parts, search_.tolerance, limit}, join_work_);
      // Pieces of one part come from a search for one net of all of it.
      if (!tree && (parts > 1 || a.merged || b.merged)) {
        tree = unfold_afresh(patch, parts, limit);
      }
    }
    if (!tree) {
      failed_.insert(std::move(both.faces));
      return false;
    }
    put_back(patch_, both.faces, *tree, folds_);
    both.merged = true;
    renew(both);
    a = std::move(both);
    pieces_.erase(pieces_.begin() + border.b);
    return true;
  }

  std::optional<Folds> unfold_afresh(const Patch& patch, std::size_t parts, double limit) {
    if (fresh_ >= fresh_budget) {
      return std::nullopt;
    }
    OnePieceFound found = find_one_piece(patch, room_, search_, random_.next(), context_);
    fresh_ += found.cost;
    std::optional<Folds> tree = std::move(found.tree);
    if (tree && !(cost_of_piece(patch, *tree, parts, weights_) < limit)) {
      tree.reset();
    }
    return tree;
  }

  const Patch& patch_;
  std::span<const PartId> part_;
  Folds folds_;
  const Room& room_;
  const Weights& weights_;
  Random random_;
  const Context& context_;
  OnePieceSearch search_;
  std::vector<GrowingPiece> pieces_;
  std::set<Faces> failed_;
  std::size_t join_work_ = join_budget;
  std::uint64_t fresh_ = 0;
};

}  // namespace

Folds merge_parts(const NetProblem& problem, const Folds& folds, const Context& context) {
  return PartMerger(problem, folds, context).run();
}

}  // namespace ridgecraft::unfold
