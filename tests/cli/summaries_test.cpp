// SPDX-License-Identifier: GPL-3.0-or-later
// What people and machines are told about a job.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/program_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft::test;
namespace fs = std::filesystem;
using Json = nlohmann::json;

TEST_CASE("what is told of tabs agrees with itself where not all are usable", "[summaries]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  // At this size some edges are too short for more than a stub.
  for (const std::vector<std::string>& verb :
       {std::vector<std::string>{}, std::vector<std::string>{"unfold"}}) {
    std::vector<std::string> arguments = verb;
    arguments.insert(arguments.end(), {"house.obj", "--size", "4mm", "--all-tabs", "-v", "-o", "x.fold"});
    const Outcome text = run_program(arguments, in(folder));
    CAPTURE(text.out);
    arguments.emplace_back("--json");
    const Json json = Json::parse(run_program(arguments, in(folder)).out);
    const auto told = [&](const char* key) { return std::to_string(json[key].get<int>()); };
    CHECK(json["tabs"].get<int>() + json["joins_without_tab"].get<int>() == json["joins"].get<int>());
    CHECK(json["tabs_usable"].get<int>() + json["joins_too_narrow"].get<int>() == json["joins"].get<int>());
    CHECK(json["joins_too_narrow"] > 0);
    CHECK(text.out.find("  tabs        " + told("tabs") + " for " + told("joins") + " joins, " +
                        told("tabs_usable") + " of them usable (the others are smaller than holds well)") !=
          std::string::npos);
    CHECK(text.out.find(
              told("joins_too_narrow") +
              (json["joins_too_narrow"] == 1
                   ? " edge is too short, or the faces behind it too narrow, for a tab that holds\n"
                   : " edges are too short, or the faces behind them too narrow, for a tab that holds\n")) !=
          std::string::npos);
  }
  std::vector<std::string> large{"house.obj", "--size", "8cm", "-v", "-o", "x.fold"};
  const std::string text = run_program(large, in(folder)).out;
  large.emplace_back("--json");
  const std::string joins =
      std::to_string(Json::parse(run_program(large, in(folder)).out)["joins"].get<int>());
  CHECK(text.find("  tabs        " + joins + " for " + joins + " joins\n") != std::string::npos);
}

TEST_CASE("machines get one JSON object with the names that they know", "[summaries]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  const Outcome outcome = run_program({"house.obj", "--size", "8cm", "--json", "-o", "out"}, in(folder));
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.err.empty());
  const Json json = Json::parse(outcome.out);
  for (const char* key : {"faces", "parts", "pieces", "pages", "size_mm", "tabs", "joins",
                          "joins_without_tab", "cut_mm", "fold_mm", "seconds", "repairs", "files"}) {
    CAPTURE(key);
    CHECK(json.contains(key));
  }
  CHECK(json["size_mm"].size() == 3);
  CHECK(json["size_mm"][2].get<double>() == Approx(80.0));
  CHECK(json["files"].size() == 5);
  CHECK(fs::exists(folder / "out/house.fold"));

  const Json verified = Json::parse(run_program({"verify", "out/house.fold", "--json"}, in(folder)).out);
  CHECK(verified["faults"].empty());
  CHECK(verified["faces"] == json["faces"]);
  CHECK(verified["cut_mm"].get<double>() == Approx(json["cut_mm"].get<double>()));

  const Json parts =
      Json::parse(run_program({"segment", "house.obj", "--labels", "h.seg", "--json"}, in(folder)).out);
  CHECK(parts["parts"] == 1);
  CHECK(parts["max_concavity"].get<double>() <= 0.1);
  CHECK(parts.contains("seconds"));
  CHECK(read_bytes(folder / "h.seg") == "0\n0\n0\n0\n0\n0\n0\n");

  const Json nets =
      Json::parse(run_program({"unfold", "house.obj", "--whole", "-o", "h.fold", "--json"}, in(folder)).out);
  CHECK(nets["pieces"] == 1);
  CHECK(nets["overlaps"] == 0);
  CHECK(nets.contains("seconds"));
}

TEST_CASE("hundreds of pages are announced, with a size that needs few", "[summaries][slow]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  const auto pages = [&](const Outcome& outcome) {
    REQUIRE(outcome.exit_code == 0);
    return Json::parse(outcome.out)["pages"].get<double>();
  };
  const Outcome large = run_program({"house.obj", "--size", "1500mm", "--json", "-o", "h.fold"}, in(folder));
  INFO(large.err);
  REQUIRE(large.err.starts_with("note: this takes about "));
  CHECK(std::stod(large.err.substr(23)) == Approx(pages(large)).epsilon(0.35));
  const std::size_t at = large.err.find("--size ");
  REQUIRE(at != std::string::npos);
  const std::string size = large.err.substr(at + 7, large.err.find("mm", at) + 2 - at - 7);
  const Outcome small = run_program({"house.obj", "--size", size, "--json", "-o", "h.fold"}, in(folder));
  CHECK(small.err.empty());
  CHECK(pages(small) <= 20.0);
  CHECK(pages(small) >= 4.0);
}

TEST_CASE("more pages than a person would print are refused before the long work", "[summaries]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  const Outcome outcome = run_program({"house.obj", "--size", "10m"}, in(folder));
  check_refusal(outcome, 2, "house.obj: at 10 m the model takes about ");
  CHECK(outcome.err.find("--most-pages") != std::string::npos);
  CHECK(folder.names() == std::set<std::string>{"house.obj"});
  check_refusal(run_program({"house.obj", "--size", "40cm", "--most-pages", "0"}, in(folder)), 2,
                "--most-pages");
  // The limit is the user's.
  CHECK(run_program({"house.obj", "--size", "1500mm", "--most-pages", "100", "-o", "h.fold"}, in(folder))
            .exit_code == 2);
}

TEST_CASE("thousands of separate bodies are refused before the long work, and unfolded without pages",
          "[summaries][slow]") {
  const TemporaryFolder folder;
  std::string off = "OFF\n32400 32400 0\n";
  for (int i = 0; i < 8100; ++i) {
    const int x = 2 * (i % 90);
    const int y = 2 * (i / 90);
    off += fmt::format("{0} {1} 0\n{2} {1} 0\n{0} {3} 0\n{0} {1} 1\n", x, y, x + 1, y + 1);
  }
  for (int i = 0; i < 32400; i += 4) {
    off +=
        fmt::format("3 {0} {2} {1}\n3 {0} {1} {3}\n3 {0} {3} {2}\n3 {1} {2} {3}\n", i, i + 1, i + 2, i + 3);
  }
  write_bytes(folder / "dust.off", off);
  const Outcome outcome = run_program({"dust.off", "--most-pages", "100", "-o", "dust.pdf"}, in(folder));
  check_refusal(outcome, 2, "dust.off: the model has 8100 separate bodies, which take about 100 pages");
  CHECK(folder.names() == std::set<std::string>{"dust.off"});
  const Outcome nets = run_program({"unfold", "dust.off", "-o", "dust.fold"}, in(folder));
  CHECK(nets.exit_code == 0);
  CHECK(nets.out.find("8100") != std::string::npos);
}

TEST_CASE("faces too thin for a knife are counted, loose bodies listed", "[summaries]") {
  const TemporaryFolder folder;
  // A bar of 100 x 0.5 x 20 with closed ends, and a triangle that stands beside it.
  write_bytes(folder / "bar.obj",
              "v 0 0 0\nv 100 0 0\nv 100 0.5 0\nv 0 0.5 0\nv 0 0 20\nv 100 0 20\nv 100 0.5 20\nv 0 0.5 20\n"
              "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
              "v 20 5 0\nv 60 5 0\nv 40 5 15\nf 9 10 11\n");
  const Outcome outcome =
      run_program({"bar.obj", "--size", "100mm", "--faces", "keep", "--json", "-o", "b.fold"}, in(folder));
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const Json json = Json::parse(outcome.out);
  CHECK(json["slivers"] == 8);  // four sides of two triangles
  REQUIRE(json["bodies"].size() == 2);
  std::size_t pieces = 0;
  for (const Json& body : json["bodies"]) {
    pieces += body["pieces"].size();
    CHECK(body["distance_mm"].get<double>() == Approx(4.5));
  }
  CHECK(pieces == json["pieces"].get<std::size_t>());
  const Outcome text =
      run_program({"bar.obj", "--size", "100mm", "--faces", "keep", "-v", "-o", "b.fold"}, in(folder));
  CHECK(text.out.find("slivers     8 faces narrower than 1 mm") != std::string::npos);
  CHECK(text.out.find("bodies      2 that no tab joins") != std::string::npos);
}

TEST_CASE("nothing that stands in a name or a file commands the terminal", "[summaries][slow]") {
  const TemporaryFolder folder;
  const std::string name =
      "a\x1b[31m\xc2\x9b"
      "31m.obj";
  write_bytes(folder / name, house);
  const auto check_harmless = [](const Outcome& outcome) {
    for (const std::string& text : {outcome.out, outcome.err}) {
      CAPTURE(text);
      CHECK(text.find('\x1b') == std::string::npos);
      CHECK(text.find("\xc2\x9b") == std::string::npos);
    }
  };
  for (const char* verb : {"info", "segment", "unfold"}) {
    check_harmless(run_program({verb, name}, in(folder)));
  }
  const Outcome made = run_program({name}, in(folder));
  check_harmless(made);
  CHECK(made.out.find("a\xef\xbf\xbd[31m") != std::string::npos);
  check_harmless(run_program({name, "--size", "1500mm", "-o", "x.fold"}, in(folder)));
  check_harmless(run_program({"hulls", name, "-o", "x.obj"}, in(folder)));
  check_harmless(run_program({name + "x"}, in(folder)));
  check_harmless(run_program({"verify", name}, in(folder)));
  check_harmless(run_program({"a\x1b[31m", "b", "c"}, in(folder)));
  // The names of pieces come from a file, too.
  REQUIRE(run_program({name, "-o", "x.fold", "--overwrite"}, in(folder)).exit_code == 0);
  Json file = Json::parse(read_bytes(folder / "x.fold"));
  file["ridgecraft:pieces"][0]["reason"] = "a\x1b[31m";
  write_bytes(folder / "x.fold", file.dump());
  const Outcome verified = run_program({"verify", "x.fold"}, in(folder));
  CHECK(verified.exit_code == 6);
  CHECK(verified.out.find('\x1b') == std::string::npos);
}

TEST_CASE("what a maker may want to change is said before the work", "[summaries][slow]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  const auto told = [&](std::vector<std::string> options) {
    options.insert(options.begin(), "house.obj");
    options.insert(options.end(), {"-v", "-o", "x.fold"});
    const Outcome outcome = run_program(options, in(folder));
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return outcome;
  };
  CHECK(told({}).err.empty());
  const Outcome small = told({"--size", "2mm"});
  REQUIRE(small.err.find("too short for fingers; --size ") != std::string::npos);
  const std::string size = small.err.substr(small.err.find("--size ") + 7);
  CHECK(told({"--size", size.substr(0, size.find("mm") + 2)}).err.empty());
  CHECK(told({"--margin", "0"}).err.find("margin of 0 mm") != std::string::npos);
  CHECK(told({"--margin", "3mm"}).err.empty());
  CHECK(told({"--tab-height", "3cm", "--size", "40mm"}).out.find("lower than 30 mm") != std::string::npos);
  CHECK(told({"--size", "40mm"}).out.find("lower than") == std::string::npos);
}

TEST_CASE("numbers in lists are told by their pieces", "[summaries]") {
  const TemporaryFolder folder;
  const Json json = Json::parse(
      run_program({RIDGECRAFT_SOURCE_DIR "/samples/penguin.obj", "--size", "3mm", "--json", "-o", "x.fold"},
                  in(folder))
          .out);
  REQUIRE_FALSE(json["numbers_in_lists"].empty());
  CHECK(json["labels_listed"] == json["numbers_in_lists"].size());
  CHECK(json["labels_left_out"] == 0);
  const Json fold = Json::parse(read_bytes(folder / "x.fold"));
  for (const Json& lost : json["numbers_in_lists"]) {
    const auto& pieces = fold["ridgecraft:pieces"];
    const auto& joins = fold["ridgecraft:joins"];
    CHECK(
        std::any_of(pieces.begin(), pieces.end(), [&](const Json& p) { return p["name"] == lost["piece"]; }));
    CHECK(std::any_of(joins.begin(), joins.end(),
                      [&](const Json& j) { return j["number"] == lost["number"]; }));
  }
}

TEST_CASE("pieces are split where all tabs are asked for, and it is told", "[summary]") {
  // A sheet of six squares with two low tips: a cut that ends at a tip hardly opens.
  const TemporaryFolder folder;
  write_bytes(folder / "tips.obj",
              "v 0 0 0\nv 15 0 0\nv 30 0 0\nv 45 0 0\nv 0 15 0\nv 15 15 4\nv 30 15 3\nv 45 15 0\n"
              "v 0 30 0\nv 15 30 0\nv 30 30 0\nv 45 30 0\n"
              "f 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\nf 3 4 8\nf 3 8 7\n"
              "f 5 6 10\nf 5 10 9\nf 6 7 11\nf 6 11 10\nf 7 8 12\nf 7 12 11\n");
  const auto figures = [&](std::vector<std::string> all) {
    for (const char* word : {"--size", "45mm", "--faces", "keep", "--json", "--overwrite"}) {
      all.emplace_back(word);
    }
    const Outcome outcome = run_program(all, in(folder));
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return Json::parse(outcome.out);
  };
  const Json whole = figures({"unfold", "tips.obj", "--whole", "--tabs", "-o", "a.fold"});
  CHECK(whole["pieces"] == 1);
  CHECK(whole["tabs_usable"] < whole["joins"]);
  for (const Json& split : {figures({"unfold", "tips.obj", "--whole", "--all-tabs", "-o", "b.fold"}),
                            figures({"tips.obj", "--concavity", "1", "--all-tabs", "-o", "b.fold"})}) {
    CHECK(split["pieces"] == 2);
    CHECK(split["joins_too_narrow"] == 0);
    CHECK(split["tabs_usable"] == split["joins"]);
    CHECK(split["notes"].back()["text"] == "1 piece was split off for tabs");
    CHECK(run_program({"verify", "b.fold"}, in(folder)).exit_code == 0);
    const Json fold = Json::parse(read_bytes(folder / "b.fold"));
    CHECK(fold["ridgecraft:pieces"][1]["reason"] == "tabs");
    CHECK(fold.dump().find("\"all_tabs\":true") != std::string::npos);
  }
  check_refusal(run_program({"tips.obj", "--all-tabs", "--no-tabs"}, in(folder)), 2, "--tabs none");
}

TEST_CASE("pieces that have to fold by themselves are split until they do, and it is told", "[summary]") {
  // A strip bent into a seam as cans have it, each edge inside the other: in one piece it can't be folded.
  const TemporaryFolder folder;
  const std::vector<std::array<double, 2>> seam{{40, 103},   {70, 103},  {70, 100},    {0, 100},
                                                {0, 0},      {100, 0},   {100, 104.5}, {38, 104.5},
                                                {38, 101.5}, {67, 101.5}};
  std::string obj;
  for (const auto& [x, y] : seam) {
    obj += fmt::format("v {} {} 0\nv {} {} 30\n", x, y, x, y);
  }
  for (std::size_t i = 0; i + 1 < seam.size(); ++i) {
    obj += fmt::format("f {} {} {} {}\n", 2 * i + 1, 2 * i + 3, 2 * i + 4, 2 * i + 2);
  }
  write_bytes(folder / "seam.obj", obj);
  const auto run = [&](std::vector<std::string> all) {
    for (const char* word : {"--scale", "1", "--unit", "mm", "--faces", "keep", "-v", "--overwrite"}) {
      all.emplace_back(word);
    }
    const Outcome outcome = run_program(all, in(folder));
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return outcome.out;
  };
  const std::vector<std::string> paper{"seam.obj", "--paper", "A2", "--concavity", "2", "-o", "a.fold"};
  std::vector<std::string> few = paper;
  few.insert(few.end(), {"--pieces", "few"});
  const std::string text = run(few);
  CHECK(text.find("no order was found in which no face is in another's way") != std::string::npos);
  CHECK(text.find("of the FOLD file)") != std::string::npos);
  std::vector<std::string> linear = paper;
  linear.emplace_back("--fold-linear");
  CHECK(run(linear).find("wouldn't fold up with all creases together (--fold-linear)") != std::string::npos);
  for (const std::vector<std::string>& job :
       {linear, {"unfold", "seam.obj", "--whole", "--fold-linear", "-o", "a.fold"}}) {
    std::vector<std::string> with_json = job;
    with_json.emplace_back("--json");
    const Json json = Json::parse(run(with_json));
    CHECK(json["pieces"] == 2);
    CHECK(json["pieces_to_fold_with_care"].empty());
    CHECK(json["notes"].back()["text"] ==
          "1 piece was split off so that all fold up with all creases together");
    const Json fold = Json::parse(read_bytes(folder / "a.fold"));
    CHECK(fold["ridgecraft:settings"]["fold_linear"] == true);
    CHECK(fold["ridgecraft:pieces"][1]["reason"] == "request");
    for (const Json& steps : fold["ridgecraft:fold_order"]) {
      CHECK(steps.size() <= 1);
    }
    CHECK(run_program({"verify", "a.fold"}, in(folder)).exit_code == 0);
  }
}

TEST_CASE("of numbers without room it is told where they stand, if that is anywhere", "[summaries]") {
  const TemporaryFolder folder;
  const auto run = [&](std::vector<std::string> words) {
    words.insert(words.begin(),
                 {RIDGECRAFT_SOURCE_DIR "/samples/penguin.obj", "--size", "30mm", "--faces", "keep"});
    const Outcome outcome = run_program(words, in(folder));
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return outcome.out;
  };
  const std::string lists = "numbers had no room at their edges and stand in lists";
  const std::string nowhere = "numbers had no room at their edges and aren't in the machine's files";
  CHECK(run({"-o", "a.pdf"}).find(lists) != std::string::npos);
  CHECK(run({"--preset", "lightburn", "-o", "b.svg"}).find(nowhere) != std::string::npos);
  CHECK(run({"--preset", "lightburn", "-o", "c.svg", "-o", "c.pdf"}).find(lists) != std::string::npos);
  CHECK(run({"--preset", "silhouette", "--print-and-cut", "-o", "d"}).find(lists) != std::string::npos);
  CHECK(run({"--preset", "silhouette", "-o", "e.svg"}).find("numbers had no room") == std::string::npos);
}

TEST_CASE("bodies that became one are told, and kept where that is asked for", "[summaries][slow]") {
  const TemporaryFolder folder;
  std::string obj;
  for (int body = 0; body < 2; ++body) {
    for (int i = 0; i < 8; ++i) {
      obj += fmt::format("v {} {} {}\n", 2 * (i % 2) + body, 2 * (i / 2 % 2) + body, 2 * (i / 4) + body);
    }
    for (const auto& q : std::vector<std::array<int, 4>>{
             {0, 2, 3, 1}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}, {4, 5, 7, 6}}) {
      obj += fmt::format("f {} {} {} {}\n", q[0] - 8, q[1] - 8, q[2] - 8, q[3] - 8);
    }
  }
  write_bytes(folder / "cross.obj", obj);
  const auto run = [&](std::vector<std::string> all) {
    all.insert(all.begin(), {"cross.obj", "--overwrite", "-o", "a.fold"});
    all.emplace_back("-v");
    const Outcome outcome = run_program(all, in(folder));
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return outcome.out;
  };
  CHECK(
      run({}).find("2 bodies into 1; 12 % of their area was hidden, with 0 whole faces (--keep-bodies leaves "
                   "them)\n") != std::string::npos);
  const Json one = Json::parse(run({"--json"}));
  CHECK(one["united"]["bodies_before"] == 2);
  CHECK(one["united"]["bodies_after"] == 1);
  CHECK(Json::parse(read_bytes(folder / "a.fold"))["ridgecraft:settings"]["bodies"] == "united");
  CHECK(run_program({"verify", "a.fold", "--model", "cross.obj"}, in(folder)).exit_code == 0);
  // Nets made before say which it was, whatever is asked for now.
  fs::copy_file(folder / "a.fold", folder / "one.fold");
  CHECK(Json::parse(run({"--json", "--from", "one.fold"}))["united"]["bodies_after"] == 1);
  const Json two = Json::parse(run({"--json", "--keep-bodies"}));
  CHECK(two["united"]["bodies_before"] == 0);
  CHECK(two["faces"] == 24);
  CHECK_FALSE(Json::parse(read_bytes(folder / "a.fold"))["ridgecraft:settings"].contains("bodies"));
  fs::copy_file(folder / "a.fold", folder / "two.fold");
  CHECK(Json::parse(run({"--json", "--from", "two.fold"}))["faces"] == 24);
}

TEST_CASE("what is told of several and of one is worded so", "[summaries]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  const Outcome large = run_program({"house.obj", "--size", "40cm", "-v", "-o", "x.fold"}, in(folder));
  CAPTURE(large.out);
  CHECK(large.out.find(": one piece with their neighbours wouldn't fit the paper\n") != std::string::npos);
  write_bytes(folder / "one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Outcome one = run_program({"shell", "one.obj", "-o", "s.obj"}, in(folder));
  CAPTURE(one.err);
  CHECK(one.out.starts_with("one.obj: 1 polygon\n"));
  write_bytes(folder / "two.seg", "0\n1\n");
  check_refusal(run_program({"segment", "one.obj", "--compare", "two.seg"}, in(folder)), 3,
                "two.seg has more than 1 label, but the model has 1 polygon");
}

TEST_CASE("a size without a unit is told of where it makes a tiny model", "[summaries]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  const auto told = [&](const std::string& size) {
    const Outcome paper = run_program({"house.obj", "--size", size, "-o", "x.fold"}, in(folder));
    const Outcome nets = run_program({"unfold", "house.obj", "--size", size, "-o", "x.fold"}, in(folder));
    const std::string note =
        "--size " + size + " has no unit, so it means " + size + " mm; --size " + size + "cm ";
    const bool by_paper = paper.err.find(note) != std::string::npos;
    CHECK((nets.err.find(note) != std::string::npos) == by_paper);
    CHECK(paper.exit_code + nets.exit_code == 0);
    return by_paper;
  };
  CHECK(told("10"));
  CHECK(told("29.5"));
  CHECK_FALSE(told("30"));
  CHECK_FALSE(told("10mm"));
  CHECK_FALSE(told("2cm"));
}

TEST_CASE("what hangs together at a thread of paper alone becomes two pieces, in every mode", "[summaries]") {
  // Two flaps at the ends of a strip of a fiftieth of a millimetre.
  const TemporaryFolder folder;
  write_bytes(folder / "strip.obj",
              "v 0 0 0\nv 10 0 0\nv 75 0 0\nv 86 0 0\nv 86 0.02 0\nv 0 0.02 0\n"
              "v 0 0 -20\nv 10 0 -20\nv 75 0 -20\nv 86 0 -20\n"
              "f 1 2 3 4 5 6\nf 2 1 7 8\nf 4 3 9 10\n");
  for (const std::vector<std::string>& mode :
       {std::vector<std::string>{}, {"--pieces", "few"}, {"--max-faces", "any"}, {"--pieces", "small"}}) {
    std::vector<std::string> words{"strip.obj", "--scale", "1",      "--unit", "mm",         "--faces",
                                   "keep",      "-o",      "a.fold", "--json", "--overwrite"};
    words.insert(words.end(), mode.begin(), mode.end());
    const Outcome outcome = run_program(words, in(folder));
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(Json::parse(outcome.out)["pieces"] == 2);
  }
}

TEST_CASE("what many loose bodies have in common is named, so that it can be left out", "[summaries]") {
  const TemporaryFolder folder;
  // A box, and twelve triangles over it.
  std::string text =
      "o trunk\nv 0 0 0\nv 40 0 0\nv 40 40 0\nv 0 40 0\nv 0 0 40\nv 40 0 40\nv 40 40 40\nv 0 40 40\n"
      "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\no leaves\n";
  for (int i = 0; i < 12; ++i) {
    const double x = 3.0 * i;
    text += fmt::format("v {} 0 50\nv {} 20 50\nv {} 10 70\nf -3 -2 -1\n", x, x, x);
  }
  write_bytes(folder / "tree.obj", text);
  const Outcome tree = run_program({"tree.obj", "--size", "70mm", "-o", "t.fold"}, in(folder));
  INFO(tree.out << tree.err);
  REQUIRE(tree.exit_code == 0);
  CHECK(tree.out.find("no evening's work: --without 'leaves' (") != std::string::npos);
  const Outcome trunk =
      run_program({"tree.obj", "--size", "70mm", "--without", "leaves", "-o", "u.fold"}, in(folder));
  CHECK(trunk.exit_code == 0);
  CHECK(trunk.out.find("no evening's work") == std::string::npos);
}
