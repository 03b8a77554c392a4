// SPDX-License-Identifier: GPL-3.0-or-later
#include "psb.hpp"

#include <algorithm>
#include <charconv>
#include <ctime>
#include <fstream>
#include <set>
#include <sstream>

#include "segment/evaluate.hpp"
#include "segment/hull/hull.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::bench {
namespace {

namespace fs = std::filesystem;

/// Rays a side of the grid on which hulls are united: 512 give the same within 0.001.
constexpr unsigned rays_a_side = 128;
/// Models of a category have consecutive numbers, this many.
constexpr int category_size = 20;
constexpr int last_model = 400;

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return std::move(text).str();
}

std::vector<std::uint32_t> read_labels(const fs::path& file) {
  const std::string text = read_text(file);
  const char* at = text.data();
  const char* end = text.data() + text.find_last_of("0123456789") + 1;
  std::vector<std::uint32_t> labels;
  while (at < end) {
    while (*at < '0' || *at > '9') {
      ++at;
    }
    std::uint32_t value = 0;
    at = std::from_chars(at, end, value).ptr;
    labels.push_back(value);
  }
  return labels;
}

}  // namespace

int category_number(int model) {
  return (model - 1) / category_size;
}

std::string category_of(int model) {
  static const char* const names[] = {
      "Human", "Cup",  "Glasses", "Airplane", "Ant",       "Chair", "Octopus", "Table",   "Teddy", "Hand",
      "Plier", "Fish", "Bird",    "",         "Armadillo", "Bust",  "Mech",    "Bearing", "Vase",  "FourLeg"};
  return names[category_number(model)];
}

std::vector<int> models_in(const fs::path& psb, bool subset) {
  std::vector<int> models;
  for (int m = 1; m <= last_model; ++m) {
    const bool chosen = !subset || (m - 1) % category_size == 0 || (m - 1) % category_size == 8;
    if (chosen && fs::exists(psb / "off" / (std::to_string(m) + ".off"))) {
      models.push_back(m);
    }
  }
  return models;
}

BenchmarkModel read_model(const fs::path& psb, int number, const Context& context) {
  BenchmarkModel model;
  model.number = number;
  const double start = cpu_seconds();
  mesh::ReadOptions options;
  options.collapse_flat_faces = false;
  model.read = mesh::read(psb / "off" / (std::to_string(number) + ".off"), options, context);
  model.seconds = cpu_seconds() - start;
  const fs::path folder = psb / "seg" / std::to_string(number);
  if (fs::is_directory(folder)) {
    std::set<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
      files.insert(entry.path());
    }
    for (const fs::path& file : files) {
      std::vector<std::uint32_t> labels = read_labels(file);
      if (labels.size() == model.read.polygon_count) {
        model.people.push_back(std::move(labels));
      }
    }
  }
  return model;
}

Figures judge(const BenchmarkModel& model, std::span<const std::uint32_t> part_of_face,
              const Context& context) {
  const mesh::Surface& surface = model.read.surface;
  Figures figures;
  figures.model = model.number;
  figures.category = category_of(model.number);
  figures.faces = surface.face_count();
  const std::set<std::uint32_t> parts(part_of_face.begin(), part_of_face.end());
  figures.parts = static_cast<double>(parts.size());
  figures.volume = segment::hull_volume_ratio(surface, part_of_face, rays_a_side, context);
  // In the file's order, as people's labels are; a face that repair dropped is a part of its own.
  std::vector<std::uint32_t> of_polygon(model.read.polygon_count, *parts.rbegin() + 1);
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    if (model.read.polygon[f] < of_polygon.size()) {
      of_polygon[model.read.polygon[f]] = part_of_face[f.value()];
    }
  }
  for (const auto& person : model.people) {
    figures.rand += segment::rand_error(of_polygon, person) / static_cast<double>(model.people.size());
  }
  return figures;
}

std::size_t outside_hulls(const mesh::Surface& surface, const segment::Segmentation& segmentation) {
  /// So far below a triangle's plane no rounding matters: the exact sign isn't needed.
  constexpr double surely_below = 1e-9;
  const segment::ScaledSurface scaled = segment::scale_surface(surface, {});
  const std::vector<Vec3>& points = scaled.points;
  segment::HullBuilder builder(points);
  segment::Hull hull;
  std::size_t outside = 0;
  for (const segment::Part& part : segmentation.parts) {
    std::vector<std::uint32_t> hull_vertices;
    for (const VertexId v : part.hull_vertices) {
      hull_vertices.push_back(v.value());
    }
    builder.build(hull_vertices, hull);
    std::set<std::uint32_t> vertices;
    for (const FaceId f : part.faces) {
      vertices.insert(scaled.corners[f.value()].begin(), scaled.corners[f.value()].end());
    }
    std::vector<Vec3> inside;
    for (const std::uint32_t v : vertices) {
      inside.push_back(points[v]);
    }
    for (const auto& [a, b, c] : hull.triangles) {
      const Vec3 normal = normalized(cross(points[b] - points[a], points[c] - points[a]));
      const double limit = dot(normal, points[a]) - surely_below;
      std::size_t near = 0;
      for (const Vec3 p : inside) {
        near += dot(normal, p) > limit ? 1U : 0U;
      }
      if (near == 0) {
        continue;
      }
      outside += std::erase_if(inside, [&](Vec3 p) {
        return dot(normal, p) > limit && segment::exact_orientation(points[a], points[b], points[c], p) > 0;
      });
    }
  }
  return outside;
}

Figures mean_of(std::span<const Figures> rows) {
  Figures mean;
  const auto n = static_cast<double>(std::max<std::size_t>(1, rows.size()));
  for (const Figures& r : rows) {
    mean.parts += r.parts / n;
    mean.volume += r.volume / n;
    mean.seconds += r.seconds / n;
    mean.reading += r.reading / n;
    mean.rand += r.rand / n;
    mean.worst = std::max(mean.worst, r.worst);
    mean.outside += r.outside;
  }
  if (!rows.empty()) {
    mean.model = rows.front().model;
    mean.category = rows.front().category;
  }
  return mean;
}

std::string json_line(const Figures& r) {
  std::ostringstream out;
  out << "{\"model\": " << r.model << ", \"category\": \"" << r.category << "\", \"faces\": " << r.faces
      << ", \"tolerance\": " << r.tolerance << ", \"parts\": " << r.parts << ", \"volume\": " << r.volume
      << ", \"seconds\": " << r.seconds << ", \"reading\": " << r.reading << ", \"rand\": " << r.rand
      << ", \"worst\": " << r.worst << ", \"outside\": " << r.outside << "}";
  return out.str();
}

double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace ridgecraft::bench
