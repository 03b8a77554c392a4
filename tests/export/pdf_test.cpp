// SPDX-License-Identifier: GPL-3.0-or-later
// PDF and PNG: held against programs that read them, and against themselves.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include <catch2/catch.hpp>
#include <unistd.h>

#include "export/sheet/drawing.hpp"
#include "export/style/line_style.hpp"
#include "sample_pages.hpp"
#include "support/shapes.hpp"
#include "verify/pages/printed.hpp"

namespace ridgecraft {
namespace {

/// A file that is gone when the test ends.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& bytes, const std::string& suffix)
      : path_(std::filesystem::temp_directory_path() /
              ("ridgecraft-page-" + std::to_string(::getpid()) + suffix)) {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] std::string name() const { return "'" + path_.string() + "'"; }

 private:
  std::filesystem::path path_;
};

struct Outcome {
  int status = -1;
  std::string output;
};

Outcome run(const std::string& command) {
  Outcome outcome;
  FILE* const pipe = ::popen((command + " 2>&1").c_str(), "r");
  REQUIRE(pipe != nullptr);
  char buffer[4096];
  while (const std::size_t size = std::fread(buffer, 1, sizeof buffer, pipe)) {
    outcome.output.append(buffer, size);
  }
  outcome.status = ::pclose(pipe);
  return outcome;
}

bool there_is(const std::string& program) {
  if (std::system(("command -v " + program + " > /dev/null 2>&1").c_str()) == 0) {
    return true;
  }
  WARN("skipped: no " << program);
  return false;
}

struct Made {
  std::vector<export_::Drawing> pages;
  export_::Mark mark;
};

Made ball(const std::string& name, const std::string& paper_name) {
  const mesh::Surface surface = test::sphere(12, 7);
  const std::vector<EdgeId> cuts = test::all_edges(surface);
  const auto sample = test::sample_pages(surface, 60.0, 5.0, cuts, name, export_::parse_paper(paper_name));
  return {export_::draw({sample.model, sample.nets, sample.pages}, {}),
          {"ridgecraft test", name, "0123456789abcdef"}};
}

TEST_CASE("a PDF is clean, of the paper's size, and says what it is") {
  const Made made = ball("Füchsin & Söhne", "letter");
  const std::string bytes = export_::write_pdf(made.pages, made.mark);
  CHECK(bytes.starts_with("%PDF-"));
  CHECK(export_::read_mark_digest(bytes) == "0123456789abcdef");
  CHECK(bytes == export_::write_pdf(made.pages, made.mark));
  const TemporaryFile file(bytes, ".pdf");
  if (there_is("qpdf")) {
    const Outcome outcome = run("qpdf --check " + file.name());
    INFO(outcome.output);
    CHECK(outcome.status == 0);
    CHECK(outcome.output.find("WARNING") == std::string::npos);
    const Outcome json = run("qpdf --json " + file.name());
    CHECK(json.output.find("/PrintScaling") != std::string::npos);
    CHECK(json.output.find("Mountain folds") != std::string::npos);
  }
  if (there_is("pdfinfo")) {
    const Outcome outcome = run("pdfinfo -box " + file.name());
    INFO(outcome.output);
    CHECK(outcome.status == 0);
    CHECK(outcome.output.find("Füchsin & Söhne") != std::string::npos);
    CHECK(outcome.output.find("612 x 792 pts") != std::string::npos);
    CHECK(outcome.output.find("Pages:           " + std::to_string(made.pages.size())) != std::string::npos);
    CHECK(outcome.output.find("TrimBox:             0.00     0.00   612.00   792.00") != std::string::npos);
  }
}

TEST_CASE("a PDF tells its settings, its language, its pages, and which layers are for what") {
  Made made = ball("Ball <1>", "A4");
  made.mark.settings = {{"only", "\"wing & tail\""}, {"seed", "7"}};
  const std::string bytes = export_::write_pdf(made.pages, made.mark);
  // Metadata isn't packed, so that programs find it that know no PDF.
  CHECK(bytes.find("<dc:title><rdf:Alt><rdf:li xml:lang=\"x-default\">Ball &lt;1&gt;</rdf:li>") !=
        std::string::npos);
  CHECK(bytes.find("{&quot;only&quot;: &quot;wing &amp; tail&quot;, &quot;seed&quot;: 7}") !=
        std::string::npos);
  CHECK(export_::read_mark_digest(bytes) == "0123456789abcdef");
  const TemporaryFile file(bytes, ".pdf");
  if (there_is("qpdf")) {
    const Outcome json = run("qpdf --json " + file.name());
    for (const char* const words :
         {"/PageLabels", "/Lang", "Print without cut lines", "Cut lines only", "/OFF"}) {
      CHECK(json.output.find(words) != std::string::npos);
    }
  }
}

/// Without blanks and line breaks, which programs set as they like.
std::string letters_alone(std::string text) {
  std::erase_if(text, [](unsigned char c) { return std::isspace(c) != 0 || c == '\f'; });
  return text;
}

TEST_CASE("each word of a PDF is text that can be searched") {
  if (!there_is("pdftotext")) {
    return;
  }
  const Made made = ball("Füchsin & Söhne – 狐", "letter");
  const TemporaryFile file(export_::write_pdf(made.pages, made.mark), ".pdf");
  const std::string found = letters_alone(run("pdftotext -raw " + file.name() + " -").output);
  std::size_t texts = 0;
  for (const export_::Drawing& page : made.pages) {
    for (const export_::Group& group : page.groups) {
      for (const export_::Text& text : group.texts) {
        CAPTURE(text.text);
        CHECK(found.find(letters_alone(text.text)) != std::string::npos);
        ++texts;
      }
    }
  }
  CHECK(texts > 50);
}

TEST_CASE("numbers on the backs stand where their edges are, seen from there") {
  const mesh::Surface surface = test::sphere(12, 7);
  const auto sample = test::sample_pages(surface, 60.0, 5.0, test::all_edges(surface));
  export_::Style style;
  const auto front = export_::draw({sample.model, sample.nets, sample.pages}, style);
  style.numbers = export_::Numbers::back;
  style.turned_over = GENERATE(export_::TurnedOver::long_edge, export_::TurnedOver::short_edge);
  const auto pages = export_::draw({sample.model, sample.nets, sample.pages}, style);
  REQUIRE(pages.size() == front.size());
  const auto texts_of = [](const std::vector<export_::Group>& groups) {
    std::vector<export_::Text> texts;
    for (const export_::Group& group : groups) {
      for (const export_::Text& text : group.texts) {
        if (text.layer != export_::Layer::mark) {
          texts.push_back(text);
        }
      }
    }
    return texts;
  };
  std::size_t moved = 0;
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const Vec2 size = pages[i].size;
    const auto before = texts_of(front[i].groups);
    for (const export_::Text& text : texts_of(pages[i].back)) {
      const Vec2 there = style.turned_over == export_::TurnedOver::long_edge
                             ? Vec2{size.x - text.centre.x, text.centre.y}
                             : Vec2{text.centre.x, size.y - text.centre.y};
      CHECK(std::any_of(before.begin(), before.end(), [&](const export_::Text& other) {
        return other.text == text.text && length(other.centre - there) < 1e-9;
      }));
      CHECK(std::cos(text.angle) > -2e-3);
      ++moved;
    }
    CHECK(texts_of(pages[i].groups).size() + texts_of(pages[i].back).size() == before.size());
  }
  CHECK(moved > 50);
  const export_::Mark mark{"ridgecraft test", "Ball", "0123456789abcdef"};
  const std::string bytes = export_::write_pdf(pages, mark);
  const TemporaryFile file(bytes, ".pdf");
  if (there_is("pdfinfo")) {
    CHECK(run("pdfinfo " + file.name()).output.find("Pages:           " + std::to_string(2 * pages.size())) !=
          std::string::npos);
  }
  const verify::PrintedFile printed = verify::read_pdf("ball.pdf", bytes);
  CHECK(printed.defect.empty());
  CHECK(printed.pages.size() == pages.size());
}

TEST_CASE("a calibrated page is smaller where the printer prints larger, and is read back as it was meant") {
  const Made made = ball("Ball", "A4");
  const Vec2 measured{100.4, 99.6};
  const export_::Drawing page = export_::calibrated(made.pages[0], measured);
  for (std::size_t g = 0; g < page.groups.size(); ++g) {
    for (std::size_t i = 0; i < page.groups[g].lines.size(); ++i) {
      const Vec2 drawn = page.groups[g].lines[i].points[0] - 0.5 * page.size;
      const Vec2 meant = made.pages[0].groups[g].lines[i].points[0] - 0.5 * page.size;
      CHECK(drawn.x * measured.x / 100.0 == Approx(meant.x).margin(1e-9));
      CHECK(drawn.y * measured.y / 100.0 == Approx(meant.y).margin(1e-9));
    }
  }
  export_::Mark mark = made.mark;
  const auto plain = verify::read_svg("1.svg", export_::write_svg(made.pages[0], mark));
  mark.settings["calibrate"] = "[100.4,99.6]";
  const auto svg = verify::read_svg("1.svg", export_::write_svg(page, mark));
  const auto pdf = verify::read_pdf("1.pdf", export_::write_pdf({&page, 1}, mark));
  const auto lines_of = [](const verify::PrintedFile& file) {
    REQUIRE(file.defect.empty());
    REQUIRE(file.pages.size() == 1);
    std::vector<verify::PrintedLine> lines = file.pages[0].lines;
    std::erase_if(lines, [](const verify::PrintedLine& line) {
      return line.layer == verify::PrintedLayer::mark;  // PDF has letters there, which keep their size
    });
    return lines;
  };
  const auto meant = lines_of(plain);
  const auto of_svg = lines_of(svg);
  const auto of_pdf = lines_of(pdf);
  REQUIRE(of_svg.size() == meant.size());
  REQUIRE(of_pdf.size() == meant.size());
  for (std::size_t i = 0; i < meant.size(); ++i) {
    CHECK(length(of_svg[i].points[0] - meant[i].points[0]) < 2e-4);
    CHECK(length(of_pdf[i].points[0] - meant[i].points[0]) < 3e-3);
  }
}

TEST_CASE("the back of a sheet is calibrated as its front is") {
  const mesh::Surface surface = test::sphere(12, 7);
  const test::SamplePages sample = test::sample_pages(surface, 60.0, 5.0, test::all_edges(surface), "Ball");
  export_::Style style;
  style.numbers = export_::Numbers::back;
  const export_::Drawing meant = export_::draw({sample.model, sample.nets, sample.pages}, style)[0];
  const Vec2 measured{104.0, 97.0};
  const export_::Drawing drawn = export_::calibrated(meant, measured);
  REQUIRE_FALSE(meant.back.empty());
  REQUIRE(drawn.back.size() == meant.back.size());
  for (std::size_t g = 0; g < meant.back.size(); ++g) {
    for (std::size_t i = 0; i < meant.back[g].texts.size(); ++i) {
      const Vec2 at = drawn.back[g].texts[i].centre - 0.5 * meant.size;
      const Vec2 wanted = meant.back[g].texts[i].centre - 0.5 * meant.size;
      CHECK(at.x * measured.x / 100.0 == Approx(wanted.x).margin(1e-9));
      CHECK(at.y * measured.y / 100.0 == Approx(wanted.y).margin(1e-9));
    }
  }
}

/// A picture as pdftoppm and a PNG reader of the test's own would see it: rows of grey values.
struct Picture {
  std::size_t width = 0;
  std::size_t height = 0;
  std::string grey;
};

Picture read_pgm(const std::string& bytes) {
  Picture picture;
  std::size_t at = 2;
  const auto number = [&] {
    while (std::isspace(static_cast<unsigned char>(bytes[at])) != 0) {
      ++at;
    }
    std::size_t value = 0;
    while (std::isdigit(static_cast<unsigned char>(bytes[at])) != 0) {
      value = 10 * value + static_cast<std::size_t>(bytes[at++] - '0');
    }
    return value;
  };
  picture.width = number();
  picture.height = number();
  number();
  picture.grey = bytes.substr(at + 1);
  return picture;
}

TEST_CASE("the scale bar of a printed PDF is 50 mm long") {
  if (!there_is("pdftoppm")) {
    return;
  }
  const auto sample = test::sample_pages(test::cube(), 30.0, 5.0);
  const auto pages = export_::draw({sample.model, sample.nets, sample.pages}, {});
  const TemporaryFile file(export_::write_pdf(pages, {"ridgecraft test", "Cube", "0123456789abcdef"}),
                           ".bar.pdf");
  const Outcome outcome = run("pdftoppm -gray -r 600 " + file.name());
  const Picture picture = read_pgm(outcome.output);
  REQUIRE(picture.width == 4961);
  REQUIRE(picture.grey.size() == picture.width * picture.height);
  // The bar as the drawing has it, and the dark run of pixels there.
  for (const auto& line : pages[0].groups.back().lines) {
    if (line.points.size() == 2 && std::abs(line.points[1].x - line.points[0].x - 50.0) < 1e-9) {
      const double pixels_per_mm = 600.0 / 25.4;
      const auto row = static_cast<std::size_t>((297.0 - line.points[0].y) * pixels_per_mm);
      const auto dark = [&](std::size_t column) {
        return static_cast<unsigned char>(picture.grey[row * picture.width + column]) < 128;
      };
      auto first = static_cast<std::size_t>((line.points[0].x + 25.0) * pixels_per_mm);
      auto last = first;
      REQUIRE(dark(first));
      while (dark(first - 1)) {
        --first;
      }
      while (dark(last + 1)) {
        ++last;
      }
      // The pen's round ends and the end ticks reach out by half a pen's width.
      CHECK(static_cast<double>(last - first + 1) / pixels_per_mm == Approx(50.0 + 0.15).margin(0.06));
      return;
    }
  }
  FAIL("no scale bar");
}

TEST_CASE("each layer of a PDF can be switched off, and all of them leave the page white") {
  if (!there_is("pdftoppm")) {
    return;
  }
  const Made made = ball("Ball", "A5");
  const std::string bytes = export_::write_pdf(made.pages, made.mark);
  // The list of what is shown, "/ON [ 5 0 R 6 0 R ]", becomes one of as many bytes of what isn't.
  const std::size_t begin = bytes.find("/ON [ ", bytes.find("/D << /Creator"));
  REQUIRE(begin != std::string::npos);
  const std::size_t end = bytes.find(']', begin);
  const auto dots_without = [&](const auto& is_off) {
    std::string changed = bytes;
    changed.replace(begin, 6, "/OFF[ ");
    std::size_t number = 0;
    for (std::size_t at = begin + 6; at + 1 < end; ++number) {
      const std::size_t next = bytes.find('R', at) + 2;
      if (!is_off(number)) {
        changed.replace(at, next - at, next - at, ' ');
      }
      at = next;
    }
    const TemporaryFile file(changed, ".layers.pdf");
    return read_pgm(run("pdftoppm -gray -r 100 -f 1 -l 1 " + file.name()).output).grey;
  };
  std::vector<export_::Layer> layers;
  for (const export_::Layer layer : export_::layer_order) {
    const bool any = std::ranges::any_of(
        made.pages, [&](const export_::Drawing& page) { return export_::has_layer(page, layer); });
    if (any || !export_::is_optional(layer)) {
      layers.push_back(layer);
    }
  }
  const std::string whole = dots_without([](std::size_t) { return false; });
  for (std::size_t i = 0; i < layers.size(); ++i) {
    CAPTURE(i);
    CHECK((dots_without([i](std::size_t number) { return number == i; }) != whole) ==
          export_::has_layer(made.pages[0], layers[i]));
  }
  const std::string none = dots_without([](std::size_t) { return true; });
  CHECK(none.size() == whole.size());
  CHECK(none.find_first_not_of('\xff') == std::string::npos);
}

TEST_CASE("a PNG has the page's pixels, its scale and its mark") {
  const Made made = ball("Ball", "A5-landscape");
  const std::string bytes = export_::write_png(made.pages[0], made.mark);
  CHECK(bytes.starts_with("\x89PNG\r\n\x1a\n"));
  CHECK(export_::read_mark_digest(bytes) == "0123456789abcdef");
  CHECK(bytes == export_::write_png(made.pages[0], made.mark));
  const auto at = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(bytes[i])); };
  CHECK((at(18) << 8U | at(19)) == 1240);  // 210 mm at 150 dots per inch
  CHECK((at(22) << 8U | at(23)) == 874);   // 148 mm
  const auto scale = bytes.find("pHYs");
  REQUIRE(scale != std::string::npos);
  CHECK((at(scale + 6) << 8U | at(scale + 7)) == 5906);  // per metre
  if (there_is("/usr/bin/python3")) {
    // zlib of another program agrees with our checksums.
    const TemporaryFile file(bytes, ".png");
    const Outcome outcome =
        run("/usr/bin/python3 -c \"import sys,zlib,struct\n"
            "b=open(sys.argv[1],'rb').read();i=8\n"
            "while i<len(b):\n"
            " n,=struct.unpack('>I',b[i:i+4]);c,=struct.unpack('>I',b[i+8+n:i+12+n])\n"
            " assert zlib.crc32(b[i+4:i+8+n])==c,b[i+4:i+8]\n"
            " i+=12+n\" " +
            file.name());
    INFO(outcome.output);
    CHECK(outcome.status == 0);
  }
}

TEST_CASE("names in any script and broken ones make clean files") {
  for (const std::string name : {"Füchsin_狐", "🦊 fox", "\xff\xfe", "(a) \\ <b>", ""}) {
    const auto sample = test::sample_pages(test::cube(), 20.0, 4.0, {}, name, export_::parse_paper("A6"));
    const auto pages = export_::draw({sample.model, sample.nets, sample.pages}, {});
    const export_::Mark mark{"ridgecraft test", name, "00000000000000aa"};
    const std::string bytes = export_::write_pdf(pages, mark);
    CHECK(export_::read_mark_digest(bytes) == "00000000000000aa");
    CHECK(export_::read_mark_digest(export_::write_png(pages[0], mark)) == "00000000000000aa");
    CHECK(export_::read_mark_digest(export_::write_svg(pages[0], mark)) == "00000000000000aa");
    if (there_is("qpdf")) {
      const TemporaryFile file(bytes, ".name.pdf");
      const Outcome outcome = run("qpdf --check " + file.name());
      INFO(outcome.output);
      CHECK(outcome.status == 0);
    }
  }
}

}  // namespace
}  // namespace ridgecraft
