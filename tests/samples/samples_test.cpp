// SPDX-License-Identifier: GPL-3.0-or-later
// The sample models: the files in the repository are those that the generator writes, and every one is what a
// maker may expect of a sample.
#include "samples/samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>

#include <catch2/catch.hpp>

#include "mesh/mesh.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
namespace fs = std::filesystem;

namespace {

const fs::path folder = fs::path(RIDGECRAFT_SOURCE_DIR) / "samples";

/// Share of the edges that are folded or glued and shorter than 6 mm when the model is 150 mm large.
double short_share(const mesh::Surface& surface) {
  const Vec3 size = surface.bounds().size();
  const double scale = 150.0 / std::max({size.x, size.y, size.z});
  double edges = 0.0;
  double short_edges = 0.0;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    // Three degrees: below that nothing is drawn.
    if (std::abs(surface.fold_angle(e)) > 0.052) {
      edges += 1.0;
      short_edges += surface.length(e) * scale < 6.0 ? 1.0 : 0.0;
    }
  }
  return short_edges / edges;
}

double volume(const mesh::Surface& surface) {
  double six = 0.0;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    six += dot(surface.point(a), cross(surface.point(b), surface.point(c)));
  }
  return six / 6.0;
}

/// Six times the signed volume of a tetrahedron.
double orient(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  return dot(cross(b - a, c - a), d - a);
}

/// Edges that run through a face with which they share no vertex: all pairs, without any search structure.
std::size_t crossings(const mesh::Surface& surface) {
  std::size_t count = 0;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const CornerId side = surface.sides(e)[0];
    const VertexId from = surface.vertex(side);
    const VertexId to = surface.vertex(mesh::next(side));
    const Vec3 p = surface.point(from);
    const Vec3 q = surface.point(to);
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      const auto vertices = surface.vertices(f);
      if (std::count(vertices.begin(), vertices.end(), from) +
              std::count(vertices.begin(), vertices.end(), to) >
          0) {
        continue;
      }
      const Vec3 a = surface.point(vertices[0]);
      const Vec3 b = surface.point(vertices[1]);
      const Vec3 c = surface.point(vertices[2]);
      // Files have six digits behind the point: what is nearer to the face's plane than that may lie in it.
      const double p_height = dot(surface.normal(f), p - a);
      const double q_height = dot(surface.normal(f), q - a);
      const bool other_sides = std::min(p_height, q_height) < -3e-6 && std::max(p_height, q_height) > 3e-6;
      const bool first = orient(p, q, a, b) > 0.0;
      if (other_sides && (orient(p, q, b, c) > 0.0) == first && (orient(p, q, c, a) > 0.0) == first) {
        ++count;
        UNSCOPED_INFO("edge near " << p.x << " " << p.y << " " << p.z << " / " << q.x << " " << q.y << " "
                                   << q.z << " face near " << a.x << " " << a.y << " " << a.z);
      }
    }
  }
  return count;
}

}  // namespace

TEST_CASE("the samples in the repository are what the generator writes", "[samples]") {
  const test::TemporaryFolder fresh;
  for (const samples::Sample& sample : samples::all()) {
    samples::write_model(sample.make(), fresh / sample.file);
  }
  CHECK(samples::all().size() >= 12);
  for (const std::string& name : fresh.names()) {
    INFO(name);
    REQUIRE(fs::exists(folder / name));
    CHECK(test::read_bytes(folder / name) == test::read_bytes(fresh / name));
  }
  // Nothing else lies there that looks like a model.
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string suffix = entry.path().extension().string();
    if (std::set<std::string>{".obj", ".mtl", ".stl", ".ply", ".off"}.contains(suffix)) {
      CHECK(fresh.names().contains(entry.path().filename().string()));
    }
  }
}

TEST_CASE("every sample is a sound surface that can be folded", "[samples]") {
  for (const samples::Sample& sample : samples::all()) {
    INFO(sample.file);
    const mesh::Model model = mesh::read(folder / sample.file, {}, {});
    const mesh::Surface& surface = model.surface;
    for (const mesh::Repair& repair : model.repairs.entries()) {
      // An STL has no shared points, and a border is said to be there; nothing else is worth a remark.
      const bool expected = repair.kind == mesh::RepairKind::points_joined ||
                            (repair.kind == mesh::RepairKind::open_border && !sample.closed);
      INFO(english(mesh::message(repair)));
      CHECK(expected);
    }
    CHECK((model.repairs.count(mesh::RepairKind::open_border) == 0) == sample.closed);
    CHECK(surface.component_count() == 1);
    CHECK(surface.face_count() >= 50);
    CHECK(surface.face_count() <= 3000);
    CHECK(short_share(surface) <= 0.1);
    CHECK(crossings(surface) == 0);
    if (sample.closed) {
      CHECK(volume(surface) > 0.0);
    }
  }
}

TEST_CASE("what has a mirror plane is its own mirror image", "[samples]") {
  for (const samples::Sample& sample : samples::all()) {
    const std::string_view name = sample.file;
    if (name != "whale.obj" && name != "fox_head.obj" && name != "dinosaur.obj" && name != "fish.obj" &&
        name != "penguin.obj") {
      continue;
    }
    INFO(name);
    const samples::Shape shape = sample.make();
    const auto key = [](Vec3 p) { return std::array<double, 3>{p.x, p.y, p.z}; };
    std::set<std::array<double, 3>> points;
    for (const Vec3 p : shape.points()) {
      points.insert(key(p));
    }
    for (const Vec3 p : shape.points()) {
      CHECK(points.contains(key({p.x == 0.0 ? 0.0 : -p.x, p.y, p.z})));
    }
  }
}

TEST_CASE("a mug and a torus have one handle, the other closed samples none", "[samples]") {
  for (const samples::Sample& sample : samples::all()) {
    if (!sample.closed) {
      continue;
    }
    INFO(sample.file);
    const mesh::Surface surface = mesh::read(folder / sample.file, {}, {}).surface;
    const auto euler = static_cast<long>(surface.vertex_count()) - static_cast<long>(surface.edge_count()) +
                       static_cast<long>(surface.face_count());
    const std::string_view name = sample.file;
    CHECK(euler == (name == "mug.obj" || name == "torus.off" ? 0 : 2));
  }
}
