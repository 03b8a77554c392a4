// SPDX-License-Identifier: GPL-3.0-or-later
// A peer for prepare's simplification: edges collapse by quadrics alone (M. Garland, P. Heckbert, Surface
// simplification using quadric error metrics, 1997, as CGAL has it), without regard to walls, folds or
// symmetry.
//
//   bench_collapse FOLDER OTHER
//
// For each pair NAME.before.obj, NAME.obj of FOLDER, as bench_simplify --obj FOLDER writes them: the first
// one down to as many faces as the second has, or to as few as CGAL reaches, as OTHER/NAME.obj, for
// bench/likeness.py FOLDER OTHER.
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <fmt/format.h>

#include "mesh/mesh.hpp"
#include "mesh/write.hpp"

using namespace ridgecraft;

namespace {

namespace sms = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Policies = sms::GarlandHeckbert_plane_policies<Mesh, Kernel>;

/// CGAL's own stops count edges.
struct FewFaces {
  const Mesh* mesh = nullptr;
  std::size_t faces = 0;

  template <class Cost, class Profile, class Count>
  bool operator()(const Cost&, const Profile&, Count, Count) const {
    return mesh->number_of_faces() <= faces;
  }
};

/// Each vertex of the surface is one of the mesh: a surface has at most one fan of faces at each.
Mesh mesh_of(const mesh::Surface& surface) {
  Mesh result;
  for (const Vec3& p : surface.points()) {
    result.add_vertex({p.x, p.y, p.z});
  }
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto& [a, b, c] = surface.vertices(f);
    result.add_face(Mesh::Vertex_index(a.value()), Mesh::Vertex_index(b.value()),
                    Mesh::Vertex_index(c.value()));
  }
  return result;
}

mesh::Surface surface_of(Mesh& mesh) {
  mesh.collect_garbage();
  std::vector<Vec3> points;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    points.push_back({p.x(), p.y(), p.z()});
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const auto f : mesh.faces()) {
    auto corner = mesh.vertices_around_face(mesh.halfedge(f)).begin();
    std::array<VertexId, 3>& face = faces.emplace_back();
    for (VertexId& v : face) {
      v = VertexId(static_cast<std::uint32_t>(std::size_t{*corner++}));
    }
  }
  return {std::move(points), std::move(faces)};
}

void run(const std::filesystem::path& before, const std::filesystem::path& after, const std::string& other) {
  Mesh mesh = mesh_of(mesh::read(before.string(), {}, {}).surface);
  const std::size_t all = mesh.number_of_faces();
  const std::size_t wanted = mesh::read(after.string(), {}, {}).surface.face_count();
  if (wanted < all) {
    const Policies policies(mesh);
    sms::edge_collapse(
        mesh, FewFaces{&mesh, wanted},
        CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
  }
  fmt::print("{:36.36} {:7} {:6} {:6}\n", after.stem().string(), all, wanted, mesh.number_of_faces());
  std::fflush(stdout);
  std::ofstream(std::filesystem::path(other) / after.filename(), std::ios::binary)
      << mesh::write_obj(surface_of(mesh));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "bench_collapse FOLDER OTHER\n");
    return 2;
  }
  constexpr std::string_view ending = ".before.obj";
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1])) {
    const std::string name = entry.path().string();
    if (name.ends_with(ending)) {
      names.push_back(name.substr(0, name.size() - ending.size()));
    }
  }
  std::sort(names.begin(), names.end());
  fmt::print("{:36} {:>7} {:>6} {:>6}\n", "model", "faces", "wanted", "left");
  int failed = 0;
  for (const std::string& name : names) {
    try {
      run(name + std::string(ending), name + ".obj", argv[2]);
    } catch (const std::exception& e) {
      fmt::print("{}: {}\n", name, e.what());
      ++failed;
    }
  }
  return failed == 0 ? 0 : 1;
}
