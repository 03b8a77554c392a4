// SPDX-License-Identifier: GPL-3.0-or-later
// Promises 6 and 7: folded nets are the model, and the order in which they are folded.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "verify/checks/checks.hpp"
#include "verify/file/relations.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/geometry/geometry.hpp"

namespace ridgecraft::verify {

// Promise 6: every piece, folded by its stated angles, is the model's surface.

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

/// Faces that folds connect, each with the motion that brings it from the plane to its place next to the
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
  if (worst > position_tolerance_fraction * file.model.size) {
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

// Promise 7: the folds of each piece, each once, in an order in which paper can be folded.

class OrderCheck {
 public:
  OrderCheck(const Case& given, Findings& findings)
      : file_(given.file),
        relations_(given.relations),
        findings_(findings),
        plates_(find_plates(file_, relations_, still_fold_deg)),
        creases_(find_creases(file_, relations_, plates_)),
        step_of_(file_.edges.size(), none) {}

  void run() {
    for (Index piece = 0; piece < file_.pieces.size(); ++piece) {
      sound_ = true;
      check_steps(piece);
      check_all_there(piece);
      check_whole_creases(piece);
      if (sound_ && file_.is_ours()) {
        check_way(piece);
      }
    }
  }

 private:
  using Steps = std::vector<std::vector<Index>>;

  [[nodiscard]] const Steps& steps(Index piece) const { return (*file_.fold_order)[piece]; }

  void add(Index piece, Index edge, const std::string& words) {
    sound_ = false;
    findings_.add(Promise::fold_order, {{"piece", piece}, {"edge", edge}},
                  [&] { return fmt::format("the fold order of {} {}", piece_name(file_, piece), words); });
  }

  void check_steps(Index piece) {
    for (std::size_t step = 0; step < steps(piece).size(); ++step) {
      for (const Index edge : steps(piece)[step]) {
        const Index own = piece_of_edge(file_, relations_, edge);
        if (file_.edges[edge].assignment == Assignment::cut) {
          add(piece, edge, fmt::format("names edge {}, which is no fold", edge));
        } else if (own != piece) {
          add(piece, edge, fmt::format("names edge {} of {}", edge, piece_name(file_, own)));
        } else if (step_of_[edge] != none) {
          add(piece, edge, fmt::format("names edge {} twice", edge));
        } else if (file_.is_ours() && file_.edges[edge].assignment == Assignment::flat) {
          add(piece, edge, fmt::format("names edge {}, which stays flat", edge));
        }
        step_of_[edge] = static_cast<Index>(step);
      }
    }
  }

  void check_all_there(Index piece) {
    for (const Crease& crease : creases_[piece]) {
      for (const Index edge : crease.edges) {
        if (step_of_[edge] == none) {
          add(piece, edge, fmt::format("lacks the fold at edge {}", edge));
        }
      }
    }
  }

  /// Folds between the same two stiff plates can only be made together.
  void check_whole_creases(Index piece) {
    for (const Crease& crease : creases_[piece]) {
      for (const Index edge : crease.edges) {
        const Index first = step_of_[crease.edges.front()];
        if (first != none && step_of_[edge] != none && step_of_[edge] != first) {
          add(piece, edge,
              fmt::format("folds edges {} and {} one after the other, which are one crease",
                          crease.edges.front(), edge));
        }
      }
    }
  }

  /// This program folds a piece all at a time or crease by crease. Plates that close a circle have creases
  /// that move together.
  void check_way(Index piece) {
    std::set<Index> plates;
    std::map<Index, Index> crease_of_step;  // the first edge of one
    for (const Crease& crease : creases_[piece]) {
      plates.insert({crease.first, crease.second});
    }
    if (steps(piece).size() < 2 || plates.size() != creases_[piece].size() + 1) {
      return;
    }
    for (const Crease& crease : creases_[piece]) {
      const Index edge = crease.edges.front();
      if (!crease_of_step.emplace(step_of_[edge], edge).second) {
        add(piece, edge, "folds several creases in one of many steps");
        return;
      }
    }
    // Edges that were to be kept may be in the way of the split that this takes.
    const Settings& settings = file_.settings;
    if (is_true(settings, "fold_linear") && settings.find("keep") == nullptr &&
        settings.find("from") == nullptr) {
      add(piece, creases_[piece].front().edges.front(),
          fmt::format("has {} steps, where the settings ask for all creases together", steps(piece).size()));
    }
  }

  const File& file_;
  const Relations& relations_;
  Findings& findings_;
  Plates plates_;
  std::vector<std::vector<Crease>> creases_;  ///< of each piece
  std::vector<Index> step_of_;                ///< per edge: the last step that names it
  bool sound_ = true;                         ///< so far, of the piece that is looked at
};

// Promise 7, in motion: do the pieces run through themselves while they are folded in their order?

using Corners = std::array<Vec3, 3>;
using Pair = std::pair<Index, Index>;

/// A part of a face, laid flat.
struct FlatTriangle {
  std::array<Vec2, 3> corners;
  Index plate = 0;  ///< local number
};

/// The triangle less a seam along its sides; false where nothing is left.
bool without_seam(const std::array<Vec2, 3>& t, double seam, std::array<Vec2, 3>& rest) {
  const std::array<double, 3> opposite = {length(t[2] - t[1]), length(t[0] - t[2]), length(t[1] - t[0])};
  const double around = opposite[0] + opposite[1] + opposite[2];
  const double inradius = cross(t[1] - t[0], t[2] - t[0]) / around;
  if (!(inradius > seam)) {
    return false;
  }
  // Towards the middle of its inscribed circle all sides move alike.
  const Vec2 middle = (opposite[0] * t[0] + opposite[1] * t[1] + opposite[2] * t[2]) / around;
  for (std::size_t k = 0; k < 3; ++k) {
    rest[k] = middle + (1.0 - seam / inradius) * (t[k] - middle);
  }
  return true;
}

/// Whether all corners of one triangle lie on one side of those of the other, seen along an axis.
bool apart(Vec3 axis, const Corners& f, const Corners& g) {
  const auto [f_low, f_high] = std::minmax({dot(axis, f[0]), dot(axis, f[1]), dot(axis, f[2])});
  const auto [g_low, g_high] = std::minmax({dot(axis, g[0]), dot(axis, g[1]), dot(axis, g[2])});
  return f_high < g_low || g_high < f_low;
}

/// By separating axes: normals, products of sides, normals of sides within a plane (Ericson: Real-time
/// collision detection, 2005, section 5.2.1).
bool meet(const Corners& f, const Corners& g) {
  const auto side = [](const Corners& t, std::size_t k) { return t[(k + 1) % 3] - t[k]; };
  const Vec3 f_normal = cross(side(f, 0), side(f, 1));
  const Vec3 g_normal = cross(side(g, 0), side(g, 1));
  if (apart(f_normal, f, g) || apart(g_normal, f, g)) {
    return false;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (apart(cross(f_normal, side(f, i)), f, g) || apart(cross(g_normal, side(g, i)), f, g)) {
      return false;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (apart(cross(side(f, i), side(g, k)), f, g)) {
        return false;
      }
    }
  }
  return true;
}

/// One piece: a tree of plates with hinges between them.
class Folder {
 public:
  Folder(const Case& given, const Plates& plates, const std::vector<Crease>& creases,
         const std::vector<Index>& faces)
      : given_(given), file_(given.file), of_face_(plates.plate), creases_(creases) {
    number_plates(faces);
    cut_faces(faces);
    hang_plates();
    for (const Hinge& h : hinges_) {
      hinged_.push_back(std::minmax(h.inner, h.outer));
    }
    std::sort(hinged_.begin(), hinged_.end());
  }

  /// A piece with a circle of plates can't be moved hinge by hinge.
  [[nodiscard]] bool is_tree() const {
    return hinges_.size() == creases_.size() && hinges_.size() + 1 == plates_;
  }
  [[nodiscard]] std::size_t size() const { return triangles_.size(); }

  /// Whether faces meet at some stage of the steps; each crease is in one of them.
  [[nodiscard]] bool runs_through_itself(const std::vector<std::vector<Index>>& creases_of_step) {
    std::vector<double> fraction(creases_.size(), 1.0);
    always_ = meetings(fraction, final_seam_mm);
    std::fill(fraction.begin(), fraction.end(), 0.0);
    for (const std::vector<Index>& step : creases_of_step) {
      for (int look = 1; look <= looks_at_step; ++look) {
        given_.context.check();
        const double now = static_cast<double>(look) / looks_at_step;
        for (const Index crease : step) {
          fraction[crease] = now;
        }
        if (!meetings(fraction, fold_seam_mm).empty()) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  struct Hinge {
    Index crease = 0, inner = 0, outer = 0;  ///< plates by local numbers
    Vec2 start, along;                       ///< the latter of length 1
    double angle = 0.0;                      ///< radians, about `along`
  };

  void number_plates(const std::vector<Index>& faces) {
    for (const Index face : faces) {
      known_.push_back(of_face_[face]);
    }
    std::sort(known_.begin(), known_.end());
    known_.erase(std::unique(known_.begin(), known_.end()), known_.end());
    plates_ = known_.size();
  }
  [[nodiscard]] Index local(Index plate) const {
    return static_cast<Index>(std::lower_bound(known_.begin(), known_.end(), plate) - known_.begin());
  }

  void cut_faces(const std::vector<Index>& faces) {
    for (const Index face : faces) {
      for (const Polygon& part : convex_parts(file_.polygon(face), given_.context)) {
        for (std::size_t k = 2; k < part.size(); ++k) {
          triangles_.push_back({{part[0], part[k - 1], part[k]}, local(of_face_[face])});
        }
      }
    }
  }

  /// From plate 0 over the creases, breadth first.
  void hang_plates() {
    std::vector<std::vector<Index>> at(plates_);
    for (Index c = 0; c < creases_.size(); ++c) {
      at[local(creases_[c].first)].push_back(c);
      at[local(creases_[c].second)].push_back(c);
    }
    std::vector<bool> hung(plates_, false);
    std::vector<Index> reached{0};
    hung[0] = true;
    for (std::size_t i = 0; i < reached.size(); ++i) {
      for (const Index c : at[reached[i]]) {
        const Index one = local(creases_[c].first);
        const Index outer = one == reached[i] ? local(creases_[c].second) : one;
        if (!hung[outer]) {
          hung[outer] = true;
          hinges_.push_back(hinge(c, reached[i], outer));
          reached.push_back(outer);
        }
      }
    }
  }

  [[nodiscard]] Hinge hinge(Index c, Index inner, Index outer) const {
    const Index edge = creases_[c].edges.front();
    const auto sides = given_.relations.sides_of(edge);
    // As the face of the inner plate has it.
    const Index side = local(of_face_[file_.faces.face(sides[0])]) == inner ? sides[0] : sides[1];
    const Vec2 start = file_.points[file_.faces.tail(side)];
    const Vec2 along = file_.points[file_.faces.head(side)] - start;
    return {c,
            inner,
            outer,
            start,
            along / length(along),
            -file_.edges[edge].angle_deg * std::numbers::pi / 180.0};
  }

  /// Pairs of faces that meet when each crease is folded by its share; those that always do left out.
  [[nodiscard]] std::vector<Pair> meetings(const std::vector<double>& fraction, double seam) const {
    std::vector<Motion> motion(plates_);
    for (const Hinge& h : hinges_) {
      const Turn turn = Turn::about({h.along.x, h.along.y, 0.0}, fraction[h.crease] * h.angle);
      const Vec3 fixed{h.start.x, h.start.y, 0.0};
      const Motion fold{turn, fixed - turn(fixed)};
      motion[h.outer] = {motion[h.inner].turn * fold.turn, motion[h.inner](fold.shift)};
    }
    std::vector<Corners> solid;
    std::vector<Index> number;
    std::vector<Box2> boxes;
    for (Index i = 0; i < triangles_.size(); ++i) {
      std::array<Vec2, 3> rest;
      if (!without_seam(triangles_[i].corners, seam, rest)) {
        continue;
      }
      Corners& corners = solid.emplace_back();
      Box2& box = boxes.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = motion[triangles_[i].plate]({rest[k].x, rest[k].y, 0.0});
        box.add({corners[k].x, corners[k].y});
      }
      // A face that stands upright has a box without area, which would meet nothing.
      box = grown(box, seam);
      number.push_back(i);
    }
    return pairs_that_meet(solid, number, boxes);
  }

  [[nodiscard]] std::vector<Pair> pairs_that_meet(const std::vector<Corners>& solid,
                                                  const std::vector<Index>& number,
                                                  const std::vector<Box2>& boxes) const {
    std::vector<Pair> found;
    const BoxFinder tree(boxes);
    for (Index i = 0; i < solid.size(); ++i) {
      tree.for_each_overlapping(boxes[i], [&](std::size_t k) {
        if (k > i && counts(number[i], number[k]) && meet(solid[i], solid[k])) {
          found.emplace_back(number[i], number[k]);
        }
      });
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  /// Plates that one crease joins can't run through each other, and what meets in the folded piece belongs to
  /// a model that runs through itself.
  [[nodiscard]] bool counts(Index i, Index k) const {
    const auto plates = std::minmax(triangles_[i].plate, triangles_[k].plate);
    return plates.first != plates.second && !std::binary_search(always_.begin(), always_.end(), Pair{i, k}) &&
           !std::binary_search(hinged_.begin(), hinged_.end(), Pair(plates));
  }

  const Case& given_;
  const File& file_;
  const std::vector<Index>& of_face_;  ///< plate of each face of the file
  const std::vector<Crease>& creases_;
  std::vector<Index> known_;  ///< plates of the piece, ascending
  std::size_t plates_ = 0;
  std::vector<FlatTriangle> triangles_;
  std::vector<Hinge> hinges_;  ///< inner ones before those beyond them
  std::vector<Pair> hinged_;   ///< plates, ascending
  std::vector<Pair> always_;   ///< triangles, ascending
};

/// Which creases each step folds. `step_of` has an entry per edge and is kept between pieces.
std::vector<std::vector<Index>> creases_of_steps(const std::vector<std::vector<Index>>& steps,
                                                 const std::vector<Crease>& creases,
                                                 std::vector<Index>& step_of) {
  for (Index step = 0; step < steps.size(); ++step) {
    for (const Index edge : steps[step]) {
      step_of[edge] = step;
    }
  }
  std::vector<std::vector<Index>> result(steps.size());
  for (Index c = 0; c < creases.size(); ++c) {
    result[step_of[creases[c].edges.front()]].push_back(c);
  }
  return result;
}

/// This program tells an order in which nothing is in the way wherever it found one, and goes from the tips
/// inwards where it found none, too.
bool has_to_work(const std::vector<std::vector<Index>>& creases_of_step, const std::vector<Crease>& creases) {
  std::vector<const Crease*> order;
  for (const std::vector<Index>& step : creases_of_step) {
    for (const Index c : step) {
      order.push_back(&creases[c]);
    }
  }
  return creases_of_step.size() == 1 || (!order.empty() && !goes_inwards(order));
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

void check_fold_order(const Case& given, Findings& findings) {
  if (given.file.fold_order) {
    OrderCheck(given, findings).run();
  }
}

void check_fold_motion(const Case& given, Findings& findings) {
  const File& file = given.file;
  const bool broken =
      findings.has(Promise::lengths) || findings.has(Promise::joins) || findings.has(Promise::fold_order);
  if (!file.fold_order || broken) {
    return;
  }
  const Plates plates = find_plates(file, given.relations, still_fold_deg);
  const auto creases = find_creases(file, given.relations, plates);
  std::vector<std::vector<Index>> faces(file.pieces.size());
  for (Index face = 0; face < file.faces.faces(); ++face) {
    faces[file.face_piece[face]].push_back(face);
  }
  std::vector<Index> step_of(file.edges.size(), 0);
  FoldingFigures& figures = findings.folding();
  for (Index piece = 0; piece < file.pieces.size(); ++piece) {
    const auto steps = creases_of_steps((*file.fold_order)[piece], creases[piece], step_of);
    Folder folder(given, plates, creases[piece], faces[piece]);
    if (!folder.is_tree() || folder.size() * steps.size() > most_fold_work) {
      ++figures.not_tried;
    } else if (!steps.empty() && folder.runs_through_itself(steps)) {
      figures.with_care.push_back(file.pieces[piece].name);
      if (file.is_ours() && has_to_work(steps, creases[piece])) {
        findings.add(Promise::fold_order, {{"piece", piece}}, [&] {
          return fmt::format("{} runs through itself when it is folded in its order",
                             piece_name(file, piece));
        });
      }
    }
  }
}

}  // namespace ridgecraft::verify
