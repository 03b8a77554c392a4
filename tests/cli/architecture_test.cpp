// SPDX-License-Identifier: GPL-3.0-or-later
// The direction of dependencies is checked, not hoped for (docs/design/architecture.md).
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

namespace {

namespace fs = std::filesystem;

/// A sub-folder with one subject.
struct Room {
  std::string name;
  std::set<std::string> stands_on;  ///< rooms of the same folder that it may include
};

/// One library.
struct Folder {
  std::string name;
  std::set<std::string> stands_on;  ///< other folders that it may include; base/ always
  std::vector<Room> rooms;          ///< from the ground up: none stands on a later one
  std::set<std::string>
      open_to_others;  ///< headers that other folders may include, without the folder's name
};

const std::vector<Folder>& folders() {
  static const std::vector<Folder> all = {
      {"base", {}, {}, {}},
      {"mesh",
       {},
       {{"model", {}},
        {"look", {"model"}},
        {"reading", {"model", "look"}},
        {"reading/gltf", {"model", "look", "reading"}},
        {"reading/threemf", {"model", "look", "reading"}},
        {"reading/pdo", {"model", "look", "reading"}},
        {"reading/imported", {"model", "look", "reading"}},
        {"repair", {"model"}}},
       {"mesh.hpp", "reading/pdo/read_pdo.hpp", "model/model.hpp", "model/surface.hpp", "model/soup.hpp",
        "look/look.hpp", "look/picture.hpp", "look/relief.hpp", "look/shade.hpp",
        "model/surface_distance.hpp", "reading/files.hpp", "reading/read_soup.hpp",
        "reading/imported/stream.hpp", "reading/text_scanner.hpp", "reading/zip_archive.hpp",
        "repair/loose_faces.hpp"}},
      {"prepare",
       {"mesh"},
       {{"prepared", {}},
        {"symmetry", {}},
        {"skin", {"prepared", "symmetry"}},
        {"panels", {"prepared"}},
        {"selection", {"prepared", "symmetry"}},
        {"domains", {"symmetry"}},
        {"walls", {"prepared", "symmetry", "panels", "domains"}},
        {"features", {"prepared", "symmetry", "panels", "walls"}},
        {"bodies", {"prepared", "symmetry", "features"}},
        {"collapses", {"symmetry", "domains", "walls"}},
        {"simplify", {"prepared", "symmetry", "panels", "domains", "walls", "features", "collapses"}}},
       {"prepare.hpp", "clean_bodies.hpp", "prepared/options.hpp", "prepared/prepared.hpp",
        "prepared/panels.hpp", "prepared/effort.hpp", "skin/skin.hpp", "selection/selection.hpp",
        "symmetry/isometry.hpp", "symmetry/correspondence.hpp", "symmetry/mirrors.hpp",
        "symmetry/twins.hpp"}},
      {"segment",
       {"mesh"},
       {{"surface", {}},
        {"hull", {"surface"}},
        {"concavity", {"surface", "hull"}},
        {"cutting", {"surface", "hull", "concavity"}},
        {"joining", {"surface", "hull", "concavity", "cutting"}}},
       {"segment.hpp", "hierarchy.hpp", "surface/segmentation.hpp", "evaluate.hpp"}},
      {"solid", {"segment", "mesh"}, {}, {"solid.hpp"}},
      {"unfold",
       {"prepare", "mesh"},
       {{"net", {}},
        {"patch", {"net"}},
        {"folding", {"net", "patch"}},
        {"search", {"net", "patch", "folding"}},
        {"tabs/shape", {"net"}},
        {"tabs/place", {"net", "patch", "tabs/shape"}},
        {"tabs/trees", {"net", "patch", "search", "tabs/shape", "tabs/place"}},
        {"energy", {"net", "patch", "search", "tabs/shape", "tabs/trees", "folding"}},
        {"pieces", {"net", "patch", "search", "tabs/place", "tabs/trees", "energy", "folding"}}},
       {"unfold.hpp", "edits.hpp", "panel_parts.hpp", "tabs_of_nets.hpp", "net/chains.hpp",
        "net/keep_numbers.hpp", "net/nets.hpp", "net/options.hpp", "net/edge_constraints.hpp",
        "net/outline.hpp", "tabs/place/fit.hpp", "tabs/place/place_tabs.hpp", "tabs/place/tab_requests.hpp"}},
      {"export",
       {"unfold", "prepare", "mesh"},
       {{"sheet", {}},
        {"style", {"sheet"}},
        {"page", {"sheet", "style"}},
        {"paint", {"sheet", "style", "page"}},
        {"machine", {"sheet", "style"}},
        {"packing", {}},
        {"assembly", {}},
        {"view", {}},
        {"guide", {"sheet", "style", "page", "paint", "assembly", "view"}},
        {"formats", {"sheet", "style", "machine", "assembly", "view"}}},
       {"export.hpp", "layout_around.hpp", "machine/thick_nets.hpp", "paint/lost_edges.hpp",
        "sheet/drawing.hpp", "sheet/pages.hpp", "sheet/paper.hpp", "sheet/pieces.hpp", "sheet/rolled.hpp",
        "view/camera.hpp"}},
      {"verify",
       {},
       {{"file", {}},
        {"geometry", {"file"}},
        {"checks", {"file", "geometry"}},
        {"pages", {"file", "geometry", "checks"}}},
       {"verify.hpp", "file/file.hpp", "pages/printed.hpp"}},
      {"job",
       {"export", "unfold", "segment", "verify", "prepare", "mesh"},
       {},
       {"job.hpp", "asked_options.hpp", "edge_requests.hpp", "options.hpp", "page_layout.hpp", "remark.hpp",
        "stage_clock.hpp", "unfold_options.hpp"}},
      {"session",
       {"job", "export", "unfold", "verify", "prepare", "mesh"},
       {},
       {"edit.hpp", "project_file.hpp", "session.hpp"}},
      {"cli",
       {"session", "job", "export", "unfold", "solid", "segment", "verify", "prepare", "mesh"},
       {{"files", {}},
        {"arguments", {"files"}},
        {"jobs", {"files", "arguments"}},
        {"report", {"files", "arguments", "jobs"}}},
       {}},
      {"import", {"mesh"}, {}, {}},
  };
  return all;
}

/// What looks at the program from beside it; no folder of the program includes any of these.
const std::set<std::string> beside_the_program = {"tests", "bench", "samples", "python", "wasm"};

/// Headers that others may include who link the libraries: PUBLIC_HEADERS of the folder's CMakeLists.txt.
std::set<std::string> public_headers(const std::string& folder) {
  std::ifstream in(fs::path(RIDGECRAFT_SOURCE_DIR) / folder / "CMakeLists.txt");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::size_t begin = text.find("PUBLIC_HEADERS");
  const std::size_t end = text.find("SOURCES", begin);
  std::set<std::string> headers;
  const std::regex name(R"re([\w/]+\.hpp)re");
  const std::string list = begin == std::string::npos ? "" : text.substr(begin, end - begin);
  for (std::sregex_iterator i(list.begin(), list.end(), name), none; i != none; ++i) {
    headers.insert(folder + "/" + i->str());
  }
  return headers;
}

struct Include {
  fs::path file;         ///< from the root
  std::string included;  ///< "mesh/model/surface.hpp", or what stands between <>
  bool quoted = false;   ///< else between <>
};

std::vector<Include> includes_of(const std::string& folder) {
  const std::regex directive(R"re(^\s*#include\s*(["<])([^">]+)[">])re");
  const fs::path root(RIDGECRAFT_SOURCE_DIR);
  std::vector<Include> includes;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    const std::string suffix = entry.path().extension().string();
    if (suffix != ".hpp" && suffix != ".cpp") {
      continue;
    }
    std::ifstream in(entry.path());
    std::string line;
    std::smatch match;
    while (std::getline(in, line)) {
      if (std::regex_search(line, match, directive)) {
        includes.push_back({entry.path().lexically_relative(root), match[2].str(), match[1] == "\""});
      }
    }
  }
  return includes;
}

const Folder* folder_named(const std::string& name) {
  const auto found =
      std::find_if(folders().begin(), folders().end(), [&](const Folder& f) { return f.name == name; });
  return found == folders().end() ? nullptr : &*found;
}

/// "pieces" of "unfold/pieces/closing.cpp", "tabs/shape" of "unfold/tabs/shape/shapes.hpp"; empty at the top.
std::string room_of(const fs::path& file) {
  const auto folder = file.begin()->string();
  return file.parent_path() == folder ? "" : file.parent_path().lexically_relative(folder).string();
}

/// "unfold/net/outline" of the header and of the source file: a unit.
std::string unit_of(const fs::path& file) {
  return fs::path(file).replace_extension().string();
}

using UnitGraph = std::map<std::string, std::set<std::string>>;

/// Which units each unit of a folder includes, itself not counted.
UnitGraph units_of(const std::string& folder) {
  UnitGraph units;
  for (const auto& [file, included, quoted] : includes_of(folder)) {
    units[unit_of(file)];
    if (quoted && unit_of(included) != unit_of(file)) {
      units[unit_of(file)].insert(unit_of(included));
    }
  }
  return units;
}

/// What stays when units that include none of the others are taken away again and again: circles, and what
/// stands on them.
UnitGraph circles_of(UnitGraph units) {
  const auto stands_on_none = [&](const auto& unit) {
    return std::none_of(unit.second.begin(), unit.second.end(),
                        [&](const std::string& other) { return units.contains(other); });
  };
  for (std::size_t before = 0; before != units.size();) {
    before = units.size();
    for (auto unit = units.begin(); unit != units.end();) {
      unit = stands_on_none(*unit) ? units.erase(unit) : std::next(unit);
    }
  }
  return units;
}

}  // namespace

TEST_CASE("every folder that is built is one of the program, or beside it", "[architecture]") {
  const std::regex directive(R"re((?:add_subdirectory|ridgecraft_component)\((\w+)\))re");
  std::ifstream in(fs::path(RIDGECRAFT_SOURCE_DIR) / "CMakeLists.txt");
  std::set<std::string> built;
  std::string line;
  std::smatch match;
  while (std::getline(in, line)) {
    if (std::regex_search(line, match, directive)) {
      built.insert(match[1].str());
    }
  }
  std::set<std::string> known = beside_the_program;
  for (const Folder& folder : folders()) {
    known.insert(folder.name);
  }
  CHECK(built == known);
}

TEST_CASE("what is included in quotes is named from the root, and none of it is beside the program",
          "[architecture]") {
  for (const Folder& folder : folders()) {
    for (const auto& [file, included, quoted] : includes_of(folder.name)) {
      const std::string from = fs::path(included).begin()->string();
      INFO(file << " includes " << included);
      // A path such as "../tests/x.hpp" begins with no folder's name, nor does "x.hpp".
      CHECK(quoted == (folder_named(from) != nullptr && included != from));
      CHECK_FALSE(beside_the_program.contains(from));
      CHECK(included.find("..") == std::string::npos);
    }
  }
}

TEST_CASE("a folder includes only those below it", "[architecture]") {
  for (const Folder& folder : folders()) {
    const std::vector<Include> includes = includes_of(folder.name);
    CHECK_FALSE(includes.empty());
    for (const auto& [file, included, quoted] : includes) {
      const Folder* const from = folder_named(fs::path(included).begin()->string());
      if (from != nullptr && from->name != folder.name) {
        INFO(file << " includes " << included);
        CHECK((from->name == "base" || folder.stands_on.contains(from->name)));
      }
    }
  }
}

TEST_CASE("a folder opens its headers to others by name", "[architecture]") {
  for (const Folder& folder : folders()) {
    for (const auto& [file, included, quoted] : includes_of(folder.name)) {
      const Folder* const from = folder_named(fs::path(included).begin()->string());
      if (from != nullptr && from->name != folder.name && from->name != "base") {
        INFO(file << " includes " << included);
        CHECK(from->open_to_others.contains(fs::path(included).lexically_relative(from->name).string()));
      }
    }
  }
}

TEST_CASE("a header that is open to others exists", "[architecture]") {
  for (const Folder& folder : folders()) {
    for (const std::string& header : folder.open_to_others) {
      INFO(folder.name << "/" << header);
      CHECK(fs::exists(fs::path(RIDGECRAFT_SOURCE_DIR) / folder.name / header));
    }
  }
}

TEST_CASE("rooms stand on each other from the ground up, and none on the top of its folder",
          "[architecture]") {
  for (const Folder& folder : folders()) {
    if (folder.rooms.empty()) {
      continue;
    }
    std::set<std::string> below;
    for (const Room& room : folder.rooms) {
      INFO(folder.name << "/" << room.name);
      CHECK(std::includes(below.begin(), below.end(), room.stands_on.begin(), room.stands_on.end()));
      below.insert(room.name);
    }
    for (const auto& [file, included, quoted] : includes_of(folder.name)) {
      const std::string here = room_of(file);
      const auto room = std::find_if(folder.rooms.begin(), folder.rooms.end(),
                                     [&](const Room& r) { return r.name == here; });
      INFO(file << " includes " << included);
      REQUIRE((here.empty() || room != folder.rooms.end()));
      if (room != folder.rooms.end() && *fs::path(included).begin() == folder.name) {
        const std::string there = room_of(included);
        CHECK((there == here || room->stands_on.contains(there)));
      }
    }
  }
}

TEST_CASE("no two units include each other, nor more of them in a circle", "[architecture]") {
  CHECK(circles_of({{"a", {"b"}}, {"b", {"c"}}, {"c", {}}}).empty());
  CHECK(circles_of({{"a", {"b"}}, {"b", {"c"}}, {"c", {"b"}}, {"d", {}}}).size() == 3);
  for (const Folder& folder : folders()) {
    const UnitGraph units = units_of(folder.name);
    CHECK(units.size() > 1);
    for (const auto& [unit, included] : circles_of(units)) {
      FAIL_CHECK(unit << " is part of a circle, or stands on one");
    }
  }
}

TEST_CASE("CGAL and OpenMesh stay behind plain headers", "[architecture]") {
  // Read by nothing but the source files of their room.
  const std::set<std::string> behind = {"prepare/collapses/collapse.hpp", "prepare/skin/exact.hpp"};
  for (const Folder& folder : folders()) {
    for (const auto& [file, included, quoted] : includes_of(folder.name)) {
      if (file.extension() == ".hpp" && !behind.contains(file.generic_string())) {
        INFO(file << " includes " << included);
        CHECK_FALSE(included.starts_with("CGAL/"));
        CHECK_FALSE(included.starts_with("OpenMesh/"));
      }
    }
  }
}

TEST_CASE("a header that is installed includes only such, of its folder or those below", "[architecture]") {
  std::set<std::string> installed;
  for (const Folder& folder : folders()) {
    installed.merge(public_headers(folder.name));
  }
  CHECK(installed.size() > 60);
  for (const std::string& header : installed) {
    INFO(header);
    CHECK(fs::exists(fs::path(RIDGECRAFT_SOURCE_DIR) / header));
    CHECK_FALSE(header.starts_with("cli/"));
  }
  for (const Folder& folder : folders()) {
    for (const auto& [file, included, quoted] : includes_of(folder.name)) {
      if (quoted && installed.contains(file.generic_string())) {
        INFO(file << " includes " << included);
        CHECK(installed.contains(included));
      }
    }
  }
  // The Python module has no more than others who link the libraries.
  for (const auto& [file, included, quoted] : includes_of("python")) {
    INFO(file << " includes " << included);
    CHECK((!quoted || included.starts_with("python/") || installed.contains(included)));
  }
}

TEST_CASE("the browser's build has what is used of std::ranges", "[architecture]") {
  // Its library is libc++ 13 (docs/design/studio.md), which has these; wasm/compat/ has the others.
  std::set<std::string> had = {"empty", "greater", "random_access_range"};
  std::ifstream compat(fs::path(RIDGECRAFT_SOURCE_DIR) / "wasm/compat/algorithm");
  const std::regex definition(R"re(^(?:auto|bool|void) (\w+)\()re");
  std::smatch match;
  for (std::string line; std::getline(compat, line);) {
    if (std::regex_search(line, match, definition)) {
      had.insert(match[1].str());
    }
  }
  const std::regex use(R"re(ranges::(\w+))re");
  std::size_t uses = 0;
  for (const Folder& folder : folders()) {
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(RIDGECRAFT_SOURCE_DIR) / folder.name)) {
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        for (auto at = std::sregex_iterator(line.begin(), line.end(), use); at != std::sregex_iterator();
             ++at) {
          ++uses;
          INFO(entry.path() << ": " << line);
          CHECK(had.contains((*at)[1].str()));
        }
      }
    }
  }
  CHECK(uses > 50);
}
