// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/paint/lost_edges.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "base/boxes.hpp"
#include "base/disjoint_sets.hpp"
#include "base/geometry.hpp"
#include "base/parallel.hpp"
#include "export/page/lines.hpp"
#include "export/page/obstacles.hpp"
#include "export/paint/cells.hpp"

namespace ridgecraft::export_ {
namespace {

/// Lines are looked at in parts of at most this length, mm.
constexpr double part_mm = 0.5;
/// Lines that run side by side nearer than this are one to the eye, mm.
constexpr double apart_mm = 2.0;
/// What is smaller is a speck, mm.
constexpr double smallest_mm = 2.0;
/// Simplification moves an edge that it keeps by up to its deviation, but an edge that is farther away than
/// this is another one, mm.
constexpr double farthest_kept_mm = 3.0;
/// Below this angle lines run side by side: cosine of 40 degrees.
constexpr double same_way = 0.766;
/// A face has the creases of faces that look its way: cosine of 75 degrees.
constexpr double same_side = 0.26;
/// What is so far above a crease hides it, mm: more than rounding, less than paper's thickness.
constexpr double above_mm = 0.1;
/// Lines whose ends are so near to each other are one, mm.
constexpr double same_end_mm = 0.1;
/// Lines keep so far away from texts, mm.
constexpr double text_gap_mm = 0.4;
constexpr std::size_t lost_edge_faces_a_task = 16;

using Stroke = std::array<Vec3, 2>;

/// A part of a crease on a face.
struct Lost {
  FaceId face;
  Stroke stroke;
  std::size_t crease = 0;  ///< in Relief::creases()
};

Box3 box_of(const Stroke& stroke) {
  Box3 box;
  box.add(stroke[0]);
  box.add(stroke[1]);
  return box;
}

BoxTree<Box3> tree_of(const std::vector<Stroke>& strokes) {
  return {strokes.size(), [&](std::uint32_t i) { return box_of(strokes[i]); },
          [&](std::uint32_t i) { return centre(box_of(strokes[i])); }};
}

/// Calls visit(i) for the boxes of a tree within `margin` of a point.
template <class Visit>
void visit_near(const BoxTree<Box3>& tree, Vec3 p, double margin, const Visit& visit) {
  tree.search([&](std::uint32_t node) { return squared_distance(p, tree.box(node)) <= margin * margin; },
              [&](std::uint32_t place) { visit(tree.order()[place]); });
}

/// Whether a stroke runs by a point nearer than `margin`, in about this direction (a unit vector), and not
/// just with its end.
bool runs_beside(const Stroke& stroke, Vec3 p, Vec3 direction, double margin) {
  const Vec3 along = stroke[1] - stroke[0];
  const double size = length(along);
  const double at = size > 0.0 ? dot(p - stroke[0], along) / size : -1.0;
  return at >= 0.0 && at <= size && std::abs(dot(along, direction)) >= same_way * size &&
         length(p - stroke[0] - at / size * along) < margin;
}

/// Of a stroke the stretches whose parts are good, by the middles of the parts.
template <class IsGood>
std::vector<Stroke> good_stretches(const Stroke& stroke, const IsGood& is_good) {
  std::vector<Stroke> stretches;
  const Vec3 along = stroke[1] - stroke[0];
  const double count = std::max(1.0, std::ceil(length(along) / part_mm));
  bool was_good = false;
  for (double i = 0.0; i < count; i += 1.0) {
    const bool good = is_good(stroke[0] + (i + 0.5) / count * along);
    if (good && !was_good) {
      stretches.push_back({stroke[0] + i / count * along, {}});
    }
    if (good) {
      stretches.back()[1] = stroke[0] + (i + 1.0) / count * along;
    }
    was_good = good;
  }
  return stretches;
}

/// Edges of the model that pages have a line for.
std::vector<Stroke> drawn_edges(const prepare::Prepared& model, double hidden_fold_angle) {
  const mesh::Surface& surface = model.model.surface;
  std::vector<Stroke> drawn;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    if (surface.is_border(e) || std::abs(surface.fold_angle(e)) >= hidden_fold_angle) {
      const CornerId side = surface.sides(e)[0];
      drawn.push_back({surface.point(surface.vertex(side)), surface.point(surface.vertex(mesh::next(side)))});
    }
  }
  return drawn;
}

class LostEdges {
 public:
  LostEdges(const prepare::Prepared& model, const mesh::Relief& relief, double reach,
            double hidden_fold_angle)
      : surface_(model.model.surface),
        relief_(relief),
        reach_(reach),
        kept_(std::clamp(model.simplified.deviation_mm, apart_mm, farthest_kept_mm)),
        drawn_(drawn_edges(model, hidden_fold_angle)),
        drawn_tree_(tree_of(drawn_)) {}

  /// Those on one face, whatever lies beside them.
  [[nodiscard]] std::vector<Lost> on_face(FaceId f) const {
    std::vector<Lost> found;
    const Vec3 normal = surface_.normal(f);
    if (normal == Vec3{}) {
      return found;
    }
    relief_.near_box(grown(surface_.bounds(f), reach_), [&](std::uint32_t i) {
      const mesh::Crease& crease = relief_.creases()[i];
      if (std::max(dot(crease.normals[0], normal), dot(crease.normals[1], normal)) < same_side) {
        return;
      }
      if (const auto over = over_face(crease.ends, f)) {
        for (const Stroke& stroke : lost_of(*over, f)) {
          found.push_back({f, stroke, i});
        }
      }
    });
    return found;
  }

 private:
  [[nodiscard]] double height(Vec3 p, FaceId f) const {
    return dot(p - surface_.point(surface_.vertices(f)[0]), surface_.normal(f));
  }

  /// What of a crease lies over or below a face within reach.
  [[nodiscard]] std::optional<Stroke> over_face(const Stroke& crease, FaceId f) const {
    double from = 0.0;
    double to = 1.0;
    const auto keep_below = [&](double a, double b, double most) {  // values at both ends
      if (a > most && b > most) {
        to = -1.0;
      } else if (a > most) {
        from = std::max(from, (a - most) / (a - b));
      } else if (b > most) {
        to = std::min(to, (most - a) / (b - a));
      }
    };
    const Vec3 normal = surface_.normal(f);
    const double a = height(crease[0], f);
    const double b = height(crease[1], f);
    keep_below(a, b, reach_);
    keep_below(-a, -b, reach_);
    for (unsigned k = 0; k < 3; ++k) {
      const Vec3 start = surface_.point(surface_.vertex(mesh::corner(f, k)));
      const Vec3 out = cross(surface_.point(surface_.vertex(mesh::corner(f, (k + 1) % 3))) - start, normal);
      keep_below(dot(crease[0] - start, out), dot(crease[1] - start, out), 0.0);
    }
    if (!(from < to)) {
      return std::nullopt;
    }
    const Vec3 along = crease[1] - crease[0];
    return Stroke{crease[0] + from * along, crease[0] + to * along};
  }

  /// What of a crease over a face is lost, on the face.
  [[nodiscard]] std::vector<Stroke> lost_of(const Stroke& crease, FaceId f) const {
    const Vec3 normal = surface_.normal(f);
    const auto foot = [&](Vec3 p) { return p - height(p, f) * normal; };
    const Vec3 along = foot(crease[1]) - foot(crease[0]);
    if (!(length(along) > same_line_mm)) {
      return {};
    }
    std::vector<Stroke> lost =
        good_stretches(crease, [&](Vec3 p) { return !is_kept(foot(p), normalized(along)) && is_seen(p, f); });
    for (Stroke& stroke : lost) {
      stroke = {foot(stroke[0]), foot(stroke[1])};
    }
    return lost;
  }

  [[nodiscard]] bool is_kept(Vec3 p, Vec3 direction) const {
    bool kept = false;
    visit_near(drawn_tree_, p, kept_,
               [&](std::uint32_t i) { kept = kept || runs_beside(drawn_[i], p, direction, kept_); });
    return kept;
  }

  /// Looking at the face from where the model may reach to.
  [[nodiscard]] bool is_seen(Vec3 p, FaceId f) const {
    const double above = reach_ + above_mm - height(p, f);
    return above <= above_mm ||
           !relief_.hides(p + above * surface_.normal(f), (above_mm - above) * surface_.normal(f));
  }

  const mesh::Surface& surface_;
  const mesh::Relief& relief_;
  double reach_;
  double kept_;
  std::vector<Stroke> drawn_;
  BoxTree<Box3> drawn_tree_;
};

/// Without those that run beside others of longer creases: a crease is as important on each face.
std::vector<mesh::FaceLine> thinned(const std::vector<Lost>& lines,
                                    const std::vector<mesh::Crease>& creases) {
  std::vector<Stroke> strokes;
  for (const Lost& line : lines) {
    strokes.push_back(line.stroke);
  }
  const auto before = [&](std::size_t a, std::size_t b) {
    const auto size = [&](std::size_t i) {
      const Stroke& ends = creases[lines[i].crease].ends;
      return length(ends[1] - ends[0]);
    };
    return size(a) > size(b) || (size(a) == size(b) && lines[a].crease < lines[b].crease);
  };
  std::vector<std::size_t> order(lines.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), before);
  const BoxTree<Box3> tree = tree_of(strokes);
  std::vector<std::vector<Stroke>> taken(lines.size());
  for (const std::size_t i : order) {
    const Vec3 direction = normalized(strokes[i][1] - strokes[i][0]);
    taken[i] = good_stretches(strokes[i], [&](Vec3 p) {
      bool free = true;
      visit_near(tree, p, apart_mm, [&](std::uint32_t other) {
        free = free && std::none_of(taken[other].begin(), taken[other].end(), [&](const Stroke& stroke) {
                 return runs_beside(stroke, p, direction, apart_mm);
               });
      });
      return free;
    });
  }
  std::vector<mesh::FaceLine> left;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (const Stroke& stroke : taken[i]) {
      left.push_back({lines[i].face, stroke});
    }
  }
  return left;
}

/// Without those that are specks with all that they hang together with.
void drop_specks(std::vector<mesh::FaceLine>& lines) {
  std::vector<Stroke> strokes;
  for (const mesh::FaceLine& line : lines) {
    strokes.push_back(line.ends);
  }
  const BoxTree<Box3> tree = tree_of(strokes);
  DisjointSets sets(lines.size());
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    for (const Vec3 end : strokes[i]) {
      visit_near(tree, end, same_end_mm, [&](std::uint32_t other) {
        if (distance_to_segment(end, strokes[other][0], strokes[other][1]) < same_end_mm) {
          sets.join(i, other);
        }
      });
    }
  }
  std::vector<Box3> boxes(lines.size());
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    boxes[sets.find(i)].add(strokes[i][0]);
    boxes[sets.find(i)].add(strokes[i][1]);
  }
  std::vector<mesh::FaceLine> left;
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    if (boxes[sets.find(i)].diagonal() >= smallest_mm) {
      left.push_back(lines[i]);
    }
  }
  lines = std::move(left);
}

/// What of a line lies outside a box.
std::vector<Segment2> outside(const Segment2& line, const TurnedBox& box) {
  const Vec2 up = perpendicular(box.along);
  const auto seen_from_box = [&](Vec2 p) {
    return Vec2{dot(p - box.centre, box.along), dot(p - box.centre, up)};
  };
  const Box2 own{{-box.half_width, -box.half_height}, {box.half_width, box.half_height}};
  const auto within = clipped(Segment2{seen_from_box(line.a), seen_from_box(line.b)}, own);
  if (!within) {
    return {line};
  }
  const auto on_page = [&](Vec2 p) { return box.centre + p.x * box.along + p.y * up; };
  std::vector<Segment2> parts{{line.a, on_page(within->a)}, {on_page(within->b), line.b}};
  std::erase_if(parts, [](const Segment2& part) { return length(part.b - part.a) <= crumb_mm; });
  return parts;
}

}  // namespace

std::vector<mesh::FaceLine> find_lost_edges(const prepare::Prepared& model, const mesh::Relief& relief,
                                            double reach_mm, double hidden_fold_angle,
                                            const Context& context) {
  const std::size_t count = model.model.surface.face_count();
  const LostEdges lost(model, relief, reach_mm, hidden_fold_angle);
  IdVector<FaceId, std::vector<Lost>> found(count);
  do_in_parallel((count + lost_edge_faces_a_task - 1) / lost_edge_faces_a_task, context,
                 [&](std::size_t task, const Context& own) {
                   own.check();
                   for (std::size_t i = task * lost_edge_faces_a_task;
                        i < std::min(count, (task + 1) * lost_edge_faces_a_task); ++i) {
                     found[FaceId(i)] = lost.on_face(FaceId(i));
                   }
                 });
  std::vector<Lost> all;
  for (const FaceId f : ids<FaceId>(count)) {
    all.insert(all.end(), found[f].begin(), found[f].end());
  }
  std::vector<mesh::FaceLine> lines = thinned(all, relief.creases());
  drop_specks(lines);
  return lines;
}

void add_lost_edges(const PieceOnPage& at, PieceDrawing& piece) {
  const std::vector<mesh::FaceLine>& lines = at.model.lost_edges;
  std::vector<TurnedBox> texts;
  for (const Text& text : piece.group.texts) {
    texts.push_back(box_of(text).grown(text_gap_mm));
  }
  const auto place = [&](const mesh::FaceLine& line, Vec3 p) {
    const auto corner = [&](unsigned k) {
      return at.surface().point(at.surface().vertex(mesh::corner(line.face, k)));
    };
    const Vec3 u = corner(1) - corner(0);
    const Vec3 v = corner(2) - corner(0);
    const Vec3 d = p - corner(0);
    const Vec3 doubled = cross(u, v);
    const double second = dot(cross(d, v), doubled) / dot(doubled, doubled);
    const double third = dot(cross(u, d), doubled) / dot(doubled, doubled);
    return (1.0 - second - third) * at.corner(mesh::corner(line.face, 0)) +
           second * at.corner(mesh::corner(line.face, 1)) + third * at.corner(mesh::corner(line.face, 2));
  };
  std::vector<Segment2> strokes;
  for (const FaceId f : at.nets.pieces[at.piece].faces) {
    for (auto line = std::lower_bound(lines.begin(), lines.end(), f,
                                      [](const mesh::FaceLine&l, FaceId face) { return l.face < face; });
         line != lines.end() && line->face == f; ++line) {
      strokes.push_back({place(*line, line->ends[0]), place(*line, line->ends[1])});
    }
  }
  for (const TurnedBox& text : texts) {
    std::vector<Segment2> left;
    for (const Segment2& stroke : strokes) {
      const auto parts = outside(stroke, text);
      left.insert(left.end(), parts.begin(), parts.end());
    }
    strokes = std::move(left);
  }
  for (const Segment2& stroke : strokes) {
    Line line{Layer::paint, {stroke.a, stroke.b}};
    line.like = Layer::paint;
    piece.group.lines.push_back(std::move(line));
  }
}

}  // namespace ridgecraft::export_
