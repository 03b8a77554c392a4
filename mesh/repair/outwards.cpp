// SPDX-License-Identifier: GPL-3.0-or-later
// Which side of each component is the outside.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/near_boxes.hpp"
#include "base/solid_angle.hpp"
#include "mesh/repair/orient.hpp"

namespace ridgecraft::mesh {
namespace {

/// A volume below this share of area times diagonal is none: its sign tells nothing.
constexpr double no_volume = 1e-9;
/// An open surface whose faces' vector areas add up to less than this share of its area is as good as closed:
/// its holes are small, or it is a tube.
constexpr double nearly_closed = 0.05;
/// Triangles and pairs of boxes between two questions whether to stop.
constexpr std::size_t check_interval = 1U << 16U;

struct Component {
  std::vector<std::uint32_t> triangles;
  Box3 box;
  bool closed = true;
  bool outside_known = false;  ///< volume can tell
  double area = 0.0;
  double volume = 0.0;
  bool was_turned = false;  ///< as a whole
};

std::vector<Component> find_components(const TriangleList& list, const std::vector<EdgeUse>& uses) {
  DisjointSets sets(list.triangles.size());
  std::vector<std::uint8_t> open(list.triangles.size(), 0);
  for_each_edge(uses, [&](std::size_t i, std::size_t j) {
    if (j - i == 2) {
      sets.join(uses[i].triangle, uses[i + 1].triangle);
    } else {
      open[uses[i].triangle] = 1;
    }
  });
  std::vector<std::uint32_t> number(list.triangles.size(), Soup::none);
  std::vector<Component> components;
  for (std::uint32_t t = 0; t < list.triangles.size(); ++t) {
    const std::uint32_t root = sets.find(t);
    if (number[root] == Soup::none) {
      number[root] = static_cast<std::uint32_t>(components.size());
      components.emplace_back();
    }
    Component& c = components[number[root]];
    c.triangles.push_back(t);
    c.closed = c.closed && open[t] == 0;
    for (const std::uint32_t p : list.triangles[t].points) {
      c.box.add(list.points[p]);
    }
  }
  return components;
}

void measure(const TriangleList& list, Component& c) {
  // Shares are summed, since the sum of extreme coordinates may be beyond the range of a double.
  const double share = 1.0 / static_cast<double>(3 * c.triangles.size());
  Vec3 mean;
  for (const std::uint32_t t : c.triangles) {
    for (const std::uint32_t p : list.triangles[t].points) {
      mean += share * list.points[p];
    }
  }
  Vec3 vector_area;
  for (const std::uint32_t t : c.triangles) {
    const auto& v = list.triangles[t].points;
    const Vec3 a = list.points[v[0]] - mean;
    const Vec3 n = cross(list.points[v[1]] - mean - a, list.points[v[2]] - mean - a);
    c.area += 0.5 * length(n);
    vector_area += 0.5 * n;
    c.volume += dot(a, n) / 6.0;
  }
  const bool has_volume = std::abs(c.volume) > no_volume * c.area * c.box.diagonal();
  c.outside_known = has_volume && (c.closed || length(vector_area) < nearly_closed * c.area);
}

/// How often the component winds around a point, times its sign: 0 outside, 1 or -1 inside.
double winding(const TriangleList& list, const Component& c, Vec3 q) {
  double angle = 0.0;
  for (const std::uint32_t t : c.triangles) {
    const auto& v = list.triangles[t].points;
    angle += solid_angle(list.points[v[0]] - q, list.points[v[1]] - q, list.points[v[2]] - q);
  }
  return angle / (4.0 * std::numbers::pi);
}

bool box_inside(const Box3& inner, const Box3& outer) {
  return outer.low.x <= inner.low.x && outer.low.y <= inner.low.y && outer.low.z <= inner.low.z &&
         outer.high.x >= inner.high.x && outer.high.y >= inner.high.y && outer.high.z >= inner.high.z;
}

/// Of each component whose volume tells the outside, the closed ones around it, ascending.
std::vector<std::vector<std::size_t>> find_around(const TriangleList& list,
                                                  const std::vector<Component>& components,
                                                  const Context& context) {
  std::vector<std::size_t> known;
  std::vector<Box3> boxes;
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (components[i].outside_known) {
      known.push_back(i);
      boxes.push_back(components[i].box);
    }
  }
  std::vector<std::vector<std::size_t>> around(components.size());
  std::size_t asked = 0;
  const auto add = [&](std::size_t inner, std::size_t outer) {
    const Component& c = components[outer];
    if (!c.closed || !box_inside(components[inner].box, c.box)) {
      return;
    }
    asked += c.triangles.size();
    if (asked > check_interval) {
      asked = 0;
      context.check();
    }
    const Vec3 q = list.points[list.triangles[components[inner].triangles[0]].points[0]];
    if (std::abs(winding(list, c, q)) > 0.5) {
      around[inner].push_back(outer);
    }
  };
  NearBoxes(boxes).for_pairs([&](std::uint32_t i, std::uint32_t j) {
    if (++asked > check_interval) {
      asked = 0;
      context.check();
    }
    add(known[i], known[j]);
    add(known[j], known[i]);
  });
  for (std::vector<std::size_t>& outer : around) {
    std::sort(outer.begin(), outer.end());
  }
  return around;
}

void turn(TriangleList& list, Component& c) {
  for (const std::uint32_t t : c.triangles) {
    list.triangles[t].turn();
  }
  c.volume = -c.volume;
  c.was_turned = true;
}

/// Components whose volume tells the outside: from the outermost inwards, as a cavity goes with what is
/// around it.
void turn_by_volume(TriangleList& list, std::vector<Component>& components, const Context& context) {
  const bool all_fine = std::all_of(components.begin(), components.end(),
                                    [](const Component& c) { return !c.outside_known || c.volume > 0.0; });
  if (all_fine) {
    return;
  }
  std::vector<std::pair<std::size_t, std::size_t>> by_depth;
  const std::vector<std::vector<std::size_t>> outer = find_around(list, components, context);
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (components[i].outside_known) {
      by_depth.emplace_back(outer[i].size(), i);
    }
  }
  std::sort(by_depth.begin(), by_depth.end());
  for (const auto& [depth, i] : by_depth) {
    Component& c = components[i];
    // The nearest one around is the deepest.
    const auto nearest =
        std::max_element(outer[i].begin(), outer[i].end(),
                         [&](std::size_t a, std::size_t b) { return outer[a].size() < outer[b].size(); });
    const bool cavity_allowed = depth % 2 == 1;
    const bool with_outer = cavity_allowed && components[*nearest].was_turned && c.volume > 0.0;
    if (with_outer || (c.volume < 0.0 && !cavity_allowed)) {
      turn(list, c);
    }
  }
}

/// The rest: as most of the area was in the file; where that says nothing, outwards from the middle.
void turn_by_majority(TriangleList& list, Component& c) {
  double as_in_file = 0.0;
  bool votes = false;
  for (const std::uint32_t t : c.triangles) {
    const Triangle& triangle = list.triangles[t];
    if (!triangle.two_sided) {
      const Vec3 a = list.points[triangle.points[0]];
      const double area =
          length(cross(list.points[triangle.points[1]] - a, list.points[triangle.points[2]] - a));
      as_in_file += triangle.turned ? -area : area;
      votes = true;
    }
  }
  if (votes ? as_in_file < 0.0 : c.volume < 0.0) {
    turn(list, c);
  }
}

void remark_turned(const TriangleList& list, const Component& c, RepairReport& report) {
  std::vector<std::uint32_t> turned;
  std::size_t told = 0;
  for (const std::uint32_t t : c.triangles) {
    if (!list.triangles[t].two_sided) {
      ++told;
      if (list.triangles[t].turned) {
        turned.push_back(list.triangles[t].origin);
      }
    }
  }
  if (turned.empty()) {
    return;
  }
  const std::string detail = "first: polygon " + std::to_string(std::uint64_t{turned.front()} + 1);
  if (turned.size() == told) {
    report.add(RepairKind::components_turned, 1, detail);
    return;
  }
  std::sort(turned.begin(), turned.end());
  turned.erase(std::unique(turned.begin(), turned.end()), turned.end());
  report.add(RepairKind::faces_turned, turned.size(), detail);
}

}  // namespace

void turn_outwards(TriangleList& list, const std::vector<EdgeUse>& uses, RepairReport& report,
                   const Context& context) {
  std::vector<Component> components = find_components(list, uses);
  for (Component& c : components) {
    measure(list, c);
  }
  turn_by_volume(list, components, context);
  for (Component& c : components) {
    if (!c.outside_known) {
      turn_by_majority(list, c);
    }
    remark_turned(list, c, report);
  }
}

}  // namespace ridgecraft::mesh
