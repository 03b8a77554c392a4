// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/one_piece.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/elementary.hpp"
#include "base/geometry.hpp"
#include "base/random.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/search/net_search.hpp"
#include "unfold/search/overlap_pairs.hpp"
#include "unfold/search/rooted_net.hpp"

namespace ridgecraft::unfold {
namespace {

/// Trials between two looks at the clock.
constexpr std::uint64_t trials_per_look = 16;
/// Places that a branch is tried at in one trial, before another branch is chosen.
constexpr int places_tried = 4;
/// Trials without progress after which it is given up, at least.
constexpr std::uint64_t patience = 150;

/// A hull in a rectangle along one of its sides.
struct Framed {
  Vec2 along;  ///< unit vector
  double low_u = 0.0, high_u = 0.0, low_v = 0.0, high_v = 0.0;
  double over = 0.0;    ///< by how much it is too large, mm
  bool across = false;  ///< `along` runs along the sheet's height
};

Framed framed(std::span<const Vec2> hull, Vec2 along, const Sheet& sheet) {
  Framed frame{along, INFINITY, -INFINITY, INFINITY, -INFINITY, 0.0, false};
  for (const Vec2 p : hull) {
    const double u = dot(along, p);
    const double v = cross(along, p);
    frame.low_u = std::min(frame.low_u, u);
    frame.high_u = std::max(frame.high_u, u);
    frame.low_v = std::min(frame.low_v, v);
    frame.high_v = std::max(frame.high_v, v);
  }
  const double u = frame.high_u - frame.low_u;
  const double v = frame.high_v - frame.low_v;
  const double upright = std::max(0.0, u - sheet.width) + std::max(0.0, v - sheet.height);
  const double across = std::max(0.0, u - sheet.height) + std::max(0.0, v - sheet.width);
  frame.across = across < upright;
  frame.over = std::min(upright, across);
  return frame;
}

/// The turn at which least sticks out.
Framed best_frame(std::span<const Vec2> hull, const Sheet& sheet) {
  Framed best{{1.0, 0.0}, 0.0, 0.0, 0.0, 0.0, INFINITY, false};
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 side = hull[(i + 1) % hull.size()] - hull[i];
    const double size = length(side);
    if (size > 0.0) {
      const Framed frame = framed(hull, side / size, sheet);
      if (frame.over < best.over) {
        best = frame;
      }
    }
  }
  return best;
}

class FitSearch {
 public:
  FitSearch(const Patch& patch, const Folds& folds, const Room& room, double tolerance, std::uint64_t seed)
      : patch_(patch),
        room_(room),
        sheet_{room.sheet->width - 2.0 * room.strip, room.sheet->height - 2.0 * room.strip},
        random_(seed),
        net_(patch),
        after_swap_(net_, tolerance),
        branch_(patch) {
    // The sequence is used from its second number on: nets that people have already come from there.
    static_cast<void>(random_.next());
    net_.set_tree(folds);
  }

  Folds run(std::uint64_t trials, const Context& context) {
    measure();
    double best = frame_.over;
    Folds result = net_.folds();
    std::uint64_t since = 0;
    for (std::uint64_t trial = 0; trial < trials && best > 0.0 && since < patience + trials / 4; ++trial) {
      if (trial % trials_per_look == 0) {
        context.check();
        if (context.out_of_time()) {
          break;
        }
      }
      ++since;
      if (step() && frame_.over < best) {
        since = 0;
        best = room_.holds(hull_, panels_) ? 0.0 : frame_.over;
        result = net_.folds();
      }
    }
    return result;
  }

 private:
  void measure() {
    std::vector<Vec2> points;
    points.reserve(3 * patch_.size());
    for (std::uint32_t f = 0; f < patch_.size(); ++f) {
      const Triangle& flat = net_.flat(f);
      points.insert(points.end(), flat.begin(), flat.end());
    }
    hull_ = convex_hull(std::move(points));
    frame_ = best_frame(hull_, sheet_);
  }

  /// A random face that lies farthest out on a side on which the net is too long, and the face nearest the
  /// middle.
  void choose_ends(std::uint32_t& out, std::uint32_t& middle) {
    const Vec2 centre{0.5 * (frame_.low_u + frame_.high_u), 0.5 * (frame_.low_v + frame_.high_v)};
    const double half_u = 0.5 * (frame_.across ? sheet_.height : sheet_.width);
    const double half_v = 0.5 * (frame_.across ? sheet_.width : sheet_.height);
    double farthest = -INFINITY;
    double nearest = INFINITY;
    out = middle = 0;
    for (std::uint32_t f = 0; f < patch_.size(); ++f) {
      double reach = -INFINITY;
      double near = 0.0;
      for (const Vec2 p : net_.flat(f)) {
        const double u = std::abs(dot(frame_.along, p) - centre.x) - half_u;
        const double v = std::abs(cross(frame_.along, p) - centre.y) - half_v;
        reach = std::max({reach, u, v});
        near += elementary::hypot(u + half_u, v + half_v);
      }
      // Blurred, so that not always the same one is chosen.
      const double rated = reach > 0.0 ? reach * (0.1 + random_.unit()) : reach;
      if (rated > farthest) {
        farthest = rated;
        out = f;
      }
      if (near < nearest) {
        nearest = near;
        middle = f;
      }
    }
  }

  /// Hangs a branch that sticks out elsewhere; true when the tree has changed.
  bool step() {
    std::uint32_t out = 0;
    std::uint32_t middle = 0;
    choose_ends(out, middle);
    const std::vector<std::uint32_t> path = net_.removable_between(out, middle);
    if (path.empty()) {
      return false;
    }
    const std::uint32_t below = path[random_.below(static_cast<std::uint32_t>(path.size()))];
    const std::uint32_t removed = net_.side_above(below);
    branch_.find(net_.folds(), removed, out);
    const std::vector<std::uint32_t>& places = branch_.places();
    for (int i = 0; i < places_tried && !places.empty(); ++i) {
      const std::uint32_t side = places[random_.below(static_cast<std::uint32_t>(places.size()))];
      if (!after_swap_.is_clean(below, side)) {
        continue;
      }
      const Framed before = frame_;
      const std::uint32_t moved = net_.swap(below, side);
      measure();
      if (accept(frame_.over - before.over)) {
        return true;
      }
      net_.swap(moved, removed);
      frame_ = before;
      return false;
    }
    return false;
  }

  /// Never worse but sometimes, and then by little.
  bool accept(double worse) { return worse <= 0.0 || random_.unit() < 0.5 * elementary::exp(-worse / 3.0); }

  const Patch& patch_;
  const Room& room_;
  Sheet sheet_;
  Random random_;
  RootedNet net_;
  SwapOverlaps after_swap_;
  std::vector<Vec2> hull_;
  Framed frame_;
  std::size_t panels_ = 2;  ///< several: the strip for tabs is kept free
  Branch branch_;
};

}  // namespace

double excess(std::span<const Vec2> hull, const Sheet& sheet) {
  return hull.size() < 2 ? 0.0 : best_frame(hull, sheet).over;
}

Folds shrink_to_fit(const Patch& patch, const Folds& folds, const Room& room, double tolerance,
                    std::uint64_t trials, std::uint64_t seed, const Context& context) {
  if (!room.sheet || patch.size() < 2 || room.sheet->width <= 2.0 * room.strip ||
      room.sheet->height <= 2.0 * room.strip) {
    return folds;
  }
  return FitSearch(patch, folds, room, tolerance, seed).run(trials, context);
}

namespace {

/// Compact trees first: they are most likely to fit.
constexpr std::array start_kinds{StartTree::short_cuts, StartTree::breadth_first, StartTree::flat_folds,
                                 StartTree::breadth_first, StartTree::depth_first};
constexpr std::uint64_t least_iterations = 600;
/// After so many hopeless starts the others aren't tried.
constexpr int hopeless_starts = 2;

}  // namespace

OnePieceFound find_one_piece(const Patch& patch, const Room& room, const OnePieceSearch& search,
                             std::uint64_t seed, const Context& context) {
  OnePieceFound result;
  if (least_pieces(patch, room) > 1) {
    return result;
  }
  Random random(seed);
  NetSearch options;
  options.tolerance = search.tolerance;
  options.starts = 1;
  options.iterations = least_iterations + search.iterations_per_face * patch.size();
  options.idle = options.iterations;
  int hopeless = 0;  // starts that were
  for (int start = 0; start < search.starts && hopeless < hopeless_starts && !context.out_of_time();
       ++start) {
    context.check();
    options.start = start_kinds[static_cast<std::size_t>(start) % start_kinds.size()];
    NetFound found = find_net(patch, options, random.next(), context);
    result.cost += found.iterations * patch.size();
    hopeless += found.hopeless ? 1 : 0;
    const std::uint64_t fit_seed = random.next();
    if (found.overlaps > 0) {
      continue;
    }
    if (all_fit(patch, found.folds, room)) {
      result.tree = std::move(found.folds);
      return result;
    }
    result.cost += search.fit_trials * patch.size();
    Folds shrunk =
        shrink_to_fit(patch, found.folds, room, search.tolerance, search.fit_trials, fit_seed, context);
    if (all_fit(patch, shrunk, room)) {
      result.tree = std::move(shrunk);
      return result;
    }
  }
  return result;
}

}  // namespace ridgecraft::unfold
