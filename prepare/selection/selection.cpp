// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/selection/selection.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <string_view>
#include <type_traits>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "prepare/symmetry/mirrors.hpp"

namespace ridgecraft::prepare {
namespace {

/// More names would hide the sentence.
constexpr std::size_t most_told = 12;

bool same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

bool matches(std::string_view name, std::string_view asked) {
  const bool open = asked.ends_with('*');
  if (open) {
    asked.remove_suffix(1);
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
    std::vector<std::string> told(
        known.begin(), known.begin() + static_cast<std::ptrdiff_t>(std::min(known.size(), most_told)));
    if (known.size() > most_told) {
      told.push_back(std::to_string(known.size() - most_told) + " more");
    }
    throw Error(ErrorKind::usage,
                "nothing in the model is named '" + name + "'; " +
                    (known.empty() ? std::string("it has no names") : "there are " + listed(told, "and")));
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
    throw Error(ErrorKind::usage,
                "nothing is left of the model: no face has a name that is wanted and none that isn't");
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
