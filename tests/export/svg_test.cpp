// SPDX-License-Identifier: GPL-3.0-or-later
// SVG pages: read back as XML, held against the shared checker and against weird names.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <pugixml.hpp>
#include <unistd.h>

#include "base/geometry.hpp"
#include "sample_pages.hpp"
#include "support/shapes.hpp"
#include "verify/pages/printed.hpp"

namespace ridgecraft {
namespace {

using test::drawings;
using test::mark;

/// The shapes whose pages are looked at in several tests.
std::vector<test::SamplePages> samples() {
  std::vector<test::SamplePages> all;
  all.push_back(test::sample_pages(test::cube(), 40.0, 5.0, {}, "Cube", {}, 0.3));
  const mesh::Surface ball = test::sphere(12, 7);
  const std::vector<EdgeId> cuts = test::all_edges(ball);
  all.push_back(test::sample_pages(ball, 60.0, 5.0, cuts, "Ball", export_::parse_paper("letter")));
  all.push_back(test::sample_pages(test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 25.0, 4.0, {},
                                   "Corner", export_::parse_paper("A3-landscape"), 1.1));
  all.push_back(test::sample_pages(test::revolve({{1, 0}, {0.7, 1}, {1.1, 2}}, 9), 22.0, 0.0, {}, "Vase"));
  return all;
}

class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() / ("ridgecraft-svg-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_CASE("every page passes the shared checker") {
  const std::string checker = std::string(RIDGECRAFT_SHARED_DIR) + "/check/check_svg.py";
  if (!std::filesystem::exists(checker)) {
    WARN("skipped: no " << checker);
    return;
  }
  const Folder folder;
  std::string files;
  for (const auto& sample : samples()) {
    for (const auto& page : drawings(sample)) {
      const auto file = folder / (page.title + std::to_string(page.page) + ".svg");
      std::ofstream(file, std::ios::binary) << export_::write_svg(page, mark);
      files += " '" + file.string() + "'";
    }
  }
  const auto report = folder / "report.json";
  const std::string command = "/usr/bin/python3 '" + checker + "'" + files + " > '" + report.string() + "'";
  const int status = std::system(command.c_str());
  INFO(content(report));
  CHECK(status == 0);
}

TEST_CASE("a page is true millimetres with one layer for each class of line") {
  const auto page = drawings(samples()[0])[0];
  pugi::xml_document document;
  REQUIRE(document.load_string(export_::write_svg(page, mark).c_str()));
  const auto root = document.child("svg");
  CHECK(std::string(root.attribute("width").value()) == "210mm");
  CHECK(std::string(root.attribute("height").value()) == "297mm");
  CHECK(std::string(root.attribute("viewBox").value()) == "0 0 210 297");
  CHECK_FALSE(root.attribute("transform"));
  CHECK(std::string(root.child("metadata").child_value()).find("ridgecraft-model:0123456789abcdef") !=
        std::string::npos);
  std::set<std::string> ids;
  std::size_t layers = 0;
  for (const auto group : root.children("g")) {
    CHECK(std::string(group.attribute("inkscape:groupmode").value()) == "layer");
    CHECK_FALSE(std::string(group.attribute("inkscape:label").value()).empty());
    ++layers;
  }
  // A page without colours, shadows of tabs, and places where something is glued on.
  CHECK(layers == static_cast<std::size_t>(export_::layer_count) - 3);
  for (const auto& found : document.select_nodes("//*[@id]")) {
    CHECK(ids.insert(found.node().attribute("id").value()).second);
  }
  for (const std::string id :
       {"cut", "mountain", "valley", "tab-fill", "tab-fold", "label", "piece-name", "mark"}) {
    CHECK(ids.contains(id));
  }
  const auto cuts = document.select_nodes("//g[@id='cut']/g[@id='cut-piece-A']/path");
  REQUIRE(cuts.size() == 1);
  const std::string d = cuts.first().node().attribute("d").value();
  CHECK(d.starts_with("M"));
  CHECK(d.ends_with(" Z"));
  CHECK(document.select_nodes("//*[@style or @class]").empty());
  CHECK(document.select_nodes("//*[@transform and not(self::text)]").empty());
}

TEST_CASE("layers and cuts stand in the order of work, and the settings are told") {
  const mesh::Surface frame =
      test::voxels({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}, {0, 2, 0}, {1, 2, 0}, {2, 2, 0}});
  const auto sample = test::sample_pages(frame, 15.0, 0.0, test::all_edges(frame));
  const auto page = drawings(sample)[0];
  export_::Mark told = mark;
  told.settings = {{"only", "\"a <b> & c\""}, {"seed", "7"}};
  pugi::xml_document document;
  REQUIRE(document.load_string(export_::write_svg(page, told).c_str()));
  std::vector<std::string> order;
  for (const auto group : document.child("svg").children("g")) {
    order.emplace_back(group.attribute("id").value());
  }
  CHECK(order == std::vector<std::string>{"tab-fill", "mark", "label", "piece-name", "mountain", "valley",
                                          "tab-fold", "cut"});
  const std::string words = document.child("svg").child("metadata").child_value();
  CHECK(words.ends_with(R"({"only": "a <b> & c", "seed": 7})"));
  // The square ring: its hole is cut before its outline.
  bool hole_seen = false;
  for (const export_::Group& group : page.groups) {
    double before = 0.0;
    for (const export_::Line& line : group.lines) {
      if (line.layer == export_::Layer::cut && line.closed) {
        const double area = std::abs(doubled_area(line.points));
        CHECK(area >= before);
        hole_seen = hole_seen || before > 0.0;
        before = area;
      }
    }
  }
  CHECK(hole_seen);
}

TEST_CASE(
    "the back of a page has all that was taken there: numbers, shadows of tabs, names of what is glued on") {
  const test::SamplePages sample = samples()[1];
  export_::Style style;
  style.numbers = export_::Numbers::back;
  style.tab_shadows = true;
  export_::Drawing page = export_::draw({sample.model, sample.nets, sample.pages}, style)[0];
  REQUIRE_FALSE(page.back.empty());
  export_::Text name = page.back[0].texts.at(0);
  name.layer = export_::Layer::glue;
  page.back[0].texts.push_back(name);
  std::size_t drawn = 0;
  std::set<export_::Layer> layers;
  for (const export_::Group& group : page.back) {
    drawn += group.lines.size() + group.texts.size();
    for (const export_::Line& line : group.lines) {
      layers.insert(line.layer);
    }
  }
  CHECK(layers.contains(export_::Layer::shadow));
  pugi::xml_document document;
  REQUIRE(document.load_string(export_::write_svg(page, mark).c_str()));
  CHECK(document.select_nodes("//g[@id='back']//*[self::path or self::text]").size() == drawn);
  std::set<std::string> ids;
  for (const auto& found : document.select_nodes("//*[@id]")) {
    CHECK(ids.insert(found.node().attribute("id").value()).second);
  }
}

TEST_CASE("the file of all pages has each page as its own file has it, side by side") {
  // More pages than lie in one row, on sheets of two sizes.
  std::vector<export_::Drawing> pages;
  for (const test::SamplePages& sample : samples()) {
    for (export_::Drawing& page : drawings(sample)) {
      pages.push_back(std::move(page));
    }
  }
  REQUIRE(pages.size() > 5);
  export_::Mark told = mark;
  told.settings = {{"seed", "7"}};
  const std::string all = export_::write_svg_of_all(pages, told);
  const verify::PrintedFile read = verify::read_svg("all.svg", all);
  REQUIRE(read.defect.empty());
  CHECK(read.whole);
  CHECK(read.digest == mark.digest);
  REQUIRE(read.pages.size() == pages.size());
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const verify::PrintedFile one = verify::read_svg("one.svg", export_::write_svg(pages[i], told));
    const verify::PrintedPage& page = read.pages[i];
    CHECK(page.size == one.pages.at(0).size);
    CHECK(page.number == i + 1);
    REQUIRE(page.lines.size() == one.pages[0].lines.size());
    double farthest = 0.0;
    for (std::size_t k = 0; k < page.lines.size(); ++k) {
      const verify::PrintedLine& line = page.lines[k];
      CHECK((line.layer == one.pages[0].lines[k].layer && line.pattern == one.pages[0].lines[k].pattern));
      REQUIRE(line.points.size() == one.pages[0].lines[k].points.size());
      for (std::size_t p = 0; p < line.points.size(); ++p) {
        farthest = std::max(farthest, length(line.points[p] - one.pages[0].lines[k].points[p]));
      }
    }
    CHECK(farthest < 2e-4);
  }
  pugi::xml_document document;
  REQUIRE(document.load_string(all.c_str()));
  const auto root = document.child("svg");
  const auto sheets = root.child("sodipodi:namedview").children("inkscape:page");
  std::vector<Box2> places;
  for (const auto& sheet : sheets) {
    const Vec2 low{sheet.attribute("x").as_double(), sheet.attribute("y").as_double()};
    places.push_back(
        {low, low + Vec2{sheet.attribute("width").as_double(), sheet.attribute("height").as_double()}});
  }
  Vec2 whole;
  for (const Box2& place : places) {
    whole = {std::max(whole.x, place.high.x), std::max(whole.y, place.high.y)};
  }
  std::istringstream view(root.attribute("viewBox").value());
  Vec2 low;
  Vec2 high;
  view >> low.x >> low.y >> high.x >> high.y;
  CHECK(low == Vec2{});
  CHECK(length(high - whole) < 1e-3);
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      CHECK((places[k].high.x < places[i].low.x || places[i].high.x < places[k].low.x ||
             places[k].high.y < places[i].low.y || places[i].high.y < places[k].low.y));
    }
  }
  for (const char* attribute : {"id", "inkscape:label"}) {
    std::set<std::string> different;
    for (const auto& found : document.select_nodes((std::string("//g[@") + attribute + "]").c_str())) {
      CHECK(different.insert(found.node().attribute(attribute).value()).second);
    }
  }
  CHECK(document.select_nodes("//*[@style or @class]").empty());
  CHECK(document.select_nodes("//*[@transform and not(self::text)]").empty());
}

TEST_CASE("each chain's number can be found on both of its sides") {
  for (const auto& sample : samples()) {
    std::map<std::string, int> found;
    for (const auto& page : drawings(sample)) {
      pugi::xml_document document;
      REQUIRE(document.load_string(export_::write_svg(page, mark).c_str()));
      for (const auto& text : document.select_nodes("//g[@id='label']//text")) {
        ++found[test::number_in(text.node().child_value())];
      }
    }
    std::map<std::uint32_t, int> most;
    for (const auto& join : sample.nets.joins) {
      most[join.number] += 2;
    }
    for (const auto& [number, expected] : most) {
      INFO(sample.model.model.name << " number " << number);
      CHECK(found[std::to_string(number)] <= expected);
      CHECK(found[std::to_string(number)] >= 2);
    }
  }
}

TEST_CASE("any name makes valid XML") {
  for (const std::string name : {"Füchsin_狐", "a & b <c> \"d\" 'e'", "\xff\xfe broken \xc3",
                                 "tab\tand\nline", "]]>", "", "🦊", "é", "\x01\x02",
                                 "a name that is much longer than any page is wide, so that it has to be cut "
                                 "off somewhere on the way, or not"}) {
    auto sample = test::sample_pages(test::cube(), 30.0, 5.0, {}, name);
    const std::string svg = export_::write_svg(drawings(sample)[0], mark);
    pugi::xml_document document;
    INFO(svg.substr(0, 400));
    CHECK(document.load_string(svg.c_str()));
    CHECK(
        std::ranges::none_of(svg, [](char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\n'; }));
  }
}

TEST_CASE("a page is the same in every run") {
  const auto sample = test::sample_pages(test::cube(), 40.0, 5.0, {}, "Cube", {}, 0.3);
  const std::string svg = export_::write_svg(drawings(sample)[0], mark);
  CHECK(svg == export_::write_svg(drawings(sample)[0], mark));
}

}  // namespace
}  // namespace ridgecraft
