// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/selection/selection.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string_view>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"
#include "prepare/symmetry/mirrors.hpp"

namespace ridgecraft::prepare {
namespace {

/// A ground is thinner than this share of its width, ...
constexpr double flat_fraction = 1e-3;
/// ... and this much wider than what stands on it, in two directions.
constexpr double wider = 1.2;
/// What stands on it may sink into it by this share of its own height.
constexpr double sunk_fraction = 0.05;

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
    const double sunk = sunk_fraction * other[up];
    const bool at_one_side = high[up] <= rest_low[up] + sunk || low[up] >= rest_high[up] - sunk;
    if (size[up] <= flat_fraction * std::max(size[a], size[b]) && size[a] >= wider * other[a] &&
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

namespace {

/// More names would hide the sentence.
constexpr std::size_t most_told = 12;

bool same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

bool matches(std::string_view name, std::string_view asked) {
  if (asked.ends_with('*')) {
    asked.remove_suffix(1);
    name = name.substr(0, asked.size());
  } else if (name.size() > asked.size() && name[asked.size()] == '/') {
    name = name.substr(0, asked.size());
  }
  return std::equal(name.begin(), name.end(), asked.begin(), asked.end(), same_letter);
}

/// The names that a face bears: of its object and of its material; empty where it has none.
std::pair<std::string, std::string> names_at(const mesh::Model& model, FaceId face) {
  const std::uint32_t material = model.material.empty() ? mesh::Soup::none : model.material[face];
  return {model.object_name(face),
          material == mesh::Soup::none ? std::string() : model.materials[material].name};
}

void require_known(const std::vector<std::string>& asked, const std::vector<std::string>& known) {
  for (const std::string& name : asked) {
    if (std::any_of(known.begin(), known.end(), [&](const std::string& k) { return matches(k, name); })) {
      continue;
    }
    if (known.empty()) {
      throw Error(ErrorKind::usage, Message("no_names", {{"name", name}}));
    }
    std::vector<Message> names = plain_items(
        {known.begin(), known.begin() + static_cast<std::ptrdiff_t>(std::min(known.size(), most_told))});
    if (known.size() > most_told) {
      names.push_back(Message("more_names", {{"n", known.size() - most_told}}));
    }
    throw Error(ErrorKind::usage, Message("unknown_object", {{"name", name}, {"names", std::move(names)}}));
  }
}

}  // namespace

std::vector<std::string> names_of(const mesh::Model& model) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  const auto add = [&](const std::string& name) {
    if (!name.empty() && seen.insert(name).second) {
      names.push_back(name);
    }
  };
  for (const std::string& name : model.objects) {
    add(name);
  }
  for (const mesh::Material& material : model.materials) {
    add(material.name);
  }
  return names;
}

std::vector<NamedPart> named_parts(const mesh::Model& model) {
  std::map<std::string, NamedPart> parts;
  for (const FaceId face : ids<FaceId>(model.surface.face_count())) {
    const auto [object, material] = names_at(model, face);
    for (const std::string& name : std::set{object, material}) {
      NamedPart& part = parts[name];
      part.name = name;
      ++part.faces;
      part.area += model.surface.area(face);
    }
  }
  parts.erase("");
  std::vector<NamedPart> result;
  for (auto& [name, part] : parts) {
    result.push_back(std::move(part));
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const NamedPart& a, const NamedPart& b) { return a.faces > b.faces; });
  return result;
}

mesh::Model select(mesh::Model model, const Selection& selection) {
  if (!selection.any()) {
    return model;
  }
  const std::vector<std::string> known = names_of(model);
  require_known(selection.only, known);
  require_known(selection.without, known);
  std::vector<FaceId> taken;
  for (const FaceId face : ids<FaceId>(model.surface.face_count())) {
    const auto [object, material] = names_at(model, face);
    const auto is_named = [&, &object = object, &material = material](const std::string& asked) {
      return (!object.empty() && matches(object, asked)) || (!material.empty() && matches(material, asked));
    };
    const bool wanted =
        selection.only.empty() || std::any_of(selection.only.begin(), selection.only.end(), is_named);
    if (wanted && std::none_of(selection.without.begin(), selection.without.end(), is_named)) {
      taken.push_back(face);
    }
  }
  if (taken.empty()) {
    throw Error(ErrorKind::usage, Message("nothing_left"));
  }
  PartOf part = part_of(model.surface, taken);
  const auto kept = [&](auto& of_faces) {
    if (!of_faces.empty()) {
      std::remove_reference_t<decltype(of_faces)> rest;
      for (const FaceId face : part.face) {
        rest.push_back(of_faces[face]);
      }
      of_faces = std::move(rest);
    }
  };
  kept(model.polygon);
  kept(model.material);
  kept(model.object);
  kept(model.texture);
  model.surface = std::move(part.surface);
  return model;
}

}  // namespace ridgecraft::prepare
