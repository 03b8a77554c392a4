// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 8: where the file says that a piece is glued onto another one, the two touch there; and where faces
// of pieces that no join connects lie on each other, it says so.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "base/boxes.hpp"
#include "base/disjoint_sets.hpp"
#include "base/geometry.hpp"
#include "verify/checks/checks.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/geometry/geometry.hpp"

namespace ridgecraft::verify {
namespace {

/// A triangle of a piece, flat and in space.
struct FoldedTriangle {
  std::array<Vec2, 3> flat;
  Triangle3 solid;
};

/// Barycentric coordinates; nothing for a triangle without area.
std::optional<std::array<double, 3>> weights_at(const std::array<Vec2, 3>& t, Vec2 p) {
  const double area = cross(t[1] - t[0], t[2] - t[0]);
  if (!(std::abs(area) > 0.0)) {
    return std::nullopt;
  }
  const double second = cross(p - t[0], t[2] - t[0]) / area;
  const double third = cross(t[1] - t[0], p - t[0]) / area;
  return std::array<double, 3>{1.0 - second - third, second, third};
}

double distance_to(const std::array<Vec2, 3>& t, Vec2 p) {
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 end = t[(k + 1) % 3];
    nearest = std::min(nearest, distance_to_segment(p, t[k], end));
    inside = inside && cross(end - t[k], p - t[k]) >= 0.0;
  }
  return inside ? 0.0 : nearest;
}

class GlueCheck {
 public:
  GlueCheck(const Case& given, Findings& findings)
      : given_(given), file_(given.file), findings_(findings), bodies_(file_.model.faces.faces()) {}

  void run() {
    if (count_bodies() < 2 && file_.glue.empty()) {
      return;
    }
    lay_out_bodies();
    std::set<std::pair<Index, Index>> stated;
    for (Index i = 0; i < file_.glue.size(); ++i) {
      const GlueOutline& spot = file_.glue[i];
      if (body_of_piece_[spot.piece] == none || body_of_piece_[spot.other] == none ||
          body_of_piece_[spot.piece] == body_of_piece_[spot.other]) {
        add(i, "names two pieces of one body");
        continue;
      }
      stated.insert(std::minmax(body_of_piece_[spot.piece], body_of_piece_[spot.other]));
      check_spot(i);
    }
    if (file_.is_ours() && file_.settings.find("paper_mm") != nullptr) {
      check_unstated(stated);
    }
  }

 private:
  void add(Index spot, std::string_view what) {
    findings_.add(Promise::statements, {{"glue", spot}, {"piece", file_.glue[spot].piece}}, [&] {
      return fmt::format("the glue spot for {} on {} {}", piece_name(file_, file_.glue[spot].other),
                         piece_name(file_, file_.glue[spot].piece), what);
    });
  }

  std::size_t count_bodies() {
    const FaceList& faces = file_.model.faces;
    std::size_t count = faces.faces();
    for (Index side = 0; side < faces.sides(); ++side) {
      const Index twin = file_.model.twin[side];
      if (twin != none && bodies_.find(faces.face(side)) != bodies_.find(faces.face(twin))) {
        bodies_.join(faces.face(side), faces.face(twin));
        --count;
      }
    }
    return count;
  }

  void lay_out_bodies() {
    body_of_piece_.assign(file_.pieces.size(), none);
    std::map<Index, std::vector<Triangle3>> triangles;
    pairs_.resize(file_.pieces.size());
    for (Index face = 0; face < file_.faces.faces(); ++face) {
      const Index solid = file_.face_model[face];
      if (!given_.relations.corners_match[face]) {
        continue;
      }
      const Index piece = file_.face_piece[face];
      body_of_piece_[piece] = bodies_.find(solid);
      const auto flat = file_.faces.vertices(face);
      const auto corners = file_.model.faces.vertices(solid);
      for (std::size_t k = 2; k < flat.size(); ++k) {
        FoldedTriangle pair;
        const std::array<std::size_t, 3> fan{0, k - 1, k};
        for (std::size_t c = 0; c < 3; ++c) {
          pair.flat[c] = file_.points[flat[fan[c]]];
          pair.solid[c] = file_.model.points[corners[fan[c]]];
        }
        triangles[body_of_piece_[piece]].push_back(pair.solid);
        pairs_[piece].push_back(pair);
      }
    }
    for (const auto& [body, list] : triangles) {
      trees_.emplace(body, SurfaceTree(list));
      Box3 box;
      for (const Triangle3& triangle : list) {
        for (const Vec3 p : triangle) {
          box.add(p);
        }
      }
      boxes_.emplace(body, box);
    }
    for (auto& [body, list] : closed_openings()) {
      openings_.emplace(body, SurfaceTree(list));
    }
  }

  /// Triangles from the middle of each opening of a body to the sides of its border, where that is flat.
  [[nodiscard]] std::map<Index, std::vector<Triangle3>> closed_openings() {
    const FaceList& faces = file_.model.faces;
    const std::vector<Index>& twin = file_.model.twin;
    std::map<Index, std::vector<Triangle3>> closed;
    std::set<Index> seen;
    for (Index first = 0; first < faces.sides(); ++first) {
      std::vector<Index> border;
      for (Index side = first; twin[side] == none && seen.insert(side).second;) {
        border.push_back(side);
        // Turns around its head, face by face, to the next side without a neighbour.
        for (side = faces.next(side); twin[side] != none;) {
          side = faces.next(twin[side]);
        }
      }
      Vec3 middle;
      for (const Index side : border) {
        middle += file_.model.points[faces.tail(side)] / static_cast<double>(border.size());
      }
      Vec3 normal;
      for (const Index side : border) {
        normal += cross(file_.model.points[faces.tail(side)] - middle,
                        file_.model.points[faces.head(side)] - middle);
      }
      const bool flat = length(normal) > 0.0 && std::all_of(border.begin(), border.end(), [&](Index side) {
                          const Vec3 p = file_.model.points[faces.tail(side)] - middle;
                          return std::abs(dot(p, normal)) <= glue_mm * length(normal);
                        });
      for (std::size_t i = 0; flat && i < border.size(); ++i) {
        closed[bodies_.find(faces.face(border[i]))].push_back(
            {middle, file_.model.points[faces.tail(border[i])], file_.model.points[faces.head(border[i])]});
      }
    }
    return closed;
  }

  /// Finds the triangles of a piece by their places in the plane.
  const BoxFinder& finder_of(Index piece) {
    const auto found = finders_.find(piece);
    if (found != finders_.end()) {
      return found->second;
    }
    std::vector<Box2> boxes;
    for (const FoldedTriangle& pair : pairs_[piece]) {
      boxes.push_back(box_of(pair.flat));
    }
    return finders_.emplace(piece, BoxFinder(boxes)).first->second;
  }

  /// How far a point of a piece is from a body when it is folded: nothing where the piece has no paper there.
  /// At a slit it is on either side, as its place isn't known better.
  [[nodiscard]] std::optional<double> distance(Index piece, Vec2 p, Index body) {
    std::optional<double> nearest;
    if (pairs_[piece].empty()) {
      return nearest;
    }
    finder_of(piece).for_each_overlapping(grown(Box2{p, p}, 2.0 * glue_place_mm), [&](std::uint32_t i) {
      const FoldedTriangle& t = pairs_[piece][i];
      const auto weights = weights_at(t.flat, p);
      if (weights && distance_to(t.flat, p) <= glue_place_mm) {
        const Vec3 place =
            (*weights)[0] * t.solid[0] + (*weights)[1] * t.solid[1] + (*weights)[2] * t.solid[2];
        const double away = distance_to_body(body, place);
        nearest = nearest ? std::min(*nearest, away) : away;
      }
    });
    return nearest;
  }

  /// To the nearest place of its faces, or of what closes its openings.
  [[nodiscard]] double distance_to_body(Index body, Vec3 p) const {
    const auto distance = [&](const SurfaceTree& tree) {
      const SurfaceTree::Place guess{tree.triangles().front()[0], 0};
      return length(tree.nearest(p, 0.0, guess).point - p);
    };
    const double from_faces = distance(trees_.at(body));
    const auto opening = openings_.find(body);
    return opening == openings_.end() ? from_faces : std::min(from_faces, distance(opening->second));
  }

  void check_spot(Index number) {
    const GlueOutline& spot = file_.glue[number];
    const Index body = body_of_piece_[spot.other];
    for (const std::vector<Vec2>& outline : spot.outlines) {
      for (std::size_t i = 0; i < outline.size(); ++i) {
        given_.context.check();
        for (const double fraction : {0.0, 0.5}) {
          const Vec2 p = outline[i] + fraction * (outline[(i + 1) % outline.size()] - outline[i]);
          const std::optional<double> away = distance(spot.piece, p, body);
          if (!away) {
            add(number, "reaches beyond its piece");
            return;
          }
          if (*away > glue_gap_mm + glue_place_mm) {
            add(number, fmt::format("is {:.3f} mm away from what is glued there", *away));
            return;
          }
        }
      }
    }
  }

  /// A face of some size whose middle lies on a parallel face of another body.
  void check_unstated(const std::set<std::pair<Index, Index>>& stated) {
    const FaceList& faces = file_.model.faces;
    if (trees_.size() < 2 || faces.faces() > most_pairs / trees_.size()) {
      return;
    }
    for (Index face = 0; face < faces.faces(); ++face) {
      if (given_.relations.area[face] < least_unstated_area) {
        continue;
      }
      given_.context.check();
      const Index body = bodies_.find(face);
      Vec3 middle;
      for (const Index v : faces.vertices(face)) {
        middle += file_.model.points[v] / static_cast<double>(faces.size(face));
      }
      for (const auto& [other, tree] : trees_) {
        if (other == body || !is_near(boxes_.at(other), middle) ||
            stated.contains(std::minmax(body, other))) {
          continue;
        }
        const SurfaceTree::Place at = tree.nearest(middle, 0.0, {tree.triangles().front()[0], 0});
        const Triangle3& t = tree.triangles()[at.triangle];
        const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
        const Vec3 own = given_.relations.normal[face];
        const bool parallel = std::abs(dot(normal, own)) > parallel_cosine * length(normal) * length(own);
        const Vec3 away = middle - at.point;
        if (parallel && length(away) < surely_touching_mm && length(normal) > 2.0 * least_unstated_area &&
            is_well_inside(t, at.point)) {
          findings_.add(Promise::statements, {{"face", face}}, [&] {
            return fmt::format("model face {} lies on a face of another body, and no glue spot says so",
                               face);
          });
          return;
        }
      }
    }
  }

  static bool is_near(const Box3& box, Vec3 p) {
    const auto within = [](double low, double x, double high) {
      return x > low - surely_touching_mm && x < high + surely_touching_mm;
    };
    return within(box.low.x, p.x, box.high.x) && within(box.low.y, p.y, box.high.y) &&
           within(box.low.z, p.z, box.high.z);
  }

  static bool is_well_inside(const Triangle3& t, Vec3 p) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 side = t[(k + 1) % 3] - t[k];
      const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
      if (dot(cross(normal, side), p - t[k]) < inside_mm * length(normal) * length(side)) {
        return false;
      }
    }
    return true;
  }

  /// Much larger than what holds nothing; nearer and flatter than what counts as touching.
  static constexpr double least_unstated_area = 40.0;
  static constexpr double surely_touching_mm = 0.05;
  static constexpr double parallel_cosine = 0.9998;
  static constexpr double inside_mm = 2.0;
  /// Pairs of a face and a body that are looked at: a fraction of a second.
  static constexpr std::size_t most_pairs = 20'000'000;

  const Case& given_;
  const File& file_;
  Findings& findings_;
  DisjointSets bodies_;                             ///< model faces
  std::vector<Index> body_of_piece_;                ///< or none
  std::vector<std::vector<FoldedTriangle>> pairs_;  ///< per piece
  std::map<Index, BoxFinder> finders_;              ///< of the pairs of pieces that spots are on
  std::map<Index, Box3> boxes_;                     ///< per body
  std::map<Index, SurfaceTree> trees_;              ///< per body
  std::map<Index, SurfaceTree> openings_;           ///< per body that has flat ones
};

}  // namespace

void check_glue(const Case& given, Findings& findings) {
  GlueCheck(given, findings).run();
}

}  // namespace ridgecraft::verify
