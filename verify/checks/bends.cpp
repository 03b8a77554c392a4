// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 8: what is said to be bent can be rolled.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "verify/checks/checks.hpp"
#include "verify/file/relations.hpp"
#include "verify/file/tolerance.hpp"

namespace ridgecraft::verify {
namespace {

class BendCheck {
 public:
  BendCheck(const Case& given, Findings& findings)
      : file_(given.file),
        relations_(given.relations),
        findings_(findings),
        plates_(find_plates(given.file, given.relations, flat_fold_deg)),
        bends_(plates_.count) {}

  void run() {
    for (Index e = 0; e < file_.edges.size(); ++e) {
      if (file_.edges[e].bent) {
        for (const Index side : relations_.sides_of(e)) {
          bends_[plate(side)].push_back(e);
        }
      }
    }
    for (Index e = 0; e < file_.edges.size(); ++e) {
      if (is_bend(e)) {
        check(e);
      }
    }
    for (const std::vector<Index>& bends : bends_) {
      check_one_way(bends);
    }
  }

 private:
  [[nodiscard]] Index plate(Index side) const { return plates_.plate[file_.faces.face(side)]; }
  /// Bent edges that are cut only tell that the surface is round there.
  [[nodiscard]] bool is_bend(Index e) const {
    return file_.edges[e].bent && file_.edges[e].assignment != Assignment::cut;
  }

  template <class Words>
  void add(Index edge, const Words& words) {
    findings_.add(Promise::statements, {{"edge", edge}}, words);
  }

  void check(Index e) {
    const double angle = std::abs(file_.edges[e].angle_deg);
    if (angle >= most_bend_deg + angle_tolerance_deg) {
      add(e, [&] { return fmt::format("edge {} is bent by {:.4f} degrees, which is a crease", e, angle); });
      return;
    }
    const auto sides = relations_.sides_of(e);
    if (sides.size() != 2 || angle < flat_fold_deg) {
      return;
    }
    const auto [narrow, wide] = std::minmax({width(plate(sides[0])), width(plate(sides[1]))});
    const double radius =
        0.5 * (narrow + std::min(flat_beside_bend * narrow, wide)) / (angle * std::numbers::pi / 180.0);
    if (radius < least_bend_radius_mm) {
      add(e,
          [&] { return fmt::format("edge {} is bent round {:.3f} mm, tighter than paper is", e, radius); });
    }
  }

  void check_one_way(const std::vector<Index>& bends) {
    const auto turns = [&](double sign) {
      return std::find_if(bends.begin(), bends.end(),
                          [&](Index e) { return is_bend(e) && sign * file_.edges[e].angle_deg > 0.0; });
    };
    const auto there = turns(1.0);
    const auto back = turns(-1.0);
    if (there != bends.end() && back != bends.end()) {
      add(*there,
          [&] { return fmt::format("edges {} and {} are bends of one band, one each way", *there, *back); });
    }
  }

  /// Of a plate between its two bends, half way along them; without end where it hasn't two.
  [[nodiscard]] double width(Index plate) const {
    const std::vector<Index>& bends = bends_[plate];
    if (bends.size() != 2) {
      return std::numeric_limits<double>::infinity();
    }
    const auto ends = [&](Index e) {
      return std::array{file_.points[file_.edges[e].ends[0]], file_.points[file_.edges[e].ends[1]]};
    };
    const auto [a, b] = ends(bends[0]);
    auto [c, d] = ends(bends[1]);
    if (dot(b - a, d - c) < 0.0) {
      std::swap(c, d);
    }
    const Vec2 one = (b - a) / length(b - a);
    const Vec2 other = (d - c) / length(d - c);
    const Vec2 along = (one + other) / length(one + other);
    return std::abs(cross(along, 0.5 * (c + d) - 0.5 * (a + b)));
  }

  const File& file_;
  const Relations& relations_;
  Findings& findings_;
  Plates plates_;
  std::vector<std::vector<Index>> bends_;  ///< of each plate, cut ones among them
};

}  // namespace

void check_bends(const Case& given, Findings& findings) {
  BendCheck(given, findings).run();
}

}  // namespace ridgecraft::verify
