// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/model/file_format.hpp"

#include <algorithm>
#include <array>

namespace ridgecraft::mesh {
namespace {

struct Row {
  FileFormat format;
  std::string_view name;
  std::uint32_t first_point;
  bool repeats_points;
};
/// Formats of one name stand beside each other.
constexpr std::array formats{
    Row{FileFormat::obj, "OBJ", 1, false},        Row{FileFormat::stl_ascii, "STL", 0, true},
    Row{FileFormat::stl_binary, "STL", 0, true},  Row{FileFormat::ply_ascii, "PLY", 0, false},
    Row{FileFormat::ply_binary, "PLY", 0, false}, Row{FileFormat::off, "OFF", 0, false},
    Row{FileFormat::glb, "GLB", 0, true},         Row{FileFormat::gltf, "glTF", 0, true},
    Row{FileFormat::threemf, "3MF", 0, false},    Row{FileFormat::pdo, "PDO", 0, false},
    Row{FileFormat::dae, "DAE", 0, true},         Row{FileFormat::fbx, "FBX", 0, true},
    Row{FileFormat::max3ds, "3DS", 0, true},      Row{FileFormat::blend, "BLEND", 0, true}};

const Row& row(FileFormat format) {
  return *std::find_if(formats.begin(), formats.end(), [&](const Row& r) { return r.format == format; });
}

}  // namespace

std::string_view format_name(FileFormat format) {
  return row(format).name;
}

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const Row& r : formats) {
    if (names.empty() || names.back() != r.name) {
      names.emplace_back(r.name);
    }
  }
  return names;
}

std::uint32_t first_point_number(FileFormat format) {
  return row(format).first_point;
}

bool repeats_points(FileFormat format) {
  return row(format).repeats_points;
}

}  // namespace ridgecraft::mesh
