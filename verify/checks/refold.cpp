// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 6: every piece, folded by its stated angles, is the model's surface.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "verify/checks/checks.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/geometry/rigid_motion.hpp"

namespace ridgecraft::verify {
namespace {

/// Across a side the neighbour is turned about that side: a mountain (negative angle) bends it away from the
/// printed side, which faces the viewer.
Motion fold_about(const File& file, Index side) {
  const Vec2 tail = file.points[file.faces.tail(side)];
  const Vec2 along = file.points[file.faces.head(side)] - tail;
  const double angle = file.edges[file.side_edge[side]].angle_deg * std::numbers::pi / 180.0;
  const Turn turn = Turn::about(normalized(Vec3{along.x, along.y, 0.0}), -angle);
  const Vec3 fixed{tail.x, tail.y, 0.0};
  return {turn, fixed - turn(fixed)};
}

/// Faces that folds connect, each with the motion that brings it from the plane to its place beside the
/// first.
struct Folded {
  std::vector<Index> faces;
  std::vector<Motion> motions;
};

/// Folds everything that is connected with a face; faces that are done are marked.
Folded fold_from(const Case& given, Index start, std::vector<bool>& done) {
  const File& file = given.file;
  const Relations& relations = given.relations;
  const Context& context = given.context;
  Folded folded{{start}, {Motion{}}};
  done[start] = true;
  for (std::size_t at = 0; at < folded.faces.size(); ++at) {
    context.check();
    const Index face = folded.faces[at];
    for (Index side = file.faces.first(face); side < file.faces.first(face) + file.faces.size(face); ++side) {
      const Index twin = relations.fold_twin[side];
      if (twin == none || done[file.faces.face(twin)]) {
        continue;
      }
      const Motion fold = fold_about(file, side);
      const Motion& parent = folded.motions[at];
      const Motion child{parent.turn * fold.turn, parent(fold.shift)};
      done[file.faces.face(twin)] = true;
      folded.faces.push_back(file.faces.face(twin));
      folded.motions.push_back(child);
    }
  }
  return folded;
}

/// Corners of the folded faces, and where the model has them.
struct FoldedCorners {
  std::vector<Vec3> folded, model;
  std::vector<Index> side;
};

FoldedCorners corners_of(const Case& given, const Folded& folded) {
  const File& file = given.file;
  const Relations& relations = given.relations;
  FoldedCorners corners;
  for (std::size_t i = 0; i < folded.faces.size(); ++i) {
    const Index face = folded.faces[i];
    if (!relations.corners_match[face]) {
      continue;  // promise 1 says so
    }
    const std::span<const Index> targets = file.model.faces.vertices(file.face_model[face]);
    for (Index k = 0; k < targets.size(); ++k) {
      const Vec2 p = file.points[file.faces.vertices(face)[k]];
      corners.folded.push_back(folded.motions[i]({p.x, p.y, 0.0}));
      corners.model.push_back(file.model.points[targets[k]]);
      corners.side.push_back(file.faces.first(face) + k);
    }
  }
  return corners;
}

void check_corners(const Case& given, const FoldedCorners& corners, Findings& findings) {
  if (corners.folded.empty()) {
    return;
  }
  const File& file = given.file;
  const Motion motion = best_motion(corners.folded, corners.model);
  double worst = 0.0;
  Index where = 0;
  for (Index i = 0; i < corners.folded.size(); ++i) {
    const double distance = length(motion(corners.folded[i]) - corners.model[i]);
    if (distance > worst) {
      worst = distance;
      where = i;
    }
  }
  double& figure = findings.figures().max_refold_error_mm;
  figure = std::fmax(figure, worst);
  if (worst > position_tolerance_share * file.model.size) {
    const Index face = file.faces.face(corners.side[where]);
    findings.add(Promise::refolds,
                 {{"piece", file.face_piece[face]}, {"vertex", file.faces.tail(corners.side[where])}}, [&] {
                   return fmt::format(
                       "folded, {} is not the model's surface: a corner of face {} is {:.4g} mm away "
                       "from where model face {} has it",
                       piece_name(file, file.face_piece[face]), face, worst, file.face_model[face]);
                 });
  }
}

}  // namespace

void check_refold(const Case& given, Findings& findings) {
  std::vector<bool> done(given.file.faces.faces(), false);
  for (Index face = 0; face < given.file.faces.faces(); ++face) {
    if (!done[face]) {
      check_corners(given, corners_of(given, fold_from(given, face, done)), findings);
    }
  }
}

}  // namespace ridgecraft::verify
