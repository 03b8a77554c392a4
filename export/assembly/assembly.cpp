// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/assembly/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "base/boxes.hpp"
#include "base/geometry.hpp"
#include "mesh/model/surface_distance.hpp"

namespace ridgecraft::export_ {
namespace {

void number_groups(SeamGraph& graph) {
  std::vector<bool> seen(graph.nodes.size(), false);
  for (const PieceId first : ids<PieceId>(graph.nodes.size())) {
    if (seen[first.value()]) {
      continue;
    }
    std::vector<PieceId> group{first};
    seen[first.value()] = true;
    for (std::size_t i = 0; i < group.size(); ++i) {
      SeamGraph::Node& node = graph.nodes[group[i]];
      node.group = static_cast<std::uint32_t>(graph.groups.size());
      for (const SeamGraph::Seam& seam : node.seams) {
        if (!seen[seam.other.value()]) {
          seen[seam.other.value()] = true;
          group.push_back(seam.other);
        }
      }
    }
    std::sort(group.begin(), group.end());
    graph.groups.push_back(std::move(group));
  }
}

}  // namespace

double SeamGraph::seam_between(PieceId a, PieceId b) const {
  const auto& seams = nodes[a].seams;
  const auto found = std::lower_bound(seams.begin(), seams.end(), b,
                                      [](const Seam& seam, PieceId piece) { return seam.other < piece; });
  return found != seams.end() && found->other == b ? found->length_mm : 0.0;
}

double SeamGraph::border_of(std::size_t group) const {
  double sum = 0.0;
  for (const PieceId piece : groups[group]) {
    sum += nodes[piece].border_mm;
  }
  return sum;
}

SeamGraph seam_graph(const mesh::Surface& surface, const unfold::Nets& nets) {
  SeamGraph graph;
  graph.nodes.resize(nets.pieces.size());
  for (const FaceId face : ids<FaceId>(surface.face_count())) {
    SeamGraph::Node& node = graph.nodes[nets.piece[face]];
    node.area_mm2 += surface.area(face);
    for (const unsigned k : {0U, 1U, 2U}) {
      const EdgeId edge = surface.edge(mesh::corner(face, k));
      node.border_mm += surface.is_border(edge) ? surface.length(edge) : 0.0;
    }
  }
  std::map<std::pair<PieceId, PieceId>, SeamGraph::Seam> seams;
  for (const unfold::Join& join : nets.joins) {
    const auto [c, d] = surface.sides(join.edge);
    const PieceId a = nets.piece[mesh::face_of(c)];
    const PieceId b = nets.piece[mesh::face_of(d)];
    const double length = surface.length(join.edge);
    if (a == b) {
      graph.nodes[a].own_mm += length;
      ++graph.nodes[a].own_joins;
      continue;
    }
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
      SeamGraph::Seam& seam = seams[{from, to}];
      seam.other = to;
      seam.length_mm += length;
      graph.nodes[from].seam_mm += length;
      ++graph.nodes[from].joins;
    }
  }
  for (const auto& [ends, seam] : seams) {
    graph.nodes[ends.first].seams.push_back(seam);
  }
  number_groups(graph);
  return graph;
}

namespace {

struct GroupBody {
  Box3 box;
  std::vector<FaceId> faces;
  bool closed = true;
};

bool holds_box(const Box3& outer, const Box3& inner) {
  return outer.low.x < inner.low.x && outer.low.y < inner.low.y && outer.low.z < inner.low.z &&
         inner.high.x < outer.high.x && inner.high.y < outer.high.y && inner.high.z < outer.high.z;
}

/// The corners of a body that lie farthest along the axes and their diagonals, both ways: what stands out of
/// another body does so with one of these, but for what no direction of these meets first.
std::vector<Vec3> farthest_corners(const mesh::Surface& surface, const GroupBody& body) {
  std::vector<Vec3> corners;
  constexpr int ways = 27;  // each component -1, 0 or 1
  for (int code = 0; code < ways; ++code) {
    if (code == ways / 2) {
      continue;  // no direction
    }
    const Vec3 way{static_cast<double>(code % 3 - 1), static_cast<double>(code / 3 % 3 - 1),
                   static_cast<double>(code / 9 - 1)};
    double most = -INFINITY;
    Vec3 farthest;
    for (const FaceId face : body.faces) {
      for (const VertexId v : surface.vertices(face)) {
        if (const double reach = dot(way, surface.point(v)); reach > most) {
          most = reach;
          farthest = surface.point(v);
        }
      }
    }
    corners.push_back(farthest);
  }
  return corners;
}

/// What lies nearer to a body than this lies on it, mm: simplification leaves sheets a hair behind walls.
constexpr double on_body_mm = 1.0;

enum class Side { outside, on, inside };

/// By how often the body winds around the point, either way round: no edge or corner has to be missed, as
/// with a ray.
Side side_of(const mesh::Surface& surface, Vec3 point, const GroupBody& body) {
  double angle = 0.0;
  double nearest = INFINITY;
  for (const FaceId face : body.faces) {
    const auto [u, v, w] = surface.vertices(face);
    const Vec3 a = surface.point(u);
    const Vec3 b = surface.point(v);
    const Vec3 c = surface.point(w);
    angle += solid_angle(a - point, b - point, c - point);
    nearest = std::min(nearest, mesh::squared_distance(a, b, c, point));
  }
  if (nearest < on_body_mm * on_body_mm) {
    return Side::on;
  }
  return std::abs(angle) > 2.0 * std::numbers::pi ? Side::inside : Side::outside;  // half of once around
}

/// What only begins in another body, as a dormer in a roof, or lies on it, isn't inside.
bool is_whole_inside(const mesh::Surface& surface, const GroupBody& inner, const GroupBody& outer) {
  bool inside = false;
  for (const Vec3 corner : farthest_corners(surface, inner)) {
    const Side side = side_of(surface, corner, outer);
    if (side == Side::outside) {
      return false;
    }
    inside = inside || side == Side::inside;
  }
  return inside;
}

}  // namespace

std::vector<std::size_t> inner_groups_first(const mesh::Surface& surface, const unfold::Nets& nets,
                                            const SeamGraph& graph) {
  std::vector<GroupBody> bodies(graph.groups.size());
  for (const FaceId face : ids<FaceId>(surface.face_count())) {
    GroupBody& body = bodies[graph.nodes[nets.piece[face]].group];
    body.faces.push_back(face);
    for (const VertexId v : surface.vertices(face)) {
      body.box.add(surface.point(v));
    }
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].closed = graph.border_of(i) == 0.0;
  }
  // In how many others each lies: what lies in a body lies in all that the body lies in, so the deepest
  // may come first.
  std::vector<std::size_t> depth(bodies.size(), 0);
  std::vector<Box3> boxes;
  for (const GroupBody& body : bodies) {
    boxes.push_back(body.faces.empty() ? Box3{{}, {}} : body.box);
  }
  const auto compare = [&](std::size_t inner, std::size_t outer) {
    if (bodies[outer].closed && !bodies[inner].faces.empty() &&
        holds_box(bodies[outer].box, bodies[inner].box) &&
        is_whole_inside(surface, bodies[inner], bodies[outer])) {
      ++depth[inner];
    }
  };
  NearBoxes(boxes).for_pairs([&](std::size_t a, std::size_t b) {
    compare(a, b);
    compare(b, a);
  });
  std::vector<std::size_t> order(bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto area = [&](std::size_t group) {
    double sum = 0.0;
    for (const PieceId piece : graph.groups[group]) {
      sum += graph.nodes[piece].area_mm2;
    }
    // Equal bodies keep their order, whatever their sums are rounded to.
    constexpr double rounding_mm2 = 1e-3;
    return std::round(sum / rounding_mm2);
  };
  std::vector<double> areas;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    areas.push_back(area(i));
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(depth[a], areas[a]) > std::pair(depth[b], areas[b]);
  });
  return order;
}

namespace {

/// Bodies of fewer pieces have no choice of a last one.
constexpr std::size_t fewest_with_closer = 3;
/// What an opening has to be wide for two fingers, mm.
constexpr double two_fingers_mm = 30.0;
/// Equal pieces come together when their seam with what stands is this share of the first one's.
constexpr double mate_fraction = 0.7;
/// ... and when they have no more than this share of it between each other.
constexpr double most_between_mates = 0.5;
/// A piece is the underside where this share of it looks down, by no less than half of the way.
constexpr double most_of_piece = 0.5;
constexpr double looks_down = 0.5;
/// It comes last where it closes this much as easily as the piece that closes easiest.
constexpr double easy_enough = 0.5;
/// Seams that differ by less are equal up to rounding, mm.
constexpr double seam_rounding_mm = 1e-6;

constexpr std::uint32_t no_kind = std::numeric_limits<std::uint32_t>::max();

/// How easily a piece is put on when no hand reaches behind it.
double ease_of_closing(const SeamGraph::Node& node) {
  const double width = 2.0 * node.area_mm2 / (node.seam_mm + node.own_mm);
  const double edge = node.seam_mm / static_cast<double>(node.joins);
  const double ease =
      edge * std::min(1.0, width / two_fingers_mm) / (1.0 + static_cast<double>(node.own_joins));
  return std::round(ease / seam_rounding_mm) * seam_rounding_mm;
}

/// Whether the group's other pieces hang together without this one.
bool hold_without(const SeamGraph& graph, const std::vector<PieceId>& group, PieceId without) {
  std::vector<bool> seen(graph.nodes.size(), false);
  seen[without.value()] = true;
  std::vector<PieceId> open{group.front() == without ? group.back() : group.front()};
  seen[open.front().value()] = true;
  std::size_t count = 1;
  while (!open.empty()) {
    const PieceId piece = open.back();
    open.pop_back();
    for (const SeamGraph::Seam& seam : graph.nodes[piece].seams) {
      if (!seen[seam.other.value()]) {
        seen[seam.other.value()] = true;
        open.push_back(seam.other);
        ++count;
      }
    }
  }
  return count + 1 == group.size();
}

/// Of each piece the share of its area that looks down; 0 where it is unknown what is up.
IdVector<PieceId, double> undersides(const mesh::Surface& surface, const unfold::Nets& nets, Vec3 up) {
  IdVector<PieceId, double> down(nets.pieces.size(), 0.0);
  IdVector<PieceId, double> all(nets.pieces.size(), 0.0);
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const double area = surface.area(f);
    all[nets.piece[f]] += area;
    down[nets.piece[f]] += dot(surface.normal(f), up) < -looks_down ? area : 0.0;
  }
  for (const PieceId piece : ids<PieceId>(down.size())) {
    down[piece] = all[piece] > 0.0 ? down[piece] / all[piece] : 0.0;
  }
  return down;
}

/// The piece that comes last; none where it doesn't matter.
PieceId closing_piece(const SeamGraph& graph, const IdVector<PieceId, double>& underside, std::size_t group) {
  const std::vector<PieceId>& pieces = graph.groups[group];
  if (pieces.size() < fewest_with_closer || graph.border_of(group) >= hand_hole_mm) {
    return {};
  }
  std::vector<PieceId> easiest = pieces;
  std::stable_sort(easiest.begin(), easiest.end(), [&](PieceId a, PieceId b) {
    return ease_of_closing(graph.nodes[a]) > ease_of_closing(graph.nodes[b]);
  });
  const auto found = std::find_if(easiest.begin(), easiest.end(),
                                  [&](PieceId piece) { return hold_without(graph, pieces, piece); });
  if (found == easiest.end()) {
    return {};
  }
  // What is seen least may be glued worst.
  const double ease = easy_enough * ease_of_closing(graph.nodes[*found]);
  const auto below = std::find_if(found, easiest.end(), [&](PieceId piece) {
    return underside[piece] > most_of_piece && ease_of_closing(graph.nodes[piece]) >= ease &&
           hold_without(graph, pieces, piece);
  });
  return below == easiest.end() ? *found : *below;
}

class Builder {
 public:
  Builder(const mesh::Surface& surface, const unfold::Nets& nets, Vec3 up)
      : nets_(nets),
        graph_(seam_graph(surface, nets)),
        kind_(nets.pieces.size(), no_kind),
        standing_mm_(nets.pieces.size(), 0.0),
        step_(nets.pieces.size(), no_step),
        left_(graph_.groups.size()) {
    for (std::size_t i = 0; i < nets.equal.size(); ++i) {
      for (const unfold::EqualPiece& equal : nets.equal[i]) {
        kind_[equal.piece] = static_cast<std::uint32_t>(i);
      }
    }
    const IdVector<PieceId, double> underside = undersides(surface, nets, up);
    for (std::size_t i = 0; i < graph_.groups.size(); ++i) {
      closer_.push_back(closing_piece(graph_, underside, i));
      left_[i] = graph_.groups[i].size();
    }
    const std::vector<std::size_t> order = inner_groups_first(surface, nets, graph_);
    for (const std::vector<std::size_t>& groups : equal_groups(order)) {
      build(groups);
    }
    add_joins(surface);
  }

  Assembly take() { return std::move(assembly_); }

 private:
  static constexpr std::size_t no_step = std::numeric_limits<std::size_t>::max();

  /// Groups that have the same kinds of pieces, in the order given.
  [[nodiscard]] std::vector<std::vector<std::size_t>> equal_groups(
      const std::vector<std::size_t>& order) const {
    std::map<std::vector<std::uint32_t>, std::size_t> known;
    std::vector<std::vector<std::size_t>> result;
    for (const std::size_t group : order) {
      std::vector<std::uint32_t> kinds;
      for (const PieceId piece : graph_.groups[group]) {
        kinds.push_back(kind_[piece]);
      }
      std::sort(kinds.begin(), kinds.end());
      if (kinds.back() == no_kind) {
        result.push_back({group});
        continue;
      }
      const auto [at, is_new] = known.try_emplace(kinds, result.size());
      if (is_new) {
        result.push_back({group});
      } else {
        result[at->second].push_back(group);
      }
    }
    return result;
  }

  [[nodiscard]] bool stands(PieceId piece) const { return step_[piece] != no_step; }

  /// Pieces of the groups that may come next.
  [[nodiscard]] std::vector<PieceId> candidates(const std::vector<std::size_t>& groups) const {
    std::vector<PieceId> pieces;
    for (const std::size_t group : groups) {
      for (const PieceId piece : graph_.groups[group]) {
        if (!stands(piece) && (piece != closer_[group] || left_[group] == 1)) {
          pieces.push_back(piece);
        }
      }
    }
    return pieces;
  }

  [[nodiscard]] bool has_begun(PieceId piece) const {
    const std::size_t group = graph_.nodes[piece].group;
    return left_[group] < graph_.groups[group].size();
  }

  /// The most of `value` first, and of equal ones the first.
  template <class Value>
  static PieceId best_of(const std::vector<PieceId>& pieces, Value value) {
    PieceId best;
    for (const PieceId piece : pieces) {
      if (!best.valid() || value(piece) > value(best) + seam_rounding_mm) {
        best = piece;
      }
    }
    return best;
  }

  void build(const std::vector<std::size_t>& groups) {
    while (true) {
      const std::vector<PieceId> open = candidates(groups);
      if (open.empty()) {
        return;
      }
      const PieceId next = best_of(open, [&](PieceId piece) { return standing_mm_[piece]; });
      // A piece whose seam with what stands has no length goes on all the same, where its group has begun.
      standing_mm_[next] > seam_rounding_mm || has_begun(next) ? go_on(next, open) : begin(open);
    }
  }

  /// The next group begins, and with it those that are equal.
  void begin(const std::vector<PieceId>& open) {
    const auto begun = std::find_if(open.begin(), open.end(), [&](PieceId p) { return !has_begun(p); });
    const std::uint32_t group = graph_.nodes[*begun].group;
    std::vector<PieceId> of_group;
    std::copy_if(open.begin(), open.end(), std::back_inserter(of_group),
                 [&](PieceId piece) { return graph_.nodes[piece].group == group; });
    const PieceId first = best_of(of_group, [&](PieceId piece) { return graph_.nodes[piece].seam_mm; });
    std::vector<PieceId> pieces{first};
    std::vector<std::uint32_t> taken{group};
    for (const PieceId piece : open) {
      const std::uint32_t other = graph_.nodes[piece].group;
      if (kind_[piece] == kind_[first] && kind_[piece] != no_kind && !has_begun(piece) &&
          std::find(taken.begin(), taken.end(), other) == taken.end()) {
        pieces.push_back(piece);
        taken.push_back(other);
      }
    }
    place(std::move(pieces), true);
  }

  void go_on(PieceId next, const std::vector<PieceId>& open) {
    std::vector<PieceId> pieces{next};
    for (const PieceId piece : open) {
      const auto far_from = [&](PieceId other) {
        return graph_.seam_between(piece, other) <= most_between_mates * standing_mm_[piece];
      };
      if (piece != next && kind_[piece] == kind_[next] && kind_[piece] != no_kind &&
          standing_mm_[piece] >= mate_fraction * standing_mm_[next] &&
          std::all_of(pieces.begin(), pieces.end(), far_from)) {
        pieces.push_back(piece);
      }
    }
    place(std::move(pieces), false);
  }

  void place(std::vector<PieceId> pieces, bool starts) {
    std::sort(pieces.begin(), pieces.end());
    AssemblyStep step;
    step.starts = starts;
    for (const PieceId piece : pieces) {
      const SeamGraph::Node& node = graph_.nodes[piece];
      step_[piece] = assembly_.steps.size();
      --left_[node.group];
      step.closes = step.closes || (left_[node.group] == 0 && graph_.border_of(node.group) < hand_hole_mm);
      for (const SeamGraph::Seam& seam : node.seams) {
        standing_mm_[seam.other] += seam.length_mm;
      }
    }
    step.pieces = std::move(pieces);
    assembly_.steps.push_back(std::move(step));
  }

  void add_joins(const mesh::Surface& surface) {
    for (const JoinId j : ids<JoinId>(nets_.joins.size())) {
      const auto [c, d] = surface.sides(nets_.joins[j].edge);
      const PieceId a = nets_.piece[mesh::face_of(c)];
      const PieceId b = nets_.piece[mesh::face_of(d)];
      AssemblyStep& step = assembly_.steps[std::max(step_[a], step_[b])];
      (a == b ? step.own : step.joins).push_back(j);
    }
  }

  const unfold::Nets& nets_;
  SeamGraph graph_;
  IdVector<PieceId, std::uint32_t> kind_;  ///< index into Nets::equal
  IdVector<PieceId, double> standing_mm_;  ///< seam with what stands
  IdVector<PieceId, std::size_t> step_;
  std::vector<std::size_t> left_;  ///< of each group: pieces that don't stand yet
  std::vector<PieceId> closer_;    ///< of each group
  Assembly assembly_;
};

}  // namespace

Assembly assembly_order(const mesh::Surface& surface, const unfold::Nets& nets, Vec3 up) {
  return Builder(surface, nets, up).take();
}

}  // namespace ridgecraft::export_
