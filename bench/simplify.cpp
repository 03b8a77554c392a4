// SPDX-License-Identifier: GPL-3.0-or-later
// What preparing makes of models, without unfolding them:
//
//   bench_simplify [--size MM | --adapt] [--faces keep|N] [--obj FOLDER] MODEL...
//
// A line for each: triangles before and after, components, the share of folds below 6 mm before and after,
// whether the model is called too fine, how far the surface moved (mm), share of the area on planes across
// the axes before and after, share of the faces that are slivers, pages that are to be expected, seconds.
// --obj writes FOLDER/NAME.obj, the model as it will be folded, and FOLDER/NAME.before.obj, the model as it
// was read and repaired, both in mm (bench/likeness.py compares them).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "mesh/mesh.hpp"
#include "prepare/prepare.hpp"
#include "prepare/prepared/expected_pages.hpp"
#include "prepare/prepared/narrow_faces.hpp"

using namespace ridgecraft;

namespace {

/// Normals so near to an axis count as along it, degrees.
constexpr double axis_degrees = 1.0;
const prepare::PanelRoom room{{190.0, 277.0}, 5.0};

struct Settings {
  prepare::SizeOptions size;
  prepare::SimplifyOptions simplify;
  std::string folder;
  std::vector<std::string> models;
};

double axis_share(const mesh::Surface& surface) {
  const double cosine = std::cos(axis_degrees * 3.14159265358979323846 / 180.0);
  double along = 0.0;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const Vec3 n = surface.normal(f);
    along += std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}) >= cosine ? surface.area(f) : 0.0;
  }
  return along / mesh::total_area(surface);
}

void write(const std::string& path, const mesh::Surface& surface) {
  std::ofstream(path, std::ios::binary) << mesh::write_obj(surface);
}

void run(const Settings& settings, const std::string& path) {
  const mesh::Model model = mesh::read(path, {}, {});
  const std::clock_t start = std::clock();
  const prepare::Prepared made = prepare::prepare(model, settings.size, settings.simplify, room, {});
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const mesh::Surface& surface = made.model.surface;
  const prepare::SimplifyReport& report = made.simplified;
  const std::string name = std::filesystem::path(path).stem().string();
  fmt::print("{:36.36} {:6} {:5} {:4} {:6.3f} {:6.3f} {:5} {:5.2f} {:6.3f} {:6.3f} {:6.3f} {:5.1f} {:6.2f}\n",
             name, model.surface.face_count(), surface.face_count(), surface.component_count(),
             report.short_edges_before, report.short_edges_after, report.still_too_fine ? "fine" : "-",
             report.deviation_mm, axis_share(model.surface), axis_share(surface),
             static_cast<double>(prepare::count_narrow_faces(surface, made.panels, prepare::sliver_mm)) /
                 static_cast<double>(surface.face_count()),
             prepare::expected_pages(made, {room.sheet.width, room.sheet.height}), seconds);
  std::fflush(stdout);
  if (!settings.folder.empty()) {
    // In the place of the other: what moved the outermost points moved the middle, too.
    std::vector<Vec3> points(model.surface.points().begin(), model.surface.points().end());
    std::transform(points.begin(), points.end(), points.begin(), made.from_model);
    std::vector<std::array<VertexId, 3>> faces;
    for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
      faces.push_back(model.surface.vertices(f));
    }
    write(settings.folder + "/" + name + ".before.obj", mesh::Surface(std::move(points), std::move(faces)));
    write(settings.folder + "/" + name + ".obj", surface);
  }
}

Settings read_settings(int argc, char** argv) {
  Settings settings;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--adapt") {
      settings.size.adapts = true;
    } else if (word == "--size" && i + 1 < argc) {
      settings.size.largest_extent_mm = std::stod(argv[++i]);
    } else if (word == "--faces" && i + 1 < argc) {
      const std::string faces = argv[++i];
      settings.simplify.mode =
          faces == "keep" ? prepare::Simplification::keep : prepare::Simplification::count;
      settings.simplify.faces = faces == "keep" ? 0 : std::stoul(faces);
    } else if (word == "--obj" && i + 1 < argc) {
      settings.folder = argv[++i];
    } else {
      settings.models.push_back(word);
    }
  }
  return settings;
}

}  // namespace

int main(int argc, char** argv) {
  const Settings settings = read_settings(argc, argv);
  fmt::print("{:36} {:>6} {:>5} {:>4} {:>6} {:>6} {:>5} {:>5} {:>6} {:>6} {:>6} {:>5} {:>6}\n", "model",
             "faces", "after", "comp", "short", "after", "fine", "moved", "axes", "after", "sliver", "pages",
             "s");
  int failed = 0;
  for (const std::string& path : settings.models) {
    try {
      run(settings, path);
    } catch (const std::exception& e) {
      fmt::print("{}: {}\n", path, e.what());
      ++failed;
    }
  }
  return failed == 0 ? 0 : 1;
}
