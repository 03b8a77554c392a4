// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/gltf/shape.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

namespace ridgecraft::mesh {
namespace {

constexpr std::array<std::size_t, 1> three{3};
constexpr std::array<std::size_t, 1> four{4};
constexpr std::array<std::size_t, 1> sixteen{16};

Vec3 vector_of(std::span<const double> numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

bool is_finite(Vec3 p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void pull(std::vector<Vec3>& points, GltfAccessors& accessors, const GltfObject& primitive,
          const std::vector<double>& weights) {
  const std::size_t targets = primitive.size("targets");
  for (std::size_t t = 0; t < targets && t < weights.size(); ++t) {
    const GltfObject target = primitive.element("targets", t);
    const auto moved = target.whole("POSITION");
    if (weights[t] == 0.0 || !moved) {
      continue;
    }
    const GltfValues& moves = accessors.values(*moved, target, three);
    if (moves.count() != points.size()) {
      target.refuse(fmt::format("it moves {} points, but there are {}", moves.count(), points.size()));
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i] += weights[t] * vector_of(moves[i]);
    }
  }
}

/// Each point goes where its joints take it, by their weights; one that no joint holds goes to the first.
void bend(std::vector<Vec3>& points, GltfAccessors& accessors, const GltfObject& attributes,
          const GltfSkin& skin) {
  std::vector<Vec3> bent(points.size());
  std::vector<double> sums(points.size(), 0.0);
  constexpr int most_sets = 16;
  for (int set = 0; set < most_sets; ++set) {
    const auto joints = attributes.whole(fmt::format("JOINTS_{}", set).c_str());
    const auto weights = attributes.whole(fmt::format("WEIGHTS_{}", set).c_str());
    if (!joints || !weights) {
      break;
    }
    const GltfValues& who = accessors.values(*joints, attributes, four);
    const GltfValues& how = accessors.values(*weights, attributes, four);
    if (who.count() != points.size() || how.count() != points.size()) {
      attributes.refuse(fmt::format("JOINTS_{0} or WEIGHTS_{0} has not one element for each point", set));
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        const double weight = how[i][k];
        const double joint = who[i][k];
        if (weight == 0.0) {
          continue;
        }
        if (!(joint >= 0.0) || joint >= static_cast<double>(skin.joints.size())) {
          attributes.refuse(
              fmt::format("a point hangs on joint {}, but there are {}", joint, skin.joints.size()));
        }
        bent[i] += weight * skin.joints[static_cast<std::size_t>(joint)](points[i]);
        sums[i] += weight;
      }
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = sums[i] > 0.0         ? bent[i] / sums[i]
                : skin.joints.empty() ? points[i]
                                      : skin.joints[0](points[i]);
  }
}

}  // namespace

std::vector<double> resting_weights(const GltfObject& node, const GltfObject& mesh) {
  auto weights = node.numbers("weights");
  if (!weights) {
    weights = mesh.numbers("weights");
  }
  return weights.value_or(std::vector<double>());
}

GltfSkin read_skin(GltfDocument& document, GltfAccessors& accessors, const GltfScene& scene,
                   std::uint64_t skin, const GltfObject& user) {
  const GltfObject object = document.element("skins", skin, user);
  const std::vector<std::uint64_t> joints = object.wholes("joints");
  const auto inverse = object.whole("inverseBindMatrices");
  const GltfValues* const binds = inverse ? &accessors.values(*inverse, object, sixteen) : nullptr;
  if (binds != nullptr && binds->count() < joints.size()) {
    object.refuse(fmt::format("it has {} joints, but {} matrices for them", joints.size(), binds->count()));
  }
  GltfSkin out;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    (void)document.element("nodes", joints[j], object);
    Affine place = scene.places[joints[j]].value_or(Affine{});
    if (binds != nullptr) {
      const auto m = (*binds)[j];
      place = place * Affine{{Vec3{m[0], m[4], m[8]}, Vec3{m[1], m[5], m[9]}, Vec3{m[2], m[6], m[10]}},
                             {m[12], m[13], m[14]}};
    }
    out.joints.push_back(place);
  }
  return out;
}

std::vector<Vec3> points_in_scene(GltfAccessors& accessors, const GltfObject& primitive,
                                  const std::vector<double>& weights, const Affine& place,
                                  const GltfSkin* skin) {
  const auto attributes = primitive.object("attributes");
  if (!attributes) {
    primitive.refuse("\"attributes\" is missing");
  }
  const GltfValues& positions = accessors.values(attributes->needed_whole("POSITION"), *attributes, three);
  std::vector<Vec3> points;
  points.reserve(positions.count());
  for (std::size_t i = 0; i < positions.count(); ++i) {
    points.push_back(vector_of(positions[i]));
  }
  pull(points, accessors, primitive, weights);
  if (skin != nullptr && attributes->has("JOINTS_0")) {
    bend(points, accessors, *attributes, *skin);
  } else if (place != Affine{}) {
    for (Vec3& p : points) {
      p = place(p);
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_finite(points[i])) {
      primitive.refuse(fmt::format("a coordinate of point {} is not finite", i), ErrorKind::unusable_mesh);
    }
  }
  return points;
}

}  // namespace ridgecraft::mesh
