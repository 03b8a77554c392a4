// SPDX-License-Identifier: GPL-3.0-or-later
// What becomes of the bodies of models, and whether the skin shows what can be seen of them:
//
//   bench_skin [--size MM] MODEL...
//
// A line for each: bodies (components) as read, after those that nobody could hold were left out, after
// union, and after the same was left out of the skin; faces and how much of the area lay inside others;
// bodies that weren't united, openings that were closed, and bodies that were left out because nobody sees
// them. Then looks from 100 sides, 2,500 parallel rays each, by CGAL's tree, which the union shares
// nothing with: how many meet the bodies; of these first places those that aren't on the skin, because
// something new is in front of them ("closed") or though nothing is ("lost"); and how many first places on
// the skin aren't on the bodies ("new": closed openings). Near enough is 0.00001 of the diagonal, and
// where bodies were moved so that they touch, as far as that may have been. "buried": faces of the skin
// that nobody sees, from 12 places on each along 100 directions, and their share of its area.
#include "prepare/skin/skin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <fmt/format.h>

#include "base/random.hpp"
#include "mesh/mesh.hpp"
#include "prepare/ready_bodies.hpp"
#include "prepare/skin/gaps.hpp"

using namespace ridgecraft;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

constexpr int sides = 100;
constexpr int rays_across = 50;
constexpr int places = 12;
constexpr double near_enough = 1e-5;  ///< of the diagonal

Kernel::Point_3 point(Vec3 p) {
  return {p.x, p.y, p.z};
}

/// Even over the sphere.
Vec3 direction(int i) {
  const double z = 1.0 - (2.0 * i + 1.0) / sides;
  const double angle = 0.7 + i * std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// A surface to look at.
class Seen {
 public:
  explicit Seen(const mesh::Surface& surface) {
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      const auto [a, b, c] = surface.vertices(f);
      const Kernel::Triangle_3 triangle(point(surface.point(a)), point(surface.point(b)),
                                        point(surface.point(c)));
      if (!triangle.is_degenerate()) {
        triangles_.push_back(triangle);
      }
    }
    tree_.insert(triangles_.begin(), triangles_.end());
    tree_.accelerate_distance_queries();
  }

  [[nodiscard]] std::optional<Kernel::Point_3> first(Vec3 from, Vec3 way) const {
    const auto hit =
        tree_.first_intersection(Kernel::Ray_3(point(from), Kernel::Vector_3(way.x, way.y, way.z)));
    if (!hit) {
      return std::nullopt;
    }
    if (const auto* at = boost::get<Kernel::Point_3>(&hit->first)) {
      return *at;
    }
    const auto* segment = boost::get<Kernel::Segment_3>(&hit->first);
    return segment != nullptr ? std::optional(segment->source()) : std::nullopt;
  }
  [[nodiscard]] bool holds(const Kernel::Point_3& p, double within) const {
    return tree_.squared_distance(p) <= within * within;
  }
  [[nodiscard]] bool gets_out(Vec3 from, Vec3 way) const {
    return !tree_.do_intersect(Kernel::Ray_3(point(from), Kernel::Vector_3(way.x, way.y, way.z)));
  }

 private:
  Triangles triangles_;
  Tree tree_;
};

struct Looks {
  std::size_t hits = 0, closed = 0, lost = 0, fresh = 0;
};

Looks compare(const Seen& bodies, const Seen& skin, const Box3& box, double near) {
  Looks looks;
  const double diagonal = box.diagonal();
  const Vec3 middle = 0.5 * box.low + 0.5 * box.high;
  for (int i = 0; i < sides; ++i) {
    const Vec3 way = direction(i);
    const Vec3 u = normalized(cross(way, std::abs(way.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    const Vec3 v = cross(way, u);
    for (int x = 0; x < rays_across; ++x) {
      for (int y = 0; y < rays_across; ++y) {
        const double s = ((x + 0.5) / rays_across - 0.5) * diagonal;
        const double t = ((y + 0.5) / rays_across - 0.5) * diagonal;
        const Vec3 from = middle - diagonal * way + s * u + t * v;
        const auto before = bodies.first(from, way);
        const auto after = skin.first(from, way);
        looks.hits += before ? 1U : 0U;
        if (before && !skin.holds(*before, near)) {
          const auto start = point(from);
          const bool covered =
              after && CGAL::squared_distance(start, *after) < CGAL::squared_distance(start, *before);
          ++(covered ? looks.closed : looks.lost);
        }
        looks.fresh += after && !bodies.holds(*after, near) ? 1U : 0U;
      }
    }
  }
  return looks;
}

struct Buried {
  std::size_t faces = 0;
  double share = 0.0;
};

/// Closed components are seen from their front; sheets from either side.
Buried buried(const mesh::Surface& surface, const Seen& skin) {
  std::vector<bool> closed(surface.component_count(), true);
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    for (unsigned k = 0; k < 3; ++k) {
      if (!surface.twin(mesh::corner(f, k)).valid()) {
        closed[surface.component(f).value()] = false;
      }
    }
  }
  Random random(1);
  Buried result;
  const double diagonal = surface.bounds().diagonal();
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    const Vec3 normal = surface.normal(f);
    bool seen = false;
    for (int i = 0; i < places && !seen; ++i) {
      double s = random.unit(), t = random.unit();
      if (s + t > 1.0) {
        s = 1.0 - s;
        t = 1.0 - t;
      }
      const Vec3 at = surface.point(a) + s * (surface.point(b) - surface.point(a)) +
                      t * (surface.point(c) - surface.point(a));
      for (int k = 0; k < sides && !seen; ++k) {
        const Vec3 way = direction(k);
        const double front = dot(way, normal);
        if (front > 0.0 || !closed[surface.component(f).value()]) {
          seen = skin.gets_out(at + (front > 0.0 ? 1.0 : -1.0) * 1e-6 * diagonal * normal, way);
        }
      }
    }
    if (!seen) {
      ++result.faces;
      result.share += surface.area(f) / mesh::total_area(surface);
    }
  }
  return result;
}

void run(const std::string& path, const prepare::SizeOptions& size) {
  mesh::Model model = mesh::read(path, {}, {});
  const std::size_t as_read = model.surface.component_count();
  prepare::ready_bodies(model, size, {}, {});
  const mesh::Surface bodies = model.surface;
  const prepare::SkinReport report = prepare::unite_bodies(model, {});
  const mesh::Surface skin = model.surface;
  if (report.united > 0) {
    prepare::leave_out_details(model, size, {}, {});
  }
  const Seen seen_bodies(bodies);
  const Seen seen_skin(skin);
  const double near = near_enough + (report.gaps_closed > 0 ? prepare::touching : 0.0);
  const Looks looks = compare(seen_bodies, seen_skin, bodies.bounds(), near * bodies.bounds().diagonal());
  const Buried below = buried(skin, seen_skin);
  fmt::print(
      "{:36.36} {:5} {:5} {:5} {:5} {:6} {:6} {:6.1f} {:4} {:4} {:6} {:7} {:6} {:5} {:5} {:6} {:7.3f}\n",
      std::filesystem::path(path).stem().string(), as_read, bodies.component_count(), skin.component_count(),
      model.surface.component_count(), bodies.face_count(), skin.face_count(), 100.0 * report.hidden_share,
      report.left_crossing, report.rims_closed, report.unseen, looks.hits, looks.closed, looks.lost,
      looks.fresh, below.faces, 100.0 * below.share);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  prepare::SizeOptions size;
  std::vector<std::string> models;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--size" && i + 1 < argc) {
      size.largest_extent_mm = std::stod(argv[++i]);
    } else {
      models.push_back(word);
    }
  }
  fmt::print(
      "{:36} {:>5} {:>5} {:>5} {:>5} {:>6} {:>6} {:>6} {:>4} {:>4} {:>6} {:>7} {:>6} {:>5} {:>5} {:>6} "
      "{:>7}\n",
      "model", "read", "ready", "skin", "left", "faces", "skin", "hidden", "not", "rims", "unseen", "rays",
      "closed", "lost", "new", "buried", "%");
  int failed = 0;
  for (const std::string& path : models) {
    try {
      run(path, size);
    } catch (const std::exception& e) {
      fmt::print("{}: {}\n", path, e.what());
      ++failed;
    }
  }
  return failed == 0 ? 0 : 1;
}
