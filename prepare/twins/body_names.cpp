// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/twins/body_names.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "prepare/symmetry/nearby_points.hpp"

namespace ridgecraft::prepare {
namespace {

Vec3 middle_of(const mesh::Surface& surface, FaceId f) {
  const auto [a, b, c] = surface.vertices(f);
  return (surface.point(a) + surface.point(b) + surface.point(c)) / 3.0;
}

}  // namespace

BodyNames::BodyNames(const mesh::Model& model) {
  if (model.objects.size() < 2 || model.surface.component_count() < 2) {
    return;
  }
  std::map<std::string, std::uint32_t> number;
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    const std::string name = model.object_of(model.polygon[f]);
    const auto [at, fresh] = number.try_emplace(name, static_cast<std::uint32_t>(names_.size()));
    if (fresh) {
      names_.push_back(name);
    }
    points_.push_back(middle_of(model.surface, f));
    name_.push_back(at->second);
  }
}

IdVector<ComponentId, std::string> BodyNames::of(const mesh::Surface& surface) const {
  if (points_.empty()) {
    return {};
  }
  std::vector<std::uint32_t> order(points_.size());
  std::iota(order.begin(), order.end(), 0U);
  const NearbyPoints tree(points_, std::move(order));
  std::vector<std::map<std::uint32_t, double>> area(surface.component_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const Vec3 p = middle_of(surface, f);
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t nearest = 0;
    tree.search(
        p, [&](double distance) { return distance < least; },
        [&](std::uint32_t i) {
          const Vec3 way = points_[i] - p;
          if (dot(way, way) < least) {
            least = dot(way, way);
            nearest = i;
          }
        });
    area[surface.component(f).value()][name_[nearest]] += surface.area(f);
  }
  IdVector<ComponentId, std::string> result(surface.component_count());
  for (const ComponentId c : ids<ComponentId>(result.size())) {
    const auto most = std::max_element(area[c.value()].begin(), area[c.value()].end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    result[c] = names_[most->first];
  }
  return result;
}

}  // namespace ridgecraft::prepare
