// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/machine/thick_nets.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <boost/polygon/polygon.hpp>

#include "base/boxes.hpp"
#include "base/disjoint_sets.hpp"
#include "base/elementary.hpp"
#include "base/geometry.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::export_ {
namespace {

using mesh::Surface;
using unfold::EdgeUse;
using unfold::Nets;
namespace planar = boost::polygon;

/// Paper below this yields, mm.
constexpr double thinnest_board_mm = 0.3;
/// A fold below this is none, radians.
constexpr double flat_angle = 1e-4 * std::numbers::pi / 180.0;
/// Below this angle a tab's step behind its neighbour is accepted, radians.
constexpr double slight_angle = 30.0 * std::numbers::pi / 180.0;
/// The thickness seen along a face is at most so many thicknesses.
constexpr double most_thicknesses = 2.0;
/// A face keeps two thirds of its height over each side.
constexpr double most_of_height = 1.0 / 3.0;
/// A corner moves no farther than so many times the larger of its sides' changes: sides that are nearly in
/// line meet far away.
constexpr double farthest_corner = 3.0;
/// A tab keeps so much of its height.
constexpr double least_of_tab = 0.4;
/// Paper that lies on paper, mm2: more than rounding, less than is seen.
constexpr double overlap_mm2 = 0.02;

double thickness_along(double t, double angle) {
  return std::min(t / elementary::sin(angle), most_thicknesses * t);
}

/// A piece's flat parts, their sides and how far these move.
class Thickener {
 public:
  Thickener(const prepare::Prepared& model, const Nets& nets, const Board& board)
      : surface_(model.model.surface),
        nets_(nets),
        board_(board),
        result_(nets),
        plates_(surface_.face_count()),
        tabs_of_(nets.pieces.size()) {
    const auto& panel = model.panels.panel;
    for (const EdgeId edge : ids<EdgeId>(surface_.edge_count())) {
      if (nets_.use[edge] == EdgeUse::fold) {
        const auto sides = surface_.sides(edge);
        const FaceId a = mesh::face_of(sides[0]);
        const FaceId b = mesh::face_of(sides[1]);
        if (std::abs(surface_.fold_angle(edge)) < flat_angle || (!panel.empty() && panel[a] == panel[b])) {
          plates_.join(a.value(), b.value());
        }
      }
    }
    for (const TabId id : ids<TabId>(nets_.tabs.size())) {
      const unfold::Tab& tab = nets_.tabs[id];
      tab_at_[tab.side] = &tab;
      tabs_of_[nets_.piece[mesh::face_of(tab.side)]].push_back(id);
    }
  }

  Nets made() {
    for (const PieceId piece : ids<PieceId>(nets_.pieces.size())) {
      thicken(piece);
    }
    // Which pieces are equal is so still: equal sides change alike.
    return std::move(result_);
  }
  ThickReport report;

 private:
  [[nodiscard]] Vec2 start(CornerId c) const { return nets_.flat[mesh::face_of(c)][c.value() % 3]; }
  [[nodiscard]] std::uint32_t plate(CornerId c) { return plates_.find(mesh::face_of(c).value()); }
  [[nodiscard]] bool is_fold(CornerId c) const { return nets_.use[surface_.edge(c)] == EdgeUse::fold; }
  [[nodiscard]] bool is_within_plate(CornerId c) { return is_fold(c) && plate(c) == plate(surface_.twin(c)); }
  [[nodiscard]] Vec2 along(CornerId c) const {
    const Vec2 d = start(mesh::next(c)) - start(c);
    return d / std::max(length(d), 1e-300);
  }
  /// Faces lie on the left of their sides.
  [[nodiscard]] Vec2 outward(CornerId c) const { return -perpendicular(along(c)); }

  [[nodiscard]] BoardSide kind_of(CornerId c) const {
    const EdgeId edge = surface_.edge(c);
    if (nets_.use[edge] == EdgeUse::fold) {
      return BoardSide::fold;
    }
    if (nets_.use[edge] == EdgeUse::border) {
      return BoardSide::border;
    }
    return tab_at_.contains(c)                  ? BoardSide::tab_base
           : tab_at_.contains(surface_.twin(c)) ? BoardSide::tab_target
                                                : BoardSide::mitre;
  }

  void thicken(PieceId piece) {
    changes_.clear();
    const std::vector<FaceId>& faces = nets_.pieces[piece].faces;
    std::map<std::uint32_t, std::vector<FaceId>> plates;
    for (const FaceId face : faces) {
      plates[plates_.find(face.value())].push_back(face);
    }
    const std::size_t clamped = report.clamped;
    for (const auto& [plate, of_plate] : plates) {
      find_changes(of_plate);
    }
    std::map<std::uint32_t, Vec2> moved = place_plates(faces);
    for (const FaceId face : faces) {
      for (unsigned k = 0; k < 3; ++k) {
        result_.flat[face][k] = moved[plates_.find(face.value())] + corner_of_plate(mesh::corner(face, k));
      }
    }
    move_tabs(piece);
    trim_tabs(piece);
    if (lies_on_itself(piece)) {
      report.clamped = clamped;
      ++report.kept;
      take_back(piece);
    }
  }

  void take_back(PieceId piece) {
    for (const FaceId face : nets_.pieces[piece].faces) {
      result_.flat[face] = nets_.flat[face];
    }
    for (const TabId tab : tabs_of_[piece]) {
      result_.tabs[tab] = nets_.tabs[tab];
    }
  }

  void find_changes(const std::vector<FaceId>& plate) {
    for (const FaceId face : plate) {
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId c = mesh::corner(face, k);
        if (is_within_plate(c)) {
          continue;
        }
        double change = side_change(kind_of(c), surface_.fold_angle(surface_.edge(c)), board_);
        if (change < 0.0) {
          double height = 0.0;
          for (const FaceId other : plate) {
            for (const Vec2 p : nets_.flat[other]) {
              height = std::max(height, -dot(p - start(c), outward(c)));
            }
          }
          if (-change > most_of_height * height) {
            change = -most_of_height * height;
            ++report.clamped;
          }
        }
        changes_[c] = change;
      }
    }
  }

  /// Where a corner of a plate comes to lie, before the plate moves: on both of the moved sides there.
  [[nodiscard]] Vec2 corner_of_plate(CornerId corner) {
    CornerId after = corner;
    while (is_within_plate(after)) {
      after = mesh::next(surface_.twin(after));
      if (after == corner) {
        return start(corner);  // within the plate
      }
    }
    CornerId before = mesh::next(mesh::next(corner));
    while (is_within_plate(before)) {
      before = mesh::next(mesh::next(surface_.twin(before)));
    }
    const Vec2 at = start(corner);
    const double a = changes_[before];
    const double b = changes_[after];
    const Vec2 m = outward(before);
    const Vec2 n = outward(after);
    const double most = farthest_corner * std::max(std::abs(a), std::abs(b));
    const double turn = cross(m, n);
    if (std::abs(turn) > 1e-6) {
      // dot(v, m) = a and dot(v, n) = b.
      const Vec2 v{(a * n.y - b * m.y) / turn, (b * m.x - a * n.x) / turn};
      if (length(v) <= most) {
        return at + v;
      }
    }
    const Vec2 middle = 0.5 * (a * m + b * n);
    return at + middle;
  }

  /// Plates move along with their folds, from the largest face on: a fold's two lines become one.
  std::map<std::uint32_t, Vec2> place_plates(const std::vector<FaceId>& faces) {
    // The longest folds first, where they close a ring.
    std::vector<std::pair<double, CornerId>> folds;
    std::map<std::uint32_t, std::vector<std::pair<std::uint32_t, Vec2>>> beside;
    for (const FaceId face : faces) {
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId c = mesh::corner(face, k);
        if (is_fold(c) && surface_.sides(surface_.edge(c))[0] == c && !is_within_plate(c)) {
          folds.emplace_back(-length(start(mesh::next(c)) - start(c)), c);
        }
      }
    }
    std::ranges::sort(folds);
    DisjointSets joined(surface_.face_count());
    for (const auto& [minus_length, c] : folds) {
      const CornerId twin = surface_.twin(c);
      const std::uint32_t a = plate(c);
      const std::uint32_t b = plate(twin);
      if (joined.find(a) == joined.find(b)) {
        continue;
      }
      joined.join(a, b);
      const Vec2 step = (changes_[c] + changes_[twin]) * outward(c);
      beside[a].emplace_back(b, step);
      beside[b].emplace_back(a, -step);
    }
    std::map<std::uint32_t, Vec2> moved;
    std::vector<std::uint32_t> open{plates_.find(faces.front().value())};
    moved[open.front()] = {};
    while (!open.empty()) {
      const std::uint32_t a = open.back();
      open.pop_back();
      for (const auto& [b, step] : beside[a]) {
        if (moved.try_emplace(b, moved[a] + step).second) {
          open.push_back(b);
        }
      }
    }
    return moved;
  }

  void move_tabs(PieceId piece) {
    for (const TabId id : tabs_of_[piece]) {
      unfold::Tab& tab = result_.tabs[id];
      const FaceId face = mesh::face_of(tab.side);
      const Vec2 from = start(tab.side);
      const Vec2 u = along(tab.side);
      const Vec2 up = outward(tab.side);
      const double size = length(start(mesh::next(tab.side)) - from);
      const Vec2 new_from = result_.flat[face][tab.side.value() % 3];
      const Vec2 new_to = result_.flat[face][mesh::next(tab.side).value() % 3];
      const double stretch = dot(new_to - new_from, u) / std::max(size, 1e-300);
      double height = 0.0;
      for (const Vec2 p : tab.polygon) {
        height = std::max(height, dot(p - from, up));
      }
      const double lower =
          board_.thickness_mm < thinnest_board_mm
              ? 1.0
              : std::max(least_of_tab, (height - board_.thickness_mm) / std::max(height, 1e-9));
      for (Vec2& p : tab.polygon) {
        const Vec2 d = p - from;
        p = new_from + (stretch * dot(d, u)) * u + (lower * dot(d, up)) * up;
      }
    }
  }

  /// Tabs that others lie on now are made smaller, as large as they can be without.
  void trim_tabs(PieceId piece) {
    std::vector<unfold::Tab*> tabs;
    for (const TabId tab : tabs_of_[piece]) {
      tabs.push_back(&result_.tabs[tab]);
    }
    const auto is_free = [&](const std::vector<Vec2>& polygon, const unfold::Tab* but) {
      const Box2 box = box_of(polygon);
      const auto clear_of = [&](const auto& other) {
        return !meet(box, box_of(other)) || !polygons_overlap(polygon, other);
      };
      return std::ranges::all_of(nets_.pieces[piece].faces,
                                 [&](FaceId face) { return clear_of(result_.flat[face]); }) &&
             std::ranges::all_of(
                 tabs, [&](const unfold::Tab* tab) { return tab == but || clear_of(tab->polygon); });
    };
    for (unfold::Tab* tab : tabs) {
      if (!is_free(tab->polygon, tab)) {
        double most = 0.0;
        std::vector<Vec2> best;
        for (std::vector<Vec2>& smaller : smaller_tabs(*tab)) {
          if (const double size = area_of(smaller); size > most && is_free(smaller, tab)) {
            most = size;
            best = std::move(smaller);
          }
        }
        if (!best.empty()) {
          tab->polygon = std::move(best);
        }
      }
    }
  }

  /// The tab with ends of its base left out, with flatter sides, lower.
  [[nodiscard]] std::vector<std::vector<Vec2>> smaller_tabs(const unfold::Tab& tab) const {
    constexpr double shortest_base_mm = 3.0;
    const Vec2 from = tab.polygon[1];
    const double base = length(tab.polygon[0] - from);
    const Vec2 u = (tab.polygon[0] - from) / base;
    const Vec2 up = -perpendicular(u);
    std::vector<Vec2> shape;
    double height = 0.0;
    for (const Vec2 p : tab.polygon) {
      shape.push_back({dot(p - from, u), dot(p - from, up)});
      height = std::max(height, shape.back().y);
    }
    std::vector<std::vector<Vec2>> found;
    const double t = board_.thickness_mm;
    for (const double left : {0.0, t, 2.0 * t}) {
      for (const double right : {0.0, t, 2.0 * t}) {
        for (const double cotangent : {0.0, 0.6, 1.0, 1.7}) {
          for (const double fraction : {1.0, 0.7, 0.5}) {
            if (base - left - right < shortest_base_mm) {
              continue;
            }
            std::vector<Vec2> cut = kept(shape, {left, 0.0}, {1.0, -cotangent});
            cut = kept(cut, {base - right, 0.0}, {-1.0, -cotangent});
            cut = kept(cut, {0.0, fraction * height}, {0.0, -1.0});
            if (auto polygon = on_base(cut)) {
              for (Vec2& p : *polygon) {
                p = from + p.x * u + p.y * up;
              }
              found.push_back(std::move(*polygon));
            }
          }
        }
      }
    }
    return found;
  }

  /// The part of a convex polygon on the side of `at` that `inward` points to.
  static std::vector<Vec2> kept(const std::vector<Vec2>& polygon, Vec2 at, Vec2 inward) {
    return part_where(polygon, [&](Vec2 p) { return dot(p - at, inward); });
  }

  /// Turned so that its first two corners are those on the base; none where it has no such side or is a
  /// crumb.
  static std::optional<std::vector<Vec2>> on_base(std::vector<Vec2> polygon) {
    constexpr double least_mm2 = 4.0;
    constexpr double on_base_mm = 1e-6;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 a = polygon[i];
      const Vec2 b = polygon[(i + 1) % polygon.size()];
      if (a.y < on_base_mm && b.y < on_base_mm && length(b - a) > 0.1) {
        std::ranges::rotate(polygon, polygon.begin() + static_cast<std::ptrdiff_t>(i));
        return area_of(polygon) > least_mm2 ? std::optional(polygon) : std::nullopt;
      }
    }
    return std::nullopt;
  }

  static double area_of(const std::vector<Vec2>& polygon) { return 0.5 * std::abs(doubled_area(polygon)); }
  /// Convex polygons, by separating lines along their sides; what only touches doesn't overlap.
  static bool polygons_overlap(std::span<const Vec2> a, std::span<const Vec2> b) {
    constexpr double touch_mm = 0.005;
    const auto separates = [&](std::span<const Vec2> one, std::span<const Vec2> other) {
      for (std::size_t i = 0; i < one.size(); ++i) {
        const Vec2 from = one[i];
        const Vec2 along = one[(i + 1) % one.size()] - from;
        const double size = length(along);
        const auto beyond = [&](Vec2 p) { return cross(along, p - from) <= touch_mm * size; };
        if (size > 0.0 && std::ranges::all_of(other, beyond)) {
          return true;
        }
      }
      return false;
    };
    return !separates(a, b) && !separates(b, a);
  }

  /// Whether faces or tabs of the piece overlap: their areas add up to more than they cover.
  [[nodiscard]] bool lies_on_itself(PieceId piece) const {
    constexpr double cells_per_mm = 1e4;
    using Polygon = planar::polygon_data<int>;
    planar::polygon_set_data<int> set;
    double sum = 0.0;
    const auto add = [&](const auto& points) {
      std::vector<planar::point_data<int>> corners;
      for (const Vec2 p : points) {
        corners.emplace_back(static_cast<int>(std::lround(cells_per_mm * p.x)),
                             static_cast<int>(std::lround(cells_per_mm * p.y)));
      }
      const Polygon polygon(corners.begin(), corners.end());
      sum += static_cast<double>(planar::area(polygon));
      set.insert(polygon);
    };
    double turned = 0.0;
    for (const FaceId face : nets_.pieces[piece].faces) {
      const auto& f = result_.flat[face];
      turned = std::min(turned, cross(f[1] - f[0], f[2] - f[0]));
      add(f);
    }
    for (const TabId tab : tabs_of_[piece]) {
      add(result_.tabs[tab].polygon);
    }
    const double covered = static_cast<double>(planar::area(set));
    return turned < -overlap_mm2 || sum - covered > overlap_mm2 * cells_per_mm * cells_per_mm;
  }

  const Surface& surface_;
  const Nets& nets_;
  Board board_;
  Nets result_;
  DisjointSets plates_;  ///< of faces
  std::map<CornerId, const unfold::Tab*> tab_at_;
  IdVector<PieceId, std::vector<TabId>> tabs_of_;
  std::map<CornerId, double> changes_;  ///< of the sides of the plates of one piece
};

}  // namespace

double side_change(BoardSide side, double angle, const Board& board) {
  const double t = board.thickness_mm;
  const double h = board.hinge == Hinge::back ? t : board.hinge == Hinge::middle ? 0.5 * t : 0.0;
  const double s = angle < 0.0 ? 1.0 : -1.0;
  const double fold = std::abs(angle);
  const double most = most_thicknesses * t;
  const double half = elementary::tan(0.5 * std::min(fold, 0.99 * std::numbers::pi));
  if (t < thinnest_board_mm && side != BoardSide::tab_base) {
    return 0.0;
  }
  switch (side) {
    case BoardSide::fold:
      return -s * std::min(h * half, most);
    case BoardSide::tab_base:
      return fold < slight_angle ? -s * t * half : -s * (thickness_along(t, fold) + std::min(h * half, most));
    case BoardSide::tab_target: {
      const double behind = fold < slight_angle ? 0.0 : std::clamp(t / elementary::tan(fold), -most, most);
      return s > 0.0 ? -std::max(0.0, -behind) : -std::max(0.0, behind);
    }
    case BoardSide::mitre:
      return s > 0.0 ? -std::min(t * half, most) : 0.0;
    case BoardSide::border:
      break;
  }
  return 0.0;
}

Nets thick_nets(const prepare::Prepared& model, const Nets& nets, const Board& board, ThickReport* report) {
  if (!(board.thickness_mm > 0.0)) {
    return nets;
  }
  Thickener thickener(model, nets, board);
  Nets made = thickener.made();
  if (report != nullptr) {
    *report = thickener.report;
  }
  return made;
}

}  // namespace ridgecraft::export_
