// SPDX-License-Identifier: GPL-3.0-or-later
// What others link: the libraries are installed into a temporary folder, found there by projects that know
// nothing of this one, and count what the program counts.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "support/program.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using nlohmann::json;
using test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

const fs::path root(RIDGECRAFT_SOURCE_DIR);

test::Outcome must_run(const std::vector<std::string>& command) {
  test::Outcome outcome = test::run_command(command);
  INFO(command.front() << " " << (command.size() > 1 ? command[1] : "") << "\n"
                       << outcome.out << outcome.err);
  REQUIRE(outcome.exit_code == 0);
  return outcome;
}

/// Libraries, headers and package files below this folder.
void install_into(const fs::path& prefix) {
  must_run({"cmake", "--install", RIDGECRAFT_BINARY_DIR, "--prefix", prefix.string(), "--component",
            "development"});
}

using Words = std::vector<std::string>;

Words configure_words(const fs::path& source, const fs::path& build, const fs::path& prefix) {
  return {"cmake", "-G", "Ninja", "-S", source.string(), "-B", build.string(),
          "-DCMAKE_PREFIX_PATH=" + prefix.string(), "-DCMAKE_BUILD_TYPE=Release",
          // No header of ours warns, whatever warnings others have switched on.
          "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wconversion -Wshadow -Werror",
          "-DCMAKE_NO_SYSTEM_FROM_IMPORTED=ON"};
}

/// A project of examples/, built against what is installed; the program's path.
std::string built_example(const std::string& name, const TemporaryFolder& folder, const Words& more = {}) {
  install_into(folder / "installed");
  Words words = configure_words(root / "examples" / name, folder / "build", folder / "installed");
  words.insert(words.end(), more.begin(), more.end());
  must_run(words);
  must_run({"cmake", "--build", (folder / "build").string()});
  return (folder / "build" / (name + "_example")).string();
}

json told_by_program(Words words) {
  words.insert(words.begin(), RIDGECRAFT_PROGRAM);
  words.emplace_back("--json");
  return json::parse(must_run(words).out);
}

/// What find_package says where a part of it is missing.
std::string refusal(const TemporaryFolder& folder, const std::string& component, const Words& more) {
  fs::create_directories(folder / "asks");
  std::ofstream(folder / "asks/CMakeLists.txt")
      << "cmake_minimum_required(VERSION 3.1)\nproject(asks LANGUAGES CXX)\n"
      << "find_package(Ridgecraft REQUIRED COMPONENTS " << component << ")\n";
  Words words = configure_words(folder / "asks", folder / "asked", folder / "installed");
  words.insert(words.end(), more.begin(), more.end());
  const test::Outcome outcome = test::run_command(words);
  fs::remove_all(folder / "asked");
  // Messages are broken into lines anywhere.
  return outcome.exit_code == 0 ? "" : std::regex_replace(outcome.err, std::regex("\\s+"), " ");
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A pkg-config that knows of nothing but these.
std::string pkg_config_of(const TemporaryFolder& folder, const std::set<std::string>& modules) {
  const fs::path known = folder / "pkgconfig";
  fs::create_directories(known);
  std::vector<std::string> open(modules.begin(), modules.end());
  for (std::size_t i = 0; i < open.size(); ++i) {
    const std::string module = open[i];
    std::string file = must_run({"pkg-config", "--variable=pcfiledir", module}).out;
    file.erase(std::remove(file.begin(), file.end(), '\n'), file.end());
    // What it requires is known, too.
    std::istringstream required(
        must_run({"pkg-config", "--print-requires", "--print-requires-private", module}).out);
    for (std::string line; std::getline(required, line);) {
      const std::string name = line.substr(0, line.find(' '));
      if (!name.empty() && std::find(open.begin(), open.end(), name) == open.end()) {
        open.push_back(name);
      }
    }
    fs::copy_file(fs::path(file) / (module + ".pc"), known / (module + ".pc"),
                  fs::copy_options::overwrite_existing);
  }
  const fs::path script = folder / "pkg-config";
  std::ofstream(script) << "#!/bin/sh\nPKG_CONFIG_LIBDIR=" << known.string() << " exec pkg-config \"$@\"\n";
  fs::permissions(script, fs::perms::owner_all);
  return "-DPKG_CONFIG_EXECUTABLE=" + script.string();
}

/// What segmentation needs, and nothing of what only pages and the program do.
Words nothing_for_pages(const TemporaryFolder& folder) {
  Words words{pkg_config_of(folder, {"gmp", "mpfr", "libwebp", "libtiff-4", "draco"})};
  for (const char* package : {"qpdf", "CLI11", "OpenMesh"}) {
    words.push_back(std::string("-DCMAKE_DISABLE_FIND_PACKAGE_") + package + "=ON");
  }
  return words;
}

/// Points and polygons of an OFF file without comments and colours, for programs that read no more.
fs::path plain_off(const TemporaryFolder& folder) {
  std::ifstream in(root / "samples/torus.off");
  std::ofstream out(folder / "plain.off");
  for (std::string line; std::getline(in, line);) {
    // Polygons of four corners, then a colour.
    const std::regex coloured(R"((4(?: \d+){4})(?: \d+)+)");
    if (!line.starts_with("#")) {
      out << std::regex_replace(line, coloured, "$1") << '\n';
    }
  }
  return folder / "plain.off";
}

}  // namespace

TEST_CASE("the code that docs show of an example is the example's", "[library]") {
  const std::regex begins("`examples/(\\w+)`:");
  std::istringstream lines(text_of(root / "docs/reference/library.md"));
  std::string line, example;
  std::set<std::string> shown;
  while (std::getline(lines, line)) {
    std::smatch match;
    if (std::regex_search(line, match, begins)) {
      example = match[1];
    } else if (!line.empty() && !line.starts_with(" ") && shown.contains(example)) {
      example.clear();
    } else if (line.starts_with("    ") && !example.empty()) {
      shown.insert(example);
      INFO(example << ": " << line);
      CHECK(text_of(root / "examples" / example / "main.cpp").find(line.substr(2) + "\n") !=
            std::string::npos);
    }
  }
  CHECK(shown == std::set<std::string>{"unfold", "job"});
}

TEST_CASE("the program that docs show is built and runs as it is there", "[library]") {
  const TemporaryFolder folder;
  install_into(folder / "installed");
  fs::create_directories(folder / "mine");
  std::istringstream lines(text_of(root / "docs/reference/library.md"));
  std::ofstream file;
  for (std::string line; std::getline(lines, line);) {
    if (line == "    cmake_minimum_required(VERSION 3.25)") {
      file.open(folder / "mine/CMakeLists.txt");
    } else if (line == "    #include <iostream>") {
      file.open(folder / "mine/main.cpp");
    } else if (!line.empty() && !line.starts_with("    ")) {
      file.close();
    }
    if (file.is_open()) {
      file << line << '\n';
    }
  }
  must_run(configure_words(folder / "mine", folder / "build", folder / "installed"));
  must_run({"cmake", "--build", (folder / "build").string()});
  CHECK(must_run({(folder / "build/mine").string()}).out == "0\n0\n0\n0\n");
}

TEST_CASE("a program that links segment finds the program's parts, without what pages need", "[library]") {
  const TemporaryFolder folder;
  const std::string example = built_example("segment", folder, nothing_for_pages(folder));
  const fs::path model = plain_off(folder);
  const json told = told_by_program(
      {"segment", model.string(), "--concavity", "0.1", "--labels", (folder / "parts.seg").string()});
  const std::string labels = must_run({example, model.string()}).out;
  CHECK(told["parts"].get<int>() > 1);
  CHECK(labels == text_of(folder / "parts.seg"));
}

TEST_CASE("a program that links unfold finds the program's nets", "[library]") {
  const TemporaryFolder folder;
  const std::string example = built_example("unfold", folder, {"-DCMAKE_DISABLE_FIND_PACKAGE_qpdf=ON"});
  for (const char* name : {"gem.stl", "heart.obj", "dinosaur.obj"}) {
    const std::string model = (root / "samples" / name).string();
    INFO(name);
    const json told = told_by_program({"unfold", model, "--whole", "--size", "100mm"});
    std::istringstream pieces(must_run({example, model}).out);
    std::size_t count = 0, face_count = 0, faces = 0;
    for (std::string piece; pieces >> piece >> faces; ++count) {
      face_count += faces;
    }
    CHECK(count == told["pieces"].get<std::size_t>());
    CHECK(face_count == told["faces"].get<std::size_t>());
  }
}

TEST_CASE("a program that links job makes the program's pages", "[library]") {
  const TemporaryFolder folder;
  const std::string example = built_example("job", folder);
  const std::string model = (root / "samples/mug.obj").string();
  const json told = told_by_program({model, "--size", "120mm", "-o", (folder / "program.pdf").string()});
  const std::string counts = must_run({example, model, (folder / "library.pdf").string()}).out;
  CHECK(counts == std::to_string(told["pieces"].get<int>()) + " pieces on " +
                      std::to_string(told["pages"].get<int>()) + " pages\n");
  must_run({"qpdf", "--check", (folder / "library.pdf").string()});
}

TEST_CASE("each installed header compiles by itself", "[library][slow]") {
  const TemporaryFolder folder;
  install_into(folder / "installed");
  const fs::path include = folder / "installed/include";
  fs::create_directories(folder / "all");
  std::ofstream project(folder / "all/CMakeLists.txt");
  project << "cmake_minimum_required(VERSION 3.25)\nproject(each LANGUAGES CXX)\n"
          << "find_package(Ridgecraft REQUIRED)\nadd_library(each OBJECT";
  std::size_t headers = 0;
  for (const auto& entry : fs::recursive_directory_iterator(include)) {
    if (entry.path().extension() == ".hpp") {
      const std::string name = std::to_string(headers++) + ".cpp";
      project << ' ' << name;
      std::ofstream(folder / "all" / fs::path(name))
          << "#include <" << entry.path().lexically_relative(include).string() << ">\n"
          << "#ifdef RIDGECRAFT_ASSERTIONS\n#error assertions reach those who link\n#endif\n";
    }
  }
  CHECK(headers > 60);
  project << ")\ntarget_link_libraries(each PRIVATE Ridgecraft::job Ridgecraft::solid)\n";
  project.close();
  must_run(configure_words(folder / "all", folder / "build", folder / "installed"));
  must_run({"cmake", "--build", (folder / "build").string()});
}

TEST_CASE("what a component lacks is told in a sentence", "[library]") {
  const TemporaryFolder folder;
  install_into(folder / "installed");
  CHECK(refusal(folder, "solid", {}).empty());
  CHECK(refusal(folder, "export", {pkg_config_of(folder, {"gmp", "mpfr", "libwebp", "libtiff-4", "draco"})})
            .find("pkg-config doesn't find cairo, which export needs") != std::string::npos);
  CHECK(refusal(folder, "hats", {}).find("hats isn't installed; there are base, mesh,") != std::string::npos);
  const test::Outcome built = test::run_command({"cmake", "-G", "Ninja", "-S", root.string(), "-B",
                                                 (folder / "hats").string(), "-DRIDGECRAFT_COMPONENTS=hats"});
  CHECK(built.exit_code != 0);
  CHECK(built.err.find("there is no hats; there are base, mesh,") != std::string::npos);
}

TEST_CASE("another project has segment as a part of it, without what pages need", "[library][slow]") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "whole");
  fs::copy_file(root / "examples/segment/main.cpp", folder / "whole/main.cpp");
  std::ofstream(folder / "whole/CMakeLists.txt")
      << "cmake_minimum_required(VERSION 3.25)\nproject(whole LANGUAGES CXX)\n"
      << "set(RIDGECRAFT_COMPONENTS segment)\nset(RIDGECRAFT_PRECOMPILED OFF)\nset(RIDGECRAFT_UNITY ON)\n"
      << "add_subdirectory(" << root.string() << " ridgecraft EXCLUDE_FROM_ALL)\n"
      << "add_executable(whole main.cpp)\ntarget_link_libraries(whole PRIVATE Ridgecraft::segment)\n";
  Words words{"cmake", "-G", "Ninja", "-S", (folder / "whole").string(), "-B", (folder / "build").string(),
              // Most of the time goes into optimising, which other tests are for.
              "-DCMAKE_BUILD_TYPE=None", "-DCMAKE_CXX_FLAGS=-O0"};
  const Words without = nothing_for_pages(folder);
  words.insert(words.end(), without.begin(), without.end());
  must_run(words);
  must_run({"cmake", "--build", (folder / "build").string(), "-j", "2"});
  CHECK_FALSE(fs::exists(folder / "build/ridgecraft/unfold"));
  const fs::path model = plain_off(folder);
  told_by_program({"segment", model.string(), "--labels", (folder / "parts.seg").string()});
  CHECK(must_run({(folder / "build/whole").string(), model.string()}).out == text_of(folder / "parts.seg"));
}

TEST_CASE("another project has unfold and job as a part of it", "[library]") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "whole");
  std::ofstream project(folder / "whole/CMakeLists.txt");
  project << "cmake_minimum_required(VERSION 3.25)\nproject(whole LANGUAGES CXX)\n"
          << "add_subdirectory(" << root.string() << " ridgecraft EXCLUDE_FROM_ALL)\n"
          << "add_compile_options(-Wall -Wextra -Wconversion -Wshadow -Werror)\n";
  for (const std::string name : {"unfold", "job"}) {
    project << "add_executable(" << name << ' ' << (root / "examples" / name / "main.cpp").string() << ")\n"
            << "target_link_libraries(" << name << " PRIVATE Ridgecraft::" << name << ")\n";
  }
  project.close();
  must_run({"cmake", "-G", "Ninja", "-S", (folder / "whole").string(), "-B", (folder / "build").string(),
            "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON"});
  // Compiled, not linked: the test before links archives that were built as a part of another project,
  // and to build all of them would take minutes.
  must_run({"cmake", "--build", (folder / "build").string(), "--target", "ridgecraft_headers"});
  std::size_t compiled = 0;
  for (const json& entry : json::parse(text_of(folder / "build/compile_commands.json"))) {
    if (entry["file"].get<std::string>().starts_with((root / "examples").string())) {
      const std::string command =
          std::regex_replace(entry["command"].get<std::string>(), std::regex(" -o \\S+ "),
                             " -o " + (folder / "main.o").string() + " ");
      must_run({"sh", "-c", command});
      ++compiled;
    }
  }
  CHECK(compiled == 2);
}
