// SPDX-License-Identifier: GPL-3.0-or-later
// How the time and memory of segmenting grow: one shape, a sphere with six spikes, in finer and finer meshes.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <vector>

#include <sys/resource.h>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "segment/segment.hpp"

namespace {

using namespace ridgecraft;

/// Radius 1, and 1.9 towards the spikes, which are corners of an icosahedron.
mesh::Surface spiked_sphere(std::uint32_t longitudes, std::uint32_t latitudes) {
  constexpr double golden = std::numbers::phi;
  constexpr double height = 0.9;
  constexpr double width = 0.02;
  const std::array<Vec3, 6> spikes{Vec3{0.0, -1.0, -golden}, Vec3{-1.0, -golden, 0.0},
                                   Vec3{-golden, 0.0, -1.0}, Vec3{0.0, -1.0, golden},
                                   Vec3{-1.0, golden, 0.0},  Vec3{golden, 0.0, -1.0}};
  std::vector<Vec3> points;
  const auto add = [&](double polar, double around) {
    const Vec3 p{std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar)};
    double rise = 0.0;
    for (const Vec3 d : spikes) {
      rise = std::max(rise, height * std::exp((dot(p, normalized(d)) - 1.0) / width));
    }
    points.push_back((1.0 + rise) * p);
  };
  add(0.0, 0.0);
  for (std::uint32_t i = 1; i < latitudes; ++i) {
    for (std::uint32_t j = 0; j < longitudes; ++j) {
      add(std::numbers::pi * i / latitudes, 2.0 * std::numbers::pi * j / longitudes);
    }
  }
  add(std::numbers::pi, 0.0);
  const auto last = static_cast<std::uint32_t>(points.size() - 1);
  std::vector<std::array<VertexId, 3>> faces;
  const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    faces.push_back({VertexId(a), VertexId(b), VertexId(c)});
  };
  for (std::uint32_t j = 0; j < longitudes; ++j) {
    const std::uint32_t k = (j + 1) % longitudes;
    face(0, 1 + j, 1 + k);
    for (std::uint32_t i = 0; i + 2 < latitudes; ++i) {
      const std::uint32_t a = 1 + i * longitudes;
      const std::uint32_t b = a + longitudes;
      face(a + j, b + j, b + k);
      face(a + j, b + k, a + k);
    }
    face(last, last - longitudes + k, last - longitudes + j);
  }
  return {std::move(points), std::move(faces)};
}

double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double peak_mebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace

/// Arguments: the greatest number of faces, a million without.
int main(int argc, char** argv) {
  const double greatest = argc > 1 ? std::atof(argv[1]) : 1e6;
  std::printf("    faces  parts  seconds  exponent  peak MiB  bytes/face\n");
  double seconds_before = 0.0;
  double faces_before = 0.0;
  for (const std::array<std::uint32_t, 2> divisions :
       {std::array{100U, 50U}, std::array{316U, 158U}, std::array{1000U, 500U}}) {
    const mesh::Surface surface = spiked_sphere(divisions[0], divisions[1]);
    const auto faces = static_cast<double>(surface.face_count());
    if (faces > greatest) {
      break;
    }
    const double start_memory = peak_mebibytes();
    const double start = cpu_seconds();
    const segment::Segmentation result = segment::segment(surface, {}, {}, Context{});
    const double seconds = cpu_seconds() - start;
    const double exponent =
        seconds_before > 0.0 ? std::log(seconds / seconds_before) / std::log(faces / faces_before) : 0.0;
    std::printf("%9.0f %6zu %8.3f %9.2f %9.0f %11.0f\n", faces, result.parts.size(), seconds, exponent,
                peak_mebibytes(), (peak_mebibytes() - start_memory) * 1024.0 * 1024.0 / faces);
    seconds_before = seconds;
    faces_before = faces;
  }
  return 0;
}
