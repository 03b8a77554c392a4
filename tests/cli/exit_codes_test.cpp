// SPDX-License-Identifier: GPL-3.0-or-later
// Every exit code: one sentence, and nothing written.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "cli/program_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft::test;
namespace fs = std::filesystem;
using Json = nlohmann::json;

TEST_CASE("exit code 2: wrong arguments", "[exit_codes]") {
  check_refusal(run_program({}), 2, "--help");
  check_refusal(run_program({"house.obj", "--size", "huge"}), 2, "huge");
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  check_refusal(run_program({"house.obj", "-o", "house.docx"}, in(folder)), 2, "docx");
  // Options that would have no effect.
  for (const auto& [arguments, option] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"house.obj", "--unit", "m"}, "--unit"},
           {{"house.obj", "--no-tabs", "--tab-height", "7mm"}, "--tab-height"},
           {{"house.obj", "--no-tabs", "--tab-angle", "45"}, "--tab-angle"},
           {{"unfold", "house.obj", "--whole", "--concavity", "0.2"}, "--concavity"},
           {{"hulls", "house.obj", "-o", "a.obj", "--density", "5"}, "--density"},
           {{"hulls", "house.obj", "-o", "a.obj", "--unit", "m"}, "--unit"}}) {
    check_refusal(run_program(arguments, in(folder)), 2, option);
  }
  CHECK(folder.names() == std::set<std::string>{"house.obj"});
}

TEST_CASE("exit code 2: lengths that mean something else say how to write them", "[exit_codes]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  for (const auto& [arguments, words] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"house.obj", "--size", "0"}, "--size 0 is too small"},
           {{"house.obj", "--size", "-5"}, "--size -5 is too small"},
           {{"house.obj", "--size", "30,5cm"}, "--size 30.5cm"},
           {{"house.obj", "--size", "30", "cm"}, "--size 30cm"},
           {{"--size", "30", "cm", "house.obj"}, "--size 30cm"},
           // 6 mm, as the file doesn't say that it means metres, and six kilometres.
           {{"house.obj", "--scale", "1"}, "--unit"},
           {{"house.obj", "--scale", "1000000"}, "--unit"}}) {
    check_refusal(run_program(arguments, in(folder)), 2, words);
  }
  CHECK(run_program({"house.obj", "--scale", "1:1", "--unit", "in", "-o", "x.fold"}, in(folder)).exit_code ==
        0);
  CHECK(run_program({"house.obj", "--scale", "10", "-o", "x.fold"}, in(folder)).exit_code == 0);
}

TEST_CASE("exit code 9: --strict refuses what nobody could build", "[exit_codes]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  const Outcome told = run_program({"house.obj", "--size", "3mm", "--json", "-o", "x.fold"}, in(folder));
  CHECK(told.exit_code == 0);
  const Json report = Json::parse(told.out);
  CHECK_FALSE(report.at("buildable").get<bool>());
  const double size = report.at("smallest_size_mm").get<double>();
  const std::string option = std::to_string(static_cast<int>(size)) + "mm";
  const Outcome strict = run_program({"house.obj", "--size", "3mm", "--strict", "-o", "y.fold"}, in(folder));
  check_refusal(strict, 9, "--size " + option + " (");
  CHECK(folder.names() == std::set<std::string>{"house.obj", "x.fold"});
  const Outcome larger = run_program({"house.obj", "--size", option, "--strict", "-o", "y.fold"}, in(folder));
  CHECK(larger.exit_code == 0);
  CHECK(folder.names() == std::set<std::string>{"house.obj", "x.fold", "y.fold"});
}

TEST_CASE("exit code 3: the input can't be read", "[exit_codes]") {
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
  const TemporaryFolder nets;
  for (const char* bytes : {house, "this is no JSON", "%PDF-1.7\n", " \n"}) {
    write_bytes(nets / "no.fold", bytes);
    check_refusal(run_program({"verify", "no.fold"}, in(nets)), 3,
                  "no.fold is in no format that can be checked");
  }
  write_bytes(nets / "no.fold", "");
  check_refusal(run_program({"verify", "no.fold"}, in(nets)), 3, "ridgecraft: no.fold is empty\n");
  check_refusal(run_program({"info", "/dev/zero"}, in(folder)), 3, "/dev/zero");
  CHECK(folder.names() == before);
}

TEST_CASE("exit code 3: nets in the place of their model", "[exit_codes]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  REQUIRE(run_program({"unfold", "house.obj", "-o", "nets.fold"}, in(folder)).exit_code == 0);
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"nets.fold", "-o", "yy"}, {"info", "nets.fold"}}) {
    check_refusal(run_program(arguments, in(folder)), 3,
                  "pages of nets are made by: ridgecraft MODEL --from nets.fold");
  }
  const Outcome missing = run_program({"missing.fold"}, in(folder));
  CHECK(missing.exit_code == 3);
  CHECK(missing.err.find("--from") == std::string::npos);
}

TEST_CASE("exit code 3: no right to read", "[exit_codes]") {
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

TEST_CASE("exit code 4: the mesh can't be used", "[exit_codes]") {
  const TemporaryFolder folder;
  write_bytes(folder / "points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  write_bytes(folder / "line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  const auto before = folder.names();
  check_refusal(run_program({"points.obj"}, in(folder)), 4, "points.obj");
  check_refusal(run_program({"line.obj"}, in(folder)), 4, "line.obj");
  CHECK(folder.names() == before);
}

TEST_CASE("exit code 5: nothing that can be cut", "[exit_codes]") {
  const TemporaryFolder folder;
  write_bytes(folder / "needle.obj",
              "v 0 0 0\nv 1 0 0\nv 0.5 1e-7 0\nv 0.5 0 1e-7\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  check_refusal(run_program({"needle.obj"}, in(folder)), 5, "needle.obj");
  CHECK(folder.names() == std::set<std::string>{"needle.obj"});
}

TEST_CASE("exit code 6: verify finds faults", "[exit_codes]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  REQUIRE(run_program({"unfold", "house.obj", "-o", "h.fold"}, in(folder)).exit_code == 0);
  Json file = Json::parse(read_bytes(folder / "h.fold"));
  file["vertices_coords"][0][0] = file["vertices_coords"][0][0].get<double>() + 1.0;
  write_bytes(folder / "bad.fold", file.dump());
  const Outcome outcome = run_program({"verify", "bad.fold", "--json"}, in(folder));
  CHECK(outcome.exit_code == 6);
  CHECK_FALSE(Json::parse(outcome.out)["faults"].empty());
  const std::string whole = read_bytes(folder / "h.fold");
  for (const std::string& bytes :
       {whole.substr(0, whole.size() / 2), std::string("{\"meshes\": []}"), std::string(" []"),
        std::string("null"), std::string("{}"), std::string("\"nets\""), "\xEF\xBB\xBF" + whole}) {
    write_bytes(folder / "no.fold", bytes);
    const Outcome text = run_program({"verify", "no.fold"}, in(folder));
    CHECK(text.exit_code == 6);
    CHECK(text.out.starts_with("no.fold: not in the form of nets"));
    CHECK(text.err.empty());
  }
}

TEST_CASE("exit code 7: the result can't be written", "[exit_codes][slow]") {
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
  SECTION("a file that the same run reads") {
    REQUIRE(run_program({"house.obj", "-o", "h"}, in(folder)).exit_code == 0);
    fs::copy_file(folder / "h/house.fold", folder / "house.fold");
    fs::create_symlink("house.fold", folder / "link.fold");
    const std::string nets = read_bytes(folder / "house.fold");
    write_bytes(folder / "edges.fold", "1 5\n");
    check_refusal(run_program({"house.obj", "--from", "h/../h/house.fold", "-o", "h"}, in(folder)), 7,
                  "h/house.fold is read by --from: name another output with -o, or --overwrite replaces it");
    check_refusal(run_program({"house.obj", "--from", "link.fold", "-o", "house.fold"}, in(folder)), 7,
                  "--from");
    check_refusal(
        run_program({"unfold", "house.obj", "--from", "house.fold", "-o", "house.fold"}, in(folder)), 7,
        "--from");
    check_refusal(run_program({"house.obj", "--cuts", "edges.fold", "-o", "edges.fold"}, in(folder)), 7,
                  "--cuts");
    check_refusal(run_program({"house.obj", "--keep", "edges.fold", "-o", "edges.fold"}, in(folder)), 7,
                  "--keep");
    write_bytes(folder / "tabs.fold", "1 none\n");
    check_refusal(run_program({"house.obj", "--tab-file", "tabs.fold", "-o", "tabs.fold"}, in(folder)), 7,
                  "tabs.fold is read by --tab-file");
    CHECK(read_bytes(folder / "house.fold") == nets);
    CHECK(run_program({"house.obj", "--from", "house.fold", "-o", "new"}, in(folder)).exit_code == 0);
    CHECK(run_program({"house.obj", "--from", "link.fold", "-o", "link.fold", "--overwrite"}, in(folder))
              .exit_code == 0);
    // The link has made room, what it led to is untouched.
    CHECK(read_bytes(folder / "house.fold") == nets);
  }
  SECTION("a link is as the file that it leads to, and one that leads nowhere is somebody's") {
    write_bytes(folder / "other.txt", "somebody's own file");
    fs::create_symlink("other.txt", folder / "foreign");
    fs::create_symlink("missing", folder / "nowhere");
    for (const std::string link : {"foreign", "nowhere"}) {
      for (const std::string suffix : {".pdf", ".ply", ".seg", ".urdf"}) {
        fs::copy_symlink(folder / link, folder / (link + suffix));
      }
      CAPTURE(link);
      for (const std::vector<std::string>& arguments :
           std::vector<std::vector<std::string>>{{"house.obj", "-o", link + ".pdf"},
                                                 {"segment", "house.obj", "-o", link + ".ply"},
                                                 {"segment", "house.obj", "--labels", link + ".seg"},
                                                 {"hulls", "house.obj", "-o", link + ".urdf"}}) {
        CAPTURE(arguments);
        check_refusal(run_program(arguments, in(folder)), 7, "--overwrite replaces it");
      }
      CHECK(run_program({"house.obj", "-o", link + ".pdf", "--overwrite"}, in(folder)).exit_code == 0);
      CHECK(fs::is_regular_file(fs::symlink_status(folder / (link + ".pdf"))));
    }
    CHECK(read_bytes(folder / "other.txt") == "somebody's own file");
    CHECK_FALSE(fs::exists(folder / "missing"));
  }
  SECTION("a cage that the same run reads, made from the same model") {
    REQUIRE(run_program({"cage", "house.obj", "-o", "cage.obj"}, in(folder)).exit_code == 0);
    fs::copy_file(folder / "cage.obj", folder / "moved.obj");
    for (const auto& [output, option] : {std::pair("cage.obj", "--cage"), std::pair("./moved.obj", "--to")}) {
      check_refusal(
          run_program({"deform", "house.obj", "--cage", "cage.obj", "--to", "moved.obj", "-o", output},
                      in(folder)),
          7, option);
    }
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

TEST_CASE("exit code 7: no right to write", "[exit_codes]") {
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

TEST_CASE("exit code 130: Ctrl-C leaves nothing behind", "[exit_codes]") {
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
  CHECK(outcome.err.find("before the work was done") != std::string::npos);
  CHECK(outcome.seconds < *options.interrupt_after_s + 5.0);
  CHECK(folder.names() == std::set<std::string>{"sheet.off"});
}

TEST_CASE("exit code 2: two results in one file", "[exit_codes]") {
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
  for (const std::string second : {"p.pdf", "./p.pdf"}) {
    check_refusal(run_program({"house.obj", "-o", "p.pdf", "-o", second}, in(folder)), 2,
                  "-o " + second + " names what another -o names");
  }
  check_refusal(run_program({"house.obj", "-o", "real/p.pdf", "-o", "link/p.pdf"}, in(folder)), 2,
                "-o link/p.pdf");
  check_refusal(run_program({"house.obj", "-o", "real", "-o", "real/"}, in(folder)), 2, "-o real/");
  CHECK(folder.names() == std::set<std::string>{"house.obj", "real", "link"});
}

TEST_CASE("exit code 2: no result goes to standard output", "[exit_codes]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"house.obj", "-o", "-"},
           {"unfold", "house.obj", "-o", "-"},
           {"segment", "house.obj", "-o", "-"},
           {"segment", "house.obj", "--labels", "-"},
           {"segment", "house.obj", "--hierarchy", "-"},
           {"hulls", "house.obj", "-o", "-"},
           {"cage", "house.obj", "-o", "-"},
           {"shell", "house.obj", "-o", "-"},
           {"deform", "house.obj", "--cage", "house.obj", "--to", "house.obj", "-o", "-"}}) {
    CAPTURE(arguments);
    check_refusal(run_program(arguments, in(folder)), 2, "never to standard output");
  }
  CHECK(folder.names() == std::set<std::string>{"house.obj"});
  CHECK(run_program({"segment", "house.obj", "--labels", "./-"}, in(folder)).exit_code == 0);
  CHECK(folder.names() == std::set<std::string>{"house.obj", "-"});
}

TEST_CASE("more than the memory holds", "[exit_codes]") {
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

TEST_CASE("a refusal names the model, whatever words the sentence has", "[exit_codes]") {
  const TemporaryFolder folder;
  // A sentence of a stage that knows no files: "the model would be larger than 100 m; ..."
  write_bytes(folder / "the", house);
  check_refusal(run_program({"the", "--scale", "1000000", "--unit", "mm"}, in(folder)), 5,
                "ridgecraft: the: the model would be larger");
  write_bytes(folder / "house.obj", house);
  write_bytes(folder / "model", "9 10\n");
  check_refusal(
      run_program({"house.obj", "--cuts", "model", "--scale", "1000000", "--unit", "mm"}, in(folder)), 5,
      "ridgecraft: house.obj: the model would be larger");
}

TEST_CASE("a refusal names the file that is wrong, not the model", "[exit_codes]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  write_bytes(folder / "box.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  const auto check_blames = [&](const Outcome& outcome, int code, const std::string& file) {
    check_refusal(outcome, code, file);
    CHECK(outcome.err.find("house.obj") == std::string::npos);
  };
  for (const char* option : {"--cuts", "--keep", "--from"}) {
    check_blames(run_program({"house.obj", option, "no.txt"}, in(folder)), 3, "no.txt");
    check_blames(run_program({"unfold", "house.obj", option, "no.txt"}, in(folder)), 3, "no.txt");
  }
  check_blames(run_program({"segment", "house.obj", "--compare", "no.seg"}, in(folder)), 3, "no.seg");
  check_blames(
      run_program({"deform", "house.obj", "--cage", "box.obj", "--to", "box.obj", "-o", "x.obj"}, in(folder)),
      4, "box.obj");
}
