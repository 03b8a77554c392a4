// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/tab_unite.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "unfold/energy/anneal.hpp"
#include "unfold/patch/check.hpp"
#include "unfold/patch/forest.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/linked_patch.hpp"
#include "unfold/patch/sub_patch.hpp"
#include "unfold/pieces/piece_borders.hpp"
#include "unfold/search/one_piece.hpp"
#include "unfold/tabs/place/place_tabs.hpp"
#include "unfold/tabs/trees/changing_net.hpp"

namespace ridgecraft::unfold {
namespace {

/// Cuts between two pieces that are tried as a fold, the longest first.
constexpr std::size_t cuts_tried = 8;
/// Of each search for tabs, for each face.
constexpr double tab_trials_per_face = 1000.0;
/// Of all searches together, for each face of the surface.
constexpr double trials_in_all = 5000.0;
/// A tab more is worth nearly any shape here: weight of bare seam.
constexpr double worth_of_any_tab = 20.0;

using Faces = std::vector<std::uint32_t>;

/// How it is tried to make one piece less, cheap ways first.
enum class Way : std::uint8_t {
  join,    ///< two pieces become one as they are
  unfold,  ///< two pieces are unfolded afresh as one
  share,   ///< three pieces are unfolded afresh as two
};
constexpr std::array ways{Way::join, Way::unfold, Way::share};

/// Pieces of the forest as a patch of their own.
struct Pieces {
  Faces faces;  ///< of the whole patch, ascending
  Patch patch;
  Folds folds;
};

class Uniter {
 public:
  Uniter(const TabUnions& rules, const Folds& folds, std::size_t missing, std::uint64_t seed,
         const Context& context)
      : rules_(rules),
        random_(seed),
        context_(context),
        best_{folds, missing},
        trials_left_(trials_in_all * rules.patch.size()) {}

  TabSplit run() {
    const std::size_t count = rules_.search ? ways.size() : 1;
    for (std::size_t i = 0; i < count && !context_.out_of_time();) {
      i = unite_any(ways[i]) ? 0 : i + 1;
    }
    return std::move(best_);
  }

 private:
  bool unite_any(Way way) {
    const Layout layout = lay_out(rules_.patch, best_.folds);
    std::vector<PieceBorder> borders = piece_borders(rules_.patch, layout.piece);
    std::erase_if(borders, [&](const PieceBorder& border) {
      const auto origin = [&](std::uint32_t piece) { return rules_.origin[layout.faces[piece].front()]; };
      return origin(border.a) != origin(border.b);
    });
    for (const PieceBorder& border : borders) {
      if (way != Way::share) {
        if (unite(layout, {border.a, border.b}, way)) {
          return true;
        }
        continue;
      }
      for (const PieceBorder& beside : borders) {
        const std::uint32_t third = beside.a == border.a || beside.a == border.b ? beside.b : beside.a;
        const bool touches = third == beside.b || beside.b == border.a || beside.b == border.b;
        if (touches && third != border.a && third != border.b &&
            unite(layout, {border.a, border.b, third}, way)) {
          return true;
        }
      }
    }
    return false;
  }

  /// Makes one piece less of these, if that costs no tab.
  bool unite(const Layout& layout, const std::vector<std::uint32_t>& pieces, Way way) {
    context_.check();
    Pieces given;
    for (const std::uint32_t piece : pieces) {
      const Faces& more = layout.faces[piece];
      given.faces.insert(given.faces.end(), more.begin(), more.end());
    }
    std::sort(given.faces.begin(), given.faces.end());
    if (context_.out_of_time() || trials_left_ <= 0.0 || !tried_.emplace(way, given.faces).second) {
      return false;
    }
    given.patch = sub_patch(rules_.patch, given.faces);
    given.folds = sub_folds(rules_.patch, best_.folds, given.faces);
    if (way == Way::join) {
      return join(given);
    }
    std::optional<Folds> start = joined(given);
    if (!start && way == Way::unfold) {
      OnePieceSearch search;
      search.tolerance = rules_.tolerance;
      start = find_one_piece(given.patch, rules_.room, search, random_.next(), context_).tree;
    }
    return start && search(given, std::move(*start));
  }

  bool join(const Pieces& given) {
    for (const std::uint32_t side : cuts_between(given.patch, given.folds)) {
      Folds folds = given.folds;
      set_fold(given.patch, folds, side, true);
      if (is_good(given.patch, folds) && take(given, folds)) {
        return true;
      }
    }
    return false;
  }

  /// One cut between two pieces folded, so that they make a clean one; tabs may be lost.
  [[nodiscard]] std::optional<Folds> joined(const Pieces& given) {
    for (const std::uint32_t side : cuts_between(given.patch, given.folds)) {
      Folds folds = given.folds;
      set_fold(given.patch, folds, side, true);
      if (is_good(given.patch, folds)) {
        return folds;
      }
    }
    return {};
  }

  /// Cuts from one piece to another, the longest first.
  [[nodiscard]] static std::vector<std::uint32_t> cuts_between(const Patch& patch, const Folds& folds) {
    const Layout layout = lay_out(patch, folds);
    std::vector<std::uint32_t> cuts;
    for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
      const std::uint32_t twin = patch.twin[side];
      if (twin != nothing && side < twin && layout.piece[side / 3] != layout.piece[twin / 3]) {
        cuts.push_back(side);
      }
    }
    std::stable_sort(cuts.begin(), cuts.end(),
                     [&](std::uint32_t x, std::uint32_t y) { return patch.length[x] > patch.length[y]; });
    cuts.resize(std::min(cuts.size(), cuts_tried));
    return cuts;
  }

  [[nodiscard]] bool is_good(const Patch& patch, const Folds& folds) const {
    return all_fit(patch, folds, rules_.room) &&
           find_overlaps(lay_out(patch, folds), rules_.tolerance).empty();
  }

  /// Searches for tabs from a clean forest of one piece or two; the cut that links two stays one.
  bool search(const Pieces& given, Folds start) {
    std::vector<std::uint32_t> links;
    if (const auto cuts = cuts_between(given.patch, start); !cuts.empty()) {
      const auto link = std::find_if(cuts.begin(), cuts.end(), [&](std::uint32_t side) {
        return rules_.tab_gaps.able(edge_of(given, side));
      });
      if (link == cuts.end()) {
        return false;
      }
      set_fold(given.patch, start, *link, true);
      links.push_back(*link);
    }
    const Annealing rules = annealing_for(tab_trials_per_face, given.patch.size());
    trials_left_ -= static_cast<double>(rules.quick_trials);
    const LinkedPatch linked = linked_patch(given.patch, links);
    ChangingNet net(rules_.surface, rules_.panels, linked.apart, linked.joined, start, rules_.options,
                    rules_.tolerance);
    Weights weights;
    weights.bare = worth_of_any_tab;
    anneal(net, cut_facts(net, rules_.options), rules_.room, weights, rules, random_.next(), context_);
    Folds found = net.folds();
    for (const std::uint32_t side : links) {
      set_fold(given.patch, found, side, false);
    }
    return is_good(given.patch, found) && take(given, found);
  }

  [[nodiscard]] EdgeId edge_of(const Pieces& given, std::uint32_t side) const {
    return rules_.surface.edge(mesh::corner(given.patch.face[side / 3], side % 3));
  }

  /// Keeps a forest of these faces if no tab is lost. Joins inside are looked at first, by themselves: that
  /// is quick.
  bool take(const Pieces& given, const Folds& changed) {
    if (missing_inside(given, changed) > best_.missing) {
      return false;
    }
    Folds folds = best_.folds;
    put_back(rules_.patch, given.faces, changed, folds);
    const std::size_t missing = rules_.tab_gaps.missing(rules_.nets_of(folds)).size();
    if (missing > best_.missing) {
      return false;
    }
    best_ = {std::move(folds), missing};
    return true;
  }

  [[nodiscard]] std::size_t missing_inside(const Pieces& given, const Folds& folds) const {
    const mesh::Surface& surface = rules_.surface;
    const Layout layout = lay_out(given.patch, folds);
    Nets nets;
    nets.use = IdVector<EdgeId, EdgeUse>(surface.edge_count(), EdgeUse::cut);
    nets.piece = IdVector<FaceId, PieceId>(surface.face_count());
    nets.flat = IdVector<FaceId, std::array<Vec2, 3>>(surface.face_count());
    for (const Faces& faces : layout.faces) {
      Piece piece;
      for (const std::uint32_t f : faces) {
        const FaceId face = given.patch.face[f];
        piece.faces.push_back(face);
        nets.piece[face] = PieceId(nets.pieces.size());
        nets.flat[face] = layout.flat[f];
      }
      nets.pieces.push_back(std::move(piece));
    }
    for (std::uint32_t side = 0; side < folds.size(); ++side) {
      if (folds[side] != 0 || is_slit(given.patch, folds, layout, side)) {
        nets.use[edge_of(given, side)] = EdgeUse::fold;
      } else if (given.patch.twin[side] != nothing && side < given.patch.twin[side]) {
        nets.joins.push_back({edge_of(given, side), 0, TabId(), NoTab::not_wanted, false});
      }
    }
    place_tabs(surface, rules_.panels, rules_.options, nets, context_);
    return rules_.tab_gaps.missing(nets).size();
  }

  const TabUnions& rules_;
  Random random_;
  const Context& context_;
  TabSplit best_;
  double trials_left_;
  std::set<std::pair<Way, Faces>> tried_;
};

}  // namespace

TabSplit unite_with_tabs(const TabUnions& rules, const Folds& folds, std::size_t missing, std::uint64_t seed,
                         const Context& context) {
  return Uniter(rules, folds, missing, seed, context).run();
}

}  // namespace ridgecraft::unfold
