// SPDX-License-Identifier: GPL-3.0-or-later
// Options for machines: what they change in files, and what is refused.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "cli/arguments/parse.hpp"
#include "cli/program_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using namespace ridgecraft::cli;
using namespace ridgecraft::test;

namespace {

MakeJob job_of(std::vector<std::string> words) {
  words.insert(words.begin(), "house.obj");
  return std::get<MakeJob>(parse_arguments(words));
}

}  // namespace

TEST_CASE("a preset sets its sheet, and every option goes before it", "[machine_options]") {
  const MakeJob cricut = job_of({"--preset", "cricut"});
  CHECK(cricut.options.paper->size == Vec2{292.0, 292.0});
  CHECK(cricut.options.paper->margin == 0.0);
  CHECK_FALSE(cricut.options.paper->furniture);
  CHECK(job_of({"--preset", "cricut", "--paper", "A4"}).options.paper->size == Vec2{210.0, 297.0});
  CHECK(job_of({"--preset", "cricut", "--margin", "7"}).options.paper->margin == 7.0);
  const MakeJob bed = job_of({"--preset", "glowforge", "--bed", "400x300mm", "--kerf", "0.2mm"});
  CHECK(bed.options.paper->size == Vec2{400.0, 300.0});
  // Room for the beam at the edges and between pieces.
  CHECK(bed.options.paper->margin == Approx(0.2));
  CHECK(job_of({"--preset", "laser", "--kerf", "2mm"}).options.paper->gap == Approx(4.5));
  CHECK(bed.preset.paths.kerf_mm == Approx(0.2));
  const MakeJob bed_alone = job_of({"--bed", "400x300mm", "-o", "a.dxf"});
  CHECK(bed_alone.options.paper->foot == 0.0);
  CHECK_FALSE(bed_alone.options.paper->furniture);
  const MakeJob changed =
      job_of({"--preset", "laser", "--score", "solid", "--bridges", "3", "--engrave", "off", "--colour",
              "cut=#010203", "--colour", "numbers=#0a0b0c", "--svg-px", "72", "--thickness", "3mm"});
  CHECK(changed.preset.paths.scores == export_::Scores::solid);
  CHECK(changed.preset.paths.bridges.count == 3);
  CHECK_FALSE(changed.preset.paths.engraves);
  CHECK(changed.preset.colors[6] == export_::Color{1, 2, 3});
  CHECK(changed.preset.colors[1] == export_::Color{10, 11, 12});
  CHECK(changed.preset.svg_units_per_inch == 72.0);
  CHECK(changed.options.board.hinge == export_::Hinge::back);
  CHECK(changed.options.tabs.height_mm == Approx(8.0));
  CHECK(job_of({"--thickness", "1mm", "--preset", "packaging"}).options.board.hinge ==
        export_::Hinge::middle);
  CHECK_FALSE(job_of({"--thickness", "1mm"}).page);
  CHECK(job_of({"--thickness", "0"}).page);
  CHECK(job_of({}).options.paper->size == Vec2{210.0, 297.0});
}

TEST_CASE("options that only machines heed are refused without one", "[machine_options]") {
  const TemporaryFolder folder;
  const auto refused = [&](const std::vector<std::string>& words, const std::string& part) {
    std::vector<std::string> all{"house.obj"};
    all.insert(all.end(), words.begin(), words.end());
    check_refusal(run_program(all, in(folder)), 2, part);
  };
  refused({"--kerf", "0.1mm"}, "--kerf is about files for machines");
  refused({"--bridges", "2"}, "--bridges is about files for machines");
  refused({"--bed", "400x300mm", "-o", "a.pdf"}, "--bed is about files for machines");
  refused({"--preset", "origami-simulator", "--kerf", "0.1"}, "--kerf");
  refused({"--preset", "origami-simulator", "--bed", "400x300mm"}, "--bed is about what is cut");
  refused({"--preset", "origami-simulator", "--thickness", "1mm"}, "--thickness is about what is cut");
  refused({"--preset", "laser", "--kerf", "3mm"}, "0 to 2mm");
  refused({"--preset", "laser", "--bridges", "51"}, "0 to 50");
  refused({"--preset", "laser", "--score", "half"}, "perforate");
  refused({"--preset", "laser", "--colour", "cut=red"}, "#ff8000");
  refused({"--preset", "laser", "--colour", "hole=#ff0000"}, "OPERATION");
  refused({"--preset", "laser", "--bed", "300x200", "--paper", "A4"}, "--bed and --paper");
  refused({"--preset", "laser", "--spot", "cut=Die"}, "packaging");
  refused({"--preset", "packaging", "--spot", "fold=Die"}, "crease");
  refused({"--preset", "packaging", "--spot", "cut=a b"}, "letters");
  refused({"--preset", "laser", "--numbers", "back"}, "files of --preset laser don't have");
  refused({"-o", "a.dxf", "--numbers", "back"}, "DXF and other files for machines");
  refused({"--dxf", "r12"}, "none is written");
  refused({"--dxf", "r12", "-o", "a.svg"}, "none is written");
  refused({"--preset", "lightburn", "--dxf", "r12", "-o", "out"}, "none is written");
  CHECK(job_of({"--preset", "laser", "--dxf", "r12", "-o", "out"}).preset.dxf_kind == export_::DxfKind::r12);
  CHECK(job_of({"-o", "a.svg", "-o", "b.dxf", "--dxf", "plain"}).preset.dxf_kind == export_::DxfKind::plain);
  refused({"--hinge", "back"}, "--thickness");
  refused({"--thickness", "25mm"}, "20mm");
  refused({"--thickness", "1mm", "-o", "a.html"}, "-o a.html names a page");
  refused({"--print-and-cut"}, "--preset silhouette");
  refused({"--preset", "cricut", "--print-and-cut"}, "cricut");
  refused({"--preset", "laser", "--print-and-cut", "--bed", "300x200"}, "--paper");
}

TEST_CASE("files for machines are written, each with its mark, and may be written again",
          "[machine_options]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  for (int round = 0; round < 2; ++round) {
    REQUIRE(run_program({"house.obj", "--size", "8cm", "-o", "h.lbrn2", "-o", "h.eps", "-o", "h.plt", "-o",
                         "h.dxf", "--kerf", "0.1mm", "--kerf-test"},
                        in(folder))
                .exit_code == 0);
    REQUIRE(run_program({"house.obj", "--size", "8cm", "--preset", "packaging"}, in(folder)).exit_code == 0);
    REQUIRE(
        run_program({"house.obj", "--size", "8cm", "--preset", "silhouette", "--print-and-cut"}, in(folder))
            .exit_code == 0);
    REQUIRE(run_program({"house.obj", "--size", "8cm", "--thickness", "1mm", "-o", "thick.pdf", "-o",
                         "thick.fold", "--no-guide"},
                        in(folder))
                .exit_code == 0);
  }
  CHECK(folder.names() == std::set<std::string>{"house.obj", "h.lbrn2", "h.eps", "h.plt", "h.dxf",
                                                "house-packaging.pdf", "house-packaging.dxf",
                                                "house-silhouette-print.pdf", "house-silhouette-cut.svg",
                                                "house-silhouette-cut-mm.dxf", "thick.pdf", "thick.fold"});
  CHECK(read_bytes(folder / "house-silhouette-cut.svg").find("Regmarks") != std::string::npos);
  CHECK(run_program({"verify", "thick.fold"}, in(folder)).exit_code == 0);
  // Nobody takes pages of board for those of the nets in the file.
  check_refusal(run_program({"verify", "thick.fold", "--pages", "thick.pdf"}, in(folder)), 3,
                "thick.pdf was made with --thickness");
}

TEST_CASE("the kerf test is calibrated like the pieces beside it", "[machine_options]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  REQUIRE(run_program({"house.obj", "--size", "8cm", "-o", "h.dxf", "--kerf-test", "--calibrate", "98x104"},
                      in(folder))
              .exit_code == 0);
  // Widths and heights of closed polylines.
  std::vector<Vec2> sizes;
  std::istringstream lines(read_bytes(folder / "h.dxf"));
  Box2 box;
  double x = 0.0;
  for (std::string code, value; std::getline(lines, code) && std::getline(lines, value);) {
    if (std::stoi(code) == 0) {
      if (!box.empty()) {
        sizes.push_back(box.size());
      }
      box = {};
    } else if (std::stoi(code) == 10) {
      x = std::stod(value);
    } else if (std::stoi(code) == 20) {
      box.add({x, std::stod(value)});
    }
  }
  CHECK(std::ranges::any_of(sizes, [](Vec2 size) {
    return length(size - Vec2{20.0 / 0.98, 20.0 / 1.04}) < 0.001;
  }));
}

TEST_CASE("the summary tells what is done with a machine's files", "[machine_options]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  const auto told = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"house.obj", "--overwrite"});
    return run_program(options, in(folder)).out;
  };
  CHECK(told({"--preset", "laser"}).find(" to the machine at 100 % (it allows for 0.1 mm of kerf") !=
        std::string::npos);
  CHECK(told({"--preset", "plotter"}).find("to the machine at 100 %; ") != std::string::npos);
  CHECK(told({"--preset", "origami-simulator"}).find("into the simulator") != std::string::npos);
  CHECK(told({"-o", "house.dxf"}).find("machine") == std::string::npos);
}

TEST_CASE("the summary tells to print what is printed, not what a machine cuts", "[machine_options]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  const auto told = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"house.obj", "--size", "8cm"});
    const Outcome outcome = run_program(words, in(folder));
    REQUIRE(outcome.exit_code == 0);
    return outcome.out;
  };
  CHECK(told({"--preset", "packaging"}).find("print ") == std::string::npos);
  CHECK(told({"--preset", "silhouette", "--print-and-cut"}).find("print house-silhouette-print.pdf at") !=
        std::string::npos);
  const std::string own = told({"-o", "by-guide.pdf", "--no-guide"});
  CHECK(own.find("print by-guide.pdf at") != std::string::npos);
  CHECK(own.find("build it by") == std::string::npos);
}

TEST_CASE("a cube of board has faces as wide as it leaves them", "[machine_options]") {
  const TemporaryFolder folder;
  write_bytes(folder / "cube.obj",
              "v 0 0 0\nv 60 0 0\nv 60 60 0\nv 0 60 0\nv 0 0 60\nv 60 0 60\nv 60 60 60\nv 0 60 60\n"
              "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  REQUIRE(run_program({"cube.obj", "--size", "60mm", "--preset", "plotter", "--score", "solid", "--bed",
                       "400x300mm", "--thickness", "2mm"},
                      in(folder))
              .exit_code == 0);
  // Lengths of folds and bases of tabs: between two folds 56, two bases 52, a base and a fold 54, a fold and
  // an edge with a tab behind it 58, two such edges 60.
  std::istringstream lines(read_bytes(folder / "cube-plotter.plt"));
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line) && line != "SP2;";) {
    double ax = 0.0;
    double ay = 0.0;
    double bx = 0.0;
    double by = 0.0;
    if (std::sscanf(line.c_str(), "PU%lf,%lf;PD%lf,%lf", &ax, &ay, &bx, &by) == 4) {
      ++count;
      const double mm = std::hypot(bx - ax, by - ay) / 40.0;
      CHECK(std::abs(mm / 2.0 - std::round(mm / 2.0)) < 0.03);
      CHECK(mm > 51.9);
      CHECK(mm < 60.1);
    }
  }
  CHECK(count == 12);
}

TEST_CASE("no machine gets a crumb of any sample, a crossing or a line twice", "[slow]") {
  if (std::system("/usr/bin/python3 -c 'import shapely' >/dev/null 2>&1") != 0) {
    WARN("skipped: python3-shapely not installed");
    return;
  }
  const TemporaryFolder folder;
  const std::string source = RIDGECRAFT_SOURCE_DIR;
  std::string files;
  for (const auto& entry : std::filesystem::directory_iterator(source + "/samples")) {
    if (!std::set<std::string>{".obj", ".off", ".ply", ".stl"}.contains(entry.path().extension().string())) {
      continue;
    }
    const std::string model = entry.path().string();
    const std::string stem = entry.path().stem().string();
    const std::string nets = (folder / (stem + ".fold")).string();
    CAPTURE(stem);
    REQUIRE(run_program({model, "-o", nets}, in(folder)).exit_code == 0);
    // With kerf and dashes, in whole lines, and in dashes on a mat.
    for (const std::string preset : {"laser", "cricut", "silhouette"}) {
      const std::string svg = (folder / preset / (stem + ".svg")).string();
      REQUIRE(run_program({model, "--from", nets, "--preset", preset, "-o", svg}, in(folder)).exit_code == 0);
    }
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
    files += entry.path().extension() == ".svg" ? " '" + entry.path().string() + "'" : "";
  }
  CHECK(std::system(("/usr/bin/python3 '" + source + "/tests/cli/machine_svg.py'" + files).c_str()) == 0);
}

TEST_CASE("other programs find nothing wrong with any preset's files", "[slow]") {
  const auto has = [](const std::string& command) {
    return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
  };
  const bool shapely = has("/usr/bin/python3 -c 'import shapely'");
  const bool ezdxf = has("/usr/bin/python3 -c 'import ezdxf'");
  const bool inkscape = has("inkscape --version");
  if (!shapely || !ezdxf || !inkscape) {
    WARN("skipped in part: " << (shapely ? "" : "python3-shapely ") << (ezdxf ? "" : "python3-ezdxf ")
                             << (inkscape ? "" : "inkscape ") << "not installed");
  }
  const TemporaryFolder folder;
  const std::string source = RIDGECRAFT_SOURCE_DIR;
  const std::vector<std::vector<std::string>> jobs{{"penguin.obj"},
                                                   {"mug.obj", "--kerf", "0.2mm", "--score", "perforate"},
                                                   {"house.obj", "--thickness", "2mm", "--score", "ends"}};
  std::size_t number = 0;
  for (const std::vector<std::string>& words : jobs) {
    for (const export_::Preset& preset : export_::presets()) {
      if (preset.simulates) {
        continue;
      }
      std::vector<std::string> all = words;
      all[0] = source + "/samples/" + words[0];
      all.insert(all.end(), {"--preset", std::string(preset.name), "-o",
                             (folder / ("out" + std::to_string(number++))).string() + "/"});
      const Outcome outcome = run_program(all, in(folder));
      INFO(outcome.err);
      REQUIRE(outcome.exit_code == 0);
    }
  }
  std::string svg;
  std::string dxf;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
    const std::string ending = entry.path().extension().string();
    (ending == ".svg" ? svg : dxf) +=
        ending == ".svg" || ending == ".dxf" ? " '" + entry.path().string() + "'" : "";
  }
  if (shapely) {
    CHECK(std::system(("/usr/bin/python3 '" + source + "/tests/cli/machine_svg.py'" +
                       (inkscape ? " --inkscape" : "") + svg)
                          .c_str()) == 0);
  }
  if (ezdxf) {
    std::ofstream(folder / "read.py") << R"(
import sys, ezdxf
for name in sys.argv[1:]:
    audit = ezdxf.readfile(name).audit()
    assert not audit.errors and not audit.fixes, (name, audit.errors, audit.fixes)
)";
    CHECK(std::system(("/usr/bin/python3 '" + (folder / "read.py").string() + "'" + dxf).c_str()) == 0);
  }
}

TEST_CASE("slits for arrows are single cuts in every kind of file for machines", "[slow]") {
  const auto has = [](const std::string& command) {
    return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
  };
  const bool ezdxf = has("/usr/bin/python3 -c 'import ezdxf'");
  const bool qpdf = has("qpdf --version");
  if (!ezdxf || !qpdf) {
    WARN("skipped in part: " << (ezdxf ? "" : "python3-ezdxf ") << (qpdf ? "" : "qpdf ") << "not installed");
  }
  const TemporaryFolder folder;
  const std::string source = RIDGECRAFT_SOURCE_DIR;
  for (const export_::Preset& preset : export_::presets()) {
    if (preset.simulates) {
      continue;
    }
    const std::string name(preset.name);
    std::vector<std::string> words{source + "/samples/house.obj", "--tabs", "slots", "--preset", name};
    for (const char* const ending : {".fold", ".svg", ".lbrn2", ".eps", ".plt", ".dxf", ".pdf"}) {
      if (std::string(ending) != ".pdf" || name == "packaging") {
        words.insert(words.end(), {"-o", name + ending});
      }
    }
    const Outcome outcome = run_program(words, in(folder));
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    std::string files;
    for (const std::string& file : folder.names()) {
      const std::string ending = std::filesystem::path(file).extension().string();
      if (file.starts_with(name) && ending != ".fold" && (ezdxf || ending != ".dxf") &&
          (qpdf || ending != ".pdf")) {
        files += " '" + (folder / file).string() + "'";
      }
    }
    CHECK(std::system(("/usr/bin/python3 '" + source + "/tests/cli/machine_slits.py' '" +
                       (folder / (name + ".fold")).string() + "'" + files)
                          .c_str()) == 0);
  }
}
