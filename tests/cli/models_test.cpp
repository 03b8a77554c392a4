// SPDX-License-Identifier: GPL-3.0-or-later
// The main job on real models: the samples, what makers build, and the broken files of the world. Every file
// that comes out is judged by checkers that share no code with the program.
#include <fstream>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "support/program.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft::test;
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

const fs::path shared = RIDGECRAFT_SHARED_DIR;
constexpr const char* python = "/usr/bin/python3";

bool checkers_missing() {
  if (fs::exists(shared / "check/check_nets.py") && fs::exists(python)) {
    return false;
  }
  WARN("skipped: the independent checkers aren't here");
  return true;
}

bool is_model(const fs::path& file) {
  const std::string suffix = file.extension().string();
  return suffix == ".obj" || suffix == ".stl" || suffix == ".ply" || suffix == ".off";
}

std::vector<fs::path> models_in(const fs::path& folder) {
  std::vector<fs::path> models;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (is_model(entry.path())) {
      models.push_back(entry.path());
    }
  }
  std::sort(models.begin(), models.end());
  return models;
}

/// Our own verdict and both independent ones on all that a run left in a folder.
void check_files(const TemporaryFolder& folder) {
  std::vector<std::string> pages{python, (shared / "check/check_svg.py").string()};
  std::size_t folds = 0;
  for (const std::string& name : folder.names()) {
    const std::string file = (folder / name).string();
    if (name.ends_with(".fold")) {
      ++folds;
      const Outcome own = run_program({"verify", file, "--json"});
      CHECK(own.exit_code == 0);
      CHECK((own.exit_code != 0 || Json::parse(own.out)["thin_necks"] == 0));
      if (!checkers_missing()) {
        const Outcome other =
            run_command({python, (shared / "check/check_nets.py").string(), file, "--json"});
        INFO(other.out.substr(0, 2000));
        CHECK(other.exit_code == 0);
      }
    } else if (name.ends_with(".svg")) {
      pages.push_back(file);
    }
  }
  CHECK(folds == 1);
  CHECK(pages.size() > 2);
  if (!checkers_missing()) {
    const Outcome svg = run_command(pages);
    INFO(svg.out.substr(0, 2000));
    CHECK(svg.exit_code == 0);
  }
}

void check_models(const fs::path& models) {
  for (const fs::path& model : models_in(models)) {
    CAPTURE(model.filename());
    const TemporaryFolder folder;
    const Outcome outcome = run_program({model.string(), "-o", folder.path().string(), "--json"});
    INFO(outcome.err);
    CHECK(outcome.exit_code == 0);
    if (outcome.exit_code == 0) {
      const Json json = Json::parse(outcome.out);
      CHECK(json["pieces"].get<std::size_t>() >= 1);
      CHECK(json["joins_without_tab"].get<std::size_t>() <= json["joins"].get<std::size_t>());
      check_files(folder);
    }
  }
}

struct Case {
  std::string file, what, reaction;
  int exit_code = 0;
};

/// CASES.tsv: file, what is wrong, proposed reaction, exit code, reason.
std::vector<Case> read_cases(const fs::path& table) {
  std::vector<Case> cases;
  std::ifstream in(table);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    Case c;
    std::string code;
    std::getline(fields, c.file, '\t');
    std::getline(fields, c.what, '\t');
    std::getline(fields, c.reaction, '\t');
    std::getline(fields, code, '\t');
    c.exit_code = std::stoi(code);
    cases.push_back(c);
  }
  return cases;
}

/// Where nobody could build it, --strict would refuse it.
Outcome check_can_be_built(const fs::path& model, const std::vector<std::string>& options) {
  const TemporaryFolder folder;
  std::vector<std::string> words = {model.string(), "--strict", "-o", (folder.path() / "nets.fold").string()};
  words.insert(words.end(), options.begin(), options.end());
  Outcome outcome = run_program(words);
  INFO(outcome.out << outcome.err);
  CHECK(outcome.exit_code == 0);
  return outcome;
}

}  // namespace

TEST_CASE("every sample becomes paper that three checkers accept", "[models][slow]") {
  check_models(fs::path(RIDGECRAFT_SOURCE_DIR) / "samples");
}

TEST_CASE("every model that makers build becomes paper that three checkers accept", "[models][slow]") {
  if (!fs::exists(shared / "models/makers")) {
    WARN("skipped: the makers' models aren't here");
    return;
  }
  check_models(shared / "models/makers");
}

TEST_CASE("walls keep more triangles only where they can be folded", "[models][slow]") {
  const fs::path house = shared / "models/makers/house.obj";
  if (!fs::exists(house)) {
    WARN("skipped: the makers' models aren't here");
    return;
  }
  // Its walls are simple, its windows too small: with all triangles that walls may keep, every eighth fold
  // is shorter than 3 mm.
  for (const std::vector<std::string>& size : {std::vector<std::string>{}, {"--size", "150mm"}}) {
    check_can_be_built(house, size);
  }
}

TEST_CASE("a lamp loses details together, at each size and to each number of faces", "[models][slow]") {
  const fs::path archive = shared / "models/wild.tar.xz";
  if (!fs::exists(archive)) {
    WARN("skipped: the models of all kinds aren't here");
    return;
  }
  const TemporaryFolder folder;
  const fs::path lamp = folder.path() / "wild/v_hacd__lamp.obj";
  REQUIRE(std::system(
              ("tar xJf '" + archive.string() + "' -C '" + folder.path().string() + "' wild/v_hacd__lamp.obj")
                  .c_str()) == 0);
  // At 250 mm some of its folds are as long as they have to be while others stay short: as coarse as it is at
  // 150 mm it can be folded. Collapses alone leave more than a thousand faces of it, for it has holes.
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--size", "250mm"},
                                                {"--size", "150mm", "--without", "globes"},
                                                {"--faces", "250"}}) {
    const Outcome outcome = check_can_be_built(lamp, words);
    CHECK(outcome.out.find("rather than") == std::string::npos);
  }
}

TEST_CASE("every broken file gets its documented exit code", "[models][slow]") {
  const fs::path broken = shared / "models/broken/generated";
  if (!fs::exists(broken / "CASES.tsv")) {
    WARN("skipped: the broken models aren't here");
    return;
  }
  for (const Case& c : read_cases(broken / "CASES.tsv")) {
    CAPTURE(c.file, c.what, c.reaction);
    const TemporaryFolder folder;
    const Outcome outcome = run_program({(broken / c.file).string(), "-v", "-o", folder.path().string()});
    INFO(outcome.err);
    CHECK_FALSE(outcome.by_signal);
    CHECK(outcome.exit_code == c.exit_code);
    if (outcome.exit_code == 0) {
      check_files(folder);
      if (c.reaction.starts_with("repaired")) {
        // What was done is told in a row of the summary of its own, or in a note.
        const bool told = outcome.out.find("\n  simplified  ") != std::string::npos ||
                          outcome.out.find("\n  thin walls  ") != std::string::npos;
        CHECK((told || outcome.err.find("note: ") != std::string::npos));
      }
    } else {
      CHECK(folder.names().empty());
      CHECK(outcome.err.starts_with("ridgecraft: "));
      CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    }
  }
}

TEST_CASE("a run is the same, byte for byte, with one thread and with two", "[models][slow]") {
  for (const char* sample : {"whale.obj", "mug.obj", "vase.ply"}) {
    CAPTURE(sample);
    const std::string model = (fs::path(RIDGECRAFT_SOURCE_DIR) / "samples" / sample).string();
    const TemporaryFolder one;
    const TemporaryFolder two;
    REQUIRE(run_program({model, "-o", one.path().string(), "--threads", "1"}).exit_code == 0);
    REQUIRE(run_program({model, "-o", two.path().string(), "--threads", "2"}).exit_code == 0);
    REQUIRE(one.names() == two.names());
    for (const std::string& name : one.names()) {
      CAPTURE(name);
      CHECK(read_bytes(one / name) == read_bytes(two / name));
    }
  }
}
