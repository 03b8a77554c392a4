// SPDX-License-Identifier: GPL-3.0-or-later
// What machines get: paths in order, SVG by preset, and DXF files, read back pair by pair and by ezdxf where
// it is installed.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <pugixml.hpp>

#include "base/disjoint_sets.hpp"
#include "export/machine/operations.hpp"
#include "machine_pages.hpp"
#include "sample_pages.hpp"
#include "support/shapes.hpp"
#include "support/temporary_folder.hpp"

namespace ridgecraft {
namespace {

using export_::DxfKind;
using export_::Operation;
using export_::Path;
using test::mark;

std::vector<export_::Drawing> pages() {
  return test::pages_for_machines();
}

double area(const std::vector<Vec2>& points) {
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += 0.5 * cross(points[i], points[(i + 1) % points.size()]);
  }
  return sum;
}

/// A page with a frame of 60 x 40, a hole of 20 x 10 in it, a slit, and crumbs.
export_::Drawing frame_with_crumbs() {
  const auto rectangle = [](Vec2 low, Vec2 high) {
    return std::vector<Vec2>{low, {high.x, low.y}, high, {low.x, high.y}};
  };
  export_::Group group;
  group.id = "piece-A";
  const auto add = [&](export_::Layer layer, std::vector<Vec2> points, bool closed) {
    export_::Line line;
    line.layer = layer;
    line.points = std::move(points);
    line.closed = closed;
    group.lines.push_back(std::move(line));
  };
  add(export_::Layer::cut, rectangle({50, 40}, {70, 50}), true);
  add(export_::Layer::cut, rectangle({30, 20}, {90, 60}), true);
  std::reverse(group.lines[1].points.begin(), group.lines[1].points.end());
  group.lines[1].points.insert(group.lines[1].points.begin() + 1, group.lines[1].points[0] + Vec2{0.01, 0.0});
  add(export_::Layer::cut, {{35, 30}, {35, 40}}, false);
  add(export_::Layer::cut, {{40, 30}, {40, 30.1}}, false);
  add(export_::Layer::mountain, {{30, 55}, {60, 55}, {90, 55}}, false);
  add(export_::Layer::tab_fold, {{30, 25}, {90, 25}}, false);
  export_::Text name;
  name.layer = export_::Layer::piece_name;
  name.text = "A";
  name.centre = {60, 30};
  group.texts.push_back(name);
  export_::Group furniture;
  furniture.id = "page";
  export_::Line bar;
  bar.layer = export_::Layer::mark;
  bar.points = {{10, 5}, {60, 5}};
  furniture.lines.push_back(bar);
  export_::Drawing page;
  page.groups = {furniture, group};
  return page;
}

/// Codes and values, a line each.
std::vector<std::pair<int, std::string>> pairs_of(const std::string& dxf) {
  std::vector<std::pair<int, std::string>> pairs;
  std::istringstream in(dxf);
  for (std::string code, value; std::getline(in, code) && std::getline(in, value);) {
    pairs.emplace_back(std::stoi(code), value);
  }
  return pairs;
}

/// Closed polylines of a file by layer.
std::map<std::string, std::vector<std::vector<Vec2>>> closed_polylines(const std::string& dxf) {
  std::map<std::string, std::vector<std::vector<Vec2>>> found;
  std::string entity;
  std::string layer;
  std::vector<Vec2>* at = nullptr;
  for (const auto& [code, value] : pairs_of(dxf)) {
    if (code == 0) {
      entity = value;
      at = entity == "VERTEX" ? at : nullptr;
    } else if (code == 8) {
      layer = value;
    } else if (code == 70 && (entity == "LWPOLYLINE" || entity == "POLYLINE")) {
      CHECK(std::stoi(value) == 1);
      at = &found[layer].emplace_back();
    } else if (at != nullptr && entity != "POLYLINE" && code == 10) {
      at->push_back({std::stod(value), 0.0});
    } else if (at != nullptr && entity != "POLYLINE" && code == 20) {
      at->back().y = std::stod(value);
    }
  }
  return found;
}

}  // namespace

TEST_CASE("paths are in the order of work, and none is too short to be meant") {
  const std::vector<Path> paths = export_::machine_paths(frame_with_crumbs());
  CHECK(std::is_sorted(paths.begin(), paths.end(),
                       [](const Path& a, const Path& b) { return a.operation < b.operation; }));
  const auto count = [&](Operation operation) {
    return std::count_if(paths.begin(), paths.end(), [&](const Path& p) { return p.operation == operation; });
  };
  CHECK(count(Operation::engrave) >= 2);  // the strokes of an A, and nothing of the scale bar
  CHECK(count(Operation::mountain) == 1);
  CHECK(count(Operation::valley) == 0);
  CHECK(count(Operation::tab_fold) == 1);
  CHECK(count(Operation::cut_inner) == 2);  // a hole, a slit; the other slit is a crumb
  REQUIRE(count(Operation::cut_outer) == 1);
  const Path& outline = paths.back();
  CHECK(outline.closed);
  CHECK(outline.points.size() == 4);
  CHECK(area(outline.points) == Approx(2400.0).margin(0.5));  // a crumb of 0.01 mm at a corner
  for (const Path& path : paths) {
    if (path.operation == Operation::cut_inner && path.closed) {
      CHECK(area(path.points) == Approx(-200.0));
    }
  }
}

TEST_CASE("a fold in dashes is held by bridges, at both ends, too") {
  const export_::PathRules rules{.engraves = false, .scores = export_::Scores::dashes};
  const std::vector<Path> paths = export_::machine_paths(frame_with_crumbs(), rules);
  double covered = 0.0;
  std::size_t dashes = 0;
  double least = 1000.0;
  double most = 0.0;
  for (const Path& path : paths) {
    CHECK(path.operation != Operation::engrave);
    if (path.operation == Operation::mountain) {
      ++dashes;
      for (const Vec2 p : path.points) {
        CHECK(p.y == Approx(55.0));
        least = std::min(least, p.x);
        most = std::max(most, p.x);
      }
      covered += length(path.points.back() - path.points.front());
    }
  }
  CHECK(least == Approx(31.0).margin(0.2));
  CHECK(most == Approx(89.0).margin(0.2));
  CHECK(dashes == Approx(20).margin(1));
  CHECK(covered == Approx(40.0).margin(2.0));
}

TEST_CASE("a preset's SVG has one colour for each operation, in the order of work, and nothing else") {
  for (const export_::Preset& preset : export_::presets()) {
    if (preset.simulates) {
      continue;
    }
    CAPTURE(preset.name);
    for (const export_::Drawing& page : pages()) {
      pugi::xml_document document;
      REQUIRE(document.load_string(export_::write_machine_svg(page, mark, preset).c_str()));
      const pugi::xml_node root = document.child("svg");
      CHECK(std::string(root.child("metadata").child_value()).find("preset:" + std::string(preset.name)) !=
            std::string::npos);
      CHECK_FALSE(document.select_node("//text | //*[@transform] | //*[@style] | //*[@stroke-dasharray]"));
      std::vector<std::string> ids;
      std::size_t lines = 0;
      for (const pugi::xml_node group : root.children("g")) {
        ids.emplace_back(group.attribute("id").value());
        std::set<std::string> colors;
        for (const pugi::xml_node path : group.children("path")) {
          colors.insert(path.attribute("stroke").value());
          const std::string d = path.attribute("d").value();
          lines += static_cast<std::size_t>(std::count(d.begin(), d.end(), 'M'));
          CHECK(std::string(path.attribute("fill").value()) == "none");
        }
        CHECK(colors.size() == 1);
        CHECK((!preset.joined || std::distance(group.begin(), group.end()) == 1));
      }
      REQUIRE_FALSE(ids.empty());
      CHECK(ids.back() == "cut");
      CHECK((std::find(ids.begin(), ids.end(), "engrave") != ids.end()) == preset.paths.engraves);
      CHECK(lines == export_::machine_paths(page, preset.paths).size());
    }
  }
}

TEST_CASE("a simulator finds every face and every angle of the nets") {
  const auto check = [](const test::SamplePages& sample) {
    std::size_t faces = 0;
    for (std::uint32_t page = 0; page < sample.pages.count; ++page) {
      pugi::xml_document document;
      REQUIRE(document.load_string(
          export_::write_simulator_svg(sample.model, sample.nets, sample.pages, PageId(page), mark).c_str()));
      CHECK(std::string(document.child("svg").attribute("viewBox").value()) == "0 0 21000 29700");
      std::vector<Vec2> points;
      std::set<std::pair<std::size_t, std::size_t>> edges;
      const auto number = [&](Vec2 p) {
        for (std::size_t i = 0; i < points.size(); ++i) {
          if (length(points[i] - p) < 3.0) {  // what the simulator takes for one point is one
            CHECK(length(points[i] - p) < 0.001);
            return i;
          }
        }
        points.push_back(p);
        return points.size() - 1;
      };
      DisjointSets sets(10000);
      for (const pugi::xml_node path : document.child("svg").children("path")) {
        Vec2 a;
        Vec2 b;
        REQUIRE(std::sscanf(path.attribute("d").value(), "M%lf,%lf L%lf,%lf", &a.x, &a.y, &b.x, &b.y) == 4);
        const std::size_t i = number(a);
        const std::size_t k = number(b);
        CHECK(edges.insert(std::minmax(i, k)).second);
        sets.join(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k));
        const std::string color = path.attribute("stroke").value();
        if (color == "#ff0000") {
          // Corners of cubes: 90 degrees.
          CHECK(path.attribute("stroke-opacity").as_double() == Approx(0.5).margin(1e-6));
        }
        CHECK(std::set<std::string>{"#000000", "#ff0000", "#0000ff", "#ffff00"}.contains(color));
      }
      std::set<std::uint32_t> nets;
      for (std::size_t i = 0; i < points.size(); ++i) {
        nets.insert(sets.find(static_cast<std::uint32_t>(i)));
      }
      // Euler: of each net its faces, without the outside.
      faces += nets.size() + edges.size() - points.size();
    }
    CHECK(faces == sample.model.model.surface.face_count());
  };
  check(test::sample_pages(test::cube(), 40.0, 5.0, {}, "Cube", {}, 0.3));
  check(test::sample_pages(test::voxels({{0, 0, 0}, {1, 0, 0}}), 25.0, 4.0, {}, "Brick", {}, 1.1));
}

TEST_CASE("no machine goes over a line twice") {
  struct Side {
    Vec2 a;
    Vec2 b;
  };
  for (const export_::Drawing& page : pages()) {
    CAPTURE(page.title, page.page);
    std::vector<Side> sides;
    for (const Path& path : export_::machine_paths(page, export_::PathRules{.engraves = false})) {
      for (std::size_t i = 1; i < path.points.size(); ++i) {
        sides.push_back({path.points[i - 1], path.points[i]});
      }
      if (path.closed) {
        sides.push_back({path.points.back(), path.points.front()});
      }
    }
    double twice = 0.0;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const double whole = length(sides[i].b - sides[i].a);
      const Vec2 way = (1.0 / whole) * (sides[i].b - sides[i].a);
      for (std::size_t k = i + 1; k < sides.size(); ++k) {
        const Vec2 from = sides[k].a - sides[i].a;
        const Vec2 to = sides[k].b - sides[i].a;
        if (std::max(std::abs(cross(way, from)), std::abs(cross(way, to))) < 0.005) {
          const double low = std::max(0.0, std::min(dot(way, from), dot(way, to)));
          const double high = std::min(whole, std::max(dot(way, from), dot(way, to)));
          twice = std::max(twice, high - low);
        }
      }
    }
    CHECK(twice < 0.01);
  }
}

TEST_CASE("every piece of a page has one outline round all that is done on it") {
  for (const export_::Drawing& page : pages()) {
    CAPTURE(page.title, page.page);
    std::size_t pieces = 0;
    for (const export_::Group& group : page.groups) {
      pieces += std::any_of(group.lines.begin(), group.lines.end(),
                            [](const export_::Line& line) { return line.layer == export_::Layer::cut; });
    }
    std::size_t outlines = 0;
    for (const Path& path : export_::machine_paths(page)) {
      outlines += path.operation == Operation::cut_outer ? 1U : 0U;
      for (const Vec2 p : path.points) {
        CHECK((p.x >= 0.0 && p.y >= 0.0 && p.x <= page.size.x && p.y <= page.size.y));
      }
    }
    CHECK(outlines == pieces);
  }
}

TEST_CASE("a DXF file has the outlines of its page, in millimetres, on their layers") {
  for (const export_::Drawing& page : pages()) {
    CAPTURE(page.title, page.page);
    const std::vector<Path> paths = export_::machine_paths(page);
    for (const DxfKind kind : {DxfKind::r2000, DxfKind::r12}) {
      auto found = closed_polylines(export_::write_dxf(page, mark, kind));
      std::map<std::string, std::size_t> next;
      for (const Path& path : paths) {
        if (path.closed) {
          const std::string layer = path.operation == Operation::cut_outer ? "CUT" : "CUT_INNER";
          REQUIRE(next[layer] < found[layer].size());
          const std::vector<Vec2>& read = found[layer][next[layer]++];
          REQUIRE(read.size() == path.points.size());
          for (std::size_t i = 0; i < read.size(); ++i) {
            CHECK(length(read[i] - path.points[i]) < 0.0001);
          }
        }
      }
      CHECK(next["CUT"] == found["CUT"].size());
      CHECK(next["CUT_INNER"] == found["CUT_INNER"].size());
    }
  }
}

TEST_CASE("a plain DXF file has lines on layer 0 alone, as many as there are sides") {
  const export_::Drawing page = frame_with_crumbs();
  std::size_t sides = 0;
  for (const Path& path : export_::machine_paths(page)) {
    sides += path.points.size() - (path.closed ? 0 : 1);
  }
  std::size_t lines = 0;
  for (const auto& [code, value] : pairs_of(export_::write_dxf(page, mark, DxfKind::plain))) {
    lines += code == 0 && value == "LINE" ? 1U : 0U;
    CHECK((code != 8 || value == "0"));
    CHECK((code != 0 || (value != "POLYLINE" && value != "LWPOLYLINE")));
  }
  CHECK(lines == sides);
}

TEST_CASE("a plain DXF file leaves registration marks out, as it can't tell them from cuts") {
  const export_::Drawing page = frame_with_crumbs();
  export_::Drawing marked = page;
  marked.groups.push_back(export_::registration_marks(page.size));
  CHECK(export_::write_dxf(marked, mark, DxfKind::plain) == export_::write_dxf(page, mark, DxfKind::plain));
  const std::string told = export_::write_dxf(marked, mark, DxfKind::r12);
  CHECK(closed_polylines(told)["REGMARKS"].size() > 0);
}

TEST_CASE("no two things in a DXF file have one handle") {
  for (const export_::Drawing& page : pages()) {
    std::set<std::string> handles;
    std::string seed;
    bool seed_is_next = false;
    std::size_t highest = 0;
    for (const auto& [code, value] : pairs_of(export_::write_dxf(page, mark))) {
      if (code == 9) {
        seed_is_next = value == "$HANDSEED";
      } else if (code == 5 && seed_is_next) {
        seed = value;
        seed_is_next = false;
      } else if (code == 5 || code == 105) {
        CHECK(handles.insert(value).second);
        highest = std::max<std::size_t>(highest, std::stoul(value, nullptr, 16));
      }
    }
    CHECK(std::stoul(seed, nullptr, 16) > highest);
  }
}

TEST_CASE("another reader of DXF finds nothing to mend") {
  if (std::system("/usr/bin/python3 -c 'import ezdxf' 2>/dev/null") != 0) {
    WARN("skipped: python3-ezdxf isn't installed");
    return;
  }
  const test::TemporaryFolder folder;
  std::ofstream(folder / "read.py") << R"(
import sys, ezdxf
for name in sys.argv[1:]:
    document = ezdxf.readfile(name)
    audit = document.audit()
    assert not audit.errors and not audit.fixes, (name, audit.errors, audit.fixes)
    assert document.dxfversion == "AC1009" or document.header["$INSUNITS"] == 4, name
    assert len(document.modelspace()) > 0, name
    for line in document.modelspace().query("LWPOLYLINE POLYLINE"):
        assert line.is_closed, name
    colors = {"CUT": 1, "CUT_INNER": 30, "MOUNTAIN": 5, "VALLEY": 6, "TAB": 3, "ENGRAVE": 7, "REGMARKS": 8}
    for layer in document.layers:
        assert layer.dxf.color == colors.get(layer.dxf.name, 7), (name, layer.dxf.name)
)";
  std::string command = "/usr/bin/python3 '" + (folder / "read.py").string() + "'";
  int number = 0;
  for (const export_::Drawing& page : pages()) {
    for (const DxfKind kind : {DxfKind::r2000, DxfKind::r12, DxfKind::plain}) {
      const auto file = folder / (std::to_string(number++) + ".dxf");
      std::ofstream(file, std::ios::binary) << export_::write_dxf(page, mark, kind);
      command += " '" + file.string() + "'";
    }
  }
  CHECK(std::system(command.c_str()) == 0);
}

}  // namespace ridgecraft
