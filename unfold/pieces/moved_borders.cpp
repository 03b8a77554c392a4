// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/moved_borders.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "unfold/energy/piece_cost.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/pieces/fewer_pieces.hpp"
#include "unfold/pieces/part_merging.hpp"

namespace ridgecraft::unfold {
namespace {

/// Faces of all pieces that are laid against each other as they are: about half a second.
constexpr std::size_t lay_budget = 300'000;
/// What a net that saves a piece may cost more than the two before, as a share of what a piece counts. More
/// saves pieces that are easy to cut for the sake of one that isn't: a vase's foot and neck in one ragged
/// net.
constexpr double share_of_a_piece = 1.0 / 3.0;
/// What has no more flat regions than this share of what a piece may have is a crumb.
constexpr std::size_t crumbs_per_piece = 4;

using Faces = std::vector<std::uint32_t>;

/// Pieces that are one part's, and those that meet them.
struct Around {
  std::vector<std::uint32_t> own;      ///< small ones first
  std::vector<std::uint32_t> foreign;  ///< of other parts, long borders first
};

class BorderMover {
 public:
  BorderMover(const NetProblem& problem, const Folds& folds, std::span<const PieceReason> cause,
              const Context& context)
      : patch_(problem.patch),
        part_(problem.part),
        cause_(cause),
        options_(problem.options),
        room_(problem.room),
        context_(context),
        tolerance_(problem.tolerance()),
        trees_(problem, context),
        result_{folds, {}} {
    look();
  }

  MovedBorders run() {
    std::map<PartId, std::size_t> surplus;  // pieces for overlap
    for (std::uint32_t p = 0; p < layout_.faces.size(); ++p) {
      surplus[piece_part_[p]] += is_for_overlap(piece_cause_[p]) ? 1U : 0U;
    }
    for (bool again = true; again && !context_.out_of_time();) {
      again = false;
      for (auto& [part, count] : surplus) {
        const std::size_t others = count > 0 ? pieces_for_size() : 0;
        if (count > 0 && save_a_piece(part)) {
          result_.parts.push_back(part);
          // A neighbour's piece that was there for another reason may be the one that is gone.
          count -= pieces_for_size() < others ? 0U : 1U;
          again = true;
        } else if (save_a_crumb(part)) {
          result_.parts.push_back(part);
          again = true;
        }
      }
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] static bool is_for_overlap(PieceReason cause) {
    return cause == PieceReason::overlap || cause == PieceReason::no_net;
  }

  [[nodiscard]] std::size_t pieces_for_size() const {
    return static_cast<std::size_t>(std::count_if(
        piece_cause_.begin(), piece_cause_.end(),
        [](PieceReason cause) { return cause == PieceReason::page || cause == PieceReason::faces; }));
  }

  /// Pieces that are there for the number of flat regions are parts of an ordinary size, and stay, but for
  /// such.
  [[nodiscard]] bool is_crumb(std::uint32_t piece) const {
    return piece_cause_[piece] == PieceReason::faces &&
           crumbs_per_piece * panels_of(patch_, result_.folds, layout_.faces[piece]) <= room_.max_panels;
  }

  /// What most faces of a piece have.
  template <class ValueOf>
  [[nodiscard]] auto most_frequent(const Faces& faces, ValueOf value_of) const {
    std::map<decltype(value_of(0U)), std::size_t> count;
    for (const std::uint32_t f : faces) {
      ++count[value_of(f)];
    }
    return std::max_element(count.begin(), count.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
  }

  void look() {
    layout_ = lay_out(patch_, result_.folds);
    piece_part_.clear();
    piece_cause_.clear();
    for (const Faces& faces : layout_.faces) {
      piece_part_.push_back(most_frequent(faces, [&](std::uint32_t f) { return part_[f]; }));
      piece_cause_.push_back(most_frequent(faces, [&](std::uint32_t f) { return cause_[f]; }));
    }
    pieces_of_.clear();
    for (std::uint32_t p = 0; p < piece_part_.size(); ++p) {
      pieces_of_[piece_part_[p]].push_back(p);
    }
    border_.assign(layout_.faces.size(), {});
    for (std::uint32_t side = 0; side < patch_.twin.size(); ++side) {
      const std::uint32_t twin = patch_.twin[side];
      if (twin != nothing && patch_.frozen[side] == 0 && layout_.piece[side / 3] != layout_.piece[twin / 3]) {
        border_[layout_.piece[side / 3]][layout_.piece[twin / 3]] += patch_.length[side];
      }
    }
  }

  /// `counts`: which of its pieces may join others.
  template <class Counts>
  [[nodiscard]] Around around(PartId part, Counts counts) const {
    Around result;
    std::map<std::uint32_t, double> met;
    const auto own = pieces_of_.find(part);
    for (const std::uint32_t p : own == pieces_of_.end() ? std::vector<std::uint32_t>() : own->second) {
      if (counts(p)) {
        result.own.push_back(p);
        for (const auto& [q, mm] : border_[p]) {
          met[q] += piece_part_[q] != part ? mm : 0.0;
        }
      }
    }
    std::stable_sort(result.own.begin(), result.own.end(), [&](std::uint32_t p, std::uint32_t q) {
      return layout_.faces[p].size() < layout_.faces[q].size();
    });
    for (const auto& [q, mm] : met) {
      if (mm > 0.0) {
        result.foreign.push_back(q);
      }
    }
    std::stable_sort(result.foreign.begin(), result.foreign.end(),
                     [&](std::uint32_t p, std::uint32_t q) { return met[p] > met[q]; });
    return result;
  }

  bool save_a_crumb(PartId part) {
    const Around here = around(part, [&](std::uint32_t p) { return is_crumb(p); });
    return std::any_of(here.own.begin(), here.own.end(),
                       [&](std::uint32_t p) { return lay_against_cheapest(p, here.foreign); });
  }

  /// The simplest first: a piece joins a net of another part; then such two are searched for one net; then
  /// more pieces around.
  bool save_a_piece(PartId part) {
    const Around here = around(part, [&](std::uint32_t p) {
      return piece_cause_[p] == PieceReason::part || is_for_overlap(piece_cause_[p]);
    });
    for (const std::uint32_t p : here.own) {
      if (lay_against_cheapest(p, here.foreign)) {
        return true;
      }
    }
    for (const std::vector<std::uint32_t>& pieces : unions(here)) {
      if (context_.out_of_time()) {
        return false;
      }
      context_.check();
      if (search(pieces)) {
        return true;
      }
    }
    return false;
  }

  /// Sets of pieces, each beginning with the one that joins another.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> unions(const Around& here) const {
    std::vector<std::vector<std::uint32_t>> sets;
    for (const std::uint32_t p : here.own) {
      for (const std::uint32_t q : here.foreign) {
        if (border_[p].count(q) != 0) {
          sets.push_back({p, q});
        }
      }
    }
    sets.push_back(here.own);
    sets.back().insert(sets.back().end(), here.foreign.begin(), here.foreign.end());
    for (const std::uint32_t q : here.foreign) {
      sets.push_back(here.own);
      sets.back().push_back(q);
    }
    // Where two fit no sheet, a third takes what is too much.
    for (const std::uint32_t p : here.own) {
      for (const std::uint32_t q : here.foreign) {
        for (const auto& [r, mm] : border_[q]) {
          const bool is_own = std::find(here.own.begin(), here.own.end(), r) != here.own.end();
          if (border_[p].count(q) != 0 && !is_own) {
            sets.push_back({p, q, r});
          }
        }
      }
    }
    // Pieces join until a part may have none that is mostly its own.
    std::erase_if(sets, [](const std::vector<std::uint32_t>& set) { return set.size() < 2; });
    return sets;
  }

  [[nodiscard]] PiecesTogether united(const std::vector<std::uint32_t>& pieces) const {
    return pieces_together(patch_, result_.folds, layout_, pieces);
  }

  /// Takes these trees, one fewer, unless they are much more ragged.
  bool keep_if_better(const PiecesTogether& all, const Folds& folds) {
    const SettledTrees fewer = trees_.settled(all.patch, folds);
    const double most = share_of_a_piece * options_.pieces.weights.pieces;
    if (fewer.energy >= trees_.settled(all.patch, all.apart).energy + most) {
      failed_.insert(all.faces);
      return false;
    }
    put_back(patch_, all.faces, fewer.folds, result_.folds);
    look();
    return true;
  }

  bool lay_against_cheapest(std::uint32_t p, const std::vector<std::uint32_t>& foreign) {
    double least = std::numeric_limits<double>::infinity();
    std::optional<std::pair<PiecesTogether, Folds>> best;
    for (const std::uint32_t q : foreign) {
      if (border_[p].count(q) == 0) {
        continue;
      }
      PiecesTogether both = united({p, q});
      if (failed_.contains(both.faces) || least_pieces(both.patch, room_) > 1) {
        continue;
      }
      const std::optional<Folds> tree =
          join_as_they_are(both.patch, both.apart, room_, options_.pieces.weights,
                           {one_part, tolerance_, std::numeric_limits<double>::infinity()}, join_work_);
      if (tree) {
        const double more = cost(both.patch, *tree) - cost_apart(both);
        if (more < least) {
          least = more;
          best.emplace(std::move(both), *tree);
        }
      }
    }
    return best && keep_if_better(best->first, best->second);
  }

  [[nodiscard]] double cost(const Patch& patch, const Folds& tree) const {
    return cost_of_piece(patch, tree, one_part, options_.pieces.weights);
  }

  [[nodiscard]] double cost_apart(const PiecesTogether& all) const {
    double sum = 0.0;
    for (Faces& faces : lay_out(all.patch, all.apart).faces) {
      std::sort(faces.begin(), faces.end());
      sum += cost(sub_patch(all.patch, faces), sub_folds(all.patch, all.apart, faces));
    }
    return sum;
  }

  /// One tree fewer for the faces of these pieces.
  bool search(const std::vector<std::uint32_t>& pieces) {
    const PiecesTogether all = united(pieces);
    if (failed_.contains(all.faces)) {
      return false;
    }
    const std::optional<Folds> folds = trees_.one_fewer(all);
    if (folds && keep_if_better(all, *folds)) {
      return true;
    }
    failed_.insert(all.faces);
    return false;
  }

  const Patch& patch_;
  std::span<const PartId> part_;
  std::span<const PieceReason> cause_;
  const Options& options_;
  const Room& room_;
  const Context& context_;
  double tolerance_;
  TreesTogether trees_;
  MovedBorders result_;
  Layout layout_;
  std::vector<PartId> piece_part_;
  std::vector<PieceReason> piece_cause_;
  std::map<PartId, std::vector<std::uint32_t>> pieces_of_;  ///< per part: the pieces that are mostly its own
  std::vector<std::map<std::uint32_t, double>> border_;     ///< per piece: length with each that it meets, mm
  std::set<Faces> failed_;
  std::size_t join_work_ = lay_budget;
};

}  // namespace

MovedBorders move_borders(const NetProblem& problem, const Folds& folds, std::span<const PieceReason> cause,
                          const Context& context) {
  return BorderMover(problem, folds, cause, context).run();
}

}  // namespace ridgecraft::unfold
