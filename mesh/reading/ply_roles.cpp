// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/ply_roles.hpp"

#include <span>
#include <string_view>

namespace ridgecraft::mesh {
namespace {

struct KnownProperty {
  std::string_view name;
  bool is_list;
  PlyRole role;
};

constexpr KnownProperty vertex_properties[] = {
    {"x", false, PlyRole::x},
    {"y", false, PlyRole::y},
    {"z", false, PlyRole::z},
    {"s", false, PlyRole::u},
    {"t", false, PlyRole::v},
    {"u", false, PlyRole::u},
    {"v", false, PlyRole::v},
    {"texture_u", false, PlyRole::u},
    {"texture_v", false, PlyRole::v},
    {"texture_s", false, PlyRole::u},
    {"texture_t", false, PlyRole::v},
    {"red", false, PlyRole::red},
    {"green", false, PlyRole::green},
    {"blue", false, PlyRole::blue},
    {"diffuse_red", false, PlyRole::red},
    {"diffuse_green", false, PlyRole::green},
    {"diffuse_blue", false, PlyRole::blue},
};
constexpr KnownProperty face_properties[] = {
    {"vertex_indices", true, PlyRole::indices},
    {"vertex_index", true, PlyRole::indices},
    {"texcoord", true, PlyRole::texture_list},
    {"texnumber", false, PlyRole::texture_number},
    {"red", false, PlyRole::red},
    {"green", false, PlyRole::green},
    {"blue", false, PlyRole::blue},
    {"diffuse_red", false, PlyRole::red},
    {"diffuse_green", false, PlyRole::green},
    {"diffuse_blue", false, PlyRole::blue},
};
constexpr KnownProperty edge_properties[] = {
    {"vertex1", false, PlyRole::first_end},
    {"vertex2", false, PlyRole::second_end},
};

std::span<const KnownProperty> known_of(PlyKind kind) {
  switch (kind) {
    case PlyKind::vertex:
      return vertex_properties;
    case PlyKind::face:
      return face_properties;
    case PlyKind::edge:
      return edge_properties;
  }
  return {};
}

}  // namespace

PlyRoles ply_roles(const PlyElement& element, PlyKind kind) {
  const std::span<const KnownProperty> known = known_of(kind);
  PlyRoles roles;
  for (const PlyProperty& property : element.properties) {
    const auto found = std::find_if(known.begin(), known.end(), [&](const KnownProperty& k) {
      return k.name == property.name && k.is_list == property.is_list;
    });
    PlyRole role = found == known.end() ? PlyRole::skipped : found->role;
    if (kind == PlyKind::edge && !is_integer(property.type)) {
      role = PlyRole::skipped;
    }
    roles.push_back(has(roles, role) ? PlyRole::skipped : role);
  }
  return roles;
}

}  // namespace ridgecraft::mesh
