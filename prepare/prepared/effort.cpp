// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/prepared/effort.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/disjoint_sets.hpp"

namespace ridgecraft::prepare {
namespace {

// What a practised maker takes; each seam has two edges to be cut.
constexpr double cut_mm_per_minute = 100.0;
constexpr double glue_mm_per_minute = 60.0;
constexpr double minutes_per_fold = 0.2;
constexpr double minutes_per_join = 0.4;  ///< to find its other edge, and to hold it until the glue does
constexpr double minutes_per_piece = 1.0;
/// With tweezers a fold or a seam takes twice as long as the mean of the two.
constexpr double minutes_per_short_edge = 0.3;
/// A strip of paper is cut and glued behind.
constexpr double minutes_per_weak_join = 0.5;

// What finished nets of 35 models at three levels of detail have in the mean.

constexpr double plates_per_piece = 35.0;
constexpr double area_per_piece_mm2 = 9600.0;
/// The search cuts where edges are short: seams are this share of the mean edge long.
constexpr double seam_to_mean_edge = 0.7;

/// A tab needs so much paper behind its edge to hold, mm; on shorter edges than tweezers_mm one in four
/// doesn't hold, and of the others so many find no room.
constexpr double paper_behind_tab_mm = 4.0;
constexpr double weak_of_short = 0.25;
constexpr double weak_of_others = 0.05;

/// How far a panel reaches from an edge of a face, mm: at least.
double reach(const mesh::Surface& surface, const Panels& panels, CornerId side) {
  const FaceId f = mesh::face_of(side);
  for (const CornerId other : {mesh::next(side), mesh::previous(side)}) {
    const FaceId g = surface.neighbor(other);
    if (g.valid() && panels.panel[g] == panels.panel[f]) {
      return std::numeric_limits<double>::infinity();
    }
  }
  return 2.0 * surface.area(f) / surface.length(surface.edge(side));
}

}  // namespace

double minutes_of(const Work& work) {
  return 2.0 * work.seam_mm / cut_mm_per_minute + work.seam_mm / glue_mm_per_minute +
         minutes_per_fold * work.folds + minutes_per_join * work.joins + minutes_per_piece * work.pieces +
         minutes_per_short_edge * work.short_edges + minutes_per_weak_join * work.weak_joins;
}

Work expected_work(const mesh::Surface& surface, const Panels& panels, const Rolls& rolls,
                   double hidden_fold_angle, double mm) {
  double edges = 0.0;
  double length_mm = 0.0;
  Work work;
  DisjointSets plates(surface.face_count());
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [c, d] = surface.sides(e);
    if (!d.valid()) {
      continue;
    }
    if (panels.panel[mesh::face_of(c)] == panels.panel[mesh::face_of(d)] ||
        std::abs(surface.fold_angle(e)) < hidden_fold_angle || rolls.bends(e)) {
      static_cast<void>(plates.join(mesh::face_of(c).value(), mesh::face_of(d).value()));
      continue;
    }
    const double length = mm * surface.length(e);
    ++edges;
    length_mm += length;
    work.short_edges += length < tweezers_mm ? 1.0 : 0.0;
    const bool narrow =
        mm * std::max(reach(surface, panels, c), reach(surface, panels, d)) < paper_behind_tab_mm;
    const double weak = narrow ? 1.0 : length < tweezers_mm ? weak_of_short : weak_of_others;
    work.weak_joins += weak;
    work.weak_mm += weak * length;
  }
  double count = 0.0;
  for (std::uint32_t f = 0; f < surface.face_count(); ++f) {
    count += plates.find(f) == f ? 1.0 : 0.0;
  }
  // A tree folds all plates of a piece but one.
  work.pieces = std::min(
      count, std::max(static_cast<double>(surface.component_count()),
                      count / plates_per_piece + mm * mm * mesh::total_area(surface) / area_per_piece_mm2));
  work.folds = std::min(edges, count - work.pieces);
  work.joins = edges - work.folds;
  work.seam_mm = edges > 0.0 ? seam_to_mean_edge * work.joins * length_mm / edges : 0.0;
  // Any edge may become a seam.
  work.weak_joins *= edges > 0.0 ? work.joins / edges : 0.0;
  work.weak_mm *= length_mm > 0.0 ? work.seam_mm / length_mm : 0.0;
  return work;
}

Budget aimed_at(const Budget& budget) {
  constexpr double surely = 0.8;
  return {budget.hours, surely * budget.short_share, surely * budget.weak_share};
}

double excess(const Work& work, const Budget& budget) {
  return std::max(0.0, minutes_of(work) / (60.0 * budget.hours) - 1.0) +
         std::max(0.0, work.short_share() / budget.short_share - 1.0) +
         std::max(0.0, work.weak_share() / budget.weak_share - 1.0);
}

}  // namespace ridgecraft::prepare
