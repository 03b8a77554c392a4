// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/net/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "base/boxes.hpp"
#include "base/elementary.hpp"
#include "base/geometry.hpp"

namespace ridgecraft::unfold {
namespace {

/// Nearer corners of a chain are one corner, mm: rounding along a fold tree stays far below, true edges far
/// above.
constexpr double same_corner_mm = 1e-9;

Vec2 start(const Nets& nets, CornerId c) {
  return nets.flat[mesh::face_of(c)][c.value() % 3];
}

/// Where the corners of a fan lie apart, as in nets of board, the chain goes over all of them; mm.
constexpr double apart_mm = 1e-6;

/// The corners of the fan at the end of side c, in the order of next_boundary(), but for the last one.
std::vector<Vec2> fan_corners(const mesh::Surface& surface, const Nets& nets, CornerId c) {
  std::vector<Vec2> corners;
  CornerId d = mesh::next(c);
  corners.push_back(start(nets, d));
  while (nets.use[surface.edge(d)] == EdgeUse::fold) {
    d = mesh::next(surface.twin(d));
    corners.push_back(start(nets, d));
  }
  const Vec2 last = corners.back();
  corners.pop_back();
  const bool together = std::ranges::all_of(corners, [&](Vec2 p) { return length(p - last) <= apart_mm; });
  return together ? std::vector<Vec2>() : corners;
}

void append(std::vector<Vec2>& loop, Vec2 p) {
  if (loop.empty() || length(p - loop.back()) > same_corner_mm) {
    loop.push_back(p);
  }
}

/// The tabs that grow from each side of a piece, in the order in which the outline comes to them: from the
/// start of the side to its end.
std::map<CornerId, std::vector<const Tab*>> tabs_of(const Nets& nets, PieceId piece) {
  std::map<CornerId, std::vector<const Tab*>> result;
  for (const Tab& tab : nets.tabs) {
    if (nets.piece[mesh::face_of(tab.side)] == piece) {
      result[tab.side].push_back(&tab);
    }
  }
  for (auto& [side, tabs] : result) {
    const Vec2 from = start(nets, side);
    std::ranges::sort(tabs, {}, [&](const Tab* tab) { return length(tab->polygon[1] - from); });
  }
  return result;
}

/// Slits in a piece that tabs are put through.
std::vector<std::vector<Vec2>> slits_in(const mesh::Surface& surface, const Nets& nets, PieceId piece) {
  std::vector<std::vector<Vec2>> slits;
  for (const Tab& tab : nets.tabs) {
    if (tab.slit && nets.piece[mesh::face_of(surface.twin(tab.side))] == piece) {
      slits.emplace_back(tab.slit->begin(), tab.slit->end());
    }
  }
  return slits;
}

}  // namespace

CornerId next_boundary(const mesh::Surface& surface, const Nets& nets, CornerId c) {
  CornerId d = mesh::next(c);
  while (nets.use[surface.edge(d)] == EdgeUse::fold) {
    d = mesh::next(surface.twin(d));
  }
  return d;
}

std::vector<std::vector<Vec2>> outline(const mesh::Surface& surface, const Nets& nets, PieceId piece) {
  const std::map<CornerId, std::vector<const Tab*>> tabs = tabs_of(nets, piece);
  const std::vector<FaceId>& faces = nets.pieces[piece].faces;
  std::map<CornerId, bool> done;
  std::vector<std::vector<Vec2>> loops;
  for (const FaceId f : faces) {
    for (unsigned k = 0; k < 3; ++k) {
      CornerId c = mesh::corner(f, k);
      if (nets.use[surface.edge(c)] == EdgeUse::fold || done[c]) {
        continue;
      }
      std::vector<Vec2> loop;
      for (; !done[c]; c = next_boundary(surface, nets, c)) {
        done[c] = true;
        append(loop, start(nets, c));
        if (const auto here = tabs.find(c); here != tabs.end()) {
          for (const Tab* tab : here->second) {
            // The tab runs counterclockwise and begins with its base, end first: so its way round the outside
            // is corners 1, 2, ..., 0.
            const std::vector<Vec2>& polygon = tab->polygon;
            for (std::size_t i = 1; i <= polygon.size(); ++i) {
              append(loop, polygon[i % polygon.size()]);
            }
          }
        }
        for (const Vec2 p : fan_corners(surface, nets, c)) {
          append(loop, p);
        }
      }
      while (loop.size() > 1 && length(loop.back() - loop.front()) <= same_corner_mm) {
        loop.pop_back();
      }
      loops.push_back(std::move(loop));
    }
  }
  // The outer loop is the one that encloses the others; holes run clockwise.
  std::stable_sort(loops.begin(), loops.end(), [](const auto& a, const auto& b) {
    return std::abs(doubled_area(a)) > std::abs(doubled_area(b));
  });
  return loops;
}

CutLines cut_lines(const mesh::Surface& surface, const Nets& nets, PieceId piece) {
  CutLines lines = arrange_cuts(outline(surface, nets, piece), touch_tolerance_mm);
  for (std::vector<Vec2>& slit : slits_in(surface, nets, piece)) {
    lines.slits.push_back(std::move(slit));
  }
  return lines;
}

Box2 extent(const mesh::Surface& /*surface*/, const Nets& nets, PieceId piece) {
  Box2 box;
  for (const FaceId f : nets.pieces[piece].faces) {
    for (const Vec2 p : nets.flat[f]) {
      box.add(p);
    }
  }
  for (const Tab& tab : nets.tabs) {
    if (nets.piece[mesh::face_of(tab.side)] == piece) {
      for (const Vec2 p : tab.polygon) {
        box.add(p);
      }
    }
  }
  return box;
}

namespace {

/// A line that is cut at a node turns by up to the tolerance, and may lie on the next short side of a narrow
/// gap then. So it is cut again, as long as it moves by no more than so many times the tolerance in all.
constexpr double most_moves = 4.0;

using Node = std::uint32_t;
using NodePair = std::array<Node, 2>;

/// A part of a side of the loops.
struct Run {
  NodePair ends{};
  NodePair side{};  ///< the ends of the whole side
};

Box2 box_of(Vec2 a, Vec2 b) {
  Box2 box;
  box.add(a);
  box.add(b);
  return box;
}

/// Points that are nearer than a tolerance are one node; the first one stands for all.
class Nodes {
 public:
  explicit Nodes(double tolerance) : tolerance_(tolerance) {}

  Node find_or_add(Vec2 p) {
    const auto x = static_cast<std::int64_t>(std::floor(p.x / tolerance_));
    const auto y = static_cast<std::int64_t>(std::floor(p.y / tolerance_));
    for (std::int64_t dx = -1; dx <= 1; ++dx) {
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        const auto [low, high] = cells_.equal_range({x + dx, y + dy});
        for (auto it = low; it != high; ++it) {
          if (length(points[it->second] - p) <= tolerance_) {
            return it->second;
          }
        }
      }
    }
    points.push_back(p);
    const Node node = static_cast<Node>(points.size() - 1);
    cells_.emplace(std::pair{x, y}, node);
    return node;
  }

  std::vector<Vec2> points;

 private:
  double tolerance_;
  std::multimap<std::pair<std::int64_t, std::int64_t>, Node> cells_;
};

double distance_from_line(Vec2 p, Vec2 a, Vec2 b) {
  return std::abs(cross(b - a, p - a)) / length(b - a);
}

/// Each run cut at the nodes that lie on it.
std::vector<Run> split_at_nodes(const std::vector<Run>& runs, const std::vector<Vec2>& points,
                                double tolerance) {
  std::vector<Box2> boxes;
  for (const Vec2 p : points) {
    boxes.push_back(box_of(p, p));
  }
  // Points have no size, so the grid chooses its cells by their number.
  const BoxGrid grid(std::move(boxes));
  std::vector<Run> result;
  std::vector<std::pair<double, Node>> on;
  for (const auto& [ends, side] : runs) {
    const auto [a, b] = ends;
    const Vec2 along = points[b] - points[a];
    const double size = length(along);
    on.clear();
    grid.visit(grown(box_of(points[a], points[b]), tolerance), [&, a = a, b = b, side = side](Node node) {
      if (node == a || node == b) {
        return;
      }
      const Vec2 to = points[node] - points[a];
      const double t = dot(to, along) / size;
      if (t > 0.0 && t < size && std::abs(cross(along, to)) <= tolerance * size &&
          distance_from_line(points[node], points[side[0]], points[side[1]]) <= most_moves * tolerance) {
        on.emplace_back(t, node);
      }
    });
    std::sort(on.begin(), on.end());
    Node from = a;
    for (const auto& [t, node] : on) {
      result.push_back({{from, node}, side});
      from = node;
    }
    result.push_back({{from, b}, side});
  }
  return result;
}

/// Runs that are run both ways cancel each other and are slits; the others stay.
void cancel_opposite(const std::vector<Run>& runs, std::vector<Run>& kept, std::vector<NodePair>& slits) {
  struct Both {
    std::vector<Run> upwards;  ///< from the smaller node
    std::vector<Run> downwards;
  };
  std::map<NodePair, Both> between;
  for (const Run& run : runs) {
    const auto [a, b] = run.ends;
    Both& both = between[{std::min(a, b), std::max(a, b)}];
    (a < b ? both.upwards : both.downwards).push_back(run);
  }
  for (const auto& [ends, both] : between) {
    const std::size_t opposite = std::min(both.upwards.size(), both.downwards.size());
    if (both.upwards.size() == both.downwards.size()) {
      slits.push_back(ends);
    }
    for (const auto* way : {&both.upwards, &both.downwards}) {
      kept.insert(kept.end(), way->begin() + static_cast<std::ptrdiff_t>(opposite), way->end());
    }
  }
}

/// Angle from direction a counterclockwise to direction b, in (0, 2 pi].
double turn(Vec2 a, Vec2 b) {
  const double angle = elementary::atan2(cross(a, b), dot(a, b));
  return angle > 0.0 ? angle : angle + 2.0 * std::numbers::pi;
}

/// Follows the runs; where there is a choice the loop keeps to the region outside, on its right.
std::vector<std::vector<Vec2>> trace_loops(const std::vector<Run>& runs, const std::vector<Vec2>& points) {
  std::vector<std::vector<std::uint32_t>> leaving(points.size());
  for (std::uint32_t i = 0; i < runs.size(); ++i) {
    leaving[runs[i].ends[0]].push_back(i);
  }
  std::vector<bool> used(runs.size(), false);
  std::vector<std::vector<Vec2>> loops;
  for (std::uint32_t first = 0; first < runs.size(); ++first) {
    if (used[first]) {
      continue;
    }
    std::vector<Vec2> loop;
    for (std::uint32_t at = first; !used[at];) {
      used[at] = true;
      const auto [from, to] = runs[at].ends;
      loop.push_back(points[from]);
      double smallest = INFINITY;
      for (const std::uint32_t other : leaving[to]) {
        const double angle = turn(points[from] - points[to], points[runs[other].ends[1]] - points[to]);
        // The run that the loop began with may close it.
        if ((!used[other] || other == first) && angle < smallest) {
          smallest = angle;
          at = other;
        }
      }
    }
    loops.push_back(std::move(loop));
  }
  std::stable_sort(loops.begin(), loops.end(), [](const auto& a, const auto& b) {
    return std::abs(doubled_area(a)) > std::abs(doubled_area(b));
  });
  return loops;
}

/// Joins segments to lines that run through all nodes with two segments.
std::vector<std::vector<Vec2>> join_lines(const std::vector<NodePair>& segments,
                                          const std::vector<Vec2>& points) {
  std::map<Node, std::vector<std::uint32_t>> at;
  for (std::uint32_t i = 0; i < segments.size(); ++i) {
    at[segments[i][0]].push_back(i);
    at[segments[i][1]].push_back(i);
  }
  std::vector<bool> used(segments.size(), false);
  std::vector<std::vector<Vec2>> lines;
  const auto follow = [&](Node node, std::uint32_t segment) {
    std::vector<Vec2> line{points[node]};
    while (!used[segment]) {
      used[segment] = true;
      node = segments[segment][0] == node ? segments[segment][1] : segments[segment][0];
      line.push_back(points[node]);
      const std::vector<std::uint32_t>& here = at[node];
      if (here.size() == 2) {
        segment = here[0] == segment ? here[1] : here[0];
      }
    }
    lines.push_back(std::move(line));
  };
  for (const bool ends_only : {true, false}) {
    for (const auto& [node, here] : at) {
      for (const std::uint32_t segment : here) {
        if (!used[segment] && (!ends_only || here.size() != 2)) {
          follow(node, segment);
        }
      }
    }
  }
  return lines;
}

}  // namespace

CutLines arrange_cuts(const std::vector<std::vector<Vec2>>& loops, double tolerance) {
  Nodes nodes(tolerance);
  std::vector<Run> runs;
  for (const std::vector<Vec2>& loop : loops) {
    std::vector<Node> chain;
    for (const Vec2 p : loop) {
      chain.push_back(nodes.find_or_add(p));
    }
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const Node to = chain[(i + 1) % chain.size()];
      if (chain[i] != to) {
        runs.push_back({{chain[i], to}, {chain[i], to}});
      }
    }
  }
  std::vector<NodePair> slits;
  // Of nodes that lie beside each other's lines in turn, a slit of one round may be the way of the next one.
  constexpr int most_rounds = 8;
  bool more = true;
  for (int round = 0; more && round < most_rounds; ++round) {
    const std::size_t known = slits.size();
    std::vector<Run> kept;
    cancel_opposite(split_at_nodes(runs, nodes.points, tolerance), kept, slits);
    runs = std::move(kept);
    more = slits.size() > known;
  }
  std::set<NodePair> drawn;
  for (const Run& run : runs) {
    drawn.insert({std::min(run.ends[0], run.ends[1]), std::max(run.ends[0], run.ends[1])});
  }
  std::erase_if(slits, [&](const NodePair& slit) { return !drawn.insert(slit).second; });
  return {trace_loops(runs, nodes.points), join_lines(slits, nodes.points)};
}

}  // namespace ridgecraft::unfold
