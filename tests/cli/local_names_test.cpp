// SPDX-License-Identifier: GPL-3.0-or-later
// Files of one folder are compiled as one unit in a release build: their local names must differ, which the
// builds for tests wouldn't show.
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

namespace {

namespace fs = std::filesystem;

/// What a line at the margin of an unnamed namespace defines: a constant, a type, or a function with the
/// first line of its parameters, since functions may differ by these alone.
std::optional<std::string> name_of(const std::string& line) {
  static const std::regex constant(R"re((?:inline )?constexpr [\w:<>, *]*?\b(\w+)(?:\{| = ).*)re");
  static const std::regex type(R"re((?:class|struct|enum class) (\w+)\b.*)re");
  static const std::regex function(R"re([\w:][\w:<>,&* ]*[ &*](\w+\([^)]*).*)re");
  static const std::regex none(R"re((?:template|using|namespace|return)\b.*)re");
  std::smatch match;
  if (!std::regex_match(line, none) &&
      (std::regex_match(line, match, constant) || std::regex_match(line, match, type) ||
       std::regex_match(line, match, function))) {
    return match[1].str();
  }
  return std::nullopt;
}

/// The name of `using Faces = std::vector<std::uint32_t>;`, another name for a type.
std::optional<std::string> alias_of(const std::string& line) {
  static const std::regex alias(R"re(using (\w+) = .*)re");
  std::smatch match;
  return std::regex_match(line, match, alias) ? std::optional(match[1].str()) : std::nullopt;
}

/// CGAL's settings keep what includes it apart.
struct LocalNames {
  bool with_cgal = false;
  std::map<std::string, std::string> names;  ///< and, of other names for types, the line
};

LocalNames local_names(const fs::path& file) {
  LocalNames result;
  std::ifstream in(file);
  std::string line;
  bool local = false;
  while (std::getline(in, line)) {
    result.with_cgal = result.with_cgal || line.starts_with("#include <CGAL/");
    local = line == "namespace {" || (local && line != "}  // namespace");
    if (local && line != "namespace {") {
      if (const auto name = name_of(line)) {
        result.names.emplace(*name, "");
      } else if (const auto alias = alias_of(line)) {
        result.names.emplace(*alias, line);
      }
    }
  }
  return result;
}

}  // namespace

TEST_CASE("names are found where they are defined", "[architecture]") {
  CHECK(name_of("constexpr std::size_t most_faces = 600;") == "most_faces");
  CHECK(name_of("constexpr std::array<float, 8> cosines{1.0F, 0.9F};") == "cosines");
  CHECK(name_of("class FewestSearch {") == "FewestSearch");
  CHECK(name_of("struct Edge;") == "Edge");
  CHECK(name_of("std::uint32_t next_side(std::uint32_t side) {") == "next_side(std::uint32_t side");
  CHECK(name_of("const std::vector<int>& all(const Patch& patch, const Layout&") ==
        "all(const Patch& patch, const Layout&");
  CHECK_FALSE(name_of("  return side;").has_value());
  CHECK_FALSE(name_of("using Faces = std::vector<std::uint32_t>;").has_value());
}

TEST_CASE("no two files of a folder have a local name in common", "[architecture]") {
  std::size_t found = 0;
  for (const char* const top :
       {"base", "mesh", "prepare", "segment", "solid", "unfold", "export", "verify", "job", "cli"}) {
    struct Place {
      std::string file;
      std::string alias;
    };
    std::map<std::pair<std::string, bool>, std::map<std::string, Place>> taken;  // by folder and CGAL
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(RIDGECRAFT_SOURCE_DIR) / top)) {
      if (entry.path().extension() != ".cpp") {
        continue;
      }
      const LocalNames local = local_names(entry.path());
      for (const auto& [name, alias] : local.names) {
        ++found;
        const auto [at, is_new] = taken[{entry.path().parent_path().string(), local.with_cgal}].emplace(
            name, Place{entry.path().string(), alias});
        INFO(name << " in " << at->second.file << " and " << entry.path().string());
        CHECK((is_new || (!alias.empty() && !at->second.alias.empty())));
      }
    }
  }
  CHECK(found > 1000);
}
