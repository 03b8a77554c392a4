// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft verify: what it is given beside the nets, what it says of it, and its exit codes.
#include <algorithm>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/program_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft::test;
using Json = nlohmann::json;

namespace {

/// A house of 25 cm on several pages.
struct House {
  House() {
    write_bytes(folder / "house.obj", house);
    REQUIRE(run_program({"house.obj", "--size", "25cm"}, in(folder)).exit_code == 0);
    REQUIRE(std::filesystem::exists(folder / "house-2.svg"));
  }
  [[nodiscard]] Outcome verify(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"verify", "house.fold"});
    return run_program(arguments, in(folder));
  }
  /// Other files of the same model.
  [[nodiscard]] Outcome run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"house.obj", "--size", "25cm"});
    return run_program(arguments, in(folder));
  }
  TemporaryFolder folder;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("verify counts the folds that have a line as the job does", "[verify]") {
  const TemporaryFolder folder;
  const std::string whale = RIDGECRAFT_SOURCE_DIR "/samples/whale.obj";
  const Json job = Json::parse(run_program({whale, "--json", "-o", folder.path().string()}, in(folder)).out);
  const Json report = Json::parse(run_program({"verify", "whale.fold", "--json"}, in(folder)).out);
  const double all = report.at("fold_mm");
  const double unlined = report.at("unlined_fold_mm");
  CHECK(unlined > 1.0);
  // A stretch that lies on another one is drawn once.
  CHECK(all - unlined == Approx(job.at("fold_mm").get<double>()).epsilon(1e-3));
  const Outcome text = run_program({"verify", "whale.fold"}, in(folder));
  CHECK(text.out.find(" too flat for a line)") != std::string::npos);
}

TEST_CASE("verify holds the nets against their model and their pages", "[verify]") {
  const House house;
  const Outcome outcome =
      house.verify({"--model", "house.obj", "--pages", "house-2.svg", "house-1.svg", "house.pdf"});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.find("  model       at most ") != std::string::npos);
  CHECK(outcome.out.find("  printed     ") != std::string::npos);
  CHECK(outcome.out.find("no faults") != std::string::npos);
  const Json all = Json::parse(house.verify({"--pages", "house.svg", "--json"}).out);
  CHECK(all.at("faults").empty());
  CHECK(all.at("printed").at("pages").get<int>() >= 2);
  CHECK(all.at("printed").at("pages_not_given") == 0);
  const Outcome one = house.verify({"--pages", "house-1.svg", "--json"});
  const Json json = Json::parse(one.out);
  CHECK(one.exit_code == 0);
  CHECK(json.at("printed").at("pages") == 1);
  CHECK(json.at("printed").at("pages_not_given").get<int>() >= 1);
  CHECK_FALSE(json.contains("against_model"));
  const Json plain = Json::parse(house.verify({"--json"}).out);
  CHECK_FALSE(plain.contains("printed"));
  CHECK(plain.at("pieces_to_fold_with_care").empty());
}

TEST_CASE("verify finds what is wrong about pages and model, with exit code 6", "[verify]") {
  const House house;
  const std::string svg = read_bytes(house.folder / "house-1.svg");
  // The first point of the first outline, 0.05 mm to the side.
  const std::size_t cut = svg.find("id=\"cut-piece");
  const std::size_t path = svg.find(" d=\"M", cut) + 5;
  const std::string x = svg.substr(path, svg.find(',', path) - path);
  std::string moved = svg;
  moved.replace(path, x.size(), std::to_string(std::stod(x) + 0.05));
  write_bytes(house.folder / "moved.svg", moved);
  const Outcome outcome = house.verify({"--pages", "moved.svg"});
  CHECK(outcome.exit_code == 6);
  CHECK(outcome.out.find("fault of promise 10: moved.svg has ") != std::string::npos);
  write_bytes(house.folder / "scaled.svg", replaced(svg, "width=\"210mm\"", "width=\"208mm\""));
  CHECK(house.verify({"--pages", "scaled.svg"}).exit_code == 6);
  write_bytes(house.folder / "half.svg", svg.substr(0, svg.size() / 2));
  const Outcome half = house.verify({"--pages", "half.svg"});
  CHECK(half.exit_code == 6);
  CHECK(half.out.find("half.svg can't be checked") != std::string::npos);

  write_bytes(house.folder / "other.obj",
              replaced(read_bytes(house.folder / "house.obj"), "v 2 5 6", "v 2 5 7"));
  const Outcome other = house.verify({"--model", "other.obj"});
  CHECK(other.exit_code == 6);
  CHECK(other.out.find("fault of promise 9: ") != std::string::npos);
  CHECK(other.out.find("isn't the one that the nets name") != std::string::npos);
}

TEST_CASE("many faults of one cause are told in a few lines", "[verify]") {
  const House house;
  // Pages of another size: hardly a line is at its place.
  REQUIRE(run_program({"house.obj", "--size", "24cm", "-o", "other"}, in(house.folder)).exit_code == 0);
  const Outcome outcome = house.verify({"--pages", "other/house.pdf"});
  INFO(outcome.out);
  CHECK(outcome.exit_code == 6);
  CHECK(outcome.out.find("off their places") == std::string::npos);
  const Json json = Json::parse(house.verify({"--pages", "other/house.pdf", "--json"}).out);
  const auto faults = json.at("faults").size();
  REQUIRE(faults > 6);
  CHECK(json.at("printed").at("faulty") == faults);
  CHECK(outcome.out.find(", " + std::to_string(faults) + " faults\n") != std::string::npos);
  const std::string end =
      "and " + std::to_string(faults - 5) + " more faults of promise 10; --json lists them\n";
  CHECK(outcome.out.ends_with(end));
  std::size_t told = 0;
  for (std::size_t at = outcome.out.find("fault of promise 10: "); at != std::string::npos;
       at = outcome.out.find("fault of promise 10: ", at + 1)) {
    ++told;
  }
  CHECK(told == 5);
}

TEST_CASE("verify refuses what are no pages and no model, in one sentence", "[verify]") {
  const House house;
  write_bytes(house.folder / "page.png", "\x89PNG\r\n\x1a\n");
  check_refusal(house.verify({"--pages", "page.png"}), 3, "page.png is in no format of pages");
  check_refusal(house.verify({"--pages", "missing.svg"}), 3, "missing.svg");
  check_refusal(house.verify({"--model", "missing.obj"}), 3, "missing.obj");
  check_refusal(house.verify({"--pages"}), 2, "--pages");
}

TEST_CASE("verify refuses pages of machines and board, and finds it wrong where none show nets",
          "[verify][slow]") {
  const House house;
  REQUIRE(house.run({"--preset", "laser", "-o", "laser.svg"}).exit_code == 0);
  REQUIRE(house.run({"--preset", "packaging", "-o", "shop.pdf"}).exit_code == 0);
  REQUIRE(house.run({"--preset", "origami-simulator", "-o", "fold.svg"}).exit_code == 0);
  REQUIRE(house.run({"--thickness", "1mm", "-o", "board.pdf", "-o", "board.svg"}).exit_code == 0);
  check_refusal(house.verify({"--pages", "laser-1.svg"}), 3, "laser-1.svg was made with --preset laser");
  check_refusal(house.verify({"--pages", "shop.pdf"}), 3, "shop.pdf was made with --preset packaging");
  check_refusal(house.verify({"--pages", "fold-1.svg"}), 3, "made with --preset origami-simulator");
  check_refusal(house.verify({"--pages", "board.pdf"}), 3, "board.pdf was made with --thickness 1mm");
  check_refusal(house.verify({"--pages", "house-1.svg", "board-1.svg"}), 3, "board-1.svg was made with");

  const Outcome guide = house.verify({"--pages", "house-guide.pdf"});
  CHECK(guide.exit_code == 6);
  CHECK(guide.out.find("house-guide.pdf is a guide, which shows no page of the nets") != std::string::npos);
  CHECK(guide.out.find("no faults") == std::string::npos);
  CHECK(house.verify({"--pages", "house.pdf", "house-guide.pdf"}).exit_code == 0);
}
