// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/formats.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"

namespace ridgecraft::cli {
namespace {

using Row = FormatRow;

constexpr std::array read_rows{
    Row{".obj", "Wavefront OBJ, with materials"},
    Row{".stl", "STL, binary and ASCII"},
    Row{".ply", "PLY, ASCII and binary of both byte orders"},
    Row{".off", "OFF and its variants, ASCII"},
    Row{".glb", "glTF 2 in one file, with colours and pictures"},
    Row{".gltf", "glTF 2 as text, with the files next to it"},
    Row{".3mf", "3MF, with colours and pictures"},
    Row{".pdo", "Pepakura Designer 2 to 5, with colours and pictures (its nets: --from)"},
    Row{".dae", "COLLADA, where ridgecraft-import is installed (it reads by Assimp)"},
    Row{".fbx", "FBX, in the same way"},
    Row{".3ds", "3DS, in the same way"},
    Row{".blend", "Blender up to 2.79, uncompressed or by gzip, in the same way"}};

struct PaperRow {
  Format format;
  Row row;
  bool per_page;
  bool by_default;
  bool for_machines = false;
};
constexpr std::array paper_formats{
    PaperRow{Format::pdf, {".pdf", "pages to print; default"}, false, true},
    PaperRow{Format::svg, {".svg", "pages with a layer for each class of line; default"}, true, true},
    PaperRow{Format::fold, {".fold", "FOLD 1.2: nets, joins, tabs and the model; default"}, false, true},
    PaperRow{Format::html,
             {".html", "a page for any browser: the model, its sheets, how it folds and is built; default"},
             false,
             true},
    PaperRow{Format::project,
             {".ridgecraft", "a project: model, options and edits, to go on with in the studio"},
             false,
             false},
    PaperRow{Format::png, {".png", "pages as pictures"}, true, false},
    PaperRow{Format::dxf,
             {".dxf", "pieces for cutters and lasers, a layer for each operation"},
             true,
             false,
             true},
    PaperRow{Format::lbrn, {".lbrn2", "pieces as a LightBurn project"}, true, false, true},
    PaperRow{Format::eps, {".eps", "pieces as PostScript, a colour for each operation"}, true, false, true},
    PaperRow{Format::plt, {".plt", "pieces as HPGL for roll plotters"}, true, false, true}};
/// What the other verbs write.
constexpr std::array verb_formats{Row{".fold", "nets without pages (unfold)"},
                                  Row{".ply", "parts in colour (segment); meshes (cage, shell, deform)"},
                                  Row{".off", "parts in colour (segment); meshes (cage, shell, deform)"},
                                  Row{".seg", "part numbers (segment --labels; any suffix)"},
                                  Row{".json", "how parts join to fewer (segment --hierarchy; any suffix)"},
                                  Row{".obj", "an object per hull (hulls); meshes (cage, shell, deform)"},
                                  Row{".urdf", "ROS: a robot description with its hulls next to it (hulls)"},
                                  Row{".xml", "MuJoCo: MJCF with its hulls next to it (hulls)"},
                                  Row{".sdf", "Gazebo: SDFormat with its hulls next to it (hulls)"},
                                  Row{".usda", "Isaac Sim, Newton: USD as text, with UsdPhysics (hulls)"},
                                  Row{".glb", "web: glTF 2 with KHR_physics_rigid_bodies (hulls)"}};

const PaperRow& row(Format format) {
  return *std::find_if(paper_formats.begin(), paper_formats.end(),
                       [&](const PaperRow& r) { return r.format == format; });
}

}  // namespace

std::vector<std::string> hull_suffixes() {
  return {".obj", ".urdf", ".xml", ".sdf", ".usda", ".glb"};
}

std::vector<FormatRow> read_formats() {
  return {read_rows.begin(), read_rows.end()};
}

std::vector<FormatRow> written_formats() {
  std::vector<Row> rows;
  for (const PaperRow& r : paper_formats) {
    rows.push_back(r.row);
  }
  rows.insert(rows.end(), verb_formats.begin(), verb_formats.end());
  return rows;
}

std::optional<Format> paper_format(std::string_view suffix) {
  for (const PaperRow& r : paper_formats) {
    if (suffix == r.row.suffix) {
      return r.format;
    }
  }
  return std::nullopt;
}

const char* suffix(Format format) {
  return row(format).row.suffix;
}

bool one_file_per_page(Format format) {
  return row(format).per_page;
}

bool for_machines_alone(Format format) {
  return row(format).for_machines;
}

std::vector<Format> default_formats(const export_::Preset& preset) {
  std::vector<Format> formats;
  if (preset.is_machine()) {
    for (const auto& [wanted, format] : {std::pair(preset.pdf, Format::pdf),
                                         {preset.svg, Format::svg},
                                         {preset.dxf, Format::dxf},
                                         {preset.plt, Format::plt},
                                         {preset.fold, Format::fold}}) {
      if (wanted) {
        formats.push_back(format);
      }
    }
    return formats;
  }
  for (const PaperRow& r : paper_formats) {
    if (r.by_default) {
      formats.push_back(r.format);
    }
  }
  return formats;
}

std::string paper_suffixes() {
  std::vector<std::string> suffixes;
  for (const PaperRow& r : paper_formats) {
    suffixes.emplace_back(r.row.suffix);
  }
  return listed(suffixes, "and");
}

std::string suffix_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return ending;
}

}  // namespace ridgecraft::cli
