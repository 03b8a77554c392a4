// SPDX-License-Identifier: GPL-3.0-or-later
// Models of makers, and files that are broken in every way known, on their way to paper.
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.hpp"
#include "mesh/mesh.hpp"
#include "mesh/shared_models.hpp"
#include "prepare/prepare.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using test::shared_models;

namespace {

struct Outcome {
  int code = 0;
  bool changed = false;
  bool simplified = false;
  std::string message;
};

Outcome run(const std::filesystem::path& file) {
  Outcome outcome;
  try {
    const prepare::Prepared p = prepare::prepare(mesh::read(file, {}, {}), {}, {}, {{190.0, 270.0}}, {});
    test::check_invariants(p.model.surface);
    for (const mesh::Repair& repair : p.model.repairs.entries()) {
      // An open border and faces that run through each other are told, but nothing is done about them.
      outcome.changed = outcome.changed || (repair.kind != mesh::RepairKind::open_border &&
                                            repair.kind != mesh::RepairKind::self_intersections);
    }
    outcome.simplified = p.simplified.deviation_mm > 0.0;
    const Vec3 size = p.model.surface.bounds().size();
    CHECK(std::isfinite(length(size)));
    CHECK(std::max({size.x, size.y, size.z}) < 156.1);
  } catch (const Error& error) {
    outcome.message = error.what();
    outcome.code = error.kind() == ErrorKind::unreadable_input ? 3
                   : error.kind() == ErrorKind::unusable_mesh  ? 4
                   : error.kind() == ErrorKind::no_nets        ? 5
                                                               : 1;
  }
  return outcome;
}

}  // namespace

TEST_CASE("broken files are repaired or refused as documented", "[cases]") {
  const std::filesystem::path folder = shared_models / "broken" / "generated";
  std::ifstream table(folder / "CASES.tsv");
  if (!table) {
    WARN("no broken models here: " << folder.string());
    return;
  }
  std::string line;
  std::getline(table, line);
  int cases = 0;
  while (std::getline(table, line)) {
    std::istringstream fields(line);
    std::string file;
    std::string what;
    std::string reaction;
    std::string code;
    std::getline(fields, file, '\t');
    std::getline(fields, what, '\t');
    std::getline(fields, reaction, '\t');
    std::getline(fields, code, '\t');
    INFO(file << ": " << what);
    const Outcome outcome = run(folder / file);
    INFO(outcome.message);
    CHECK(outcome.code == std::stoi(code));
    if (reaction == "repaired+warning" && outcome.code == 0) {
      // Simplification mends what is too fine to be folded.
      CHECK((outcome.changed || outcome.simplified));
    }
    if (reaction == "ok") {
      // docs/design/mesh.md: ignored elements, unused points and bent polygons are told, though nothing is
      // wrong.
      const bool remarked =
          file == "other_elements.obj" || file == "hard_monkey_saddle.obj" || file == "points_unused.obj";
      CHECK((!outcome.changed || remarked));
    }
    if (outcome.code == 3 || outcome.code == 4) {
      CHECK(outcome.message.find(file) != std::string::npos);
    }
    ++cases;
  }
  CHECK(cases > 150);
}

TEST_CASE("models of makers become foldable", "[cases]") {
  if (!std::filesystem::exists(shared_models / "makers")) {
    WARN("no makers' models here");
    return;
  }
  for (const auto& entry : std::filesystem::directory_iterator(shared_models / "makers")) {
    const std::string suffix = entry.path().extension().string();
    if (suffix == ".obj" || suffix == ".stl" || suffix == ".ply" || suffix == ".off") {
      INFO(entry.path().string());
      CHECK(run(entry.path()).code == 0);
    }
  }
}
