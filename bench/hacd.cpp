// SPDX-License-Identifier: GPL-3.0-or-later
// HACD, as Debian's libbullet-extras-dev has it, against our segmentation: models of an unpacked Princeton
// Segmentation Benchmark, parts, seconds, volume ratio, and whether the hulls hold the model.
//
// HACD scales the diagonal of the model's bounding box to 2000; the paper's tolerance of 0.1 in a ball of
// radius 1 is therefore a concavity of 100. Its time depends on the shape and may be hours; each model runs
// in a process of its own with a limit.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

#include <hacdHACD.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "psb.hpp"
#include "segment/evaluate.hpp"
#include "segment/segment.hpp"

namespace {

using namespace ridgecraft;
namespace fs = std::filesystem;

/// The paper's tolerance, in HACD's scale.
constexpr double concavity = 100.0;
/// HACD gives hulls back in numbers that were scaled and moved: farther outside than this share of the radius
/// isn't rounding.
constexpr double rounding = 1e-4;
constexpr unsigned rays_a_side = 128;

struct Peer {
  double parts = 0.0;
  double seconds = 0.0;
  double volume = 0.0;       ///< of the union of its own hulls, over the model's
  double part_volume = 0.0;  ///< of the union of the whole hulls of its parts
  double outside = 0.0;      ///< greatest distance of a vertex from its part's hull, in radii of the model
  double uncovered = 0.0;    ///< share of the model's vertices outside the hull of a part of theirs
};

using Points = std::vector<Vec3>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

struct Body {
  Points points;
  Triangles triangles;
};

/// How far a point is outside the planes of a body's triangles; 0 inside.
double outside(const Body& body, Vec3 p) {
  double most = 0.0;
  for (const auto& [a, b, c] : body.triangles) {
    const Vec3 n = cross(body.points[b] - body.points[a], body.points[c] - body.points[a]);
    if (length(n) > 0.0) {
      most = std::fmax(most, dot(normalized(n), p - body.points[a]));
    }
  }
  return most;
}

/// Volume of the union of the bodies' hulls.
double united_volume(const std::vector<Body>& bodies) {
  Points points;
  std::vector<std::array<VertexId, 3>> corners;
  std::vector<std::uint32_t> label;
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    const std::size_t first = points.size();
    points.insert(points.end(), bodies[i].points.begin(), bodies[i].points.end());
    for (const auto& [a, b, c] : bodies[i].triangles) {
      corners.push_back({VertexId(first + a), VertexId(first + b), VertexId(first + c)});
      label.push_back(i);
    }
  }
  const mesh::Surface all(std::move(points), std::move(corners));
  return segment::hull_volume_ratio(all, label, rays_a_side, Context{}) * segment::enclosed_volume(all);
}

double radius_of(const mesh::Surface& surface) {
  return 0.5 * length(surface.bounds().size());
}

std::vector<Body> hulls_of(HACD::HACD& hacd) {
  std::vector<Body> bodies(hacd.GetNClusters());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    std::vector<HACD::Vec3<HACD::Real>> points(hacd.GetNPointsCH(i));
    std::vector<HACD::Vec3<long>> triangles(hacd.GetNTrianglesCH(i));
    hacd.GetCH(i, points.data(), triangles.data());
    for (const auto& p : points) {
      bodies[i].points.push_back({p.X(), p.Y(), p.Z()});
    }
    for (const auto& t : triangles) {
      bodies[i].triangles.push_back({static_cast<std::uint32_t>(t.X()), static_cast<std::uint32_t>(t.Y()),
                                     static_cast<std::uint32_t>(t.Z())});
    }
  }
  return bodies;
}

Peer run_peer(const bench::BenchmarkModel& model) {
  const mesh::Surface& s = model.read.surface;
  std::vector<HACD::Vec3<HACD::Real>> points;
  for (const Vec3 p : s.points()) {
    points.emplace_back(p.x, p.y, p.z);
  }
  std::vector<HACD::Vec3<long>> triangles;
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    const auto [a, b, c] = s.vertices(f);
    triangles.emplace_back(static_cast<long>(a.value()), static_cast<long>(b.value()),
                           static_cast<long>(c.value()));
  }
  const double start = bench::cpu_seconds();
  HACD::HACD hacd;
  hacd.SetPoints(points.data());
  hacd.SetNPoints(points.size());
  hacd.SetTriangles(triangles.data());
  hacd.SetNTriangles(triangles.size());
  hacd.SetCompacityWeight(0.0001);
  hacd.SetVolumeWeight(0.0);
  hacd.SetNClusters(1);
  hacd.SetNVerticesPerCH(100);
  hacd.SetConnectDist(30.0);
  hacd.SetConcavity(concavity);
  hacd.SetAddExtraDistPoints(false);
  hacd.SetAddNeighboursDistPoints(false);
  hacd.SetAddFacesPoints(false);
  hacd.Compute();
  Peer peer;
  peer.seconds = bench::cpu_seconds() - start;
  const std::span<const long> partition(hacd.GetPartition(), triangles.size());
  std::vector<std::uint32_t> labels;
  for (const long p : partition) {
    labels.push_back(static_cast<std::uint32_t>(p));
  }
  peer.parts = static_cast<double>(hacd.GetNClusters());
  const Context context;
  peer.part_volume = bench::judge(model, labels, context).volume;
  hacd.DenormalizeData();
  const std::vector<Body> bodies = hulls_of(hacd);
  peer.volume = united_volume(bodies) / segment::enclosed_volume(s);
  std::vector<bool> uncovered(s.vertex_count(), false);
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    for (const VertexId v : s.vertices(f)) {
      const double by = outside(bodies[labels[f.value()]], s.point(v)) / radius_of(s);
      peer.outside = std::fmax(peer.outside, by);
      uncovered[v.value()] = uncovered[v.value()] || by > rounding;
    }
  }
  peer.uncovered = static_cast<double>(std::count(uncovered.begin(), uncovered.end(), true)) /
                   static_cast<double>(s.vertex_count());
  return peer;
}

/// In a process of its own; none when it took longer than the limit or died.
std::optional<Peer> run_limited(const bench::BenchmarkModel& model, unsigned limit) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) {
    return {};
  }
  const pid_t child = fork();
  if (child == 0) {
    const rlimit time{limit, limit};
    setrlimit(RLIMIT_CPU, &time);
    std::fclose(stdout);  // HACD prints its progress
    const Peer peer = run_peer(model);
    const ssize_t sent = write(ends[1], &peer, sizeof peer);
    _exit(sent == static_cast<ssize_t>(sizeof peer) ? 0 : 1);
  }
  close(ends[1]);
  Peer peer;
  const bool got = read(ends[0], &peer, sizeof peer) == static_cast<ssize_t>(sizeof peer);
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return got ? std::optional(peer) : std::nullopt;
}

void print_ours(const bench::BenchmarkModel& model) {
  const double start = bench::cpu_seconds();
  const auto result = segment::segment(model.read.surface, model.read.polygon.items(), {}, Context{});
  const double seconds = model.seconds + bench::cpu_seconds() - start;
  std::vector<std::uint32_t> labels;
  for (const PartId p : result.part) {
    labels.push_back(p.value());
  }
  const bench::Figures figures = bench::judge(model, labels, Context{});
  std::printf("  | %5.0f %8.3f %7.3f %5zu\n", figures.parts, seconds, figures.volume,
              bench::outside_hulls(model.read.surface, result));
}

/// The model with the fewest faces of each category, by the size of its file.
std::vector<int> smallest_of_each(const fs::path& psb) {
  std::map<int, std::pair<std::uintmax_t, int>> smallest;
  for (const int m : bench::models_in(psb, false)) {
    const std::pair key{fs::file_size(psb / "off" / (std::to_string(m) + ".off")), m};
    auto& best = smallest.try_emplace(bench::category_number(m), key).first->second;
    best = std::min(best, key);
  }
  std::vector<int> models;
  for (const auto& [category, best] : smallest) {
    models.push_back(best.second);
  }
  return models;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr,
                 "usage: bench_hacd PSB [SECONDS [MODEL...]]\n"
                 "without models: the smallest of each category; SECONDS (300) limits each\n");
    return 2;
  }
  const fs::path psb = argv[1];
  const unsigned limit = argc > 2 ? static_cast<unsigned>(std::stoul(argv[2])) : 300;
  std::vector<int> models;
  for (int i = 3; i < argc; ++i) {
    models.push_back(std::stoi(argv[i]));
  }
  if (models.empty()) {
    models = smallest_of_each(psb);
  }
  std::printf(
      "model category    faces | HACD: parts seconds, volume of its hulls, of its parts' hulls, vertices "
      "outside, how far | ours: parts seconds volume, vertices outside\n");
  for (const int m : models) {
    const bench::BenchmarkModel model = bench::read_model(psb, m, Context{});
    std::printf("%5d %-10s %6zu ", m, bench::category_of(m).c_str(), model.read.surface.face_count());
    std::fflush(stdout);
    if (const auto peer = run_limited(model, limit)) {
      std::printf("%5.0f %8.2f %7.3f %7.3f %6.2f%% %8.5f", peer->parts, peer->seconds, peer->volume,
                  peer->part_volume, 100.0 * peer->uncovered, peer->outside);
    } else {
      std::printf("stopped after %u s", limit);
    }
    print_ours(model);
    std::fflush(stdout);
  }
  return 0;
}
