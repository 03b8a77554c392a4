// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/tab_split.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "base/elementary.hpp"
#include "base/parallel.hpp"
#include "base/random.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/pieces/page_split.hpp"
#include "unfold/pieces/piece_borders.hpp"
#include "unfold/tabs/place/missing_tabs.hpp"
#include "unfold/tabs/place/place_tabs.hpp"

namespace ridgecraft::unfold {
namespace {

/// A place from which a share s of what stands in the way is cut off is worth s to this power: one cut that
/// frees a tab is better than many that nearly do.
constexpr int sharpness = 3;
/// A cut that can't have a tab itself costs so much of one.
constexpr double narrow_cut = 0.7;
/// What a cut of this length costs more than a short one, in tabs: only to choose among equals.
constexpr double cost_of_length = 1e-4;  // per mm

/// All trees of a forest at once.
struct RootedForest {
  std::vector<std::uint32_t> up;     ///< per face: its side to its parent; nothing at a root
  std::vector<std::uint32_t> depth;  ///< per face

  RootedForest(const Patch& patch, const Folds& folds) : up(patch.size()), depth(patch.size(), nothing) {
    std::vector<std::uint32_t> place(patch.size());
    for (std::uint32_t root = 0; root < patch.size(); ++root) {
      if (depth[root] != nothing) {
        continue;
      }
      const RootedTree tree = rooted_tree(patch, folds, root, place);
      for (std::size_t i = 0; i < tree.order.size(); ++i) {
        up[tree.order[i]] = tree.up[i];
        depth[tree.order[i]] = i == 0 ? 0 : depth[tree.order[tree.parent[i]]] + 1;
      }
    }
  }
};

class Chooser {
 public:
  Chooser(const ForestWithGaps& forest, const Context& context)
      : surface_(forest.surface),
        patch_(forest.patch),
        tab_gaps_(forest.tab_gaps),
        context_(context),
        forest_(patch_, forest.folds),
        sum_(patch_.twin.size(), 0.0) {
    for (const TabGap& gap : forest.gaps) {
      context_.check();
      Gap& own = gaps_.emplace_back();
      for (const TabGap::Place& place : gap.places) {
        add_place(place, own);
      }
      if (own.places.empty()) {
        cut_off(gap, forest.folds, own);
      }
      measure(own);
    }
  }

  std::vector<std::uint32_t> run(double blur, Random& random) {
    std::vector<std::uint32_t> cuts;
    for (;;) {
      context_.check();
      std::uint32_t best = nothing;
      double most = 0.0;
      for (const Worth& worth : worths()) {
        const double blurred = worth.tabs * (1.0 + blur * random.unit());
        if (blurred > most) {
          most = blurred;
          best = worth.side;
        }
      }
      if (best == nothing) {
        return cuts;
      }
      cuts.push_back(best);
      take_away(best);
    }
  }

 private:
  using Path = std::vector<std::uint32_t>;  ///< folds that may be cut, each by its side of the lower face
  using Place = std::vector<Path>;          ///< to each thing in the way that isn't cut off yet
  struct Worth {
    std::uint32_t side = nothing;
    double tabs = 0.0;
  };
  struct Gap {
    std::vector<Place> places;
    std::vector<Worth> worths;  ///< of cutting each fold, for this gap; ascending by side
  };

  [[nodiscard]] Path path(std::uint32_t f, std::uint32_t g) const {
    Path result;
    while (f != g) {
      std::uint32_t& deeper = forest_.depth[f] >= forest_.depth[g] ? f : g;
      const std::uint32_t side = forest_.up[deeper];
      if (patch_.frozen[side] == 0) {
        result.push_back(side);
      }
      deeper = patch_.twin[side] / 3;
    }
    return result;
  }

  void add_place(const TabGap::Place& place, Gap& gap) const {
    Place paths;
    for (const FaceId f : place.in_the_way) {
      paths.push_back(path(place.face.value(), f.value()));
      if (paths.back().empty()) {
        return;
      }
    }
    if (!paths.empty()) {
      gap.places.push_back(std::move(paths));
    }
  }

  /// Where no place can be freed that was thought of: around the faces of the join, or where these lie inside
  /// flat regions, at the faces of those that are next to them.
  void cut_off(const TabGap& gap, const Folds& folds, Gap& own) const {
    std::set<std::uint32_t> ring;
    for (const TabGap::Place& place : gap.places) {
      ring.insert(place.face.value());
    }
    for (std::set<std::uint32_t> seen; !ring.empty() && own.places.empty();) {
      seen.insert(ring.begin(), ring.end());
      std::set<std::uint32_t> next;
      for (const std::uint32_t f : ring) {
        for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
          if (folds[side] == 0) {
            continue;
          }
          const std::uint32_t twin = patch_.twin[side];
          if (patch_.frozen[side] == 0) {
            own.places.push_back({{forest_.up[f] == side ? side : twin}});
          } else if (seen.count(twin / 3) == 0) {
            next.insert(twin / 3);
          }
        }
      }
      ring = std::move(next);
    }
  }

  static void measure(Gap& gap) {
    std::map<std::uint32_t, double> most;
    for (const Place& place : gap.places) {
      std::map<std::uint32_t, std::uint32_t> count;
      for (const Path& path : place) {
        for (const std::uint32_t side : path) {
          ++count[side];
        }
      }
      for (const auto& [side, n] : count) {
        const double share = static_cast<double>(n) / static_cast<double>(place.size());
        double& worth = most[side];
        worth = std::max(worth, elementary::pow(share, sharpness));
      }
    }
    gap.worths.clear();
    for (const auto& [side, worth] : most) {
      gap.worths.push_back({side, worth});
    }
  }

  /// What cutting each fold is worth, in tabs; ascending by side.
  [[nodiscard]] std::vector<Worth> worths() {
    std::vector<Worth> result;
    for (const Gap& gap : gaps_) {
      for (const Worth& worth : gap.worths) {
        if (sum_[worth.side] == 0.0) {
          result.push_back({worth.side, 0.0});
        }
        sum_[worth.side] += worth.tabs;
      }
    }
    std::sort(result.begin(), result.end(), [](const Worth& x, const Worth& y) { return x.side < y.side; });
    for (auto& [side, worth] : result) {
      const EdgeId edge = surface_.edge(mesh::corner(patch_.face[side / 3], side % 3));
      const double cost = (tab_gaps_.able(edge) ? 0.0 : narrow_cut) + cost_of_length * patch_.length[side];
      worth = std::max(sum_[side] - cost, 0.01 * sum_[side]);
      sum_[side] = 0.0;
    }
    return result;
  }

  void take_away(std::uint32_t cut) {
    for (Gap& gap : gaps_) {
      const auto at =
          std::lower_bound(gap.worths.begin(), gap.worths.end(), cut,
                           [](const Worth& worth, std::uint32_t side) { return worth.side < side; });
      if (at == gap.worths.end() || at->side != cut) {
        continue;
      }
      for (Place& place : gap.places) {
        std::erase_if(
            place, [&](const Path& path) { return std::find(path.begin(), path.end(), cut) != path.end(); });
      }
      if (std::any_of(gap.places.begin(), gap.places.end(), [](const Place& p) { return p.empty(); })) {
        gap = {};
      } else {
        measure(gap);
      }
    }
  }

  const mesh::Surface& surface_;
  const Patch& patch_;
  const TabGaps& tab_gaps_;
  const Context& context_;
  RootedForest forest_;
  std::vector<Gap> gaps_;
  std::vector<double> sum_;  ///< per side: space to work in, 0
};

}  // namespace

std::vector<std::uint32_t> choose_tab_cuts(const ForestWithGaps& forest, double blur, Random& random,
                                           const Context& context) {
  return Chooser(forest, context).run(blur, random);
}

namespace {

/// Cuts between two pieces that are tried as a fold, the longest first.
constexpr std::size_t cuts_tried = 8;
using Faces = std::vector<std::uint32_t>;

/// What cutting and uniting have to know and to keep.
struct SplitRules {
  const NetProblem& problem;
  const TabGaps& tab_gaps;
  const NetsOf& nets_of;
  std::span<const std::uint32_t> origin;  ///< per face: only pieces of one origin are united
};

/// Pieces of the forest as a patch of their own.
struct Pieces {
  Faces faces;  ///< of the whole patch, ascending
  Patch patch;
  Folds folds;
};

class Uniter {
 public:
  Uniter(const SplitRules& rules, TabSplit split, const Context& context)
      : rules_(rules), context_(context), best_(std::move(split)) {}

  TabSplit run() {
    while (!context_.out_of_time() && unite_any()) {
    }
    return std::move(best_);
  }

 private:
  bool unite_any() {
    const Layout layout = lay_out(rules_.problem.patch, best_.folds);
    std::vector<PieceBorder> borders = piece_borders(rules_.problem.patch, layout.piece);
    std::erase_if(borders, [&](const PieceBorder& border) {
      const auto origin = [&](std::uint32_t piece) { return rules_.origin[layout.faces[piece].front()]; };
      return origin(border.a) != origin(border.b);
    });
    return std::any_of(borders.begin(), borders.end(), [&](const PieceBorder& border) {
      return unite(layout.faces[border.a], layout.faces[border.b]);
    });
  }

  /// Makes one piece of two, if that costs no tab.
  bool unite(const Faces& one, const Faces& other) {
    context_.check();
    Pieces given;
    given.faces = one;
    given.faces.insert(given.faces.end(), other.begin(), other.end());
    std::sort(given.faces.begin(), given.faces.end());
    if (context_.out_of_time() || !tried_.insert(given.faces).second) {
      return false;
    }
    given.patch = sub_patch(rules_.problem.patch, given.faces);
    given.folds = sub_folds(rules_.problem.patch, best_.folds, given.faces);
    for (const std::uint32_t side : cuts_between(given.patch, given.folds)) {
      Folds folds = given.folds;
      set_fold(given.patch, folds, side, true);
      if (is_good(given.patch, folds) && take(given, folds)) {
        return true;
      }
    }
    return false;
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
    return all_fit(patch, folds, rules_.problem.room) &&
           find_overlaps(lay_out(patch, folds), rules_.problem.tolerance()).empty();
  }

  [[nodiscard]] EdgeId edge_of(const Pieces& given, std::uint32_t side) const {
    return rules_.problem.surface.edge(mesh::corner(given.patch.face[side / 3], side % 3));
  }

  /// Keeps a forest of these faces if no tab is lost. Joins inside are looked at first, by themselves: that
  /// is quick.
  bool take(const Pieces& given, const Folds& changed) {
    if (missing_inside(given, changed) > best_.missing) {
      return false;
    }
    Folds folds = best_.folds;
    put_back(rules_.problem.patch, given.faces, changed, folds);
    const std::size_t missing = rules_.tab_gaps.missing(rules_.nets_of(folds)).size();
    if (missing > best_.missing) {
      return false;
    }
    best_ = {std::move(folds), missing};
    return true;
  }

  [[nodiscard]] std::size_t missing_inside(const Pieces& given, const Folds& folds) const {
    const mesh::Surface& surface = rules_.problem.surface;
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
    place_tabs({surface, rules_.problem.panels, rules_.problem.options.tabs}, nets, context_);
    return rules_.tab_gaps.missing(nets).size();
  }

  const SplitRules& rules_;
  const Context& context_;
  TabSplit best_;
  std::set<Faces> tried_;
};

/// Ways to split that are tried: the first by the order of worth, the others with blurred orders.
constexpr std::size_t attempts = 4;
constexpr double blur_of_order = 0.5;

/// Cuts until no tab is missing, or none of those that are can be had by cutting.
TabSplit cut_for_tabs(const SplitRules& rules, const Folds& folds, double blur, Random& random,
                      const Context& context) {
  const Patch& patch = rules.problem.patch;
  TabSplit result{folds, 0};
  for (;;) {
    context.check();
    const Nets nets = rules.nets_of(result.folds);
    const std::vector<JoinId> missing = rules.tab_gaps.missing(nets);
    result.missing = missing.size();
    if (missing.empty() || context.out_of_time()) {
      return result;
    }
    const std::vector<TabGap> gaps = rules.tab_gaps.gaps(nets, missing, context);
    const std::vector<std::uint32_t> cuts = choose_tab_cuts(
        {rules.problem.surface, patch, result.folds, rules.tab_gaps, gaps}, blur, random, context);
    if (cuts.empty()) {
      return result;
    }
    for (const std::uint32_t side : cuts) {
      set_fold(patch, result.folds, side, false);
    }
  }
}

}  // namespace

TabSplit split_for_tabs(const NetProblem& problem, const Folds& folds, const NetsOf& nets_of,
                        const Context& context) {
  const Patch& patch = problem.patch;
  const TabGaps tab_gaps({problem.surface, problem.panels, problem.options.tabs}, patch, folds, context);
  const Layout before = lay_out(patch, folds);
  const SplitRules rules{problem, tab_gaps, nets_of, before.piece};
  // What there is no time to try is worse than anything.
  std::vector<TabSplit> tried(attempts, {folds, std::numeric_limits<std::size_t>::max()});
  do_in_parallel(attempts, context, [&](std::size_t i, const Context& own) {
    if (i > 0 && own.out_of_time()) {
      return;
    }
    Random random = Random::stream(context.seed, i);
    const double blur = i == 0 ? 0.0 : blur_of_order;
    const TabSplit cut = cut_for_tabs(rules, folds, blur, random, own);
    tried[i] = Uniter(rules, cut, own).run();
  });
  std::size_t best = 0;
  for (std::size_t i = 1; i < attempts; ++i) {
    const bool fewer = tried[i].missing < tried[best].missing;
    if (fewer || (tried[i].missing == tried[best].missing &&
                  cost_of(patch, tried[i].folds) < cost_of(patch, tried[best].folds))) {
      best = i;
    }
  }
  return std::move(tried[best]);
}

}  // namespace ridgecraft::unfold
