// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/moved_borders.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/random.hpp"
#include "unfold/energy/anneal.hpp"
#include "unfold/net/tolerance.hpp"
#include "unfold/patch/check.hpp"
#include "unfold/patch/forest.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/linked_patch.hpp"
#include "unfold/patch/objective.hpp"
#include "unfold/patch/sub_patch.hpp"
#include "unfold/pieces/joined_nets.hpp"
#include "unfold/search/heated_search.hpp"
#include "unfold/search/least_trees.hpp"

namespace ridgecraft::unfold {
namespace {

/// Faces of all pieces that are laid against each other as they are, and swaps of all searches: about half a
/// second, and one each.
constexpr std::size_t join_budget = 300'000;
constexpr std::uint64_t heat_budget = 400'000;
constexpr std::uint64_t fit_budget = 400'000;
/// Swaps for each face of pieces that are searched for a net, and of such as don't fit yet.
constexpr std::uint64_t heat_per_face = 1200;
constexpr double fit_per_face = 1500.0;
/// What has no more flat regions than this share of what a piece may have is a crumb.
constexpr std::size_t crumbs_per_piece = 4;
/// Larger unions take too long.
constexpr std::size_t most_faces = 600;
/// What a proof that a union needs as many pieces may take: pairs of faces, panels of a block.
constexpr std::uint64_t proof_pairs = 500'000;
constexpr std::size_t most_proven_panels = 30;

using Faces = std::vector<std::uint32_t>;

/// Pieces that are one part's, and those that meet them.
struct Around {
  std::vector<std::uint32_t> own;      ///< small ones first
  std::vector<std::uint32_t> foreign;  ///< of other parts, long borders first
};

/// A few pieces as one patch. The first of them is to be joined to another one.
struct Union {
  Faces faces;  ///< ascending
  Patch patch;
  Folds apart;
  std::size_t trees = 0;    ///< that it has
  std::uint32_t first = 0;  ///< one of the first piece's faces, of the patch
};

/// Sides at which its trees meet, as many as make one tree of them, and the fold that makes them one fewer.
struct Links {
  std::uint32_t joint = nothing;
  std::vector<std::uint32_t> sides;
};

class BorderMover {
 public:
  BorderMover(const mesh::Surface& surface, const prepare::Panels& panels, const Patch& patch,
              std::span<const PartId> part, const Folds& folds, std::span<const PieceReason> cause,
              const Options& options, const Room& room, const Context& context)
      : surface_(surface),
        panels_(panels),
        patch_(patch),
        part_(part),
        cause_(cause),
        options_(options),
        room_(room),
        context_(context),
        tolerance_(net_tolerance(patch.extent)),
        random_(context.seed),
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
        const std::size_t others = pieces_for_size();
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
    for (std::uint32_t p = 0; p < layout_.faces.size(); ++p) {
      if (piece_part_[p] == part && counts(p)) {
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
    return sets;
  }

  [[nodiscard]] Union united(const std::vector<std::uint32_t>& pieces) const {
    Union all;
    for (const std::uint32_t p : pieces) {
      all.faces.insert(all.faces.end(), layout_.faces[p].begin(), layout_.faces[p].end());
    }
    std::sort(all.faces.begin(), all.faces.end());
    all.patch = sub_patch(patch_, all.faces);
    all.apart = sub_folds(patch_, result_.folds, all.faces);
    all.trees = pieces.size();
    const std::uint32_t f = layout_.faces[pieces.front()].front();
    all.first = static_cast<std::uint32_t>(std::lower_bound(all.faces.begin(), all.faces.end(), f) -
                                           all.faces.begin());
    return all;
  }

  void keep(const Union& all, const Folds& folds) {
    put_back(patch_, all.faces, folds, result_.folds);
    look();
  }

  bool lay_against_cheapest(std::uint32_t p, const std::vector<std::uint32_t>& foreign) {
    double least = std::numeric_limits<double>::infinity();
    std::optional<std::pair<Union, Folds>> best;
    for (const std::uint32_t q : foreign) {
      if (border_[p].count(q) == 0) {
        continue;
      }
      Union both = united({p, q});
      if (least_pieces(both.patch, room_) > 1) {
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
    if (best) {
      keep(best->first, best->second);
    }
    return best.has_value();
  }

  [[nodiscard]] double cost(const Patch& patch, const Folds& tree) const {
    return cost_of_piece(patch, tree, one_part, options_.pieces.weights);
  }

  [[nodiscard]] double cost_apart(const Union& all) const {
    double sum = 0.0;
    for (Faces& faces : lay_out(all.patch, all.apart).faces) {
      std::sort(faces.begin(), faces.end());
      sum += cost(sub_patch(all.patch, faces), sub_folds(all.patch, all.apart, faces));
    }
    return sum;
  }

  /// One tree fewer for the faces of these pieces.
  bool search(const std::vector<std::uint32_t>& pieces) {
    const Union all = united(pieces);
    const std::size_t wanted = all.trees - 1;
    if (wanted > LinkedPatch::most_links || all.faces.size() > most_faces || failed_.contains(all.faces) ||
        least_pieces(all.patch, room_) > wanted ||
        least_trees(all.patch, {tolerance_, most_proven_panels, proof_pairs}, context_) > wanted) {
      return false;
    }
    const std::optional<Links> links = linked(all);
    if (links) {
      const std::optional<Folds> folds = searched(all, *links);
      if (folds) {
        keep(all, *folds);
        return true;
      }
    }
    failed_.insert(all.faces);
    return false;
  }

  /// Over long sides; nothing where its pieces don't hang together.
  [[nodiscard]] static std::optional<Links> linked(const Union& all) {
    const Patch& patch = all.patch;
    const Layout layout = lay_out(patch, all.apart);
    std::vector<std::uint32_t> sides;
    for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
      const std::uint32_t twin = patch.twin[side];
      if (twin != nothing && side < twin && patch.frozen[side] == 0 &&
          layout.piece[side / 3] != layout.piece[twin / 3]) {
        sides.push_back(side);
      }
    }
    std::stable_sort(sides.begin(), sides.end(),
                     [&](std::uint32_t s, std::uint32_t t) { return patch.length[s] > patch.length[t]; });
    const auto ends = [&](std::uint32_t side) {
      return std::pair(layout.piece[side / 3], layout.piece[patch.twin[side] / 3]);
    };
    Links links;
    DisjointSets sets(layout.faces.size());
    const std::uint32_t first = layout.piece[all.first];
    const auto joint = std::find_if(sides.begin(), sides.end(), [&](std::uint32_t side) {
      return ends(side).first == first || ends(side).second == first;
    });
    if (joint == sides.end()) {
      return std::nullopt;
    }
    links.joint = *joint;
    static_cast<void>(sets.join(ends(*joint).first, ends(*joint).second));
    for (const std::uint32_t side : sides) {
      if (sets.join(ends(side).first, ends(side).second)) {
        links.sides.push_back(side);
      }
    }
    return links.sides.size() + 2 == all.trees ? std::optional(std::move(links)) : std::nullopt;
  }

  /// Clean trees that fit, or nothing.
  [[nodiscard]] std::optional<Folds> searched(const Union& all, const Links& links) {
    const LinkedPatch linked = linked_patch(all.patch, links.sides);
    Folds tree = all.apart;
    set_fold(all.patch, tree, links.joint, true);
    for (const std::uint32_t side : links.sides) {
      set_fold(all.patch, tree, side, true);
    }
    const std::uint64_t trials = std::min<std::uint64_t>(heat_per_face * all.patch.size(), heat_work_);
    HeatedFound found = heated_search(linked.joined, tree, {tolerance_, trials}, random_.next(), context_);
    heat_work_ -= std::min(heat_work_, found.trials);
    if (found.overlaps > 0) {
      return std::nullopt;
    }
    std::optional<Folds> forest = parted(all.patch, found.folds, links);
    // Of two that don't fit as one nothing can be handed to others.
    return forest || all.trees == 2 ? forest : parted(all.patch, fitted(linked, found.folds), links);
  }

  /// The trees that links hold together; nothing where one overlaps or doesn't fit.
  [[nodiscard]] std::optional<Folds> parted(const Patch& patch, Folds tree, const Links& links) const {
    for (const std::uint32_t side : links.sides) {
      set_fold(patch, tree, side, false);
    }
    const bool good = all_fit(patch, tree, room_) && find_overlaps(lay_out(patch, tree), tolerance_).empty();
    return good ? std::optional(std::move(tree)) : std::nullopt;
  }

  /// The same trees brought to less energy, of which what is too large is most.
  [[nodiscard]] Folds fitted(const LinkedPatch& linked, const Folds& tree) {
    Annealing rules = annealing_for(fit_per_face, linked.joined.size());
    rules.quick_trials = std::min(rules.quick_trials, fit_work_);
    rules.exact_trials = 0;
    rules.until_it_fits = true;
    if (rules.quick_trials == 0) {
      return tree;
    }
    fit_work_ -= rules.quick_trials;
    TabOptions no_tabs = options_.tabs;
    no_tabs.wanted = false;
    ChangingNet net(surface_, panels_, linked.apart, linked.joined, tree, no_tabs, tolerance_);
    const CutFacts facts = cut_facts(net, no_tabs);
    anneal(net, facts, room_, options_.pieces.weights, rules, random_.next(), context_);
    return net.folds();
  }

  const mesh::Surface& surface_;
  const prepare::Panels& panels_;
  const Patch& patch_;
  std::span<const PartId> part_;
  std::span<const PieceReason> cause_;
  const Options& options_;
  const Room& room_;
  const Context& context_;
  double tolerance_;
  Random random_;
  MovedBorders result_;
  Layout layout_;
  std::vector<PartId> piece_part_;
  std::vector<PieceReason> piece_cause_;
  std::vector<std::map<std::uint32_t, double>> border_;  ///< per piece: length with each that it meets, mm
  std::set<Faces> failed_;
  std::size_t join_work_ = join_budget;
  std::uint64_t heat_work_ = heat_budget;
  std::uint64_t fit_work_ = fit_budget;
};

}  // namespace

MovedBorders move_borders(const mesh::Surface& surface, const prepare::Panels& panels, const Patch& patch,
                          std::span<const PartId> part, const Folds& folds,
                          std::span<const PieceReason> cause, const Options& options, const Room& room,
                          const Context& context) {
  return BorderMover(surface, panels, patch, part, folds, cause, options, room, context).run();
}

}  // namespace ridgecraft::unfold
