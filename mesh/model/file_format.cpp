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
};
/// Formats of one name stand beside each other.
constexpr std::array formats{Row{FileFormat::obj, "OBJ", 1},        Row{FileFormat::stl_ascii, "STL", 0},
                             Row{FileFormat::stl_binary, "STL", 0}, Row{FileFormat::ply_ascii, "PLY", 0},
                             Row{FileFormat::ply_binary, "PLY", 0}, Row{FileFormat::off, "OFF", 0}};

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

}  // namespace ridgecraft::mesh
