// SPDX-License-Identifier: GPL-3.0-or-later
// Files for machines, read back: the same cuts in every format, bridges, scores, marks, inks.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <pugixml.hpp>

#include "base/geometry.hpp"
#include "export/formats/write.hpp"
#include "export/machine/marks.hpp"
#include "export/machine/operations.hpp"
#include "machine_pages.hpp"
#include "sample_pages.hpp"
#include "support/temporary_folder.hpp"

namespace ridgecraft {
namespace {

using export_::Operation;
using export_::Path;
using export_::Scores;
using test::mark;

double length_of(const Path& path) {
  return ridgecraft::length_of(path.points) +
         (path.closed ? length(path.points.front() - path.points.back()) : 0.0);
}

double total(const std::vector<Path>& paths, bool folds) {
  double sum = 0.0;
  for (const Path& path : paths) {
    if ((path.operation < Operation::cut_inner) == folds && path.operation != Operation::engrave &&
        path.operation != Operation::registration) {
      sum += length_of(path);
    }
  }
  return sum;
}

std::vector<Path> closed_cuts(const export_::Drawing& page, const export_::PathRules& rules) {
  std::vector<Path> paths = export_::machine_paths(page, rules);
  std::erase_if(paths, [](const Path& path) { return !path.closed; });
  return paths;
}

void check_same(const std::vector<std::vector<Vec2>>& read, const std::vector<Path>& wanted,
                double tolerance) {
  REQUIRE(read.size() == wanted.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    REQUIRE(read[i].size() == wanted[i].points.size());
    for (std::size_t k = 0; k < read[i].size(); ++k) {
      CHECK(length(read[i][k] - wanted[i].points[k]) < tolerance);
    }
  }
}

bool runs(const std::string& command) {
  return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
}

/// The dots of an uncompressed TIFF of one grey byte a dot, little-endian, row by row.
std::string tiff_dots(const std::filesystem::path& file) {
  const std::string bytes = test::read_bytes(file);
  const auto number = [&](std::size_t at, std::size_t size) {
    std::size_t value = 0;
    for (std::size_t i = size; i-- > 0;) {
      value = 256 * value + static_cast<unsigned char>(bytes.at(at + i));
    }
    return value;
  };
  std::vector<std::size_t> offsets;
  std::vector<std::size_t> sizes;
  const std::size_t directory = number(4, 4);
  for (std::size_t entry = 0; entry < number(directory, 2); ++entry) {
    const std::size_t at = directory + 2 + 12 * entry;
    const std::size_t tag = number(at, 2);
    if (tag == 273 || tag == 279) {  // where strips begin, and how long they are
      const std::size_t width = number(at + 2, 2) == 3 ? 2 : 4;
      const std::size_t count = number(at + 4, 4);
      const std::size_t values = count * width <= 4 ? at + 8 : number(at + 8, 4);
      for (std::size_t i = 0; i < count; ++i) {
        (tag == 273 ? offsets : sizes).push_back(number(values + i * width, width));
      }
    }
  }
  std::string dots;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    dots += bytes.substr(offsets[i], sizes.at(i));
  }
  return dots;
}

}  // namespace

TEST_CASE("an outline with bridges is cut but for them, on tabs before other places and off corners") {
  for (const export_::Drawing& page : test::pages_for_machines()) {
    const auto whole = export_::machine_paths(page, {.engraves = false});
    const auto held = export_::machine_paths(page, {.engraves = false, .bridges = {3, 0.4}});
    CHECK(total(whole, true) == Approx(total(held, true)));
    std::size_t outlines = 0;
    double left = 0.0;
    for (const Path& path : whole) {
      outlines += path.operation == Operation::cut_outer ? 1U : 0U;
    }
    left = total(whole, false) - total(held, false);
    const double bridges = left / 0.4;
    CHECK(bridges == Approx(std::round(bridges)).margin(1e-6));
    CHECK(std::round(bridges) <= 3.0 * static_cast<double>(outlines));
    CHECK(std::round(bridges) >= static_cast<double>(outlines));
    for (const Path& path : held) {
      if (path.operation == Operation::cut_outer && !path.closed) {
        // Its ends are 3 mm or more from the corners before and after.
        CHECK(length(path.points[1] - path.points[0]) > 3.0 - 1e-6);
        CHECK(length(path.points[path.points.size() - 1] - path.points[path.points.size() - 2]) > 3.0 - 1e-6);
      }
    }
  }
}

TEST_CASE("the widest kerf hides no tab from bridges") {
  // A piece of 40 x 20 with a tab of 10 at its right.
  export_::Group group;
  group.id = "piece-A";
  group.lines.push_back({export_::Layer::cut, {{20, 20}, {70, 20}, {70, 40}, {20, 40}}, true});
  group.areas.push_back({export_::Layer::tab_fill, {{60, 40}, {60, 20}, {70, 20}, {70, 40}}});
  export_::Drawing page;
  page.groups = {group};
  for (const double kerf : {0.0, 0.1, 0.8, 2.0}) {
    CAPTURE(kerf);
    const auto paths = export_::machine_paths(page, {.kerf_mm = kerf, .bridges = {1, 0.4}});
    REQUIRE(paths.size() == 1);
    REQUIRE_FALSE(paths[0].closed);
    CHECK(paths[0].points.front().x == Approx(70.0 + 0.5 * kerf));
    CHECK(paths[0].points.back().x == Approx(70.0 + 0.5 * kerf));
  }
}

TEST_CASE("dashes begin and end with a bridge, whatever the length of the fold") {
  for (const export_::ScorePattern pattern :
       {export_::pattern_of(Scores::dashes, false), export_::pattern_of(Scores::dashes, true),
        export_::pattern_of(Scores::perforate, false)}) {
    for (double size = 0.5; size < 60.0; size += 0.137) {
      CAPTURE(size, pattern.cut, pattern.bridge);
      const auto dashes = export_::dashes_along({{1.0, 2.0}, {1.0 + size, 2.0}}, pattern);
      CHECK(dashes.empty() == (size < 3.0 * pattern.bridge));
      double at = 1.0;
      for (const auto& dash : dashes) {
        REQUIRE(dash.size() == 2);
        CHECK(dash[0].x - at > 0.8 * pattern.bridge - 1e-9);
        at = dash[1].x;
        if (size >= 2.0 * pattern.bridge + pattern.cut) {
          CHECK(dash[1].x - dash[0].x > 0.75 * pattern.cut - 1e-9);
          CHECK(dash[1].x - dash[0].x < 1.25 * pattern.cut + 1e-9);
        }
      }
      if (!dashes.empty()) {
        CHECK(1.0 + size - at > 0.8 * pattern.bridge - 1e-9);
      }
    }
  }
}

TEST_CASE("scores at ends lie beside the piece, and none are none") {
  for (const export_::Drawing& page : test::pages_for_machines()) {
    const auto ends = export_::machine_paths(page, {.engraves = false, .scores = Scores::ends});
    const auto none = export_::machine_paths(page, {.engraves = false, .scores = Scores::none});
    CHECK(total(none, true) == 0.0);
    CHECK(total(ends, false) == Approx(total(none, false)));
    std::vector<std::vector<Vec2>> outlines;
    for (const Path& path : none) {
      if (path.closed && path.operation >= Operation::cut_inner) {
        outlines.push_back(path.points);  // what lies in a hole lies in two of them
      }
    }
    std::size_t count = 0;
    for (const Path& path : ends) {
      if (path.operation >= Operation::cut_inner) {
        continue;
      }
      ++count;
      CHECK(length_of(path) < 4.0 + 1e-9);
      const Vec2 p = 0.5 * (path.points.front() + path.points.back());
      bool odd = false;
      for (const auto& outline : outlines) {
        for (std::size_t i = 0; i < outline.size(); ++i) {
          const Vec2 a = outline[i];
          const Vec2 b = outline[(i + 1) % outline.size()];
          odd ^= (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
        }
      }
      CHECK_FALSE(odd);
      // Nothing is cut along it, and it is on the sheet.
      const Vec2 last = path.points.back();
      CHECK(std::min(last.x, last.y) > -1e-9);
      CHECK(std::min(page.size.x - last.x, page.size.y - last.y) > -1e-9);
      for (const auto& outline : outlines) {
        for (std::size_t i = 0; i < outline.size(); ++i) {
          CHECK(distance_to_segment(p, outline[i], outline[(i + 1) % outline.size()]) > 0.08);
        }
      }
    }
    CHECK(count > 0);
  }
}

TEST_CASE("no path of a machine is shorter than 0.2 mm, no step of one than 0.05, with every rule") {
  for (const export_::Drawing& page : test::pages_for_machines()) {
    for (const Scores scores :
         {Scores::solid, Scores::dashes, Scores::perforate, Scores::ends, Scores::none}) {
      for (const double kerf : {0.0, 0.1, 0.3}) {
        for (const Path& path :
             export_::machine_paths(page, {.scores = scores, .kerf_mm = kerf, .bridges = {2, 0.4}})) {
          CHECK(length_of(path) >= 0.2 - 1e-9);
          for (std::size_t i = 1; path.closed && i < path.points.size(); ++i) {
            CHECK(length(path.points[i] - path.points[i - 1]) >= 0.05 - 1e-9);
          }
        }
      }
    }
  }
}

TEST_CASE("a LightBurn project has the settings that its shapes use, and the page's outlines") {
  for (const export_::Drawing& page : test::pages_for_machines()) {
    const export_::PathRules rules{.kerf_mm = 0.1};
    pugi::xml_document document;
    const std::string bytes = export_::write_lbrn(page, mark, rules);
    REQUIRE(document.load_string(bytes.c_str()));
    CHECK(export_::read_mark_digest(bytes) == mark.digest);
    std::set<int> settings;
    std::set<int> used;
    int priority = -1;
    std::vector<std::vector<Vec2>> closed;
    for (const pugi::xml_node setting : document.child("LightBurnProject").children("CutSetting")) {
      CHECK(settings.insert(setting.child("index").attribute("Value").as_int()).second);
      CHECK(setting.child("priority").attribute("Value").as_int() > priority);
      priority = setting.child("priority").attribute("Value").as_int();
      CHECK_FALSE(setting.child("maxPower"));
    }
    for (const pugi::xml_node shape : document.child("LightBurnProject").children("Shape")) {
      used.insert(shape.attribute("CutIndex").as_int());
      std::vector<Vec2> points;
      std::istringstream in(shape.child("VertList").child_value());
      for (std::string word; std::getline(in, word, 'V');) {
        Vec2 p;
        if (std::sscanf(word.c_str(), "%lf %lfc0x1c1x1", &p.x, &p.y) == 2) {
          points.push_back(p);
        }
      }
      if (std::string(shape.child("PrimList").child_value()) == "LineClosed") {
        closed.push_back(points);
      } else {
        CHECK(std::string(shape.child("PrimList").child_value()).starts_with("L0 1"));
      }
    }
    CHECK(settings == used);
    check_same(closed, closed_cuts(page, rules), 1e-4);
  }
}

TEST_CASE("EPS has the page's outlines in millimetres, in the colours of the operations, and no date") {
  for (const export_::Drawing& page : test::pages_for_machines()) {
    const export_::Preset& laser = export_::presets()[1];
    const std::string eps = export_::write_eps(page, mark, laser);
    CHECK(eps == export_::write_eps(page, mark, laser));
    CHECK(export_::read_mark_digest(eps) == mark.digest);
    CHECK(eps.find("Date") == std::string::npos);
    std::vector<std::vector<Vec2>> closed;
    std::vector<Vec2> points;
    std::istringstream in(eps);
    for (std::string line; std::getline(in, line);) {
      Vec2 p;
      char word[16] = "";
      if (std::sscanf(line.c_str(), "%lf %lf %15s", &p.x, &p.y, word) == 3 &&
          (std::string(word) == "moveto" || std::string(word) == "lineto")) {
        if (std::string(word) == "moveto") {
          points.clear();
        }
        points.push_back(p);
      } else if (line == "closepath stroke") {
        closed.push_back(points);
      }
    }
    check_same(closed, closed_cuts(page, laser.paths), 1e-4);
  }
}

TEST_CASE("HPGL scores with pen 1 and cuts with pen 2, within a plotter's unit") {
  for (const export_::Drawing& page : test::pages_for_machines()) {
    const export_::PathRules rules{.engraves = false, .scores = Scores::dashes};
    const std::string plt = export_::write_plt(page, mark, rules);
    CHECK(export_::read_mark_digest(plt) == mark.digest);
    const std::vector<Path> paths = export_::machine_paths(page, rules);
    std::istringstream in(plt);
    int pen = 0;
    std::size_t next = 0;
    for (std::string word; std::getline(in, word, ';');) {
      word.erase(0, word.find_first_not_of('\n'));
      if (word.starts_with("SP")) {
        pen = std::stoi(word.substr(2));
      } else if (word.starts_with("PU") && word.size() > 2) {
        REQUIRE(next < paths.size());
        const Path& path = paths[next++];
        CHECK(pen == (path.operation >= Operation::cut_inner ? 2 : 1));
        long x = 0;
        long y = 0;
        REQUIRE(std::sscanf(word.c_str(), "PU%ld,%ld", &x, &y) == 2);
        CHECK(length(Vec2{static_cast<double>(x), static_cast<double>(y)} / 40.0 - path.points[0]) < 0.02);
      }
    }
    CHECK(next == paths.size());
  }
}

TEST_CASE("the lines of a hatched area lie in it, 2 mm apart") {
  const std::vector<Vec2> tab{{10, 10}, {40, 10}, {36, 16}, {14, 16}};
  const auto lines = export_::hatching(tab, 2.0);
  CHECK(lines.size() > 10);
  for (const auto& line : lines) {
    for (const Vec2 p : line) {
      CHECK((p.y > 10.0 - 1e-9 && p.y < 16.0 + 1e-9));
    }
    CHECK(std::abs((line[1].y - line[0].y) - (line[1].x - line[0].x)) < 1e-9);
  }
}

TEST_CASE("a packaging PDF has an ink for each step, and they overprint") {
  const test::TemporaryFolder folder;
  const std::vector<export_::Drawing> pages = test::pages_for_machines();
  const auto preset = std::ranges::find(export_::presets(), "packaging", &export_::Preset::name);
  REQUIRE(preset != export_::presets().end());
  export_::SpotNames spots;
  spots.cut = "Die_Cut";
  const std::string pdf = export_::write_packaging_pdf(pages, mark, *preset, spots);
  CHECK(pdf == export_::write_packaging_pdf(pages, mark, *preset, spots));
  CHECK(export_::read_mark_digest(pdf) == mark.digest);
  for (const char* word : {"/Separation /Die_Cut", "/Separation /Crease", "/Separation /Glue", "/OP true",
                           "/GTS_ProcStepsType /Cutting", "/TrimBox"}) {
    CHECK(pdf.find(word) != std::string::npos);
  }
  CHECK(pdf.find("CutContour") == std::string::npos);
  const auto file = folder.path() / "box.pdf";
  std::ofstream(file, std::ios::binary) << pdf;
  if (!runs("qpdf --version")) {
    WARN("qpdf isn't installed: the packaging PDF isn't checked by it");
  } else {
    CHECK(runs("qpdf --check " + file.string()));
  }
  if (!runs("gs --version")) {
    WARN("Ghostscript isn't installed: separations aren't made");
    return;
  }
  REQUIRE(
      runs("gs -dBATCH -dNOPAUSE -dFirstPage=1 -dLastPage=1 -r72 -sDEVICE=tiffsep -sCompression=none -o " +
           (folder.path() / "plate.tif").string() + " " + file.string()));
  std::set<std::string> plates;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    plates.insert(entry.path().filename().string());
  }
  for (const char* ink : {"Die_Cut", "Crease", "Glue"}) {
    CAPTURE(ink);
    CHECK(std::ranges::any_of(
        plates, [&](const std::string& plate) { return plate.find(ink) != std::string::npos; }));
  }
  // What is cut or creased is printed in none of the inks of pictures.
  const auto plate = [&](const std::string& ink) {
    return tiff_dots(folder.path() / ("plate(" + ink + ").tif"));
  };
  constexpr unsigned char no_ink = 255;
  const std::string cut = plate("Die_Cut");
  const std::string crease = plate("Crease");
  CHECK(std::ranges::any_of(cut, [](char dot) { return static_cast<unsigned char>(dot) != no_ink; }));
  for (const char* ink : {"Cyan", "Magenta", "Yellow", "Black"}) {
    CAPTURE(ink);
    const std::string dots = plate(ink);
    REQUIRE(dots.size() == cut.size());
    REQUIRE(dots.size() == crease.size());
    std::size_t on_lines = 0;
    for (std::size_t i = 0; i < dots.size(); ++i) {
      const bool line =
          static_cast<unsigned char>(cut[i]) != no_ink || static_cast<unsigned char>(crease[i]) != no_ink;
      on_lines += line && static_cast<unsigned char>(dots[i]) != no_ink ? 1U : 0U;
    }
    CHECK(on_lines == 0);
  }
}

TEST_CASE("registration marks lie where cutters look for them, the same in what is printed and what is cut") {
  export_::Paper sheet;
  export_::fit_registration(sheet);
  const Box2 area = export_::piece_box(sheet);
  CHECK(area.low == Vec2{10.0, 30.0});
  CHECK(area.high == Vec2{200.0, 267.0});
  export_::Drawing page = test::pages_for_machines()[0];
  page.size = sheet.size;
  const export_::Drawing printed = export_::printed_page(page);
  page.groups.push_back(export_::registration_marks(page.size));
  std::vector<std::vector<Vec2>> in_cut;
  for (const Path& path : export_::machine_paths(page, {.engraves = false})) {
    if (path.operation == Operation::registration) {
      in_cut.push_back(path.points);
    }
  }
  REQUIRE(in_cut.size() == 3);
  Box2 marks;
  for (const auto& points : in_cut) {
    for (const Vec2 p : points) {
      marks.add(p);
    }
  }
  CHECK(marks.size() == Vec2{190.0, 277.0});
  std::size_t found = 0;
  for (const export_::Group& group : printed.groups) {
    for (const export_::Line& line : group.lines) {
      CHECK(line.layer != export_::Layer::cut);
      found +=
          group.id == export_::registration_group && std::ranges::find(in_cut, line.points) != in_cut.end()
              ? 1U
              : 0U;
    }
  }
  // What stands beside the pieces is printed; a page of nothing else needs no marks.
  CHECK(std::ranges::any_of(printed.groups, [](const export_::Group& group) {
    return std::ranges::any_of(group.texts,
                               [](const export_::Text& text) { return text.layer == export_::Layer::mark; });
  }));
  export_::Drawing list = page;
  std::erase_if(list.groups, [](const export_::Group& group) { return group.id != "page"; });
  REQUIRE(list.groups.size() == 1);
  CHECK(export_::printed_page(list).groups.size() == 1);
  CHECK(found == 2);  // the angles; the square runs the other way round where it is cut
  // They come first, so that a machine that works down a file doesn't cut them.
  CHECK(export_::machine_paths(page, {}).front().operation == Operation::registration);
}

}  // namespace ridgecraft
