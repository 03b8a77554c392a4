// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/merge_pieces.hpp"

#include <algorithm>

#include "base/geometry.hpp"
#include "base/random.hpp"
#include "unfold/patch/forest.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/search/circle_tree.hpp"

namespace ridgecraft::unfold {
namespace {

class Merger {
 public:
  Merger(const Patch& patch, const Folds& folds, const Room& room, double tolerance, std::uint64_t budget)
      : patch_(patch), folds_(folds), room_(room), tolerance_(tolerance), budget_(budget) {
    Layout layout = lay_out(patch, folds);
    for (const auto& faces : layout.faces) {
      hulls_.push_back(hull_of(layout, faces));
      panels_.push_back(panels_of(patch, folds, faces));
    }
    flat_ = std::move(layout.flat);
    piece_ = std::move(layout.piece);
    faces_ = std::move(layout.faces);
    circles_.reserve(flat_.size());
    for (const Triangle& t : flat_) {
      circles_.push_back(smallest_circle(t[0], t[1], t[2]));
    }
  }

  void run(const Context& context, Random* random) {
    std::vector<std::uint32_t> cuts;
    std::vector<double> weight(patch_.twin.size(), 0.0);
    for (std::uint32_t side = 0; side < patch_.twin.size(); ++side) {
      const std::uint32_t twin = patch_.twin[side];
      if (twin != nothing && side < twin && piece_[side / 3] != piece_[twin / 3]) {
        cuts.push_back(side);
        weight[side] = patch_.length[side] * (random != nullptr ? 0.3 + random->unit() : 1.0);
      }
    }
    std::stable_sort(cuts.begin(), cuts.end(), [&](std::uint32_t a, std::uint32_t b) {
      if (patch_.frozen[a] != patch_.frozen[b]) {
        return patch_.frozen[a] > patch_.frozen[b];
      }
      return weight[a] > weight[b];
    });
    for (bool again = true; again && budget_ > 0;) {
      again = false;
      for (const std::uint32_t side : cuts) {
        context.check();
        if (piece_[side / 3] != piece_[patch_.twin[side] / 3] && join(side)) {
          again = true;
        }
      }
    }
  }

  [[nodiscard]] Folds& folds() { return folds_; }

 private:
  bool join(std::uint32_t side) {
    if (faces_[piece_[side / 3]].size() < faces_[piece_[patch_.twin[side] / 3]].size()) {
      side = patch_.twin[side];
    }
    const std::uint32_t stays = piece_[side / 3];
    const std::uint32_t moves = piece_[patch_.twin[side] / 3];
    const Rigid motion = frame(side / 3) * patch_.across[side] * frame(patch_.twin[side] / 3).inverse();
    std::vector<Vec2> points = hulls_[stays];
    for (const Vec2 p : hulls_[moves]) {
      points.push_back(motion(p));
    }
    const std::size_t panels = panels_[stays] + panels_[moves] - within_panel(patch_, side);
    std::vector<Vec2> hull = convex_hull(std::move(points));
    if (!room_.holds(hull, panels) || collides(stays, moves, motion)) {
      return false;
    }
    for (const std::uint32_t f : faces_[moves]) {
      piece_[f] = stays;
      for (Vec2& p : flat_[f]) {
        p = motion(p);
      }
      circles_[f].centre = motion(circles_[f].centre);
      faces_[stays].push_back(f);
    }
    faces_[moves].clear();
    hulls_[stays] = std::move(hull);
    panels_[stays] = panels;
    set_fold(patch_, folds_, side, true);
    return true;
  }

  /// Where a face's own frame lies now.
  [[nodiscard]] Rigid frame(std::uint32_t f) const {
    const Triangle& own = patch_.shape[f];
    unsigned k = 0;
    for (unsigned j = 1; j < 3; ++j) {
      k = patch_.length[3 * f + j] > patch_.length[3 * f + k] ? j : k;
    }
    const Vec2 from = own[(k + 1) % 3] - own[k];
    const Vec2 to = flat_[f][(k + 1) % 3] - flat_[f][k];
    const double size = length(from) * length(to);
    Rigid r;
    if (size > 0.0) {
      r = {dot(from, to) / size, cross(from, to) / size, {}};
      r = r * Rigid{};
    }
    r.shift = flat_[f][k] - r.turn(own[k]);
    return r;
  }

  bool collides(std::uint32_t stays, std::uint32_t moves, const Rigid& motion) {
    for (const std::uint32_t f : faces_[moves]) {
      const Circle circle{motion(circles_[f].centre), circles_[f].radius};
      const Triangle moved{motion(flat_[f][0]), motion(flat_[f][1]), motion(flat_[f][2])};
      for (const std::uint32_t g : faces_[stays]) {
        if (!apart(circle, circles_[g]) && overlap(moved, flat_[g], tolerance_)) {
          return true;
        }
      }
      const std::uint64_t tested = faces_[stays].size();
      if (budget_ <= tested) {
        budget_ = 0;
        return true;
      }
      budget_ -= tested;
    }
    return false;
  }

  const Patch& patch_;
  Folds folds_;
  const Room& room_;
  double tolerance_;
  std::uint64_t budget_;
  std::vector<Triangle> flat_;
  std::vector<Circle> circles_;
  std::vector<std::uint32_t> piece_;
  std::vector<std::vector<std::uint32_t>> faces_;
  std::vector<std::vector<Vec2>> hulls_;
  std::vector<std::size_t> panels_;
};

}  // namespace

Folds merge_pieces(const Patch& patch, const Folds& folds, const Room& room, double tolerance,
                   std::uint64_t pair_budget, const Context& context, Random* random) {
  Merger merger(patch, folds, room, tolerance, pair_budget);
  merger.run(context, random);
  return std::move(merger.folds());
}

}  // namespace ridgecraft::unfold
