// SPDX-License-Identifier: GPL-3.0-or-later
// How many cut edges of whole models get a tab: tabs_bench FILE... prints a line for each model, unfolded
// into one net at 150 mm.
#include <chrono>
#include <cstdio>
#include <exception>

#include "mesh/mesh.hpp"
#include "unfold/tab_shapes.hpp"
#include "unfold/tabs.hpp"
#include "unfold/unfold.hpp"

using namespace ridgecraft;

namespace {

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

mesh::Surface at_150_mm(const mesh::Surface& surface) {
  const Vec3 size = surface.bounds().size();
  const double factor = 150.0 / std::fmax(size.x, std::fmax(size.y, size.z));
  std::vector<Vec3> points;
  for (const Vec3 p : surface.points()) {
    points.push_back(factor * p);
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faces.push_back(surface.vertices(f));
  }
  return mesh::Surface(std::move(points), std::move(faces));
}

void measure(const char* file) {
  const Context context;
  const mesh::Surface surface = at_150_mm(mesh::read(file, {}, context).surface);
  const mesh::Panels panels = mesh::find_panels(surface);
  unfold::Options options;
  const auto start = std::chrono::steady_clock::now();
  unfold::Nets nets = unfold::unfold(
      surface, panels, IdVector<FaceId, PartId>(surface.face_count(), PartId(0)), options, context);
  const double unfold_ms = milliseconds_since(start);
  const auto tabs_start = std::chrono::steady_clock::now();
  unfold::place_tabs(surface, panels, options.tabs, nets, context);
  const double tabs_ms = milliseconds_since(tabs_start);
  std::size_t long_edges = 0;
  std::size_t too_short = 0;
  std::size_t target = 0;
  for (const unfold::Join& join : nets.joins) {
    long_edges += unfold::long_enough_for_usable(surface.length(join.edge), options.tabs) ? 1U : 0U;
    too_short += join.no_tab == unfold::NoTab::edge_too_short ? 1U : 0U;
    target += join.no_tab == unfold::NoTab::target_too_small ? 1U : 0U;
  }
  const double joins = static_cast<double>(nets.joins.size());
  const double usable = static_cast<double>(unfold::count_usable_tabs(surface, nets, options.tabs));
  std::printf(
      "%-40s faces %5zu pieces %2zu joins %5zu usable %5.1f %% any %5.1f %% long enough %5.1f %% "
      "short %zu target %zu  unfold %.1f ms tabs %.2f ms\n",
      file, surface.face_count(), nets.pieces.size(), nets.joins.size(), 100.0 * usable / joins,
      100.0 * static_cast<double>(nets.tabs.size()) / joins, 100.0 * static_cast<double>(long_edges) / joins,
      too_short, target, unfold_ms, tabs_ms);
}

}  // namespace

int main(int count, char** files) {
  try {
    for (int i = 1; i < count; ++i) {
      measure(files[i]);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
