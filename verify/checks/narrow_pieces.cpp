// SPDX-License-Identifier: GPL-3.0-or-later
// The figure narrow_pieces: what no knife cuts out, though it might hang on another piece.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/convex_hull.hpp"
#include "verify/checks/checks.hpp"
#include "verify/file/tolerance.hpp"

namespace ridgecraft::verify {
namespace {

/// The distance of the two parallel lines between which these corners of a convex polygon lie, at its least.
double width_of(const std::vector<Vec2>& hull) {
  double least = hull.size() < 3 ? 0.0 : HUGE_VAL;
  for (std::size_t i = 0; i < hull.size() && hull.size() >= 3; ++i) {
    const Vec2 along = hull[(i + 1) % hull.size()] - hull[i];
    double most = 0.0;
    for (const Vec2 p : hull) {
      most = std::max(most, cross(along, p - hull[i]));
    }
    least = std::min(least, most / length(along));
  }
  return least;
}

}  // namespace

void count_narrow_pieces(const Case& given, Findings& findings) {
  const File& file = given.file;
  std::vector<std::vector<Vec2>> corners(file.pieces.size());
  for (Index face = 0; face < file.faces.faces(); ++face) {
    for (const Vec2 p : file.polygon(face)) {
      corners[file.face_piece[face]].push_back(p);
    }
  }
  const auto piece_of = [&](Index edge) {
    return file.face_piece[file.faces.face(given.relations.sides_of(edge).front())];
  };
  std::vector<char> meets_another(file.pieces.size(), 0);
  for (const Join& join : file.joins) {
    const Index first = piece_of(join.edges[0]);
    const Index second = piece_of(join.edges[1]);
    if (first != second) {
      meets_another[first] = meets_another[second] = 1;
    }
  }
  for (Index piece = 0; piece < file.pieces.size(); ++piece) {
    const bool narrow =
        meets_another[piece] != 0 && width_of(convex_hull(std::move(corners[piece]))) < least_piece_mm;
    findings.figures().narrow_pieces += narrow ? 1 : 0;
  }
}

}  // namespace ridgecraft::verify
