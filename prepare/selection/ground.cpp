// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "prepare/selection/selection.hpp"

namespace ridgecraft::prepare {
namespace {

/// A ground is thinner than this share of its width, ...
constexpr double flat_share = 1e-3;
/// ... and this much wider than what stands on it, in two directions.
constexpr double wider = 1.2;
/// What stands on it may sink into it by this share of its own height.
constexpr double sunk_share = 0.05;

std::array<double, 3> coordinates(Vec3 p) {
  return {p.x, p.y, p.z};
}

/// Whether one box is a ground for another that stands on or hangs below it.
bool carries(const Box3& ground, const Box3& rest) {
  const auto size = coordinates(ground.size());
  const auto other = coordinates(rest.size());
  const auto low = coordinates(ground.low);
  const auto high = coordinates(ground.high);
  const auto rest_low = coordinates(rest.low);
  const auto rest_high = coordinates(rest.high);
  for (std::size_t up = 0; up < 3; ++up) {
    const std::size_t a = (up + 1) % 3;
    const std::size_t b = (up + 2) % 3;
    const double sunk = sunk_share * other[up];
    const bool at_one_side = high[up] <= rest_low[up] + sunk || low[up] >= rest_high[up] - sunk;
    if (size[up] <= flat_share * std::max(size[a], size[b]) && size[a] >= wider * other[a] &&
        size[b] >= wider * other[b] && other[up] > 0.0 && at_one_side) {
      return true;
    }
  }
  return false;
}

void grow(Box3& box, const Box3& by) {
  if (!by.empty()) {
    box.add(by.low);
    box.add(by.high);
  }
}

/// Of each name's faces; the last one of faces without a name.
std::vector<Box3> boxes_of(const mesh::Model& model, const std::vector<std::string>& names) {
  std::unordered_map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < names.size(); ++i) {
    place.emplace(names[i], i);
  }
  std::vector<Box3> boxes(names.size() + 1);
  const mesh::Surface& surface = model.surface;
  for (const FaceId face : ids<FaceId>(surface.face_count())) {
    const std::string object = model.object_name(face);
    const std::uint32_t material = model.material.empty() ? mesh::Soup::none : model.material[face];
    // A face counts by its object; by its material where objects have no names.
    const bool by_object = !object.empty() || material == mesh::Soup::none;
    const auto at = place.find(by_object ? object : model.materials[material].name);
    for (const VertexId v : surface.vertices(face)) {
      boxes[at == place.end() ? names.size() : at->second].add(surface.point(v));
    }
  }
  return boxes;
}

/// Only what reaches all sides of the model's box in two directions can be wider than the rest.
bool spans(const Box3& box, const Box3& all) {
  const auto size = coordinates(box.size());
  const auto whole = coordinates(all.size());
  std::size_t directions = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    directions += size[axis] >= whole[axis] / wider ? 1U : 0U;
  }
  return directions >= 2;
}

}  // namespace

std::optional<std::string> ground_name(const mesh::Model& model) {
  const std::vector<std::string> names = names_of(model);
  if (names.size() < 2) {
    return std::nullopt;
  }
  const std::vector<Box3> boxes = boxes_of(model, names);
  constexpr std::size_t most_looked_at = 8;
  std::size_t looked_at = 0;
  for (std::size_t i = 0; i < names.size() && looked_at < most_looked_at; ++i) {
    if (boxes[i].empty() || !spans(boxes[i], model.surface.bounds())) {
      continue;
    }
    ++looked_at;
    Box3 rest;
    for (std::size_t j = 0; j < boxes.size(); ++j) {
      if (j != i) {
        grow(rest, boxes[j]);
      }
    }
    if (!rest.empty() && carries(boxes[i], rest)) {
      return names[i];
    }
  }
  return std::nullopt;
}

}  // namespace ridgecraft::prepare
