// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/pair_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "base/boxes.hpp"
#include "base/disjoint_sets.hpp"
#include "base/elementary.hpp"
#include "base/geometry.hpp"

namespace ridgecraft::mesh {
namespace {

/// Triangles that lie on each other are at one angle around their edge, radians.
constexpr double same_angle = 1e-7;

/// A triangle at an edge: where it goes from there.
struct Blade {
  std::uint32_t use;        ///< index into the uses
  double angle = 0.0;       ///< around the edge, counterclockwise seen against its direction from low to high
  bool forward = false;     ///< runs from low to high: a solid lies on the side of smaller angles
  std::uint32_t component;  ///< over edges with two faces
};

using UsePair = std::array<std::uint32_t, 2>;  ///< of uses

std::uint32_t far_corner(const TriangleList& list, const EdgeUse& use) {
  return list.triangles[use.triangle].points[(use.side + 2U) % 3];
}

std::vector<Blade> blades_at(const TriangleList& list, const std::vector<EdgeUse>& uses, std::size_t first,
                             std::size_t last, DisjointSets& components) {
  const Vec3 low = list.points[uses[first].low];
  const Vec3 axis = normalized(list.points[uses[first].high] - low);
  const auto aside = [&](const EdgeUse& use) {
    const Vec3 d = list.points[far_corner(list, use)] - low;
    return d - dot(d, axis) * axis;
  };
  const Vec3 x = normalized(aside(uses[first]));
  const Vec3 y = cross(axis, x);
  std::vector<Blade> blades;
  for (std::size_t i = first; i < last; ++i) {
    const Vec3 d = aside(uses[i]);
    double angle = elementary::atan2(dot(d, y), dot(d, x));
    if (angle < -same_angle) {
      angle += 2.0 * std::numbers::pi;
    }
    blades.push_back(
        {static_cast<std::uint32_t>(i), angle, uses[i].forward, components.find(uses[i].triangle)});
  }
  std::sort(blades.begin(), blades.end(), [](const Blade& a, const Blade& b) {
    return a.angle != b.angle ? a.angle < b.angle : a.use < b.use;
  });
  // Of two that lie on each other the one that ends a solid comes first: each solid keeps its own.
  for (std::size_t i = 0; i + 1 < blades.size(); ++i) {
    if (blades[i + 1].angle - blades[i].angle < same_angle && !blades[i].forward && blades[i + 1].forward) {
      std::swap(blades[i], blades[i + 1]);
      ++i;
    }
  }
  return blades;
}

/// Where solids and air take turns around the edge: each solid's two faces; else nothing.
std::vector<UsePair> around_solids(const std::vector<Blade>& blades) {
  const std::size_t n = blades.size();
  std::vector<UsePair> pairs;
  for (std::size_t i = 0; i < n; ++i) {
    const Blade& a = blades[i];
    const Blade& b = blades[(i + 1) % n];
    if (a.forward == b.forward) {
      return {};
    }
    if (!a.forward) {
      pairs.push_back({a.use, b.use});
    }
  }
  return pairs;
}

/// Bodies that only touch: each has two of the faces, whichever way round it is drawn.
bool two_of_each_component(const std::vector<Blade>& blades) {
  return std::all_of(blades.begin(), blades.end(), [&](const Blade& a) {
    return 2 == std::count_if(blades.begin(), blades.end(),
                              [&](const Blade& b) { return b.component == a.component; });
  });
}

/// Those of one component, where it has two here; then those that are folded least.
std::vector<UsePair> by_component_and_turn(const std::vector<Blade>& blades) {
  std::vector<bool> taken(blades.size(), false);
  std::vector<UsePair> pairs;
  const auto take = [&](std::size_t i, std::size_t j) {
    taken[i] = taken[j] = true;
    pairs.push_back({blades[i].use, blades[j].use});
  };
  for (std::size_t i = 0; i < blades.size(); ++i) {
    const auto same = [&](const Blade& b) { return b.component == blades[i].component; };
    if (!taken[i] && std::count_if(blades.begin(), blades.end(), same) == 2) {
      const auto other =
          std::find_if(blades.begin() + static_cast<std::ptrdiff_t>(i) + 1, blades.end(), same);
      take(i, static_cast<std::size_t>(other - blades.begin()));
    }
  }
  struct Turn {
    double angle;
    std::size_t i, j;
  };
  std::vector<Turn> turns;
  for (std::size_t i = 0; i < blades.size(); ++i) {
    for (std::size_t j = i + 1; j < blades.size(); ++j) {
      turns.push_back({std::abs(std::numbers::pi - (blades[j].angle - blades[i].angle)), i, j});
    }
  }
  // Rounding doesn't decide between turns that are equal: the earlier faces do.
  std::stable_sort(turns.begin(), turns.end(), [](const Turn& a, const Turn& b) {
    return std::round(a.angle / same_angle) < std::round(b.angle / same_angle);
  });
  for (const Turn& turn : turns) {
    if (!taken[turn.i] && !taken[turn.j]) {
      take(turn.i, turn.j);
    }
  }
  return pairs;
}

std::uint32_t corner_at(const TriangleList& list, const EdgeUse& use, std::uint32_t point) {
  const auto& points = list.triangles[use.triangle].points;
  const std::uint32_t k = points[use.side] == point ? use.side : (use.side + 1U) % 3;
  return 3 * use.triangle + k;
}

/// Joins the corners of two triangles at both ends of their edge.
void hold_together(const TriangleList& list, const EdgeUse& a, const EdgeUse& b, DisjointSets& fans) {
  for (const std::uint32_t point : {a.low, a.high}) {
    fans.join(corner_at(list, a, point), corner_at(list, b, point));
  }
}

/// Each fan but the first one at a point of a crowded edge gets a copy of it.
void part_fans(TriangleList& list, const std::vector<bool>& crowded, DisjointSets& fans) {
  std::vector<std::uint32_t> first_fan(list.points.size(), Soup::none);
  std::map<std::uint32_t, std::uint32_t> copy;  // of each fan that isn't the first
  for (std::uint32_t c = 0; c < 3 * list.triangles.size(); ++c) {
    std::uint32_t& point = list.triangles[c / 3].points[c % 3];
    if (!crowded[point]) {
      continue;
    }
    const std::uint32_t fan = fans.find(c);
    if (first_fan[point] == Soup::none) {
      first_fan[point] = fan;
    }
    if (first_fan[point] != fan) {
      const auto [at, fresh] = copy.try_emplace(fan, static_cast<std::uint32_t>(list.points.size()));
      if (fresh) {
        list.points.push_back(list.points[point]);
      }
      point = at->second;
    }
  }
}

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
  const std::string detail = first_polygon(turned.front());
  if (turned.size() == told) {
    report.add(RepairKind::components_turned, 1, detail);
    return;
  }
  std::sort(turned.begin(), turned.end());
  turned.erase(std::unique(turned.begin(), turned.end()), turned.end());
  report.add(RepairKind::faces_turned, turned.size(), detail);
}

}  // namespace

void pair_faces(TriangleList& list, std::vector<EdgeUse>& uses, RepairReport& report) {
  bool any = false;
  std::vector<bool> crowded(list.points.size(), false);
  DisjointSets components(list.triangles.size());
  for_each_edge(uses, [&](std::size_t i, std::size_t j) {
    if (j - i > 2) {
      any = crowded[uses[i].low] = crowded[uses[i].high] = true;
    } else if (j - i == 2) {
      components.join(uses[i].triangle, uses[i + 1].triangle);
    }
  });
  if (!any) {
    return;
  }
  DisjointSets fans(3 * list.triangles.size());
  for_each_edge(uses, [&](std::size_t i, std::size_t j) {
    if (j - i == 2) {
      hold_together(list, uses[i], uses[i + 1], fans);
    } else if (j - i > 2) {
      const std::vector<Blade> blades = blades_at(list, uses, i, j, components);
      std::vector<UsePair> pairs;
      if (!two_of_each_component(blades)) {
        pairs = around_solids(blades);
      }
      if (pairs.empty()) {
        pairs = by_component_and_turn(blades);
      }
      for (const UsePair& pair : pairs) {
        hold_together(list, uses[pair[0]], uses[pair[1]], fans);
      }
    }
  });
  const std::vector<EdgeUse> before = std::move(uses);
  part_fans(list, crowded, fans);
  uses = edge_uses(list.triangles);
  // An edge is cut where a triangle at it is alone now, or where it is crowded still.
  std::vector<std::uint8_t> companions(3 * list.triangles.size(), 0);
  for_each_edge(uses, [&](std::size_t i, std::size_t j) {
    for (std::size_t k = i; k < j; ++k) {
      companions[3 * uses[k].triangle + uses[k].side] =
          static_cast<std::uint8_t>(std::min<std::size_t>(j - i, 3));
    }
  });
  for_each_edge(before, [&](std::size_t i, std::size_t j) {
    if (j - i > 2) {
      const bool paired = std::all_of(
          before.begin() + static_cast<std::ptrdiff_t>(i), before.begin() + static_cast<std::ptrdiff_t>(j),
          [&](const EdgeUse& use) { return companions[3 * use.triangle + use.side] == 2; });
      report.add(paired ? RepairKind::edges_paired : RepairKind::edges_split, 1,
                 first_at_polygon(list.triangles[before[i].triangle].origin));
    }
  });
}

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
