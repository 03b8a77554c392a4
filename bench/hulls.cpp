// SPDX-License-Identifier: GPL-3.0-or-later
// How well sets of convex hulls fit a model, whatever made them: bench_hulls MODEL HULLS.obj..., one JSON
// line a set.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include "base/context.hpp"
#include "base/random.hpp"
#include "mesh/mesh.hpp"
#include "solid/cover.hpp"
#include "solid/solid.hpp"

namespace ridgecraft::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = CGAL::Surface_mesh<Kernel::Point_3>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Triangles>>>;

/// Points on all hulls' surfaces that are asked how far the model is.
constexpr int samples = 4000;
/// A vertex is outside of what doesn't reach it by more than this share of the model's diagonal.
constexpr double outside_share = 1e-6;
/// Height of a triangle over its longest side, below which it tells no plane.
constexpr double needle = 1e-6;

/// One body an object (CoACD, V-HACD and Ridgecraft all write that).
std::vector<solid::Body> read_hulls(const std::string& file) {
  std::ifstream in(file);
  std::vector<solid::Body> bodies;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "o") {
      first = count;
      bodies.emplace_back();
    } else if (kind == "v") {
      Vec3 p;
      words >> p.x >> p.y >> p.z;
      bodies.back().points.push_back(p);
      ++count;
    } else if (kind == "f") {
      std::array<std::uint32_t, 3> triangle{};
      for (std::uint32_t& corner : triangle) {
        std::string word;
        words >> word;
        corner = static_cast<std::uint32_t>(std::stoul(word)) - 1 - first;
      }
      bodies.back().triangles.push_back(triangle);
    }
  }
  return bodies;
}

Kernel::Point_3 to_cgal(Vec3 p) {
  return {p.x, p.y, p.z};
}

struct Side {
  Vec3 normal;
  double offset;
};

/// How far a point is outside the planes of a convex body; negative inside.
double distance_outside(Vec3 p, const std::vector<Side>& sides) {
  double worst = -INFINITY;
  for (const Side& side : sides) {
    worst = std::fmax(worst, dot(side.normal, p) - side.offset);
  }
  return worst;
}

std::vector<Side> sides_of(const solid::Body& body) {
  std::vector<Side> sides;
  for (const auto& [a, b, c] : body.triangles) {
    const Vec3 ab = body.points[b] - body.points[a];
    const Vec3 ac = body.points[c] - body.points[a];
    const Vec3 normal = cross(ab, ac);
    // Of a needle rounding leaves no direction; its neighbours in the same side have one.
    if (length(normal) > needle * std::fmax(dot(ab, ab), dot(ac, ac))) {
      sides.push_back({normalized(normal), dot(normalized(normal), body.points[a])});
    }
  }
  return sides;
}

class Measure {
 public:
  explicit Measure(const std::string& file) {
    mesh::ReadOptions options;
    options.collapse_flat_faces = false;
    model_ = mesh::read(file, options, context_);
    surface_ = mesh::surface_in_file_numbers(model_);
    for (const Vec3 p : surface_.points()) {
      triangles_.add_vertex(to_cgal(p));
    }
    for (const FaceId f : ids<FaceId>(surface_.face_count())) {
      const auto [a, b, c] = surface_.vertices(f);
      using V = Triangles::Vertex_index;
      triangles_.add_face(V(a.value()), V(b.value()), V(c.value()));
    }
    tree_.insert(faces(triangles_).first, faces(triangles_).second, triangles_);
  }

  [[nodiscard]] std::string line(const std::string& file) const {
    const std::vector<solid::Body> bodies = read_hulls(file);
    std::vector<std::vector<Side>> sides;
    std::size_t most_vertices = 0;
    for (const solid::Body& body : bodies) {
      sides.push_back(sides_of(body));
      most_vertices = std::max(most_vertices, body.points.size());
    }
    const double diagonal = surface_.bounds().diagonal();
    std::size_t outside = 0;
    for (const Vec3 p : surface_.points()) {
      outside += std::all_of(sides.begin(), sides.end(), [&](const std::vector<Side>& one) {
        return distance_outside(p, one) > outside_share * diagonal;
      });
    }
    const solid::Fit fit = solid::fit_of(surface_, bodies, context_);
    const auto [mean, largest] = distances(bodies, sides);
    return fmt::format(
        R"({{"file":"{}","hulls":{},"vertices":{},"ratio":{:.5f},"uncovered":{:.6f},"outside":{:.6f},)"
        R"("mean":{:.6f},"largest":{:.6f}}})",
        file, bodies.size(), most_vertices,
        fit.solid_volume > 0.0 ? fit.union_volume / fit.solid_volume : 0.0, fit.uncovered,
        static_cast<double>(outside) / static_cast<double>(surface_.points().size()), mean / diagonal,
        largest / diagonal);
  }

 private:
  /// From the union's surface to the model's.
  [[nodiscard]] std::array<double, 2> distances(const std::vector<solid::Body>& bodies,
                                                const std::vector<std::vector<Side>>& sides) const {
    double area = 0.0;
    std::vector<double> until;
    std::vector<std::array<std::size_t, 2>> which;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      for (std::size_t k = 0; k < bodies[i].triangles.size(); ++k) {
        const auto [a, b, c] = bodies[i].triangles[k];
        const std::vector<Vec3>& p = bodies[i].points;
        area += length(cross(p[b] - p[a], p[c] - p[a]));
        until.push_back(area);
        which.push_back({i, k});
      }
    }
    Random random(1);
    double sum = 0.0;
    double largest = 0.0;
    std::size_t count = 0;
    for (int n = 0; n < samples; ++n) {
      const auto at = std::upper_bound(until.begin(), until.end(), random.unit() * area) - until.begin();
      const auto [i, k] = which[std::min(static_cast<std::size_t>(at), which.size() - 1)];
      const auto [a, b, c] = bodies[i].triangles[k];
      const std::vector<Vec3>& p = bodies[i].points;
      const double root = std::sqrt(random.unit());
      const double share = random.unit();
      const Vec3 point = (1.0 - root) * p[a] + (root * (1.0 - share)) * p[b] + (root * share) * p[c];
      bool buried = false;
      for (std::size_t j = 0; j < bodies.size() && !buried; ++j) {
        buried = j != i && distance_outside(point, sides[j]) < outside_share * surface_.bounds().diagonal();
      }
      if (!buried) {
        const double d = std::sqrt(tree_.squared_distance(to_cgal(point)));
        sum += d;
        largest = std::fmax(largest, d);
        ++count;
      }
    }
    return {count == 0 ? 0.0 : sum / static_cast<double>(count), largest};
  }

  Context context_;
  mesh::Model model_;
  mesh::Surface surface_;
  Triangles triangles_;
  Tree tree_;
};

}  // namespace
}  // namespace ridgecraft::bench

int main(int argc, char** argv) {
  try {
    if (argc < 3) {
      std::fputs("usage: bench_hulls MODEL HULLS.obj...\n", stderr);
      return 2;
    }
    const ridgecraft::bench::Measure measure(argv[1]);
    for (int i = 2; i < argc; ++i) {
      std::puts(measure.line(argv[i]).c_str());
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_hulls: %s\n", error.what());
    return 1;
  }
}
