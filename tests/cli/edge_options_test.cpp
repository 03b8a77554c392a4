// SPDX-License-Identifier: GPL-3.0-or-later
// Edges that a user wants cut or kept: --cuts, --keep, --from, and lines in the model.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <tuple>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/program_checks.hpp"
#include "mesh/file_writers.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft::test;
using Json = nlohmann::json;
using ridgecraft::Vec3;

TEST_CASE("edges to be cut and kept are cut, and counted", "[edge_options]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  write_bytes(folder / "cuts.txt", "9 10\n2 3\n1 5\n");
  write_bytes(folder / "keep.txt", "3 2\n10 9\n2 6\n");
  const auto notes = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"house.obj", "--json", "-o", "x.fold", "--overwrite"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return Json::parse(run_program(arguments, in(folder)).out)["notes"].dump();
  };
  CHECK(notes({"--cuts", "cuts.txt", "--keep", "keep.txt"})
            .find("2 edges to be kept are to be cut, too, and are cut") != std::string::npos);
  CHECK(notes({"--cuts", "cuts.txt"}).find("too") == std::string::npos);
  write_bytes(folder / "keep.txt", "2 6\n");
  CHECK(notes({"--cuts", "cuts.txt", "--keep", "keep.txt"}).find("too") == std::string::npos);
  // The lines of the model are cuts as well.
  write_bytes(folder / "house.obj", std::string(house) + "l 2 6\n");
  CHECK(notes({"--keep", "keep.txt"}).find("1 edge to be kept is to be cut, too, and is cut") !=
        std::string::npos);
}

TEST_CASE("a model too fine that named edges keep from being simplified says so", "[edge_options]") {
  const TemporaryFolder folder;
  write_bytes(folder / "whale.obj",
              read_bytes(std::filesystem::path(RIDGECRAFT_SOURCE_DIR) / "samples/whale.obj"));
  write_bytes(folder / "cuts.txt", "1 2\n");
  const auto model_line = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"whale.obj", "--size", "25mm", "-o", "x.fold", "--overwrite"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const std::string told = run_program(arguments, in(folder)).out;
    const std::size_t at = told.find("  model ");
    return told.substr(at, told.find('\n', at) - at);
  };
  CHECK(model_line({"--cuts", "cuts.txt"}).find("not simplified, as edges") != std::string::npos);
  CHECK(model_line({}).find("not simplified") == std::string::npos);
  // Which of them are as they were asked to be is told, and nothing where none were named.
  write_bytes(folder / "keep.txt", "2 3\n");
  CHECK(model_line({"--cuts", "cuts.txt"}).find("1 edge cut as asked") != std::string::npos);
  CHECK(model_line({"--keep", "keep.txt"}).find("1 edge folded as asked") != std::string::npos);
  CHECK(model_line({"--cuts", "cuts.txt", "--keep", "keep.txt"}).find("1 edge cut and 1 folded as asked") !=
        std::string::npos);
  CHECK(model_line({"--page-by", "material"}).find("as asked") == std::string::npos);
  const Outcome both =
      run_program({"whale.obj", "--cuts", "cuts.txt", "--faces", "60", "-o", "y.fold"}, in(folder));
  CHECK(both.exit_code == 2);
  CHECK(both.err.find("--cuts names edges of the model as it is") != std::string::npos);
}

TEST_CASE("edges named in a file are cut or kept, nets made before survive", "[edge_options]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  write_bytes(folder / "cuts.txt", "# the ridge\n9 10\n\n2, 3\n");
  write_bytes(folder / "keep.txt", "1 5\n");
  const auto run = [&](std::vector<std::string> options, const std::string& output) {
    options.insert(options.begin(), {"house.obj", "--json", "-o", output});
    const Outcome outcome = run_program(options, in(folder));
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return Json::parse(read_bytes(folder / output));
  };
  // What each edge of the model is in the nets: B where it is cut.
  const auto kinds = [](const Json& fold) {
    std::map<std::pair<int, int>, std::string> kind_of_net_edge;
    for (std::size_t e = 0; e < fold["edges_vertices"].size(); ++e) {
      const auto ends = fold["edges_vertices"][e].get<std::vector<int>>();
      kind_of_net_edge[std::minmax(ends[0], ends[1])] = fold["edges_assignment"][e];
    }
    std::map<std::pair<int, int>, bool> cut;
    for (std::size_t f = 0; f < fold["faces_vertices"].size(); ++f) {
      const auto flat = fold["faces_vertices"][f].get<std::vector<int>>();
      const std::size_t model = fold["ridgecraft:faces_model"][f];
      const auto solid = fold["file_frames"][0]["faces_vertices"][model].get<std::vector<int>>();
      for (std::size_t k = 0; k < flat.size(); ++k) {
        const std::size_t j = (k + 1) % flat.size();
        cut[std::minmax(solid[k], solid[j])] = kind_of_net_edge[std::minmax(flat[k], flat[j])] == "B";
      }
    }
    return cut;
  };
  const auto asked = kinds(run({"--cuts", "cuts.txt", "--keep", "keep.txt"}, "asked.fold"));
  CHECK(asked.at({8, 9}));
  CHECK(asked.at({1, 2}));
  CHECK_FALSE(asked.at({0, 4}));
  CHECK(kinds(run({"--from", "asked.fold", "--seed", "7", "--size", "12cm"}, "again.fold")) == asked);

  write_bytes(folder / "house.obj", std::string(house) + "l 9 10\nl 2 3\n");
  const auto marked = kinds(run({}, "marked.fold"));
  CHECK(marked.at({8, 9}));
  CHECK(marked.at({1, 2}));

  // As Blender exports seams that were duplicated in place: edges of no face, with points of their own.
  std::vector<std::string> points;
  std::string faces;
  std::size_t face_count = 0;
  std::istringstream text(house);
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("v ")) {
      points.push_back(line.substr(2));
    } else if (line.starts_with("f ")) {
      std::istringstream numbers(line.substr(2));
      std::vector<int> corners;
      for (int n = 0; numbers >> n;) {
        corners.push_back(n - 1);
      }
      faces += std::to_string(corners.size());
      for (const int c : corners) {
        faces += " " + std::to_string(c);
      }
      faces += "\n";
      ++face_count;
    }
  }
  for (const std::size_t copied : {8U, 9U, 1U, 2U}) {
    points.push_back(points[copied]);
  }
  std::string ply = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(points.size()) +
                    "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                    std::to_string(face_count) +
                    "\nproperty list uchar uint vertex_indices\nelement edge 2\nproperty int vertex1\n"
                    "property int vertex2\nend_header\n";
  for (const std::string& point : points) {
    ply += point + "\n";
  }
  const std::size_t last = points.size();
  write_bytes(folder / "house.obj", ply + faces + std::to_string(last - 4) + " " + std::to_string(last - 3) +
                                        "\n" + std::to_string(last - 2) + " " + std::to_string(last - 1) +
                                        "\n");
  const auto from_ply = kinds(run({}, "ply.fold"));
  CHECK(from_ply.at({8, 9}));
  CHECK(from_ply.at({1, 2}));

  write_bytes(folder / "house.obj", house);
  write_bytes(folder / "cuts.txt", "9 11\n");
  check_refusal(run_program({"house.obj", "--cuts", "cuts.txt"}, in(folder)), 3, "cuts.txt, line 1");
  write_bytes(folder / "cuts.txt", "9\n");
  check_refusal(run_program({"house.obj", "--cuts", "cuts.txt"}, in(folder)), 3, "two numbers");
  write_bytes(folder / "bad.fold", "{}");
  check_refusal(run_program({"house.obj", "--from", "bad.fold"}, in(folder)), 3, "bad.fold");
}

TEST_CASE("points are counted as the format does that a file has, not its name", "[edge_options]") {
  const TemporaryFolder folder;
  const std::string off =
      "OFF\n10 7 0\n0 0 0\n4 0 0\n4 5 0\n0 5 0\n0 0 4\n4 0 4\n4 5 4\n0 5 4\n2 0 6\n2 5 6\n"
      "4 3 2 1 0\n5 0 1 5 8 4\n5 2 3 7 9 6\n4 1 2 6 5\n4 3 0 4 7\n4 5 6 9 8\n4 7 4 8 9\n";
  write_bytes(folder / "from_1.txt", "9 10\n2 3\n");
  write_bytes(folder / "from_0.txt", "8 9\n1 2\n");
  std::set<std::string> nets;
  for (const auto& [name, bytes, cuts] :
       {std::tuple("a.obj", std::string(house), "from_1.txt"),
        std::tuple("a.dat", std::string(house), "from_1.txt"), std::tuple("a.off", off, "from_0.txt"),
        std::tuple("a.OBJ", off, "from_0.txt")}) {
    CAPTURE(name);
    write_bytes(folder / name, bytes);
    const Outcome outcome =
        run_program({"unfold", name, "--whole", "--cuts", cuts, "-o", "x.fold", "--overwrite"}, in(folder));
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const Json fold = Json::parse(read_bytes(folder / "x.fold"));
    nets.insert(fold["faces_vertices"].dump() + fold["edges_assignment"].dump());
    write_bytes(folder / "beyond.txt", bytes == off ? "0 10\n" : "0 1\n");
    check_refusal(run_program({"unfold", name, "--cuts", "beyond.txt"}, in(folder)), 3, "beyond.txt, line 1");
  }
  CHECK(nets.size() == 1);
}

TEST_CASE("nets say what they were made with", "[edge_options][slow]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  write_bytes(folder / "a.txt", "9 10\n");
  write_bytes(folder / "b.txt", "9 10\n");
  write_bytes(folder / "c.txt", "9 10\n2 3\n");
  const auto settings = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"-o", "x.fold", "--overwrite"});
    const Outcome outcome = run_program(arguments, in(folder));
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return Json::parse(read_bytes(folder / "x.fold"))["ridgecraft:settings"];
  };
  const Json plain = settings({"house.obj"});
  CHECK(plain["faces"] == "auto");
  CHECK_FALSE(plain.contains("cuts"));
  const Json cut = settings({"house.obj", "--cuts", "a.txt"});
  CHECK(cut["faces"] == "keep");
  CHECK(cut == settings({"house.obj", "--cuts", "b.txt"}));  // not the file's name
  CHECK(cut["cuts"] != settings({"house.obj", "--cuts", "c.txt"})["cuts"]);
  CHECK(settings({"house.obj", "--keep", "a.txt"})["keep"] == cut["cuts"]);
  REQUIRE(run_program({"house.obj", "-o", "made.fold"}, in(folder)).exit_code == 0);
  CHECK(settings({"house.obj", "--from", "made.fold"}).contains("from"));

  CHECK(settings({"unfold", "house.obj"})["tabs"] == false);
  const Json tabs = settings({"unfold", "house.obj", "--tabs"});
  CHECK(tabs["tabs"] == true);
  CHECK(tabs["tab_height_mm"] == 5);

  write_bytes(folder / "house.obj", std::string(house) + "l 9 10\n");
  CHECK(settings({"house.obj"})["faces"] == "keep");
  CHECK(settings({"house.obj", "--faces", "12"})["faces"] == 12);
}

TEST_CASE("nets that Pepakura keeps with its model are taken by --from", "[edge_options]") {
  const TemporaryFolder folder;
  PdoTestFile file;
  file.objects = {pdo_cube()};
  file.scale = 20.0;
  write_bytes(folder / "cube.pdo", pdo(file));
  // The same cube as another program exports it, at another place and size.
  std::string obj;
  for (const Vec3 p : file.objects[0].points) {
    obj += "v " + std::to_string(10 * p.x + 5) + " " + std::to_string(10 * p.y) + " " +
           std::to_string(10 * p.z) + "\n";
  }
  for (const PdoTestFace& face : file.objects[0].faces) {
    obj += "f";
    for (const std::uint32_t p : face.points) {
      obj += " " + std::to_string(p + 1);
    }
    obj += "\n";
  }
  write_bytes(folder / "cube.obj", obj);
  const auto run = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--json", "--overwrite"});
    const Outcome outcome = run_program(words, in(folder));
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return Json::parse(outcome.out);
  };
  CHECK(run({"cube.pdo", "--size", "40mm", "-o", "own.fold"}).at("pieces") == 1);
  const Json same = run({"cube.pdo", "--from", "cube.pdo", "--scale", "1:1", "-o", "same.fold"});
  CHECK(same.at("pieces") == 2);
  CHECK(same.at("size_mm").at(0) == 40.0);
  CHECK(run({"cube.obj", "--from", "cube.pdo", "--size", "50mm", "-o", "other.fold"}).at("pieces") == 2);
  file.scale.reset();
  write_bytes(folder / "flat.pdo", pdo(file));
  check_refusal(run_program({"cube.obj", "--from", "flat.pdo"}, in(folder)), 3, "flat.pdo holds no nets");
}

TEST_CASE("nets of a simplified model are taken again, at another size and on other paper",
          "[edge_options]") {
  const TemporaryFolder folder;
  const std::string penguin = std::string(RIDGECRAFT_SOURCE_DIR) + "/samples/penguin.obj";
  const auto nets = [&](std::vector<std::string> options, const std::string& output) {
    options.insert(options.begin(), {penguin, "-o", output, "--json"});
    const Outcome outcome = run_program(options, in(folder));
    CAPTURE(outcome.err, outcome.out);
    REQUIRE(outcome.exit_code == 0);
    REQUIRE(run_program({"verify", output, "--model", penguin}, in(folder)).exit_code == 0);
    return std::pair(Json::parse(outcome.out), Json::parse(read_bytes(folder / output)));
  };
  const auto [first, before] = nets({"--size", "70mm"}, "a.fold");
  REQUIRE(first["simplified"]["faces_after"] < first["simplified"]["faces_before"]);
  const auto [same, again] = nets({"--size", "70mm", "--from", "a.fold", "--seed", "9"}, "b.fold");
  CHECK(again["ridgecraft:joins"].size() == before["ridgecraft:joins"].size());
  CHECK(again["faces_vertices"].size() == before["faces_vertices"].size());
  CHECK(same["cut_mm"].get<double>() == Approx(first["cut_mm"].get<double>()).epsilon(0.01));
  const auto [larger, larger_nets] = nets({"--size", "140mm", "--paper", "A3", "--from", "a.fold"}, "c.fold");
  CHECK(larger_nets["ridgecraft:joins"].size() == before["ridgecraft:joins"].size());
  CHECK(larger["glue_mm"].get<double>() == Approx(2.0 * first["glue_mm"].get<double>()).epsilon(1e-6));
}

/// Of the house's edges below its roof those that are cut, by their ends in its own numbers times 10.
static std::set<std::array<std::array<long, 3>, 2>> cuts_of_walls(const Json& fold, double scale,
                                                                  Vec3 middle) {
  std::set<std::array<std::array<long, 3>, 2>> cuts;
  std::map<std::pair<int, int>, bool> is_cut;
  for (std::size_t e = 0; e < fold["edges_vertices"].size(); ++e) {
    const auto ends = fold["edges_vertices"][e].get<std::vector<int>>();
    is_cut[std::minmax(ends[0], ends[1])] = fold["edges_assignment"][e] == "B";
  }
  const Json& solid = fold["file_frames"][0];
  const auto place = [&](int v) {
    const auto p = solid["vertices_coords"][static_cast<std::size_t>(v)].get<std::vector<double>>();
    return std::array<long, 3>{std::lround(10.0 * (p[0] / scale + middle.x)),
                               std::lround(10.0 * (p[1] / scale + middle.y)),
                               std::lround(10.0 * (p[2] / scale + middle.z))};
  };
  for (std::size_t f = 0; f < fold["faces_vertices"].size(); ++f) {
    const auto flat = fold["faces_vertices"][f].get<std::vector<int>>();
    const std::size_t model = fold["ridgecraft:faces_model"][f];
    const auto corners = solid["faces_vertices"][model].get<std::vector<int>>();
    for (std::size_t k = 0; k < flat.size(); ++k) {
      const std::size_t j = (k + 1) % flat.size();
      std::array<std::array<long, 3>, 2> ends{place(corners[k]), place(corners[j])};
      std::sort(ends.begin(), ends.end());
      const bool of_walls =
          std::all_of(ends.begin(), ends.end(), [](const auto& p) { return p[0] <= 40 && p[2] <= 40; });
      if (of_walls && is_cut[std::minmax(flat[k], flat[j])]) {
        cuts.insert(ends);
      }
    }
  }
  return cuts;
}

TEST_CASE("a changed model keeps every cut that still lies on an edge", "[edge_options]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  REQUIRE(run_program({"house.obj", "-o", "a.fold"}, in(folder)).exit_code == 0);
  // The ridge becomes twice as high, and a pyramid stands beside the house: its box is larger on two sides.
  std::string changed = house;
  for (const char* const ridge : {"v 2 0 6", "v 2 5 6"}) {
    changed.replace(changed.find(ridge) + 6, 1, "9");
  }
  changed += "v 6 0 0\nv 8 0 0\nv 7 2 0\nv 7 1 2\nf 13 12 11\nf 11 12 14\nf 12 13 14\nf 13 11 14\n";
  write_bytes(folder / "house.obj", changed);
  const Outcome outcome =
      run_program({"house.obj", "--from", "a.fold", "--json", "-o", "b.fold"}, in(folder));
  CAPTURE(outcome.err, outcome.out);
  REQUIRE(outcome.exit_code == 0);
  const Json before = Json::parse(read_bytes(folder / "a.fold"));
  const Json after = Json::parse(read_bytes(folder / "b.fold"));
  CHECK(cuts_of_walls(before, 150.0 / 6.0, {2.0, 2.5, 3.0}) ==
        cuts_of_walls(after, 150.0 / 9.0, {4.0, 2.5, 4.5}));
  CHECK(Json::parse(outcome.out)["notes"].dump().find("are no edges of the model on paper") !=
        std::string::npos);
}

TEST_CASE("settings of earlier nets that no option could have made are refused", "[edge_options]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  REQUIRE(run_program({"house.obj", "-o", "made.fold"}, in(folder)).exit_code == 0);
  const Json made = Json::parse(read_bytes(folder / "made.fold"));
  for (const char* const name : {"size_mm", "mm_per_unit", "judged_at_mm"}) {
    for (const Json& value : {Json(-1), Json(0), Json("wide"), Json(1e300)}) {
      if (name == std::string_view("mm_per_unit") && value == Json(1e300)) {
        continue;  // a number that some model may need
      }
      Json edited = made;
      edited["ridgecraft:settings"][name] = value;
      write_bytes(folder / "edited.fold", edited.dump());
      check_refusal(run_program({"house.obj", "--from", "edited.fold", "-o", "x.fold"}, in(folder)), 3,
                    "edited.fold");
    }
  }
}
