// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/repair.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/context.hpp"
#include "base/disjoint_sets.hpp"
#include "base/error.hpp"
#include "mesh/repair/clean_polygons.hpp"
#include "mesh/repair/orient.hpp"
#include "mesh/repair/pair_faces.hpp"
#include "mesh/repair/polygon_list.hpp"
#include "mesh/repair/self_intersections.hpp"
#include "mesh/repair/star_polygons.hpp"
#include "mesh/repair/weld.hpp"

namespace ridgecraft::mesh {
namespace {

// Faces without area: paper can't hold them. Private to mesh/.

/// A height below this share of the longest side is none: far below what a coordinate of a file can say.
inline constexpr double no_height = 1e-9;

/// Where flat faces share an edge with a fan of others, each divides each: no more than this many times the
/// triangles that there were. A surface without such edges gains less than one for each flat face.
constexpr std::size_t most_growth = 4;

/// Is the triangle without area in the sense of this header?
bool is_flat(Vec3 a, Vec3 b, Vec3 c) {
  const double longest = std::max({length(b - a), length(c - b), length(a - c)});
  return !(length(cross(b - a, c - a)) > no_height * longest * longest);
}

struct Sides {
  std::array<double, 3> length;  ///< of the side from corner k to corner k + 1
  unsigned longest;
  unsigned shortest;
};

Sides sides_of(const TriangleList& list, const Triangle& t) {
  Sides s{};
  for (unsigned k = 0; k < 3; ++k) {
    s.length[k] = length(list.points[t.points[(k + 1) % 3]] - list.points[t.points[k]]);
    s.longest = s.length[k] > s.length[s.longest] ? k : s.longest;
    s.shortest = s.length[k] < s.length[s.shortest] ? k : s.shortest;
  }
  return s;
}

bool has_no_area(const TriangleList& list, const Triangle& t) {
  return is_flat(list.points[t.points[0]], list.points[t.points[1]], list.points[t.points[2]]);
}

/// Joins the ends of sides that are nothing beside the others. True when it did.
bool join_short_sides(TriangleList& list, const std::vector<std::size_t>& flat) {
  DisjointSets joined(list.points.size());
  bool any = false;
  for (const std::size_t i : flat) {
    const Triangle& t = list.triangles[i];
    const Sides s = sides_of(list, t);
    if (s.length[s.shortest] <= no_height * s.length[s.longest]) {
      any = joined.join(t.points[s.shortest], t.points[(s.shortest + 1) % 3]) || any;
    }
  }
  if (any) {
    for (Triangle& t : list.triangles) {
      for (std::uint32_t& p : t.points) {
        p = joined.find(p);
      }
    }
    std::erase_if(list.triangles, [](const Triangle& t) {
      return t.points[0] == t.points[1] || t.points[1] == t.points[2] || t.points[2] == t.points[0];
    });
  }
  return any;
}

/// Takes flat triangles away, the one with the longest side first, and divides the others at that side. The
/// sum of the flat triangles' longest sides falls with each step, so it ends. Once there are very many, the
/// others stay whole, and a seam without width opens.
class Divider {
 public:
  explicit Divider(TriangleList& list)
      : list_(list), gone_(list.triangles.size(), false), most_(most_growth * list.triangles.size()) {}

  void run(const Context& context) {
    for (std::size_t i = 0; i < list_.triangles.size(); ++i) {
      enter(i);
    }
    for (std::size_t steps = 0; !queue_.empty(); ++steps) {
      if (steps % 1024 == 0) {
        context.check();
      }
      const std::size_t i = std::prev(queue_.end())->second;
      step(i);
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < list_.triangles.size(); ++i) {
      if (!gone_[i]) {
        list_.triangles[kept++] = list_.triangles[i];
      }
    }
    list_.triangles.resize(kept);
  }

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  static Edge edge(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

  void enter(std::size_t i) {
    const Triangle& t = list_.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      uses_[edge(t.points[k], t.points[(k + 1) % 3])].insert(i);
    }
    if (has_no_area(list_, t)) {
      const Sides s = sides_of(list_, t);
      queue_.insert({s.length[s.longest], i});
    }
  }

  void leave(std::size_t i) {
    const Triangle& t = list_.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      uses_[edge(t.points[k], t.points[(k + 1) % 3])].erase(i);
    }
    const Sides s = sides_of(list_, t);
    queue_.erase({s.length[s.longest], i});
    gone_[i] = true;
  }

  void step(std::size_t i) {
    const Triangle flat = list_.triangles[i];
    const unsigned k = sides_of(list_, flat).longest;
    const std::uint32_t a = flat.points[k];
    const std::uint32_t b = flat.points[(k + 1) % 3];
    const std::uint32_t middle = flat.points[(k + 2) % 3];
    leave(i);
    if (list_.triangles.size() > most_) {
      return;
    }
    const std::set<std::size_t> beyond = uses_[edge(a, b)];
    for (const std::size_t j : beyond) {
      const Triangle t = list_.triangles[j];
      leave(j);
      unsigned side = 0;
      while (edge(t.points[side], t.points[(side + 1) % 3]) != edge(a, b)) {
        ++side;
      }
      if (t.points[(side + 2) % 3] == middle) {
        continue;  // the same place again: nothing is left of it
      }
      for (const unsigned half : {0U, 1U}) {
        Triangle part = t;
        const unsigned moved = (side + 1 - half) % 3;
        part.points[moved] = middle;
        list_.triangles.push_back(part);
        gone_.push_back(false);
        enter(list_.triangles.size() - 1);
      }
    }
  }

  TriangleList& list_;
  std::vector<bool> gone_;
  std::size_t most_;  ///< triangles, those that are gone included
  std::map<Edge, std::set<std::size_t>> uses_;
  std::set<std::pair<double, std::size_t>> queue_;
};

/// Removes the flat triangles without opening the surface: where two corners are at one place they become one
/// point; where a corner lies on the side opposite, the triangles beyond that side get the corner, too. Works
/// on any list. Returns how many of the triangles given were flat. O(n log n).
std::size_t collapse_flat_triangles(TriangleList& list, const Context& context) {
  std::vector<std::size_t> flat;
  for (std::size_t i = 0; i < list.triangles.size(); ++i) {
    if (has_no_area(list, list.triangles[i])) {
      flat.push_back(i);
    }
  }
  const std::size_t count = flat.size();
  while (!flat.empty() && join_short_sides(list, flat)) {
    context.check();
    flat.clear();
    for (std::size_t i = 0; i < list.triangles.size(); ++i) {
      if (has_no_area(list, list.triangles[i])) {
        flat.push_back(i);
      }
    }
  }
  if (!flat.empty()) {
    Divider(list).run(context);
  }
  return count;
}

/// Coordinates from 2^-200 to 2^200 can be multiplied four times without leaving the range of a double.
constexpr int largest_exponent = 200;
/// Nearly equal points of borders, share of the diagonal: far more than rounding in a file's decimals leaves
/// between copies of a point, far less than any detail that paper shows.
constexpr double near = 1e-6;
/// Distance of a polygon's corners from its mean plane, share of the diagonal: what a panel may have, too.
constexpr double flat = 1e-5;

/// Takes the polygons over; points keep their numbers.
PolygonList polygons_of(const Soup& soup) {
  PolygonList list;
  list.points = soup.points;
  list.first = soup.first_corner;
  list.corners = soup.corner_point;
  list.textures = soup.corner_texture;
  list.origin.resize(soup.polygon_count());
  for (std::size_t i = 0; i < list.origin.size(); ++i) {
    list.origin[i] = static_cast<std::uint32_t>(i);
  }
  list.two_sided.assign(soup.polygon_count(), 0);
  return list;
}

std::vector<bool> used_points(const PolygonList& list) {
  std::vector<bool> used(list.points.size(), false);
  for (const std::uint32_t c : list.corners) {
    used[c] = true;
  }
  return used;
}

Box3 bounds(const PolygonList& list) {
  Box3 box;
  for (const std::uint32_t c : list.corners) {
    box.add(list.points[c]);
  }
  return box;
}

/// Brings extreme coordinates to about 1 by an exact power of two and returns what undoes it.
double scale_into_range(PolygonList& list, const std::vector<bool>& used) {
  double largest = 0.0;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) {
      const Vec3 p = list.points[i];
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
  }
  const int exponent = largest > 0.0 ? std::ilogb(largest) : 0;
  if (std::abs(exponent) <= largest_exponent) {
    return 1.0;
  }
  for (Vec3& p : list.points) {
    p = {std::ldexp(p.x, -exponent), std::ldexp(p.y, -exponent), std::ldexp(p.z, -exponent)};
  }
  return std::ldexp(1.0, exponent);
}

bool any_area(const TriangleList& list, double diagonal) {
  // Below this share of the diagonal a height is nothing, whatever the size on paper.
  constexpr double nothing = 1e-12;
  return std::any_of(list.triangles.begin(), list.triangles.end(), [&](const Triangle& t) {
    const Vec3 a = list.points[t.points[0]];
    const Vec3 b = list.points[t.points[1]];
    const Vec3 c = list.points[t.points[2]];
    const double longest = std::max({length(b - a), length(c - b), length(a - c)});
    return !is_flat(a, b, c) && length(cross(b - a, c - a)) > nothing * diagonal * longest;
  });
}

std::shared_ptr<const CornerColours> corner_colours_of(const Soup& soup, double file_scale) {
  if (soup.corner_colour.empty()) {
    return nullptr;
  }
  CornerColours colours{soup.first_corner, {}, soup.corner_colour};
  colours.point.reserve(soup.corner_point.size());
  for (const std::uint32_t p : soup.corner_point) {
    colours.point.push_back(soup.points[p] / file_scale);
  }
  return std::make_shared<const CornerColours>(std::move(colours));
}

/// Objects of one name are one.
void take_objects(const Soup& soup, Model& model) {
  std::map<std::string_view, std::uint32_t> number;
  std::vector<std::uint32_t> of_range;
  for (const auto& [first, name] : soup.objects) {
    if (name.empty()) {
      of_range.push_back(Soup::none);
      continue;
    }
    const auto [at, fresh] = number.try_emplace(name, static_cast<std::uint32_t>(model.objects.size()));
    if (fresh) {
      model.objects.push_back(name);
    }
    of_range.push_back(at->second);
  }
  if (model.objects.empty()) {
    return;
  }
  model.object.reserve(model.polygon.size());
  for (const std::uint32_t polygon : model.polygon) {
    const auto after = std::upper_bound(soup.objects.begin(), soup.objects.end(), polygon,
                                        [](std::uint32_t p, const auto& object) { return p < object.first; });
    model.object.push_back(after == soup.objects.begin()
                               ? Soup::none
                               : of_range[static_cast<std::size_t>(after - soup.objects.begin()) - 1]);
  }
}

/// The polygon whose material a triangle shows: the reversed copy of its own where it runs the way of that.
std::uint32_t shown_polygon(const TriangleList& list, const Triangle& triangle) {
  const auto copy = triangle.turned ? list.reversed_copy.find(triangle.origin) : list.reversed_copy.end();
  return copy == list.reversed_copy.end() ? triangle.origin : copy->second;
}

/// The texture of the polygon's corner that is nearest to a place.
std::uint32_t texture_at(const Soup& soup, std::uint32_t polygon, Vec3 place) {
  std::uint32_t nearest = Soup::none;
  double least = INFINITY;
  for (std::uint32_t c = soup.first_corner[polygon]; c < soup.first_corner[polygon + 1]; ++c) {
    const Vec3 away = soup.points[soup.corner_point[c]] - place;
    if (const double distance = dot(away, away); distance < least) {
      least = distance;
      nearest = soup.corner_texture[c];
    }
  }
  return nearest;
}

Model build(const Soup& soup, const TriangleList& list, double file_scale) {
  Model model;
  std::vector<std::array<std::uint32_t, 3>> faces;
  const bool textured = !soup.corner_texture.empty();
  const auto place = [&](std::uint32_t t) { return t == Soup::none ? Vec2{} : soup.texture_points[t]; };
  for (const Triangle& t : list.triangles) {
    faces.push_back(t.points);
    model.polygon.push_back(t.origin);
    const std::uint32_t shown = shown_polygon(list, t);
    if (!soup.polygon_material.empty()) {
      model.material.push_back(soup.polygon_material[shown]);
    }
    if (textured) {
      std::array<std::uint32_t, 3> textures = t.textures;
      for (std::size_t k = 0; k < 3 && shown != t.origin; ++k) {
        textures[k] = texture_at(soup, shown, file_scale * list.points[t.points[k]]);
      }
      model.texture.push_back({place(textures[0]), place(textures[1]), place(textures[2])});
    }
  }
  model.surface = surface_of(list.points, faces);
  model.polygon_count = soup.polygon_count();
  model.materials = soup.materials;
  take_objects(soup, model);
  return model;
}

void note_borders(Model& model) {
  std::size_t borders = 0;
  for (const EdgeId e : ids<EdgeId>(model.surface.edge_count())) {
    borders += model.surface.is_border(e) ? 1U : 0U;
  }
  model.repairs.add(RepairKind::open_border, borders);
}

}  // namespace

Model repair(Soup soup, const ReadOptions& options, const Context& context) {
  RepairReport report = std::move(soup.remarks);
  PolygonList polygons = polygons_of(soup);
  const std::vector<bool> used = used_points(polygons);
  report.add(RepairKind::unused_points_dropped,
             static_cast<std::size_t>(std::count(used.begin(), used.end(), false)));
  const double file_scale = scale_into_range(polygons, used);
  std::vector<std::array<Vec3, 2>> lines;
  for (const auto& [a, b] : soup.lines) {
    lines.push_back({soup.points[a] / file_scale, soup.points[b] / file_scale});
  }
  std::vector<Vec3> file_points;
  if (options.keep_points) {
    file_points = soup.points;
    for (Vec3& p : file_points) {
      p = p / file_scale;
    }
  }
  const double diagonal = bounds(polygons).diagonal();

  const std::size_t joined = join_equal_points(polygons);
  report.add(RepairKind::points_joined, repeats_points(soup.format) ? 0 : joined);
  drop_repeated_corners(polygons, report);
  outline_stars(polygons, flat * diagonal, report);
  report.add(RepairKind::border_points_joined, join_border_points(polygons, near * diagonal, context));
  drop_duplicates(polygons, report);
  context.check();
  TriangleList triangles = triangulate(std::move(polygons), flat * diagonal, report, context);
  drop_duplicates(triangles, report);
  if (!any_area(triangles, diagonal)) {
    throw Error(ErrorKind::unusable_mesh,
                soup.polygon_count() == 0 ? "there are no faces" : "no face has an area");
  }
  if (options.collapse_flat_faces) {
    report.add(RepairKind::flat_faces_collapsed, collapse_flat_triangles(triangles, context));
    drop_duplicates(triangles, report);
    if (triangles.triangles.empty()) {
      throw Error(ErrorKind::unusable_mesh, "no face has an area beside which the others count");
    }
  }
  std::vector<EdgeUse> uses = edge_uses(triangles.triangles);
  report.add(RepairKind::t_junctions_joined, join_t_junctions(triangles, uses, near * diagonal, context));
  make_manifold(triangles, uses, report, context);
  turn_outwards(triangles, uses, report, context);
  uses = std::vector<EdgeUse>();  // = {} would keep its memory while the surface is built
  Model model = build(soup, triangles, file_scale);
  model.file_scale = file_scale;
  model.corner_colours = corner_colours_of(soup, file_scale);
  model.lines = std::move(lines);
  model.file_points = std::move(file_points);
  model.format = soup.format;
  model.frame = soup.frame;
  model.repairs = std::move(report);
  note_borders(model);
  context.check();
  model.repairs.add(RepairKind::self_intersections, count_self_intersections(model.surface, context));
  return model;
}

}  // namespace ridgecraft::mesh
