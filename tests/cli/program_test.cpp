// SPDX-License-Identifier: GPL-3.0-or-later
// The finished program from outside: every exit code, what it writes, and what it never leaves behind.
#include "support/program.hpp"

#include <algorithm>
#include <map>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "support/temporary_folder.hpp"

using namespace ridgecraft::test;
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

constexpr const char* house = R"(# a house, 4 x 5 x 6
v 0 0 0
v 4 0 0
v 4 5 0
v 0 5 0
v 0 0 4
v 4 0 4
v 4 5 4
v 0 5 4
v 2 0 6
v 2 5 6
f 4 3 2 1
f 1 2 6 9 5
f 3 4 8 10 7
f 2 3 7 6
f 4 1 5 8
f 6 7 10 9
f 8 5 9 10
)";

RunOptions in(const TemporaryFolder& folder) {
  RunOptions options;
  options.folder = folder.path();
  return options;
}

/// One sentence on standard error that names the file, nothing on standard output, nothing written.
void check_refusal(const Outcome& outcome, int code, const std::string& word) {
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == code);
  CHECK_FALSE(outcome.by_signal);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.starts_with("ridgecraft: "));
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  CHECK(outcome.err.find(word) != std::string::npos);
}

}  // namespace

TEST_CASE("a model becomes PDF, SVG and FOLD in the current folder", "[program]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  const Outcome outcome = run_program({"house.obj", "--size", "8cm"}, in(folder));
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(folder.names() == std::set<std::string>{"house.obj", "house.pdf", "house.svg", "house.fold"});
  CHECK(outcome.out.find("wrote house.pdf") != std::string::npos);
  CHECK(read_bytes(folder / "house.pdf").starts_with("%PDF"));
  CHECK(run_program({"verify", "house.fold"}, in(folder)).exit_code == 0);
}

TEST_CASE("machines get one JSON object with the names that they know", "[program]") {
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
  CHECK(json["files"].size() == 3);
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

TEST_CASE("hulls, cages, shells and deformed models are made from the command line", "[program]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  const Json hulls = Json::parse(
      run_program({"hulls", "house.obj", "-o", "hulls.obj", "--max-vertices", "8", "--json"}, in(folder))
          .out);
  CHECK(hulls["parts"] == 1);
  REQUIRE(hulls["bodies"].size() == 1);
  CHECK(hulls["bodies"][0]["vertices"].get<int>() <= 8);
  CHECK(run_program({"hulls", "house.obj", "-o", "house.urdf"}, in(folder)).exit_code == 0);
  CHECK(folder.names() == std::set<std::string>{"house.obj", "hulls.obj", "house.urdf", "house-visual.obj",
                                                "house-hull-1.obj"});
  CHECK(run_program({"cage", "house.obj", "-o", "cage.off", "--faces", "80"}, in(folder)).exit_code == 0);
  CHECK(run_program({"deform", "house.obj", "--cage", "cage.off", "--to", "cage.off", "-o", "same.obj"},
                    in(folder))
            .exit_code == 0);
  // A cage that doesn't move moves nothing.
  const Json before = Json::parse(run_program({"info", "house.obj", "--json"}, in(folder)).out);
  const Json after = Json::parse(run_program({"info", "same.obj", "--json"}, in(folder)).out);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(after["size"][i].get<double>() == Approx(before["size"][i].get<double>()).margin(1e-3));
  }
  CHECK(run_program({"shell", "house.obj", "-o", "shell.ply", "--opening", "10%"}, in(folder)).exit_code ==
        0);
  const Json shell = Json::parse(run_program({"info", "shell.ply", "--json"}, in(folder)).out);
  CHECK(shell["components"] == 1);

  CHECK(run_program({"hulls", "house.obj", "-o", "hulls.stl"}, in(folder)).exit_code == 2);
  CHECK(run_program({"hulls", "house.obj"}, in(folder)).exit_code == 2);
  CHECK(run_program({"shell", "house.obj", "-o", "x.obj", "--opening", "0"}, in(folder)).exit_code == 2);
  CHECK(run_program({"deform", "house.obj", "--cage", "cage.off", "--to", "house.obj", "-o", "x.obj"},
                    in(folder))
            .exit_code == 4);
  CHECK_FALSE(fs::exists(folder / "x.obj"));
}

TEST_CASE("hundreds of pages are announced, with a size that needs few", "[program]") {
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

TEST_CASE("faces too thin for a knife are counted, loose bodies listed", "[program]") {
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
      run_program({"bar.obj", "--size", "100mm", "--faces", "keep", "-o", "b.fold"}, in(folder));
  CHECK(text.out.find("slivers     8 faces thinner than 1 mm") != std::string::npos);
  CHECK(text.out.find("bodies      2 that no join connects") != std::string::npos);
}

TEST_CASE("parts are compared with other people's", "[program]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  write_bytes(folder / "same.seg", "4 4 4 4 4 4 4");
  write_bytes(folder / "roof.seg", "0\n0\n0\n0\n0\n1\n1\n");
  write_bytes(folder / "short.seg", "0\n0\n");
  write_bytes(folder / "long.seg", "0 0 0 0 0 0 0 0");
  write_bytes(folder / "words.seg", "0 0 0 roof 0 0 0");
  const Json json = Json::parse(
      run_program({"segment", "house.obj", "--json", "--compare", "same.seg", "roof.seg"}, in(folder)).out);
  CHECK(json["volume_ratio"].get<double>() == Approx(1.0).margin(0.02));
  REQUIRE(json["compare"].size() == 2);
  CHECK(json["compare"][0]["rand_error"] == 0.0);
  CHECK(json["compare"][0]["cut_discrepancy"] == 0.0);
  CHECK(json["compare"][1]["rand_error"].get<double>() == Approx(10.0 / 21.0));
  CHECK(json["compare"][1]["gce"].get<double>() == Approx(0.0).margin(1e-12));
  CHECK(json["compare"][1]["cut_discrepancy"].is_null());
  CHECK(json["compare_mean"]["rand_error"].get<double>() == Approx(5.0 / 21.0));
  for (const char* bad : {"short.seg", "long.seg", "words.seg", "none.seg"}) {
    const auto run = run_program({"segment", "house.obj", "--compare", bad, "-o", "x.ply"}, in(folder));
    CHECK(run.exit_code == 3);
    CHECK(run.err.find(bad) != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "x.ply"));
  }
}

TEST_CASE("two runs with one seed give the same bytes, with one thread and with two", "[program]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  REQUIRE(run_program({"house.obj", "--size", "8cm", "-o", "a", "--threads", "1"}, in(folder)).exit_code ==
          0);
  REQUIRE(run_program({"house.obj", "--size", "8cm", "-o", "b", "--threads", "2"}, in(folder)).exit_code ==
          0);
  for (const char* suffix : {"pdf", "svg", "fold"}) {
    const std::string name = std::string("house.") + suffix;
    CAPTURE(name);
    CHECK(read_bytes(folder.path() / "a" / name) == read_bytes(folder.path() / "b" / name));
  }
}

TEST_CASE("exit code 2: wrong arguments", "[program]") {
  check_refusal(run_program({}), 2, "--help");
  check_refusal(run_program({"house.obj", "--size", "huge"}), 2, "huge");
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  check_refusal(run_program({"house.obj", "-o", "house.docx"}, in(folder)), 2, "docx");
}

TEST_CASE("exit code 3: the input can't be read", "[program]") {
  const TemporaryFolder folder;
  write_bytes(folder / "empty.obj", "");
  write_bytes(folder / "cut.off", "OFF\n8 6 12\n0 0 0\n");
  fs::create_directory(folder / "folder.obj");
  const auto before = folder.names();
  check_refusal(run_program({"missing.obj"}, in(folder)), 3, "missing.obj");
  check_refusal(run_program({"empty.obj"}, in(folder)), 3, "empty.obj");
  check_refusal(run_program({"folder.obj"}, in(folder)), 3, "folder.obj");
  check_refusal(run_program({"cut.off"}, in(folder)), 3, "cut.off");
  check_refusal(run_program({"verify", "missing.fold"}, in(folder)), 3, "missing.fold");
  check_refusal(run_program({"info", "/dev/zero"}, in(folder)), 3, "/dev/zero");
  CHECK(folder.names() == before);
}

TEST_CASE("exit code 3: no right to read", "[program]") {
  if (::geteuid() == 0 && !can_drop_rights()) {
    WARN("skipped: root's rights can't be dropped here");
    return;
  }
  const TemporaryFolder folder;
  write_bytes(folder / "secret.obj", house);
  fs::permissions(folder / "secret.obj", fs::perms::none);
  fs::permissions(folder.path(), fs::perms::all);
  RunOptions options = in(folder);
  options.as_nobody = true;
  check_refusal(run_program({"secret.obj"}, options), 3, "secret.obj");
  CHECK(folder.names() == std::set<std::string>{"secret.obj"});
}

TEST_CASE("exit code 4: the mesh can't be used", "[program]") {
  const TemporaryFolder folder;
  write_bytes(folder / "points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  write_bytes(folder / "line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  const auto before = folder.names();
  check_refusal(run_program({"points.obj"}, in(folder)), 4, "points.obj");
  check_refusal(run_program({"line.obj"}, in(folder)), 4, "line.obj");
  CHECK(folder.names() == before);
}

TEST_CASE("exit code 5: nothing that can be cut", "[program]") {
  const TemporaryFolder folder;
  write_bytes(folder / "needle.obj",
              "v 0 0 0\nv 1 0 0\nv 0.5 1e-7 0\nv 0.5 0 1e-7\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  check_refusal(run_program({"needle.obj"}, in(folder)), 5, "needle.obj");
  CHECK(folder.names() == std::set<std::string>{"needle.obj"});
}

TEST_CASE("exit code 6: verify finds faults", "[program]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  REQUIRE(run_program({"unfold", "house.obj", "-o", "h.fold"}, in(folder)).exit_code == 0);
  Json file = Json::parse(read_bytes(folder / "h.fold"));
  file["vertices_coords"][0][0] = file["vertices_coords"][0][0].get<double>() + 1.0;
  write_bytes(folder / "bad.fold", file.dump());
  const Outcome outcome = run_program({"verify", "bad.fold", "--json"}, in(folder));
  CHECK(outcome.exit_code == 6);
  CHECK_FALSE(Json::parse(outcome.out)["faults"].empty());
  write_bytes(folder / "no.fold", "this is no JSON");
  CHECK(run_program({"verify", "no.fold"}, in(folder)).exit_code == 6);
}

TEST_CASE("exit code 7: the result can't be written", "[program]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  write_bytes(folder / "house.pdf", "somebody's own file");
  SECTION("a file that wasn't made from this model") {
    check_refusal(run_program({"house.obj"}, in(folder)), 7, "house.pdf");
    CHECK(read_bytes(folder / "house.pdf") == "somebody's own file");
    CHECK(folder.names() == std::set<std::string>{"house.obj", "house.pdf"});
    CHECK(run_program({"house.obj", "--overwrite"}, in(folder)).exit_code == 0);
    CHECK(run_program({"house.obj"}, in(folder)).exit_code == 0);
  }
  SECTION("a full disk") {
    RunOptions options = in(folder);
    options.largest_file = 1000;
    check_refusal(run_program({"house.obj", "-o", "new.pdf"}, options), 7, "new.pdf");
    CHECK(folder.names() == std::set<std::string>{"house.obj", "house.pdf"});
  }
  SECTION("standard output is full") {
    if (!fs::exists("/dev/full")) {
      WARN("skipped: no /dev/full here");
      return;
    }
    RunOptions options = in(folder);
    options.out_file = "/dev/full";
    CHECK(run_program({"formats"}, options).exit_code == 7);
  }
}

TEST_CASE("exit code 7: no right to write", "[program]") {
  if (::geteuid() == 0 && !can_drop_rights()) {
    WARN("skipped: root's rights can't be dropped here");
    return;
  }
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec | fs::perms::group_read |
                                     fs::perms::group_exec | fs::perms::others_read | fs::perms::others_exec);
  RunOptions options = in(folder);
  options.as_nobody = true;
  check_refusal(run_program({"house.obj"}, options), 7, "can't write");
  fs::permissions(folder.path(), fs::perms::owner_all);
  CHECK(folder.names() == std::set<std::string>{"house.obj"});
}

TEST_CASE("exit code 130: Ctrl-C leaves nothing behind", "[program]") {
  const TemporaryFolder folder;
  // A wavy sheet of 80 000 faces keeps the program busy for longer than it takes to interrupt it.
  std::string sheet = "OFF\n40401 80000 0\n";
  for (int i = 0; i <= 200; ++i) {
    for (int j = 0; j <= 200; ++j) {
      sheet +=
          std::to_string(i) + " " + std::to_string(j) + " " + std::to_string((i * i + 3 * j * i) % 17) + "\n";
    }
  }
  for (int i = 0; i < 200; ++i) {
    for (int j = 0; j < 200; ++j) {
      const int a = 201 * i + j;
      const auto face = [&](int p, int q, int r) {
        sheet += "3 " + std::to_string(p) + " " + std::to_string(q) + " " + std::to_string(r) + "\n";
      };
      face(a, a + 201, a + 202);
      face(a, a + 202, a + 1);
    }
  }
  write_bytes(folder / "sheet.off", sheet);
  RunOptions options = in(folder);
  options.interrupt_after_s = GENERATE(0.3, 0.8);
  const Outcome outcome = run_program({"sheet.off", "--faces", "keep"}, options);
  CHECK(outcome.exit_code == 130);
  CHECK_FALSE(outcome.by_signal);
  CHECK(outcome.err.find("nothing was written") != std::string::npos);
  CHECK(outcome.seconds < *options.interrupt_after_s + 5.0);
  CHECK(folder.names() == std::set<std::string>{"sheet.off"});
}

TEST_CASE("pages left over from an earlier run of the same model are removed", "[program]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  write_bytes(folder / "house-9.svg", "<svg>somebody's own</svg>");
  REQUIRE(run_program({"house.obj", "--size", "25cm"}, in(folder)).exit_code == 0);
  REQUIRE(fs::exists(folder / "house-2.svg"));
  CHECK_FALSE(fs::exists(folder / "house.svg"));
  REQUIRE(run_program({"house.obj", "--size", "8cm"}, in(folder)).exit_code == 0);
  CHECK(folder.names() ==
        std::set<std::string>{"house.obj", "house.pdf", "house.svg", "house.fold", "house-9.svg"});
}

TEST_CASE("a file that is asked for twice is written once", "[program]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  fs::create_directory(folder / "real");
  fs::create_directory_symlink("real", folder / "link");
  const Outcome outcome = run_program(
      {"house.obj", "--size", "8cm", "-o", "real/h.pdf", "-o", "link/h.pdf", "-o", "link/../real/h.fold"},
      in(folder));
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(read_bytes(folder / "real/h.pdf").starts_with("%PDF"));
  CHECK(folder.names() == std::set<std::string>{"house.obj", "real", "link"});
}

TEST_CASE("exit code 2: two results in one file", "[program]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  fs::create_directory(folder / "real");
  fs::create_directory_symlink("real", folder / "link");
  check_refusal(run_program({"segment", "house.obj", "-o", "p.ply", "--labels", "p.ply"}, in(folder)), 2,
                "p.ply");
  check_refusal(
      run_program({"segment", "house.obj", "-o", "real/p.ply", "--labels", "link/p.ply"}, in(folder)), 2,
      "link/p.ply");
  check_refusal(
      run_program({"segment", "house.obj", "--hierarchy", "new/a", "--labels", "new/../new/a"}, in(folder)),
      2, "new/a");
  CHECK(folder.names() == std::set<std::string>{"house.obj", "real", "link"});
}

TEST_CASE("names as long as the file system allows", "[program]") {
  const TemporaryFolder folder;
  const std::string stem(240, 'x');
  write_bytes(folder / "house.obj", house);
  const Outcome outcome = run_program({"house.obj", "--size", "8cm", "-o", stem + ".pdf"}, in(folder));
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(folder.names() == std::set<std::string>{"house.obj", stem + ".pdf"});
}

TEST_CASE("folders are made for results, and go again when there are none", "[program]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  RunOptions options = in(folder);
  options.largest_file = 1000;
  check_refusal(run_program({"house.obj", "-o", "a/b/h.pdf"}, options), 7, "h.pdf");
  CHECK(folder.names() == std::set<std::string>{"house.obj"});
  CHECK(run_program({"segment", "house.obj", "-o", "a/b/h.ply"}, in(folder)).exit_code == 0);
  CHECK(fs::exists(folder / "a/b/h.ply"));
}

TEST_CASE("parts leave in the numbers of the file, however extreme", "[program]") {
  const TemporaryFolder folder;
  write_bytes(folder / "far.obj",
              "v 0 0 0\nv 1e71 0 0\nv 0 1e71 0\nv 0 0 1e71\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  const Outcome outcome =
      run_program({"segment", "far.obj", "-o", "p.off", "-o", "p.ply", "--json"}, in(folder));
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(read_bytes(folder / "p.off").find("\n1e+71 0 0\n") != std::string::npos);
  CHECK(Json::parse(outcome.out)["part"][0]["hull_volume"].get<double>() == Approx(1e213 / 6.0));
  const Json ply = Json::parse(run_program({"info", "p.ply", "--json"}, in(folder)).out);
  CHECK(ply["size"][0].get<double>() == Approx(1e71));
}

TEST_CASE("a file that is no label file is refused before the work", "[program]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  write_bytes(folder / "notes", "somebody's own");
  // After the segmentation, other people's labels would have been missed first.
  for (const char* option : {"--labels", "--hierarchy"}) {
    check_refusal(
        run_program({"segment", "house.obj", option, "notes", "--compare", "missing.seg"}, in(folder)), 7,
        "notes");
  }
  REQUIRE(run_program({"segment", "house.obj", "--labels", "l", "--hierarchy", "h"}, in(folder)).exit_code ==
          0);
  CHECK(run_program({"segment", "house.obj", "--labels", "l", "--hierarchy", "h"}, in(folder)).exit_code ==
        0);
}

TEST_CASE("more than the memory holds", "[program]") {
  const TemporaryFolder folder;
  std::string cloud = "OFF\n1500000 1 0\n";
  for (int i = 0; i < 1500000; ++i) {
    cloud += "0 1 2\n";
  }
  write_bytes(folder / "cloud.off", cloud + "3 0 1 2\n");
  const auto with_kilobytes = [&](const std::string& kilobytes, const std::string& arguments) {
    return run_command(
        {"/bin/sh", "-c", "ulimit -v " + kilobytes + " && exec " + RIDGECRAFT_PROGRAM + " " + arguments},
        in(folder));
  };
  if (with_kilobytes("120000", "formats").exit_code != 0) {
    WARN("skipped: the program doesn't start in little memory here");
    return;
  }
  for (const char* verb : {"", "segment ", "unfold ", "info ", "shell -o s.ply "}) {
    CAPTURE(verb);
    check_refusal(with_kilobytes("120000", verb + std::string("cloud.off --threads 1")), 4, "cloud.off");
  }
}

TEST_CASE("names with spaces and letters of any script work", "[program]") {
  const TemporaryFolder folder;
  write_bytes(folder / "Füchsin 狐 & <co>.obj", house);
  const Outcome outcome = run_program({"Füchsin 狐 & <co>.obj", "--size", "8cm"}, in(folder));
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(fs::exists(folder / "Füchsin 狐 & <co>.svg"));
}

TEST_CASE("edges named in a file are cut or kept, nets made before survive", "[program]") {
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

  write_bytes(folder / "cuts.txt", "9 11\n");
  check_refusal(run_program({"house.obj", "--cuts", "cuts.txt"}, in(folder)), 3, "cuts.txt, line 1");
  write_bytes(folder / "cuts.txt", "9\n");
  check_refusal(run_program({"house.obj", "--cuts", "cuts.txt"}, in(folder)), 3, "two numbers");
  write_bytes(folder / "bad.fold", "{}");
  check_refusal(run_program({"house.obj", "--from", "bad.fold"}, in(folder)), 3, "bad.fold");
}
