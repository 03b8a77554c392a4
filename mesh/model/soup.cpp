// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/model/soup.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "base/error.hpp"

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

struct Unit {
  double mm;
  std::string_view name;
};
constexpr std::array units{Unit{0.001, "micrometres"}, Unit{1.0, "millimetres"}, Unit{10.0, "centimetres"},
                           Unit{1000.0, "metres"},     Unit{25.4, "inches"},     Unit{304.8, "feet"}};

/// In the order of the enumeration, so that a kind is its index.
constexpr std::array names_of_kinds{
    std::string_view("content_is_other_format"),
    std::string_view("trailing_data_ignored"),
    std::string_view("count_corrected"),
    std::string_view("missing_end"),
    std::string_view("material_file_missing"),
    std::string_view("material_unknown"),
    std::string_view("material_value_corrected"),
    std::string_view("texture_missing"),
    std::string_view("texture_point_dropped"),
    std::string_view("element_ignored"),
    std::string_view("object_left_out"),
    std::string_view("feature_ignored"),
    std::string_view("motion_ignored"),
    std::string_view("points_joined"),
    std::string_view("border_points_joined"),
    std::string_view("unused_points_dropped"),
    std::string_view("polygon_corner_dropped"),
    std::string_view("polygons_dropped"),
    std::string_view("crossed_polygons_rebuilt"),
    std::string_view("bent_polygons_split"),
    std::string_view("duplicate_faces_dropped"),
    std::string_view("inner_walls_dropped"),
    std::string_view("flat_faces_collapsed"),
    std::string_view("faces_turned"),
    std::string_view("components_turned"),
    std::string_view("edges_paired"),
    std::string_view("edges_split"),
    std::string_view("vertices_split"),
    std::string_view("cut_open"),
    std::string_view("t_junctions_joined"),
    std::string_view("open_border"),
    std::string_view("self_intersections"),
    std::string_view("narrow_faces"),
};
static_assert(names_of_kinds.size() == static_cast<std::size_t>(RepairKind::narrow_faces) + 1);

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

const char* axis_name(Axis axis) {
  constexpr std::array names{"x", "y", "z"};
  return names[static_cast<std::size_t>(axis)];
}

std::string unit_names(double mm_per_unit) {
  for (const Unit& unit : units) {
    if (unit.mm == mm_per_unit) {
      return std::string(unit.name);
    }
  }
  return fmt::format("units of {:g} mm", mm_per_unit);
}

std::string_view name(RepairKind kind) {
  return names_of_kinds[static_cast<std::size_t>(kind)];
}

Message message(const Repair& repair) {
  Message what("repair_" + std::string(name(repair.kind)), {{"n", repair.count}});
  return repair.detail.empty()
             ? what
             : Message("with_detail", {{"what", std::vector{what}}, {"detail", repair.detail}});
}

void RepairReport::add(RepairKind kind, std::size_t count, std::string detail) {
  if (count == 0) {
    return;
  }
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Repair& entry) { return entry.kind == kind; });
  if (found == entries_.end()) {
    entries_.push_back({kind, count, std::move(detail)});
    return;
  }
  found->count += count;
  if (found->detail.empty()) {
    found->detail = std::move(detail);
  }
}

void RepairReport::add(const RepairReport& other) {
  for (const Repair& entry : std::vector<Repair>(other.entries_)) {
    add(entry.kind, entry.count, entry.detail);
  }
}

std::size_t RepairReport::count(RepairKind kind) const {
  for (const Repair& entry : entries_) {
    if (entry.kind == kind) {
      return entry.count;
    }
  }
  return 0;
}

}  // namespace ridgecraft::mesh
