// SPDX-License-Identifier: GPL-3.0-or-later
// Reading printed pages: what is understood, and that nothing is overlooked in silence.
#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/random.hpp"
#include "verify/file/file.hpp"
#include "verify/pages/check_pages.hpp"
#include "verify/pages/printed.hpp"
#include "verify/pages/readers.hpp"
#include "verify/support.hpp"

using namespace ridgecraft;
using namespace ridgecraft::verify;
using test::replaced;

namespace {

std::string svg_with(const std::string& content,
                     const std::string& root = "width=\"100mm\" height=\"50mm\" viewBox=\"0 0 100 50\"") {
  return "<?xml version=\"1.0\"?><svg xmlns=\"http://www.w3.org/2000/svg\" "
         "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" " +
         root + "><title>A \xE2\x80\x93 page 2 of 3</title><metadata>x ridgecraft-model:00ff</metadata>" +
         content + "</svg>";
}

std::string cut_layer(const std::string& content) {
  return "<g inkscape:groupmode=\"layer\" id=\"cut\" fill=\"none\"><g id=\"cut-a\">" + content + "</g></g>";
}

std::string defect_of(const std::string& svg) {
  const PrintedFile file = read_svg("x.svg", svg);
  CHECK(file.pages.empty() == !file.defect.empty());
  return file.defect;
}

/// What a content stream strokes.
std::vector<std::pair<InkPath, InkState>> strokes_of(std::string_view content) {
  std::vector<std::pair<InkPath, InkState>> strokes;
  const ContentEvents events{
      .path = [&](const InkPath& path, const InkState& state) { strokes.emplace_back(path, state); },
      .object = [](std::string_view, const InkState&) {},
      .hides_lines = [](std::string_view name) -> std::optional<bool> {
        return name == "thick" ? std::nullopt : std::optional(name == "clear");
      },
      .text = [](const InkText&, const InkState&) {},
      .other = [] {}};
  read_content(content, {}, events);
  return strokes;
}

}  // namespace

TEST_CASE("an SVG page is read in millimetres, y up", "[pages]") {
  const PrintedFile file = read_svg(
      "x.svg",
      svg_with(cut_layer("<path stroke=\"#000000\" stroke-width=\"0.2\" d=\"M10,10 L20,10 20,5 Z\"/>")));
  REQUIRE(file.defect.empty());
  CHECK(file.digest == "00ff");
  CHECK_FALSE(file.whole);
  REQUIRE(file.pages.size() == 1);
  const PrintedPage& page = file.pages[0];
  CHECK(page.size == Vec2{100, 50});
  CHECK(page.number == 2);
  CHECK(page.count == 3);
  REQUIRE(page.lines.size() == 1);
  CHECK(page.lines[0].points == std::vector<Vec2>{{10, 40}, {20, 40}, {20, 45}, {10, 40}});
  CHECK(page.lines[0].pattern == Pattern::solid);
}

TEST_CASE("the unit of an SVG page is that of its width", "[pages]") {
  const PrintedFile file =
      read_svg("x.svg", svg_with(cut_layer("<path stroke=\"#000\" d=\"M0,0 H100\"/>"),
                                 "width=\"200mm\" height=\"100mm\" viewBox=\"0 0 100 50\""));
  REQUIRE(file.pages.size() == 1);
  CHECK(file.pages[0].lines.at(0).points == std::vector<Vec2>{{0, 100}, {200, 100}});
}

TEST_CASE("an SVG file of several pages has each in a layer of its own", "[pages]") {
  const std::string view =
      "<sodipodi:namedview xmlns:sodipodi=\"s\"><inkscape:page x=\"0\" y=\"0\" width=\"100\" height=\"50\"/>"
      "<inkscape:page x=\"110\" y=\"60\" width=\"80\" height=\"40\"/></sodipodi:namedview>";
  const auto page = [](int number, const std::string& content) {
    const std::string id = "page-" + std::to_string(number);
    return "<g inkscape:groupmode=\"layer\" id=\"" + id + "\"><g inkscape:groupmode=\"layer\" id=\"" + id +
           "-cut\" fill=\"none\">" + content + "</g></g>";
  };
  const std::string path = "<path stroke=\"#000000\" d=\"M120,70 L130,70\"/>";
  const PrintedFile file = read_svg("x.svg", svg_with(view + page(1, "") + page(2, path)));
  INFO(file.defect);
  CHECK(file.whole);
  REQUIRE(file.pages.size() == 2);
  CHECK(file.pages[0].lines.empty());
  CHECK(file.pages[1].name == "page 2 of x.svg");
  CHECK(file.pages[1].number == 2);
  CHECK(file.pages[1].count == 2);
  CHECK(file.pages[1].size == Vec2{80, 40});
  CHECK(file.pages[1].lines.at(0).points == std::vector<Vec2>{{10, 30}, {20, 30}});
  // What lies on no page, or on a page twice, could be overlooked.
  CHECK(defect_of(svg_with(view + page(1, ""))).find("page 2 has no layer") != std::string::npos);
  CHECK(defect_of(svg_with(view + page(1, "") + page(2, "") + page(3, ""))).find("belongs to no page") !=
        std::string::npos);
  CHECK(defect_of(svg_with(view + page(1, "") + page(2, "") + page(2, ""))).find("on no page") !=
        std::string::npos);
  CHECK(defect_of(svg_with(view + page(1, "") + page(2, "") + cut_layer(path))).find("on no page") !=
        std::string::npos);
  CHECK(defect_of(svg_with(view + page(1, "") + page(2, "") + path)).find("on no page") != std::string::npos);
  CHECK(defect_of(svg_with(replaced(view, "x=\"110\"", "x=\"far\"") + page(1, "") + page(2, "")))
            .find("the x of one of its pages") != std::string::npos);
  CHECK(defect_of(svg_with(view + page(1, "") + replaced(page(2, ""), "id=\"page-2-cut\"", "id=\"cut\"")))
            .find("no layer of ours") != std::string::npos);
  CHECK(defect_of(svg_with(view + page(1, "") +
                           replaced(page(2, path), "id=\"page-2\"", "id=\"page-2\" transform=\"scale(2)\"")))
            .find("transform") != std::string::npos);
}

TEST_CASE("invisible lines are no lines", "[pages]") {
  for (const char* look : {"stroke=\"none\"", "stroke=\"#ffffff\"", "stroke=\"white\"",
                           "stroke=\"#000000\" stroke-width=\"0\"", ""}) {
    const PrintedFile file =
        read_svg("x.svg", svg_with(cut_layer(std::string("<path ") + look + " d=\"M0,0 L1,1\"/>")));
    INFO(look);
    REQUIRE(file.pages.size() == 1);
    CHECK(file.pages[0].lines.empty());
  }
  CHECK(strokes_of("1 G 0 0 m 1 1 l S").at(0).second.white);
  CHECK(strokes_of("1 1 1 RG 0 0 m 1 1 l S").at(0).second.white);
  CHECK(strokes_of("0 0 0 0 K 0 0 m 1 1 l S").at(0).second.white);
  CHECK_FALSE(strokes_of("0 0 0 1 K 0 0 m 1 1 l S").at(0).second.white);
  CHECK(strokes_of("/clear gs 0 0 m 1 1 l S").at(0).second.hidden);
  CHECK_FALSE(strokes_of("/clear gs /full gs 0 0 m 1 1 l S").at(0).second.hidden);
  // A state that says nothing of opacity leaves it.
  CHECK(strokes_of("/clear gs /thick gs 0 0 m 1 1 l S").at(0).second.hidden);
}

TEST_CASE("what may move, hide or add a line in an SVG page is a defect", "[pages]") {
  const std::string path = "<path stroke=\"#000000\" d=\"M0,0 L1,1\"";
  CHECK(defect_of(svg_with(cut_layer(path + "/>"))).empty());
  CHECK(defect_of(svg_with(cut_layer(path + " transform=\"scale(2)\"/>"))).find("transform") !=
        std::string::npos);
  CHECK(defect_of(svg_with(cut_layer(path + " style=\"display:none\"/>"))).find("style") !=
        std::string::npos);
  CHECK(defect_of(svg_with(cut_layer(path + " fill=\"#000000\"/>"))).find("area") != std::string::npos);
  CHECK(defect_of(svg_with(cut_layer("<rect width=\"3\" height=\"3\"/>"))).find("<rect>") !=
        std::string::npos);
  CHECK(defect_of(svg_with(path + "/>")).find("no layer") != std::string::npos);
  CHECK(defect_of(svg_with("<g id=\"cut\">" + path + "/></g>")).find("no layer") != std::string::npos);
  CHECK(defect_of(svg_with("<g inkscape:groupmode=\"layer\" id=\"extra\">" + path + "/></g>"))
            .find("no layer") != std::string::npos);
  CHECK(defect_of(svg_with("", "width=\"100\" height=\"50\" viewBox=\"0 0 100 50\"")).find("millimetres") !=
        std::string::npos);
  CHECK(defect_of(svg_with("", "width=\"100mm\" height=\"50mm\"")).find("viewBox") != std::string::npos);
  CHECK(defect_of(svg_with(cut_layer(path + "/>")).substr(0, 300)).find("isn't XML") != std::string::npos);
  CHECK(defect_of("<html><svg/></html>").find("<html>") != std::string::npos);
  std::string nested = path + "/>";
  for (int i = 0; i < 60; ++i) {
    nested = "<g>" + nested + "</g>";
  }
  CHECK(defect_of(svg_with(cut_layer(nested))).find("nested deeper") != std::string::npos);
}

TEST_CASE("path data are straight lines or refused", "[pages]") {
  using Lines = std::vector<std::vector<Vec2>>;
  CHECK(path_lines("M1,2 L3,4") == Lines{{{1, 2}, {3, 4}}});
  CHECK(path_lines("M1 2 3 4") == Lines{{{1, 2}, {3, 4}}});
  CHECK(path_lines("m1,2 l1,0 v-1.5e0 h.5 z") == Lines{{{1, 2}, {2, 2}, {2, 0.5}, {2.5, 0.5}, {1, 2}}});
  CHECK(path_lines("M0,0L1,0ZL5,5") == Lines{{{0, 0}, {1, 0}, {0, 0}}, {{0, 0}, {5, 5}}});
  CHECK(path_lines("M0,0 M1,1").empty());
  CHECK(path_lines("").empty());
  for (const char* bad : {"M0,0 C1,1 2,2 3,3", "M0,0 A1,1 0 0 0 2,2", "L1,1", "Z", "1,1", "M0", "M0,0 L",
                          "M0,0 L1,x", "M0,0 Z 1,1", "M1e99,0 L0,0", "M nan,0", "\xff"}) {
    INFO(bad);
    CHECK_THROWS_AS(path_lines(bad), NotInForm);
  }
}

TEST_CASE("the operators of a content stream move and bend lines as the standard says", "[pages]") {
  const auto strokes = strokes_of(
      "% a comment\nq 2 0 0 -2 10 20 cm [3 1.5] 0 d 0.5 w 1 2 m 3 2 l h S Q\n"
      "0 0 4 3 re s 0 0 m 1 1 2 2 3 3 c S (te(x)t) BT /F1 12 Tf (a\\)b) Tj ET /P <</MCID 0>> BDC EMC");
  CHECK_THROWS_AS(strokes_of("0 0 m S Q"), NotInForm);
  REQUIRE(strokes.size() == 3);
  CHECK(strokes[0].first.lines == std::vector<std::vector<Vec2>>{{{12, 16}, {16, 16}, {12, 16}}});
  CHECK(strokes[0].second.dashes == std::vector<double>{3, 1.5});
  CHECK(strokes[0].second.matrix.scale() == 2.0);
  CHECK(strokes[1].second.dashes.empty());
  CHECK(strokes[1].first.lines.at(0).size() >= 5);
  CHECK(strokes[2].first.curved);
}

TEST_CASE("content that can't be checked is refused", "[pages]") {
  for (const char* bad : {"1 2 m 3 l S", "BI ID x EI", "frobnicate", "1 1 l S", "0 0 m 1 0 l 0 1 l h W n",
                          "(open", "<< /a 1", "1e5 0 m", "1--2 0 m", "/OC /a BDC", "{ }", "<12"}) {
    INFO(bad);
    CHECK_THROWS_AS(strokes_of(bad), NotInForm);
  }
  std::string deep;
  for (int i = 0; i < 5000; ++i) {
    deep += "q ";
  }
  CHECK_THROWS_AS(strokes_of(deep), NotInForm);
  CHECK(strokes_of("0 0 10 10 re W n 1 1 m 2 2 l S").at(0).second.window->high == Vec2{10, 10});
}

TEST_CASE("damaged PDF and SVG files have a defect", "[pages]") {
  const test::WrittenJob& job = test::whale();
  const std::string pdf = test::read_bytes(job.folder / "whale.pdf");
  const std::string svg = test::read_bytes(job.folder / "whale-1.svg");
  CHECK(is_pdf(pdf));
  CHECK_FALSE(is_svg(pdf));
  CHECK(is_svg(svg));
  CHECK_FALSE(is_pdf(svg));
  CHECK_FALSE(read_pdf("x.pdf", pdf.substr(0, pdf.size() / 2)).defect.empty());
  CHECK_FALSE(read_pdf("x.pdf", "%PDF-1.4\n").defect.empty());
  CHECK_FALSE(read_pdf("x.pdf", "").defect.empty());
  CHECK_FALSE(read_svg("x.svg", svg.substr(0, svg.size() / 2)).defect.empty());
  // Whatever else the bytes say, reading them ends, and says something.
  Random random(7);
  for (int round = 0; round < 60; ++round) {
    std::string bytes = round % 2 == 0 ? pdf : svg;
    for (int edit = 0; edit < 3; ++edit) {
      bytes[random.below(static_cast<std::uint32_t>(bytes.size()))] = static_cast<char>(random.below(256));
    }
    const PrintedFile file = round % 2 == 0 ? read_pdf("x.pdf", bytes) : read_svg("x.svg", bytes);
    CHECK(file.pages.empty() == !file.defect.empty());
  }
}

TEST_CASE("lines lie on lines as sets of points", "[pages]") {
  const LineSet set({{{0, 0}, {5, 0}}, {{5.001, 0.001}, {10, 0}}, {{20, 20}, {20, 20}}});
  CHECK_FALSE(set.bare({{0, 0}, {10, 0}}, 0.01));
  CHECK_FALSE(set.bare({{10, 0.005}, {2, 0}}, 0.01));
  CHECK(set.bare({{0, 0}, {10, 0}}, 0.0001));
  const auto beyond = set.bare({{8, 0}, {12, 0}}, 0.01);
  REQUIRE(beyond);
  CHECK(beyond->length == Approx(1.99));
  CHECK(beyond->middle.x == Approx(11.005));
  CHECK(set.bare({{0, 0.02}, {10, 0.02}}, 0.01)->length == Approx(10.0));
  // Across: only what is near the crossing lies on the line.
  CHECK(set.bare({{3, -1}, {3, 1}}, 0.01)->length == Approx(1.98));
  CHECK_FALSE(set.bare({{20, 20}, {20, 20}}, 0.01));
  CHECK(set.distance_to({3, 0.5}, 1.0) == Approx(0.5));
  CHECK_FALSE(set.distance_to({3, 1.5}, 1.0));
  CHECK_FALSE(LineSet().distance_to({0, 0}, 1.0));
  CHECK(LineSet().bare({{0, 0}, {1, 0}}, 0.01)->length == Approx(1.0));
}

TEST_CASE("what may change how an SVG page looks, and isn't ours, is refused", "[pages]") {
  const std::string layer = cut_layer("<path stroke=\"#000000\" d=\"M10,10 L20,10\"/>");
  REQUIRE(defect_of(svg_with(layer)).empty());
  const auto before_root = [&](const std::string& text) {
    std::string svg = svg_with(layer);
    return defect_of(svg.insert(svg.find("<svg"), text));
  };
  CHECK(before_root("<!-- words -->").empty());
  CHECK(before_root("<?xml-stylesheet href=\"data:text/css,%23cut{display:none}\"?>")
            .find("has a processing instruction") != std::string::npos);
  CHECK(before_root("<!DOCTYPE svg [<!ATTLIST path stroke-opacity CDATA \"0\">]>")
            .find("has a document type") != std::string::npos);
  CHECK(defect_of(svg_with("<desc><style>path{display:none}</style></desc>" + layer))
            .find("its <desc> has a <style>") != std::string::npos);
  CHECK(
      defect_of(svg_with(layer, "width=\"100mm\" height=\"50mm\" viewBox=\"0 0 100 50\" style=\"opacity:0\""))
          .find("its root has the attribute \"style\"") != std::string::npos);
}
