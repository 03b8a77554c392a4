// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 5, slits: each lies where its tab comes when it is laid on the face beyond its edge, lets the neck
// through and holds the head, and keeps away from all cuts and folds of its piece and from other slits.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "base/segment.hpp"
#include "verify/checks/checks.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/geometry/polygon.hpp"

namespace ridgecraft::verify {
namespace {

struct SlitLine {
  Vec2 a, b;
};

double apart(const SlitLine& s, const SlitLine& t) {
  const Vec2 along = s.b - s.a;
  const Vec2 other = t.b - t.a;
  const bool crosses = cross(along, t.a - s.a) * cross(along, t.b - s.a) < 0.0 &&
                       cross(other, s.a - t.a) * cross(other, s.b - t.a) < 0.0;
  return crosses ? 0.0
                 : std::min({distance_to_segment(s.a, t.a, t.b), distance_to_segment(s.b, t.a, t.b),
                             distance_to_segment(t.a, s.a, s.b), distance_to_segment(t.b, s.a, s.b)});
}

class SlitCheck {
 public:
  SlitCheck(const Case& given, Findings& findings)
      : file_(given.file), relations_(given.relations), context_(given.context), findings_(findings) {}

  void run() {
    for (Index tab = 0; tab < file_.tabs.size(); ++tab) {
      if (!file_.tabs[tab].slit) {
        continue;
      }
      if (const Index side = target_of_slit(file_, relations_, tab); side != none) {
        slits_[file_.face_piece[file_.faces.face(side)]].push_back(tab);
      } else {
        add(tab, "has a slit, but no join tells where that is");
      }
    }
    if (slits_.empty()) {
      return;
    }
    gather_lines();
    for (const auto& [piece, tabs] : slits_) {
      for (const Index tab : tabs) {
        context_.check();
        check_place(tab, piece);
        check_tab(tab);
      }
    }
  }

 private:
  void add(Index tab, std::string_view what) {
    findings_.add(Promise::joins, {{"tab", tab}, {"edge", file_.tabs[tab].edge}},
                  [&] { return fmt::format("{} {}", tab_name(file_, tab), what); });
  }
  [[nodiscard]] SlitLine slit(Index tab) const {
    return {(*file_.tabs[tab].slit)[0], (*file_.tabs[tab].slit)[1]};
  }

  /// Cuts and folds of the pieces that have slits.
  void gather_lines() {
    for (Index e = 0; e < file_.edges.size(); ++e) {
      const Edge& edge = file_.edges[e];
      const auto sides = relations_.sides_of(e);
      if (sides.empty() ||
          (edge.assignment != Assignment::cut && std::abs(edge.angle_deg) < flat_region_fold_deg)) {
        continue;
      }
      const Index piece = file_.face_piece[file_.faces.face(sides.front())];
      if (slits_.contains(piece)) {
        lines_[piece].push_back({file_.points[edge.ends[0]], file_.points[edge.ends[1]]});
      }
    }
    for (Index face = 0; face < file_.faces.faces(); ++face) {
      if (slits_.contains(file_.face_piece[face])) {
        faces_[file_.face_piece[face]].push_back(face);
      }
    }
  }

  void check_place(Index tab, Index piece) {
    const SlitLine own = slit(tab);
    const Vec2 middle = 0.5 * (own.a + own.b);
    if (std::ranges::none_of(faces_[piece],
                             [&](Index face) { return inside(std::array{file_.polygon(face)}, middle); })) {
      add(tab, "has a slit beside its piece");
      return;
    }
    if (std::ranges::any_of(lines_[piece],
                            [&](const SlitLine& line) { return apart(own, line) < least_beside_slit_mm; })) {
      add(tab, fmt::format("has a slit less than {} mm from a cut or a fold", least_beside_slit_mm));
    }
    if (std::ranges::any_of(slits_[piece], [&](Index other) {
          return other != tab && apart(own, slit(other)) < least_between_slits_mm;
        })) {
      add(tab, fmt::format("has a slit less than {} mm from another one", least_between_slits_mm));
    }
  }

  /// The tab as it is folded over its edge, against the slit: along the edge and away from it.
  void check_tab(Index tab) {
    const std::vector<Vec2>& polygon = file_.tabs[tab].polygon;
    const Index side = target_of_slit(file_, relations_, tab);
    if (polygon.size() < 8) {
      add(tab, "has a slit, but no neck and no head");
      return;
    }
    const Index own_side = relations_.sides_of(file_.tabs[tab].edge).front();
    // Both run from the same end of the edge.
    const SlitLine own{file_.points[file_.faces.head(own_side)], file_.points[file_.faces.tail(own_side)]};
    const SlitLine other{file_.points[file_.faces.tail(side)], file_.points[file_.faces.head(side)]};
    const auto in = [](const SlitLine& edge, Vec2 p) {
      const Vec2 along = (edge.b - edge.a) / length(edge.b - edge.a);
      return Vec2{dot(p - edge.a, along), cross(along, p - edge.a)};
    };
    const Vec2 from = in(other, slit(tab).a);
    const Vec2 to = in(other, slit(tab).b);
    double neck_low = HUGE_VAL;
    double neck_high = -HUGE_VAL;
    double head_low = HUGE_VAL;
    double head_high = -HUGE_VAL;
    for (const Vec2 corner : polygon) {
      const Vec2 p = in(own, corner);
      const bool neck = p.y < from.y;
      (neck ? neck_low : head_low) = std::min(neck ? neck_low : head_low, p.x);
      (neck ? neck_high : head_high) = std::max(neck ? neck_high : head_high, p.x);
    }
    const double low = std::min(from.x, to.x);
    const double high = std::max(from.x, to.x);
    if (std::abs(from.y - to.y) > slit_place_mm || from.y < least_beside_slit_mm) {
      add(tab, "has a slit that isn't along its edge");
    } else if (!(low < neck_low && neck_high < high)) {
      add(tab, "has a neck that its slit doesn't let through");
    } else if (!(head_low < low && high < head_high)) {
      add(tab, "has a head that its slit doesn't hold");
    }
  }

  const File& file_;
  const Relations& relations_;
  const Context& context_;
  Findings& findings_;
  std::map<Index, std::vector<Index>> slits_;  ///< per piece in which they lie
  std::map<Index, std::vector<SlitLine>> lines_;
  std::map<Index, std::vector<Index>> faces_;
};

}  // namespace

void check_slits(const Case& given, Findings& findings) {
  SlitCheck(given, findings).run();
}

}  // namespace ridgecraft::verify
