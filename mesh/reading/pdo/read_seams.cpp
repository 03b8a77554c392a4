// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/pdo/read_seams.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>

#include "base/printable.hpp"
#include "mesh/reading/pdo/document.hpp"

namespace ridgecraft::mesh {
namespace {

/// Ends of one fold in two faces lie within this share of its length: far more than floats lose, far less
/// than pieces keep apart.
constexpr double same_place = 1e-3;

/// A side of a face: where the nets lay it, from the point of the smaller number to the other.
struct NetSide {
  std::array<std::uint32_t, 2> points;
  std::int32_t piece;
  std::array<Vec2, 2> flat;
};

std::vector<NetSide> sides_of(const PdoObject& object) {
  std::vector<NetSide> sides;
  sides.reserve(object.corners.size());
  for (const PdoFace& face : object.faces) {
    const auto corners = object.corners_of(face);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const PdoCorner* from = &corners[k];
      const PdoCorner* to = &corners[k + 1 < corners.size() ? k + 1 : 0];
      if (from->point == to->point) {
        continue;
      }
      if (from->point > to->point) {
        std::swap(from, to);
      }
      sides.push_back({{from->point, to->point}, face.piece, {from->flat, to->flat}});
    }
  }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const NetSide& a, const NetSide& b) { return a.points < b.points; });
  return sides;
}

bool are_folded(const NetSide& a, const NetSide& b) {
  const double near = same_place * length(a.flat[1] - a.flat[0]);
  return a.piece == b.piece && length(b.flat[0] - a.flat[0]) <= near && length(b.flat[1] - a.flat[1]) <= near;
}

/// Sides of one edge, at least two of them in a piece.
void add_edge(std::span<const NetSide> sides, const PdoObject& object, FileSeams& seams) {
  bool fold = false;
  std::size_t in_pieces = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    in_pieces += sides[i].piece >= 0 ? 1U : 0U;
    // Of an edge with many faces neighbours in the file are looked at.
    fold = fold || (i > 0 && sides[i].piece >= 0 && are_folded(sides[i - 1], sides[i]));
  }
  if (in_pieces >= 2) {
    (fold ? seams.keep : seams.cut)
        .push_back({object.points[sides[0].points[0]], object.points[sides[0].points[1]]});
  }
}

}  // namespace

bool may_have_seams(std::string_view bytes) {
  return is_pdo(bytes);
}

FileSeams read_seams(std::string_view bytes, std::string_view file_name, const Context& context) {
  const Source source{bytes, printable(file_name), {}, context};
  const PdoDocument document = read_pdo_document(source);
  FileSeams seams;
  for (const PdoObject* const object : shown_objects(document)) {
    std::vector<bool> used(object->points.size(), false);
    for (const PdoCorner& corner : object->corners) {
      used[corner.point] = true;
    }
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (used[i]) {
        seams.points.push_back(object->points[i]);
      }
    }
    const std::vector<NetSide> sides = sides_of(*object);
    for (std::size_t from = 0; from < sides.size();) {
      std::size_t to = from + 1;
      while (to < sides.size() && sides[to].points == sides[from].points) {
        ++to;
      }
      add_edge(std::span(sides).subspan(from, to - from), *object, seams);
      from = to;
    }
    context.check();
  }
  if (!document.has_nets || (seams.cut.empty() && seams.keep.empty())) {
    source.refuse(ErrorKind::unreadable_input, "holds no nets: unfold the model in Pepakura Designer first");
  }
  return seams;
}

}  // namespace ridgecraft::mesh
