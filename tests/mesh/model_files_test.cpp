// SPDX-License-Identifier: GPL-3.0-or-later
// The broken files and the makers' models of the shared folder, which isn't part of the repository.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include <catch2/catch.hpp>

#include "mesh/shared_models.hpp"
#include "reading.hpp"

using namespace ridgecraft;
using mesh::RepairKind;
using mesh::Soup;
using test::shared_models;
namespace fs = std::filesystem;

namespace {

struct Case {
  std::string file;
  int exit_code = 0;
  std::string reaction;
};

std::vector<Case> broken_cases() {
  std::ifstream table(shared_models / "broken/generated/CASES.tsv");
  std::string line;
  std::getline(table, line);
  std::vector<Case> cases;
  while (std::getline(table, line)) {
    std::istringstream cells(line);
    Case c;
    std::string wrong;
    std::string code;
    std::getline(cells, c.file, '\t');
    std::getline(cells, wrong, '\t');
    std::getline(cells, c.reaction, '\t');
    std::getline(cells, code, '\t');
    c.exit_code = std::stoi(code);
    cases.push_back(c);
  }
  return cases;
}

/// Refusals with exit code 4 that need the mesh to be looked at, not only read.
bool decided_by_repair(const std::string& file) {
  return file == "all_points_equal.obj" || file == "all_points_on_a_line.obj" ||
         file == "one_point_at_1e200.obj";
}

/// What the reader has to remark on; all other files are read without a word.
const std::map<std::string, RepairKind> expected_remarks{
    {"zero_bytes_at_end.obj", RepairKind::trailing_data_ignored},
    {"stl_inside.obj", RepairKind::content_is_other_format},
    {"obj_inside.stl", RepairKind::content_is_other_format},
    {"off_inside.ply", RepairKind::content_is_other_format},
    {"ply_inside.off", RepairKind::content_is_other_format},
    {"other_elements.obj", RepairKind::element_ignored},
    {"mtl_missing.obj", RepairKind::material_file_missing},
    {"mtl_is_itself.obj", RepairKind::material_file_missing},
    {"mtl_absolute_path.obj", RepairKind::material_file_missing},
    {"mtl_undefined_name.obj", RepairKind::material_unknown},
    {"mtl_bad_colours.obj", RepairKind::material_value_corrected},
    {"texture_missing.obj", RepairKind::texture_missing},
    {"texture_cut_off.obj", RepairKind::texture_missing},
    {"texture_is_text.obj", RepairKind::texture_missing},
    {"texture_empty.obj", RepairKind::texture_missing},
    {"texture_index_too_high.obj", RepairKind::texture_point_dropped},
    {"texture_far_outside.obj", RepairKind::texture_point_dropped},
    {"count_too_low.stl", RepairKind::count_corrected},
    {"count_zero.stl", RepairKind::count_corrected},
    {"ascii_no_endsolid.stl", RepairKind::missing_end},
};

void check_remarks(const std::string& file, const Soup& soup) {
  const auto expected = expected_remarks.find(file);
  CHECK(soup.remarks.entries().size() == (expected == expected_remarks.end() ? 0 : 1));
  if (expected != expected_remarks.end()) {
    CHECK(soup.remarks.count(expected->second) > 0);
  }
}

}  // namespace

TEST_CASE("Broken files are read or refused as the table of cases proposes") {
  if (!fs::exists(shared_models / "broken/generated/CASES.tsv")) {
    WARN("no shared folder: skipped");
    return;
  }
  const std::vector<Case> cases = broken_cases();
  CHECK(cases.size() > 150);
  for (const Case& c : cases) {
    INFO(c.file);
    const fs::path path = shared_models / "broken/generated" / c.file;
    const bool refused = c.exit_code == 3 || (c.exit_code == 4 && !decided_by_repair(c.file));
    try {
      const Soup soup = mesh::read_soup(path, {});
      CHECK(!refused);
      check_remarks(c.file, soup);
    } catch (const Error& error) {
      INFO(error.what());
      CHECK(refused);
      CHECK(error.kind() == (c.exit_code == 3 ? ErrorKind::unreadable_input : ErrorKind::unusable_mesh));
      const std::string_view sentence = error.what();
      CHECK(sentence.starts_with(path.string()));
      CHECK(sentence.size() > path.string().size() + 5);
      CHECK(!sentence.ends_with('.'));
    }
  }
}

TEST_CASE("Files that differ only in form hold the same house") {
  if (!fs::exists(shared_models / "broken/generated")) {
    WARN("no shared folder: skipped");
    return;
  }
  const auto read = [](const std::string& file) {
    return mesh::read_soup(shared_models / "broken/generated" / file, {});
  };
  const Soup house = read("crlf.obj");
  for (const std::string file : {"utf8_bom.obj",
                                 "tabs.obj",
                                 "blank_lines.obj",
                                 "no_final_newline.obj",
                                 "zero_bytes_at_end.obj",
                                 "long_comment_line.obj",
                                 "no_suffix",
                                 "line_continuation.obj",
                                 "faces_before_points.obj",
                                 "relative_indices.obj",
                                 "corner_forms_mixed.obj",
                                 "point_colours.obj",
                                 "fourth_coordinate.obj",
                                 "number_forms.obj",
                                 "texture_options.obj",
                                 "crlf.off",
                                 "comments.off",
                                 "counts_beside_keyword.off",
                                 "point_colours.off",
                                 "point_normals.off",
                                 "face_colours.off",
                                 "big_endian.ply",
                                 "list_types.ply",
                                 "edges_element.ply"}) {
    INFO(file);
    const Soup soup = read(file);
    CHECK(soup.points == house.points);
    CHECK(soup.first_corner == house.first_corner);
    CHECK(soup.corner_point == house.corner_point);
  }
  const Soup facets = read("attribute_bytes.stl");
  for (const std::string file :
       {"ascii_capitals.stl", "ascii_no_endsolid.stl", "count_zero.stl", "normals_wrong.stl",
        "solid_but_binary.stl", "unknown_suffix.mesh3d", "stl_inside.obj"}) {
    INFO(file);
    CHECK(read(file).points == facets.points);
  }
}

TEST_CASE("The makers' models have the faces that their table says") {
  if (!fs::exists(shared_models / "makers/README.md")) {
    WARN("no shared folder: skipped");
    return;
  }
  std::ifstream table(shared_models / "makers/README.md");
  std::string line;
  std::size_t found = 0;
  while (std::getline(table, line)) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, '|');) {
      cells.push_back(cell.substr(std::min<std::size_t>(cell.size(), 1)));
    }
    if (cells.size() < 6 || cells[1].find('.') == std::string::npos || cells[1].starts_with("File")) {
      continue;
    }
    const std::string file = cells[1].substr(0, cells[1].find(' '));
    INFO(file);
    const Soup soup = mesh::read_soup(shared_models / "makers" / file, {});
    ++found;
    CHECK(soup.polygon_count() == std::stoul(cells[4]));
    CHECK(soup.points.size() == std::stoul(cells[5]));
    CHECK(soup.remarks.entries().empty());
    const bool textured = cells[3].starts_with("texture");
    CHECK(!soup.corner_texture.empty() == textured);
    const bool picture = std::any_of(soup.materials.begin(), soup.materials.end(),
                                     [](const mesh::Material& m) { return !m.texture_file.empty(); });
    CHECK(picture == textured);
    CHECK(soup.materials.empty() == cells[3].starts_with("-"));
  }
  CHECK(found == 15);
}
