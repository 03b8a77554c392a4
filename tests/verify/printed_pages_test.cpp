// SPDX-License-Identifier: GPL-3.0-or-later
// What is printed against the nets: the program's own pages are sound, and whatever is changed about them is
// found.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <catch2/catch.hpp>

#include "base/geometry.hpp"
#include "support/program.hpp"
#include "verify/support.hpp"

using namespace ridgecraft;
using Pages = std::vector<verify::PrintedFile>;
using verify::Pattern;
using verify::PrintedLayer;
using verify::PrintedLine;
using verify::PrintedPage;

namespace {

constexpr int printed_promise = 10;

double length_of(const PrintedLine& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    sum += length(line.points[i] - line.points[i - 1]);
  }
  return sum;
}

/// The page of either format that has the number.
PrintedPage& page(Pages& pages, std::size_t number) {
  return pages.size() > 1 ? pages.at(number - 1).pages.at(0) : pages.at(0).pages.at(number - 1);
}

/// The longest line of a layer.
PrintedLine& line(PrintedPage& of, PrintedLayer layer) {
  PrintedLine* best = nullptr;
  for (PrintedLine& candidate : of.lines) {
    if (candidate.layer == layer && (best == nullptr || length_of(candidate) > length_of(*best))) {
      best = &candidate;
    }
  }
  REQUIRE(best != nullptr);
  return *best;
}

void erase(PrintedPage& of, const PrintedLine& gone) {
  const auto at =
      std::find_if(of.lines.begin(), of.lines.end(), [&](const PrintedLine& l) { return &l == &gone; });
  of.lines.erase(at);
}

/// The line of the scale bar: the level one among the marks that is 50 mm long.
PrintedLine& bar(PrintedPage& of) {
  const auto found = std::find_if(of.lines.begin(), of.lines.end(), [](const PrintedLine& l) {
    return l.layer == PrintedLayer::mark && l.points.size() == 2 && std::abs(length_of(l) - 50.0) < 0.01;
  });
  REQUIRE(found != of.lines.end());
  return *found;
}

/// A way of 5 mm that leads at least 1 mm away from every line of the page. One that happens to lie on a line
/// is that line drawn once more.
Vec2 way_off(const PrintedPage& of, Vec2 from) {
  for (int turn = 0; turn < 36; ++turn) {
    const double angle = turn * std::numbers::pi / 18.0;
    const Vec2 way = 5.0 * Vec2{std::cos(angle), std::sin(angle)};
    bool is_off = true;
    for (const PrintedLine& l : of.lines) {
      for (std::size_t i = 1; is_off && i < l.points.size(); ++i) {
        is_off = distance_to_segment(from + way, l.points[i - 1], l.points[i]) >= 1.0;
      }
    }
    if (is_off) {
      return way;
    }
  }
  FAIL("lines all around");
  return {};
}

/// Breaks page 1 of the whale in both formats: each time there has to be a fault with these words, of no
/// other promise.
void check_found(const std::string& words, const std::function<void(PrintedPage&)>& break_page) {
  for (const bool of_pdf : {false, true}) {
    Pages pages = test::whale().pages(of_pdf);
    break_page(page(pages, 1));
    const verify::Report report = test::verify_pages(test::whale().fold, pages);
    INFO(words << (of_pdf ? ", PDF: " : ", SVG: ") << test::first_fault(report));
    CHECK(test::broken(report) == std::vector<int>{printed_promise});
    CHECK(std::any_of(report.faults.begin(), report.faults.end(), [&](const verify::Fault& fault) {
      return fault.message.find(words) != std::string::npos;
    }));
    CHECK(report.printed->faulty >= report.faults.size());
  }
}

}  // namespace

TEST_CASE("the pages of the samples show their nets, as SVG and as PDF", "[pages][slow]") {
  struct Case {
    const char* model;
    std::vector<std::string> options;
  };
  const std::vector<Case> cases = {{"fox_head.obj", {}},
                                   {"chess_rook.obj", {"--pieces", "small", "--no-tabs", "--margin", "0"}},
                                   {"gem.stl", {"--paper", "A7", "--size", "4cm"}},
                                   {"house.obj", {"--hide-folds", "0"}},
                                   {"penguin.obj", {"--hide-folds", "40", "--paper", "A3-landscape"}},
                                   {"packaging_box.obj", {"--tab-height", "9mm"}},
                                   {"torus.off", {"--faces", "60"}},
                                   {"vase.ply", {"--pieces", "few"}}};
  for (const Case& c : cases) {
    const test::WrittenJob job(test::sample(c.model), c.options);
    for (const bool of_pdf : {false, true}) {
      const verify::Report report = test::verify_pages(job.fold, job.pages(of_pdf));
      INFO(c.model << (of_pdf ? ".pdf: " : ".svg: ") << test::first_fault(report));
      CHECK(report.sound());
      REQUIRE(report.printed.has_value());
      CHECK(report.printed->pages == report.figures->pages);
      CHECK(report.printed->pages_not_given == 0);
      CHECK(report.printed->faulty == 0);
      CHECK(report.printed->max_error_mm < 0.0215);
    }
    REQUIRE(job.svg_of_all.size() == (job.svg.size() > 1 ? 1U : 0U));
    if (!job.svg_of_all.empty()) {
      const verify::Report report = test::verify_pages(job.fold, job.svg_of_all);
      INFO(c.model << ", all pages: " << test::first_fault(report));
      CHECK(report.sound());
      CHECK(report.printed->pages == report.figures->pages);
      CHECK(report.printed->pages_not_given == 0);
    }
  }
}

TEST_CASE("both formats have the same lines", "[pages]") {
  const test::WrittenJob& job = test::whale();
  REQUIRE(job.svg.size() == job.pdf.at(0).pages.size());
  for (const PrintedLayer layer :
       {PrintedLayer::cut, PrintedLayer::mountain, PrintedLayer::valley, PrintedLayer::tab_fold}) {
    const auto total = [&](const PrintedPage& of) {
      double sum = 0.0;
      for (const PrintedLine& l : of.lines) {
        sum += l.layer == layer ? length_of(l) : 0.0;
      }
      return sum;
    };
    double all = 0.0;
    for (std::size_t p = 0; p < job.svg.size(); ++p) {
      const double in_svg = total(job.svg[p].pages.at(0));
      CHECK(total(job.pdf[0].pages[p]) == Approx(in_svg).epsilon(1e-4));
      all += in_svg;
    }
    CHECK(all > 5.0);
  }
}

TEST_CASE("an outline that is 0.05 mm off its place is found", "[pages]") {
  check_found("of cut lines where the nets have", [](PrintedPage& broken) {
    for (Vec2& p : line(broken, PrintedLayer::cut).points) {
      p += Vec2{0.03, 0.04};
    }
  });
}

TEST_CASE("what a page has too little is found", "[pages]") {
  check_found("mountain fold lines of piece",
              [](PrintedPage& broken) { erase(broken, line(broken, PrintedLayer::mountain)); });
  check_found("valley fold lines of piece",
              [](PrintedPage& broken) { erase(broken, line(broken, PrintedLayer::valley)); });
  check_found("lines of piece",
              [](PrintedPage& broken) { erase(broken, line(broken, PrintedLayer::tab_fold)); });
  check_found("of the cut lines of piece", [](PrintedPage& broken) {
    // A whole piece: all that lies within the box of its outline.
    const PrintedLine outline = line(broken, PrintedLayer::cut);
    Box2 box;
    for (const Vec2 p : outline.points) {
      box.add(p);
    }
    std::erase_if(broken.lines, [&](const PrintedLine& l) {
      return l.layer != PrintedLayer::mark && std::all_of(l.points.begin(), l.points.end(), [&](Vec2 p) {
               return box.low.x - 1.0 <= p.x && p.x <= box.high.x + 1.0 && box.low.y - 1.0 <= p.y &&
                      p.y <= box.high.y + 1.0;
             });
    });
  });
  check_found("of the cut lines", [](PrintedPage& broken) {
    // One side of an outline.
    PrintedLine& outline = line(broken, PrintedLayer::cut);
    outline.points.pop_back();
  });
}

TEST_CASE("what a page has too much is found", "[pages]") {
  // From where any of the mountain folds begins.
  Pages pages = test::whale().pages(false);
  const std::vector<PrintedLine> lines = page(pages, 1).lines;
  const auto folds = std::count_if(lines.begin(), lines.end(),
                                   [](const PrintedLine& l) { return l.layer == PrintedLayer::mountain; });
  for (std::ptrdiff_t fold = 0; fold < folds; ++fold) {
    check_found("cut lines where the nets have none", [&](PrintedPage& broken) {
      auto at = broken.lines.begin();
      for (std::ptrdiff_t before = fold; at->layer != PrintedLayer::mountain || before-- > 0;) {
        ++at;
        REQUIRE(at != broken.lines.end());
      }
      const Vec2 from = at->points[0];
      broken.lines.push_back({PrintedLayer::cut, Pattern::solid, {from, from + way_off(broken, from)}});
    });
  }
  check_found("mountain fold lines where the nets have none", [](PrintedPage& broken) {
    const Vec2 middle =
        0.5 * (line(broken, PrintedLayer::cut).points[0] + line(broken, PrintedLayer::cut).points[2]);
    broken.lines.push_back({PrintedLayer::mountain, Pattern::dash_dot, {middle, middle + Vec2{7, 9}}});
  });
}

TEST_CASE("a stretch of a line that is drawn once more is the same line", "[pages]") {
  for (const bool of_pdf : {false, true}) {
    Pages pages = test::whale().pages(of_pdf);
    PrintedPage& drawn = page(pages, 1);
    const PrintedLine outline = line(drawn, PrintedLayer::cut);
    const Vec2 from = outline.points[0];
    const Vec2 way = 0.5 * (outline.points[1] - from);
    const auto report_with = [&](Vec2 off) {
      Pages more = pages;
      page(more, 1).lines.push_back({PrintedLayer::cut, Pattern::solid, {from, from + way + off}});
      return test::verify_pages(test::whale().fold, more);
    };
    const Vec2 across = perpendicular(way) / length(way);
    CHECK(report_with(0.02 * across).sound());
    CHECK(report_with(0.05 * across).faults.size() == 1);
  }
}

TEST_CASE("a line of the wrong kind is found", "[pages]") {
  check_found("where a mountain fold belongs", [](PrintedPage& broken) {
    PrintedLine& fold = line(broken, PrintedLayer::mountain);
    fold.layer = PrintedLayer::cut;
    fold.pattern = Pattern::solid;
  });
  check_found("where a mountain fold belongs", [](PrintedPage& broken) {
    PrintedLine& fold = line(broken, PrintedLayer::mountain);
    fold.layer = PrintedLayer::valley;
    fold.pattern = Pattern::dashed;
  });
  check_found("in another pattern",
              [](PrintedPage& broken) { line(broken, PrintedLayer::valley).pattern = Pattern::dash_dot; });
  check_found("in another pattern",
              [](PrintedPage& broken) { line(broken, PrintedLayer::mountain).pattern = Pattern::solid; });
  check_found("in another pattern",
              [](PrintedPage& broken) { line(broken, PrintedLayer::cut).pattern = Pattern::dashed; });
  check_found("tab base lines where the nets have none", [](PrintedPage& broken) {
    PrintedLine& base = line(broken, PrintedLayer::tab_fold);
    base.pattern = base.pattern == Pattern::dash_dot ? Pattern::dashed : Pattern::dash_dot;
  });
}

TEST_CASE("a wrong size of the sheet and a wrong scale bar are found", "[pages]") {
  check_found("mm large instead of", [](PrintedPage& broken) { broken.size.x += 0.02; });
  check_found("scale bar of 49.90 mm instead of 50 mm",
              [](PrintedPage& broken) { bar(broken).points[1].x -= 0.1; });
  check_found("has no scale bar", [](PrintedPage& broken) { erase(broken, bar(broken)); });
  check_found("ticks aren't 10 mm apart", [](PrintedPage& broken) {
    const PrintedLine whole = bar(broken);
    const Vec2 inner = whole.points[0] + Vec2{20.0, 0.0};
    for (PrintedLine& tick : broken.lines) {
      if (tick.layer == PrintedLayer::mark && tick.points.size() == 2 &&
          length(0.5 * (tick.points[0] + tick.points[1]) - inner) < 0.01) {
        tick.points[0].x += 0.5;
        tick.points[1].x += 0.5;
      }
    }
  });
  // All of a page at 99 %: the size of the sheet is right, and nothing else.
  check_found("scale bar of 49.50 mm instead of 50 mm", [](PrintedPage& broken) {
    for (PrintedLine& l : broken.lines) {
      for (Vec2& p : l.points) {
        p = 0.99 * p;
      }
    }
  });
}

TEST_CASE("numbers and names that were exchanged, changed or taken away are found", "[pages]") {
  const auto texts_of = [](PrintedPage& of, PrintedLayer layer) {
    std::vector<verify::PrintedText*> texts;
    for (verify::PrintedText& text : of.texts) {
      if (text.layer == layer) {
        texts.push_back(&text);
      }
    }
    REQUIRE(texts.size() > 2);
    return texts;
  };
  check_found("where it joins nothing", [&](PrintedPage& of) {
    const auto numbers = texts_of(of, PrintedLayer::label);
    verify::PrintedText& first = *numbers.front();
    verify::PrintedText& farthest =
        **std::max_element(numbers.begin(), numbers.end(), [&](const auto* a, const auto* b) {
          return length(a->from - first.from) < length(b->from - first.from);
        });
    std::swap(first.words, farthest.words);
  });
  check_found("has the number 9999",
              [&](PrintedPage& of) { texts_of(of, PrintedLayer::label).front()->words = "A:9999"; });
  check_found("lacks the number", [&](PrintedPage& of) {
    const std::string gone = texts_of(of, PrintedLayer::label).front()->words;
    std::erase_if(of.texts, [&](const verify::PrintedText& text) { return text.words == gone; });
  });
  check_found("has the name of", [&](PrintedPage& of) {
    for (verify::PrintedText* text : texts_of(of, PrintedLayer::name)) {
      text->from = text->to = {-100.0, -100.0};
    }
  });
  check_found("another length than its scale bar has", [](PrintedPage& of) {
    for (verify::PrintedText& text : of.texts) {
      text.words = text.words == "50 mm" ? "60 mm" : text.words;
    }
  });
}

TEST_CASE("pages that are exchanged are found", "[pages]") {
  for (const bool of_pdf : {false, true}) {
    Pages pages = test::whale().pages(of_pdf);
    std::swap(page(pages, 1).lines, page(pages, 2).lines);
    const verify::Report report = test::verify_pages(test::whale().fold, pages);
    REQUIRE(report.faults.size() == 2);
    CHECK(report.faults[0].message.find("shows page 2 of the nets instead of page 1") != std::string::npos);
    CHECK(report.faults[1].message.find("shows page 1 of the nets instead of page 2") != std::string::npos);
  }
  // Files in another order are still the pages that they say they are.
  Pages pages = test::whale().svg;
  std::reverse(pages.begin(), pages.end());
  CHECK(test::verify_pages(test::whale().fold, pages).sound());
}

TEST_CASE("pages that don't say which they are come in the order given", "[pages]") {
  Pages pages = test::whale().svg;
  for (verify::PrintedFile& file : pages) {
    file.pages[0].number.reset();
    file.pages[0].count.reset();
  }
  CHECK(test::verify_pages(test::whale().fold, pages).sound());
  std::reverse(pages.begin(), pages.end());
  CHECK_FALSE(test::verify_pages(test::whale().fold, pages).sound());
}

TEST_CASE("one page of several can be checked by itself, and twice is once too often", "[pages]") {
  const Pages all = test::whale().svg;
  const verify::Report report = test::verify_pages(test::whale().fold, {all[1]});
  CHECK(report.sound());
  CHECK(report.printed->pages == 1);
  CHECK(report.printed->pages_not_given == 1);
  CHECK(test::first_fault(test::verify_pages(test::whale().fold, {all[1], all[1]}))
            .find("as another file is") != std::string::npos);
  Pages pdf = test::whale().pdf;
  pdf[0].pages.pop_back();
  CHECK(test::first_fault(test::verify_pages(test::whale().fold, pdf)).find("has 1 page, the nets have 2") !=
        std::string::npos);
}

TEST_CASE("pages of another model, or of as many pages, are found", "[pages]") {
  Pages pages = test::whale().svg;
  pages[0].digest = "0123456789abcdef";
  CHECK(test::first_fault(test::verify_pages(test::whale().fold, pages)).find("made from another model") !=
        std::string::npos);
  pages = test::whale().svg;
  pages[0].pages[0].count = 1;
  CHECK(test::first_fault(test::verify_pages(test::whale().fold, pages))
            .find("one of 1 pages, the nets have 2") != std::string::npos);
  pages[0].pages[0].count = 3;
  CHECK(test::first_fault(test::verify_pages(test::whale().fold, pages))
            .find("one of 2 pages, another file says 3") != std::string::npos);
}

TEST_CASE("pages after those of the nets may have words, but no pieces", "[pages]") {
  Pages pdf = test::whale().pdf;
  pdf[0].pages.push_back(pdf[0].pages[0]);
  pdf[0].pages[2].number = 3;
  CHECK(test::first_fault(test::verify_pages(test::whale().fold, pdf))
            .find("is page 3 and shows pieces, the nets have 2 pages") != std::string::npos);
  std::erase_if(pdf[0].pages[2].lines,
                [](const auto& line) { return line.layer != verify::PrintedLayer::mark; });
  REQUIRE_FALSE(pdf[0].pages[2].lines.empty());
  CHECK(test::verify_pages(test::whale().fold, pdf).sound());
}

TEST_CASE("nets without pages have none that could be printed", "[pages]") {
  auto json = test::cube_file();
  json["ridgecraft:pages"] = {{{"origin", {0, 0}}, {"size", nullptr}}};
  const Pages pages = {test::whale().svg[0]};
  const verify::Report report = test::verify_pages(json.dump(), pages);
  CHECK(test::broken(report) == std::vector<int>{printed_promise});
}

TEST_CASE("the file of another program can be checked against pages, too", "[pages]") {
  // The cube of the tests is no file of this program: its settings say nothing of folds that are hidden.
  const auto json = test::cube_file();
  PrintedPage sheet;
  sheet.name = "cube.svg";
  sheet.size = {210.0, 297.0};
  const auto point = [&](const nlohmann::json& v) {
    const auto& p = json["vertices_coords"][v.get<std::size_t>()];
    return Vec2{p[0], p[1]};
  };
  for (std::size_t e = 0; e < json["edges_vertices"].size(); ++e) {
    const auto& ends = json["edges_vertices"][e];
    const bool fold = json["edges_assignment"][e] == "M";
    bool has_tab = false;
    for (const auto& tab : json["ridgecraft:tabs"]) {
      has_tab = has_tab || tab["edge"] == e;
    }
    const PrintedLayer layer = fold      ? PrintedLayer::mountain
                               : has_tab ? PrintedLayer::tab_fold
                                         : PrintedLayer::cut;
    const Pattern pattern = layer == PrintedLayer::cut ? Pattern::solid : Pattern::dash_dot;
    sheet.lines.push_back({layer, pattern, {point(ends[0]), point(ends[1])}});
  }
  for (const auto& tab : json["ridgecraft:tabs"]) {
    PrintedLine side{PrintedLayer::cut, Pattern::solid, {}};
    for (const std::size_t k : {1U, 2U, 3U, 0U}) {
      side.points.push_back({tab["polygon"][k][0], tab["polygon"][k][1]});
    }
    sheet.lines.push_back(side);
  }
  sheet.lines.push_back({PrintedLayer::mark, Pattern::solid, {{20, 12}, {70, 12}}});
  for (int i = 0; i <= 5; ++i) {
    sheet.lines.push_back(
        {PrintedLayer::mark, Pattern::solid, {{20.0 + 10.0 * i, 11}, {20.0 + 10.0 * i, 13}}});
  }
  verify::PrintedFile file;
  file.name = "cube.svg";
  file.pages = {sheet};
  const verify::Report sound = test::verify_pages(json.dump(), {file});
  INFO(test::first_fault(sound));
  CHECK(sound.sound());
  file.pages[0].lines[0].points[0] += Vec2{0.05, 0.05};
  CHECK_FALSE(test::verify_pages(json.dump(), {file}).sound());
}

TEST_CASE("what is changed within a PDF is found", "[pages]") {
  const test::WrittenJob& job = test::whale();
  REQUIRE(test::run_command({"qpdf", "--qdf", "--object-streams=disable", (job.folder / "whale.pdf").string(),
                             (job.folder / "plain.pdf").string()})
              .exit_code == 0);
  const std::string plain = test::read_bytes(job.folder / "plain.pdf");
  // As many bytes as before, so that the file stays whole.
  const auto fault_after = [&](const std::string& from, const std::string& to, std::size_t after = 0) {
    REQUIRE(from.size() == to.size());
    std::string bytes = plain;
    const std::size_t at = bytes.find(from, after);
    REQUIRE(at != std::string::npos);
    bytes.replace(at, from.size(), to);
    return test::first_fault(test::verify_pages(job.fold, {verify::read_pdf("plain.pdf", bytes)}));
  };
  CHECK(test::verify_pages(job.fold, {verify::read_pdf("plain.pdf", plain)}).sound());
  // Of the layers that are seen by default; others may be chosen.
  CHECK(fault_after("/ON [", "/OFF[", plain.find("/Name (All)")).find("is switched off") !=
        std::string::npos);
  CHECK(fault_after("/Name (Cut)", "/Name (Cup)").find("in no layer of ours") != std::string::npos);
  CHECK(fault_after("/cut Do", "% cut  ").find("of the cut lines of piece") != std::string::npos);
  // Boxes of the page: what isn't the whole sheet hides the rest.
  std::string cropped = plain;
  const std::size_t box = cropped.find("/TrimBox [");
  REQUIRE(box != std::string::npos);
  cropped.replace(box, 8, "/CropBox");
  cropped.replace(cropped.find("595.2756", box), 8, "495.2756");
  CHECK(test::first_fault(test::verify_pages(job.fold, {verify::read_pdf("plain.pdf", cropped)}))
            .find("crop box") != std::string::npos);
  // A layer that is 1 point off the others, and white lines.
  const std::size_t cut = plain.find("0.566929 w");
  REQUIRE(cut != std::string::npos);
  const std::size_t matrix = plain.rfind(" cm", cut);
  const std::size_t line = plain.rfind("1 0 0 -1 0 ", matrix);
  CHECK(fault_after("1 0 0 -1 0 ", "1 0 0 -1 1 ", line).find("from a cut") != std::string::npos);
  const std::size_t colour = plain.rfind("0 0 0 RG", cut);
  CHECK(fault_after("0 0 0 RG", "1 1 1 RG", colour).find("of the cut lines of piece") != std::string::npos);
}

TEST_CASE("what may change how a PDF's lines look, and isn't ours, is refused", "[pages]") {
  const test::WrittenJob& job = test::whale();
  REQUIRE(test::run_command({"qpdf", "--qdf", "--object-streams=disable", (job.folder / "whale.pdf").string(),
                             (job.folder / "plain.pdf").string()})
              .exit_code == 0);
  const std::string plain = test::read_bytes(job.folder / "plain.pdf");
  // Each place where some words are, changed by itself; how many of these changes are found by this sentence.
  const auto found_as = [&](const std::string& from, const std::string& to, const std::string& words) {
    REQUIRE(from.size() == to.size());
    std::size_t found = 0;
    for (std::size_t at = plain.find(from); at != std::string::npos; at = plain.find(from, at + 1)) {
      std::string bytes = plain;
      bytes.replace(at, from.size(), to);
      const std::string fault =
          test::first_fault(test::verify_pages(job.fold, {verify::read_pdf("plain.pdf", bytes)}));
      found += fault.find(words) != std::string::npos ? 1U : 0U;
    }
    return found;
  };
  CHECK(found_as("/TrimBox [", "/Annots  [", "has annotations, which may be printed") == 2);
  // Layers of lines on two pages: at least those for cuts, folds and bases of tabs.
  CHECK(found_as("/BBox [\n    0\n    0\n    595", "/BBox [\n    0\n    0\n    005", "a line is cut off") >=
        6);
  CHECK(found_as("/ca 1", "/BM 1", "its graphics state has /BM, which may change what is printed") >= 6);
}

TEST_CASE("a PDF that another tool has turned round, reordered or cropped is found", "[pages]") {
  const test::WrittenJob& job = test::whale();
  const auto after = [&](const std::vector<std::string>& how) {
    std::vector<std::string> command{"qpdf", (job.folder / "whale.pdf").string()};
    command.insert(command.end(), how.begin(), how.end());
    command.push_back((job.folder / "other.pdf").string());
    REQUIRE(test::run_command(command).exit_code == 0);
    return verify::read_pdf("other.pdf", test::read_bytes(job.folder / "other.pdf"));
  };
  CHECK(test::verify_pages(job.fold, {after({"--linearize"})}).sound());
  CHECK(test::verify_pages(job.fold, {after({"--qdf"})}).sound());
  CHECK(test::first_fault(test::verify_pages(job.fold, {after({"--pages", ".", "2,1", "--"})}))
            .find("shows page 2") != std::string::npos);
  CHECK(test::first_fault(test::verify_pages(job.fold, {after({"--rotate=+90:1"})})).find("is turned") !=
        std::string::npos);
  CHECK(test::first_fault(test::verify_pages(job.fold, {after({"--pages", ".", "1", "--"})}))
            .find("has 1 page") != std::string::npos);
}
