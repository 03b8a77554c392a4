// SPDX-License-Identifier: GPL-3.0-or-later
// The direction of dependencies is checked, not hoped for (docs/architecture.md).
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

#include <catch2/catch.hpp>

namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::set<std::string>> allowed = {
    {"mesh", {"mesh"}},
    {"segment", {"segment", "mesh"}},
    {"solid", {"solid", "segment", "mesh"}},
    {"unfold", {"unfold", "mesh"}},
    {"export", {"export", "unfold", "mesh"}},
    {"verify", {"verify", "mesh"}},
    {"cli", {"cli", "export", "unfold", "solid", "segment", "verify", "mesh"}},
};

/// verify/ may use the foundation only: whatever judges results shares no algorithm with what makes them.
const std::set<std::string> foundation = {"mesh/foundation/vector.hpp", "mesh/foundation/error.hpp",
                                          "mesh/foundation/context.hpp", "mesh/foundation/id.hpp"};

template <class Visit>
void for_each_include(const std::string& folder, const Visit& visit) {
  const std::regex include(R"re(^\s*#include\s*["<]([^">]+)[">])re");
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(RIDGECRAFT_SOURCE_DIR) / folder)) {
    const std::string suffix = entry.path().extension().string();
    if (suffix != ".hpp" && suffix != ".cpp") {
      continue;
    }
    std::ifstream in(entry.path());
    std::string line;
    std::smatch match;
    while (std::getline(in, line)) {
      if (std::regex_search(line, match, include)) {
        visit(entry.path(), match[1].str());
      }
    }
  }
}

}  // namespace

TEST_CASE("folders include only what the architecture allows", "[architecture]") {
  for (const auto& [folder, may] : allowed) {
    std::size_t seen = 0;
    for_each_include(folder, [&](const fs::path& file, const std::string& included) {
      ++seen;
      const std::size_t slash = included.find('/');
      const std::string from = slash == std::string::npos ? "" : included.substr(0, slash);
      if (allowed.contains(from)) {
        INFO(file << " includes " << included);
        CHECK(may.contains(from));
        if (folder == "verify" && from == "mesh") {
          CHECK(foundation.contains(included));
        }
      }
    });
    CHECK(seen > 0);
  }
}

TEST_CASE("sub-folders are private, but for the foundation", "[architecture]") {
  for (const auto& [folder, may] : allowed) {
    for_each_include(folder, [&](const fs::path& file, const std::string& included) {
      if (std::count(included.begin(), included.end(), '/') == 2 &&
          !included.starts_with("mesh/foundation/") &&
          allowed.contains(included.substr(0, included.find('/')))) {
        INFO(file << " includes " << included);
        CHECK(included.starts_with(folder + "/"));
      }
    });
  }
}

TEST_CASE("CGAL and OpenMesh stay behind plain headers", "[architecture]") {
  for (const auto& [folder, may] : allowed) {
    for_each_include(folder, [&](const fs::path& file, const std::string& included) {
      if (file.extension() == ".hpp" && file.filename() != "edit_mesh.hpp") {
        INFO(file << " includes " << included);
        CHECK_FALSE(included.starts_with("CGAL/"));
        CHECK_FALSE(included.starts_with("OpenMesh/"));
      }
    });
  }
}
