// SPDX-License-Identifier: GPL-3.0-or-later
// Files of one folder are compiled as one unit in some builds, tests as well as libraries: their local names
// must differ, from each other and from those of headers that only others of the folder include. Builds of
// each file alone wouldn't show it.
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

namespace {

namespace fs = std::filesystem;

/// What a line at the margin of a namespace defines or declares: a constant, a type, or a function with the
/// first line of its parameters, since functions of one folder may differ by these alone.
std::optional<std::string> name_of(const std::string& line) {
  static const std::regex constant(R"re((?:inline )?const(?:expr)? [\w:<>, *]*?\b(\w+)(?:\{| = ).*)re");
  static const std::regex type(R"re((?:class|struct|enum class) (\w+)\b.*)re");
  static const std::regex function(R"re((?:\[\[nodiscard\]\] )?[\w:][\w:<>,&* ]*[ &*](\w+\([^)]*).*)re");
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

/// The name that `using test::sphere;` takes from another namespace.
std::optional<std::string> taken_name_of(const std::string& line) {
  static const std::regex taken(R"re(using [\w:]+::(\w+);)re");
  std::smatch match;
  return std::regex_match(line, match, taken) ? std::optional(match[1].str()) : std::nullopt;
}

/// A function as overloads tell it apart: with the types of its parameters, whatever they are called.
std::string with_types(const std::string& name) {
  static const std::regex parameter(R"re(([ &*>])\w+(?=,|$))re");
  return std::regex_replace(name, parameter, "$1");
}

/// The name alone, without parameters.
std::string bare(const std::string& name) {
  return name.substr(0, name.find('('));
}

/// A file of ours: what it includes of us, and what it defines and declares.
struct SourceFile {
  std::set<std::string> includes;
  bool with_cgal = false;                     ///< CGAL's settings keep what includes it apart
  std::set<std::string> taken;                ///< names from other namespaces, outside of all functions
  std::set<std::string> spaces;               ///< namespaces around the local names
  std::map<std::string, std::string> locals;  ///< in unnamed namespaces; of other names for types, the line
  std::map<std::string, std::set<std::string>>
      shared;  ///< by namespace, outside of these, without parameters
};

SourceFile read_source(const fs::path& file) {
  static const std::regex include(R"re(#include "(.+)")re");
  static const std::regex begin(R"re(namespace (ridgecraft[\w:]*) \{)re");
  SourceFile result;
  std::ifstream in(file);
  std::string line;
  std::string space;
  bool local = false;
  std::smatch match;
  while (std::getline(in, line)) {
    result.with_cgal = result.with_cgal || line.starts_with("#include <CGAL/");
    if (std::regex_match(line, match, include)) {
      result.includes.insert(match[1].str());
    } else if (std::regex_match(line, match, begin)) {
      space = match[1].str();
    } else if (line == "}  // namespace " + space) {
      space.clear();
    } else if (line == "namespace {" || line == "}  // namespace") {
      local = line == "namespace {";
    } else if (const auto taken = taken_name_of(line)) {
      result.taken.insert(*taken);
    } else if (const auto alias = alias_of(line); alias || name_of(line)) {
      const std::string name = alias ? *alias : with_types(*name_of(line));
      if (local) {
        result.spaces.insert(space);
        result.locals.emplace(name, alias ? line : "");
      } else {
        result.shared[space].insert(bare(name));
      }
    }
  }
  return result;
}

/// Adds the files of a folder and of those in it, by their paths in the repository.
void add_sources(const std::string& folder, std::map<std::string, SourceFile>& sources) {
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(RIDGECRAFT_SOURCE_DIR) / folder)) {
    if (entry.path().extension() == ".cpp" || entry.path().extension() == ".hpp") {
      sources.emplace(fs::relative(entry.path(), RIDGECRAFT_SOURCE_DIR).generic_string(),
                      read_source(entry.path()));
    }
  }
}

/// All files of the libraries, of the program, and of their tests.
std::map<std::string, SourceFile> read_sources() {
  std::map<std::string, SourceFile> result;
  for (const std::string top : {"base", "mesh", "prepare", "segment", "solid", "unfold", "export", "verify",
                                "job", "session", "cli"}) {
    add_sources(top, result);
    add_sources("tests/" + top, result);
  }
  add_sources("tests/support", result);
  // Tests name their headers from their own folder or from that of all tests.
  for (auto& [file, source] : result) {
    if (!file.starts_with("tests/")) {
      continue;
    }
    std::set<std::string> resolved;
    for (const std::string& header : source.includes) {
      const std::string beside = (fs::path(file).parent_path() / header).generic_string();
      resolved.insert(result.contains(beside)              ? beside
                      : result.contains("tests/" + header) ? "tests/" + header
                                                           : header);
    }
    source.includes = std::move(resolved);
  }
  return result;
}

/// Adds the headers of ours that a file includes, by others, too.
void add_headers(const std::map<std::string, SourceFile>& sources, const std::string& file,
                 std::set<std::string>& headers) {
  const auto found = sources.find(file);
  for (const std::string& header :
       found == sources.end() ? std::set<std::string>() : found->second.includes) {
    if (headers.insert(header).second) {
      add_headers(sources, header, headers);
    }
  }
}

}  // namespace

TEST_CASE("names are found where they are defined", "[architecture]") {
  CHECK(name_of("constexpr std::size_t most_faces = 600;") == "most_faces");
  CHECK(name_of("constexpr std::array<float, 8> cosines{1.0F, 0.9F};") == "cosines");
  CHECK(name_of("const double turn_cosine = elementary::cos(1.3);") == "turn_cosine");
  CHECK(name_of("class FewestSearch {") == "FewestSearch");
  CHECK(name_of("struct Edge;") == "Edge");
  CHECK(name_of("std::uint32_t next_side(std::uint32_t side) {") == "next_side(std::uint32_t side");
  CHECK(name_of("const std::vector<int>& all(const Patch& patch, const Layout&") ==
        "all(const Patch& patch, const Layout&");
  CHECK(name_of("[[nodiscard]] bool has_layer(const Group& group, Layer layer);") ==
        "has_layer(const Group& group, Layer layer");
  CHECK(name_of("[[nodiscard]] inline bool meet(const Segment2& s, const Segment2& t) {") ==
        "meet(const Segment2& s, const Segment2& t");
  CHECK(with_types("panels_of(const Panels& whole, const IdVector<FaceId, FaceId>& kept") ==
        with_types("panels_of(const Panels& all, const IdVector<FaceId, FaceId>& face"));
  CHECK(with_types("side_of(FaceId face") != with_types("side_of(EdgeId face"));
  CHECK_FALSE(name_of("  return side;").has_value());
  CHECK_FALSE(name_of("using Faces = std::vector<std::uint32_t>;").has_value());
}

TEST_CASE("no two files of a folder have a local name in common", "[architecture]") {
  struct Place {
    std::string file;
    std::string alias;
  };
  std::size_t found = 0;
  std::map<std::pair<std::string, bool>, std::map<std::string, Place>> taken;  // by folder and CGAL
  for (const auto& [file, source] : read_sources()) {
    if (!file.ends_with(".cpp")) {
      continue;
    }
    for (const auto& [name, alias] : source.locals) {
      ++found;
      const auto [at, is_new] =
          taken[{fs::path(file).parent_path().string(), source.with_cgal}].emplace(name, Place{file, alias});
      INFO(name << " in " << at->second.file << " and " << file);
      CHECK((is_new || (!alias.empty() && !at->second.alias.empty())));
    }
  }
  CHECK(found > 2000);
}

TEST_CASE("no file has a local name that another of its folder takes from elsewhere", "[architecture]") {
  const std::map<std::string, SourceFile> sources = read_sources();
  std::map<std::pair<std::string, bool>, std::map<std::string, std::string>> taken;  // by folder and CGAL
  for (const auto& [file, source] : sources) {
    for (const std::string& name : source.taken) {
      taken[{fs::path(file).parent_path().string(), source.with_cgal}].emplace(name, file);
    }
  }
  for (const auto& [file, source] : sources) {
    const auto& names = taken[{fs::path(file).parent_path().string(), source.with_cgal}];
    for (const auto& [name, alias] : source.locals) {
      const auto found = names.find(bare(name));
      INFO(name << " in " << file << " and " << (found == names.end() ? "none" : found->second));
      CHECK((found == names.end() || !alias.empty()));
    }
  }
}

TEST_CASE("no file has a local name of a header that others of its folder include", "[architecture]") {
  const std::map<std::string, SourceFile> sources = read_sources();
  std::map<std::pair<std::string, bool>, std::set<std::string>> unit;  // headers by folder and CGAL
  for (const auto& [file, source] : sources) {
    if (file.ends_with(".cpp")) {
      add_headers(sources, file, unit[{fs::path(file).parent_path().string(), source.with_cgal}]);
    }
  }
  std::size_t foreign = 0;
  for (const auto& [file, source] : sources) {
    if (!file.ends_with(".cpp")) {
      continue;
    }
    std::set<std::string> own;
    add_headers(sources, file, own);
    for (const std::string& header : unit[{fs::path(file).parent_path().string(), source.with_cgal}]) {
      const auto declared = sources.find(header);
      if (own.contains(header) || declared == sources.end()) {
        continue;  // with its own headers each file is compiled in the builds for tests
      }
      ++foreign;
      for (const auto& [space, names] : declared->second.shared) {
        for (const auto& [name, alias] : source.locals) {
          INFO(name << " in " << file << " and " << header);
          CHECK_FALSE((source.spaces.contains(space) && names.contains(bare(name))));
        }
      }
    }
  }
  CHECK(foreign > 1000);
}
