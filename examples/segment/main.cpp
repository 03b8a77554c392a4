// SPDX-License-Identifier: GPL-3.0-or-later
// segment_example MODEL.off: the nearly convex part of each polygon, one line each.
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include <ridgecraft/base/error.hpp>
#include <ridgecraft/mesh/mesh.hpp>
#include <ridgecraft/segment/segment.hpp>
#include <ridgecraft/segment/surface/segmentation.hpp>

using namespace ridgecraft;

int main(int /*count*/, char** arguments) try {
  // Points and polygons of your own; here those of a plain OFF file.
  std::ifstream file(arguments[1]);
  std::string off;
  std::size_t point_count = 0, polygon_count = 0, edge_count = 0, corner_count = 0;
  file >> off >> point_count >> polygon_count >> edge_count;
  std::vector<Vec3> points(point_count);
  for (Vec3& p : points)
    file >> p.x >> p.y >> p.z;
  std::vector<std::vector<std::uint32_t>> polygons(polygon_count);
  for (std::vector<std::uint32_t>& polygon : polygons) {
    file >> corner_count;
    polygon.resize(corner_count);
    for (std::uint32_t& point : polygon)
      file >> point;
  }

  Context context;
  context.threads = 2;
  const mesh::Model model = mesh::repair(points, polygons, {.collapse_flat_faces = false}, context);
  const segment::Segmentation found =
      segment::segment(model.surface, model.polygon.items(), {.concavity = 0.1}, context);
  for (const std::uint32_t part : segment::polygon_labels(model, found))
    std::cout << part << '\n';
} catch (const Error& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
