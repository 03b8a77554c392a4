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

namespace {

struct Unit {
  double mm;
  std::string_view name;
};
constexpr std::array units{Unit{0.001, "micrometres"}, Unit{1.0, "millimetres"}, Unit{10.0, "centimetres"},
                           Unit{1000.0, "metres"},     Unit{25.4, "inches"},     Unit{304.8, "feet"}};

}  // namespace

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

namespace {

/// How a kind is called and told; {} stands for the count.
struct Wording {
  RepairKind kind;
  std::string_view name;
  std::string_view one;
  std::string_view many;
};

using enum RepairKind;

constexpr std::array wordings{
    Wording{content_is_other_format, "content_is_other_format",
            "the file's suffix names another format than its content has; the content was read",
            "{} files have a suffix that names another format than their content has; the content was read"},
    Wording{trailing_data_ignored, "trailing_data_ignored", "1 byte after the end of the mesh was ignored",
            "{} bytes after the end of the mesh were ignored"},
    Wording{count_corrected, "count_corrected", "a count in the file's header was wrong and was corrected",
            "{} counts in the file's header were wrong and were corrected"},
    Wording{missing_end, "missing_end", "the file's end mark is missing, but the mesh is complete",
            "{} end marks are missing, but the mesh is complete"},
    Wording{material_file_missing, "material_file_missing",
            "a material file wasn't found or can't be read: its colours are missing",
            "{} material files weren't found or can't be read: their colours are missing"},
    Wording{material_unknown, "material_unknown",
            "1 material is used but defined nowhere; its faces stay white",
            "{} materials are used but defined nowhere; their faces stay white"},
    Wording{material_value_corrected, "material_value_corrected",
            "1 colour of a material was out of range and was corrected",
            "{} colours of materials were out of range and were corrected"},
    Wording{texture_missing, "texture_missing", "a texture picture is missing or can't be used",
            "{} texture pictures are missing or can't be used"},
    Wording{texture_point_dropped, "texture_point_dropped",
            "1 face has texture coordinates that are missing or can't be used; it gets no picture",
            "{} faces have texture coordinates that are missing or can't be used; they get no picture"},
    Wording{element_ignored, "element_ignored", "1 element that is no face was ignored",
            "{} elements that are no faces were ignored"},
    Wording{motion_ignored, "motion_ignored", "the model moves in its file; it was taken at rest",
            "{} models move in their files; they were taken at rest"},
    Wording{points_joined, "points_joined", "1 point was joined with another at the same place",
            "{} points at equal places were joined"},
    Wording{border_points_joined, "border_points_joined",
            "1 point on a border was joined with another very close to it",
            "{} points on borders were joined with others very close to them"},
    Wording{unused_points_dropped, "unused_points_dropped", "1 point that no face uses was dropped",
            "{} points that no face uses were dropped"},
    Wording{polygon_corner_dropped, "polygon_corner_dropped",
            "1 corner of a face that repeats its neighbour was dropped",
            "{} corners of faces that repeat their neighbours were dropped"},
    Wording{polygons_dropped, "polygons_dropped",
            "1 face with fewer than three different corners was dropped",
            "{} faces with fewer than three different corners were dropped"},
    Wording{crossed_polygons_rebuilt, "crossed_polygons_rebuilt",
            "1 face that crosses itself was rebuilt or left out",
            "{} faces that cross themselves were rebuilt or left out"},
    Wording{bent_polygons_split, "bent_polygons_split", "1 face that isn't flat was split into triangles",
            "{} faces that aren't flat were split into triangles"},
    Wording{duplicate_faces_dropped, "duplicate_faces_dropped", "1 face that was there twice was dropped",
            "{} faces that were there more than once were dropped"},
    Wording{inner_walls_dropped, "inner_walls_dropped",
            "1 wall between two bodies, there from either side, was dropped: they are one",
            "{} walls between bodies, there from either side, were dropped: the bodies are one"},
    Wording{flat_faces_collapsed, "flat_faces_collapsed", "1 face without area was removed",
            "{} faces without area were removed"},
    Wording{faces_turned, "faces_turned", "1 face was turned around to agree with its neighbours",
            "{} faces were turned around to agree with their neighbours"},
    Wording{components_turned, "components_turned", "1 closed piece that was inside out was turned",
            "{} closed pieces that were inside out were turned"},
    Wording{edges_paired, "edges_paired",
            "1 edge has more than two faces: those that belong together were joined in pairs",
            "{} edges have more than two faces: those that belong together were joined in pairs"},
    Wording{edges_split, "edges_split",
            "1 edge has three or more faces: two of them stay joined at most, the others come apart",
            "{} edges have three or more faces: two of them stay joined at most, the others come apart"},
    Wording{vertices_split, "vertices_split", "at 1 point parts of the surface only touch: they come apart",
            "at {} points parts of the surface only touch: they come apart"},
    Wording{cut_open, "cut_open", "1 edge was cut open since the surface has only one side",
            "{} edges were cut open since the surface has only one side"},
    Wording{t_junctions_joined, "t_junctions_joined",
            "1 point that lay on an edge without being joined to it is joined to it now",
            "{} points that lay on edges without being joined to them are joined to them now"},
    Wording{open_border, "open_border", "the model isn't closed: 1 edge has a face on one side only",
            "the model isn't closed: {} edges have a face on one side only"},
    Wording{self_intersections, "self_intersections", "1 face runs through another",
            "{} faces run through each other"},
    Wording{narrow_faces, "narrow_faces",
            "1 face is narrower than 0.05 mm: on paper it is part of the face beside it",
            "{} faces are narrower than 0.05 mm: on paper each is part of the face beside it"},
};

/// The table is in the order of the enumeration, so that a kind is its index.
constexpr bool in_order() {
  for (std::size_t i = 0; i < wordings.size(); ++i) {
    if (static_cast<std::size_t>(wordings[i].kind) != i) {
      return false;
    }
  }
  return wordings.size() == static_cast<std::size_t>(narrow_faces) + 1;
}
static_assert(in_order());

const Wording& wording(RepairKind kind) {
  return wordings[static_cast<std::size_t>(kind)];
}

}  // namespace

std::string_view name(RepairKind kind) {
  return wording(kind).name;
}

std::string sentence(RepairKind kind, std::size_t count) {
  const Wording& words = wording(kind);
  return count == 1 ? std::string(words.one) : fmt::format(fmt::runtime(words.many), count);
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
