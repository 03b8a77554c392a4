// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/sheet/paper.hpp"

#include <string>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/error.hpp"
#include "base/random.hpp"
#include "export/sheet/mark.hpp"

using namespace ridgecraft;
using export_::parse_paper;

namespace {

void check_size(const std::string& text, double width, double height) {
  INFO(text);
  const export_::Paper paper = parse_paper(text);
  CHECK(paper.size.x == Approx(width).epsilon(1e-12));
  CHECK(paper.size.y == Approx(height).epsilon(1e-12));
  CHECK(paper.margin == 10.0);
}

std::string refusal(const std::string& text) {
  try {
    static_cast<void>(parse_paper(text));
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::usage);
    return error.what();
  }
  FAIL("accepted: " << text);
  return {};
}

}  // namespace

TEST_CASE("papers by name have their exact sizes", "[paper]") {
  check_size("A4", 210, 297);
  check_size("a4", 210, 297);
  check_size(" a0 ", 841, 1189);
  check_size("A6", 105, 148);
  check_size("b4", 250, 353);
  check_size("jis-b4", 257, 364);
  check_size("JIS_B5", 182, 257);
  check_size("letter", 215.9, 279.4);
  check_size("Legal", 215.9, 355.6);
  check_size("tabloid", 279.4, 431.8);
  check_size("mat-12x24", 304.8, 609.6);
  check_size("A3-landscape", 420, 297);
  check_size("letter landscape", 279.4, 215.9);
  check_size("A3-portrait", 297, 420);
}

TEST_CASE("every name that is listed is known, turned as well", "[paper]") {
  for (const std::string& name : export_::paper_names()) {
    const auto upright = parse_paper(name);
    const auto lying = parse_paper(name + "-landscape");
    CHECK(upright.size.x <= upright.size.y);
    CHECK(lying.size.x == upright.size.y);
    CHECK(lying.size.y == upright.size.x);
    CHECK_NOTHROW(export_::check_paper(upright));
  }
}

TEST_CASE("papers in numbers, in millimetres unless a unit is given", "[paper]") {
  check_size("210x297", 210, 297);
  check_size("210x297mm", 210, 297);
  check_size("210mm x 297mm", 210, 297);
  check_size("21X29.7cm", 210, 297);
  check_size("8.5x11in", 215.9, 279.4);
  check_size("8.5\"x11\"", 215.9, 279.4);
  check_size("12x12 inches", 304.8, 304.8);
  check_size("12in x 300mm", 304.8, 300);
  check_size(
      "300\xC3\x97"
      "200",
      300, 200);
  check_size("300x200-portrait", 200, 300);
}

TEST_CASE("a near miss gets a proposal", "[paper]") {
  CHECK(refusal("a44") == "unknown paper 'a44', did you mean 'A4'?");
  CHECK(refusal("A9").find("A0 to A7") != std::string::npos);
  CHECK(refusal("lettre") == "unknown paper 'lettre', did you mean 'Letter'?");
  CHECK(refusal("tabliod") == "unknown paper 'tabliod', did you mean 'Tabloid'?");
  CHECK(refusal("jisb5") == "unknown paper 'jisb5', did you mean 'JIS-B5'?");
  CHECK(refusal("wallpaper").find("210x297mm") != std::string::npos);
}

TEST_CASE("sizes that can't be meant are refused", "[paper]") {
  for (const char* text : {"",
                           " ",
                           "x",
                           "210",
                           "210x",
                           "x297",
                           "210x297x3",
                           "210x297furlong",
                           "0x100",
                           "-210x297",
                           "210x-1",
                           "nanxnan",
                           "infx100",
                           "1e999x100",
                           "10x10",
                           "39.9x100",
                           "1e9x100",
                           "21x30m",
                           "-landscape",
                           "landscape",
                           "A4-landscape-landscape-",
                           "\xFF\xFE"}) {
    INFO(text);
    CHECK_FALSE(refusal(text).empty());
  }
}

TEST_CASE("margins and furniture come off the sheet", "[paper]") {
  const export_::Paper a4 = parse_paper("A4");
  const Box2 box = export_::piece_box(a4);
  CHECK(box.low == Vec2{10.0, 10.0 + export_::furniture_height});
  CHECK(box.high == Vec2{200.0, 287.0});
  CHECK(export_::piece_area(a4) == Vec2{190.0, 277.0 - export_::furniture_height});
}

TEST_CASE("margins that leave nothing are refused", "[paper]") {
  export_::Paper a6 = parse_paper("A6");
  CHECK_NOTHROW(export_::check_paper(a6));
  a6.margin = 52.0;
  CHECK_THROWS_AS(export_::check_paper(a6), Error);
  a6.margin = -1.0;
  CHECK_THROWS_AS(export_::check_paper(a6), Error);
  a6.margin = NAN;
  CHECK_THROWS_AS(export_::check_paper(a6), Error);
  a6.margin = 5.0;
  a6.gap = -0.1;
  CHECK_THROWS_AS(export_::check_paper(a6), Error);
}

using export_::read_mark_digest;
using namespace std::string_literals;

namespace {

const std::string of_model = "0123456789abcdef";
const std::string told_mark = export_::mark_word({"ridgecraft 1", "a whale", of_model});

std::string chunk(const std::string& type, const std::string& data) {
  std::string bytes;
  for (const unsigned shift : {24U, 16U, 8U, 0U}) {
    bytes += static_cast<char>((data.size() >> shift) & 0xffU);
  }
  return bytes + type + data + "crc!";
}

const std::string png = "\x89PNG\r\n\x1a\n" + chunk("IHDR", std::string(13, '\0')) +
                        chunk("tEXt", "Comment\0"s + told_mark) + chunk("IDAT", "pixels") + chunk("IEND", "");
const std::string svg = "<?xml version='1.0'?>\n<svg><metadata>\n" + told_mark + "</metadata><path/></svg>";
const std::string pdf = "%PDF-1.5\n1 0 obj\n<< /Keywords (" + told_mark + ") >>\nendobj\n";
const std::string fold = "{\n\"file_spec\": 1.2, \"ridgecraft:model_digest\" : \"" + of_model + "\"}";
const std::string obj = "# " + told_mark + "\nv 0 0 0\n";
const std::string dxf = "999\nridgecraft 1 " + told_mark + "\n  0\nSECTION\n";
const std::string html =
    "<!doctype html>\n<head>\n<meta name=\"ridgecraft-model\" content=\"" + told_mark + "\">\n";
const std::string urdf =
    "<?xml version=\"1.0\"?>\n<!-- " + told_mark + " -->\n<robot name=\"x\">\n</robot>\n";

}  // namespace

TEST_CASE("the mark is found in every format", "[mark]") {
  CHECK(read_mark_digest(obj) == of_model);
  CHECK(read_mark_digest(urdf) == of_model);
  CHECK(read_mark_digest(dxf) == of_model);
  CHECK(read_mark_digest(png) == of_model);
  CHECK(read_mark_digest(svg) == of_model);
  CHECK(read_mark_digest(pdf) == of_model);
  CHECK(read_mark_digest(fold) == of_model);
  CHECK(read_mark_digest(html) == of_model);
}

TEST_CASE("a file of another program has no mark", "[mark]") {
  CHECK(read_mark_digest("").empty());
  CHECK(read_mark_digest(" \n").empty());
  CHECK(read_mark_digest(told_mark).empty());
  CHECK(read_mark_digest("my notes: " + told_mark).empty());
  CHECK(read_mark_digest("# my notes: " + told_mark).empty());
  CHECK(read_mark_digest("<!-- " + told_mark + " --><html/>").empty());
  CHECK(read_mark_digest("<robot><!-- " + told_mark + " --></robot>").empty());
  CHECK(read_mark_digest("<svg><text>" + told_mark + "</text></svg>").empty());
  CHECK(read_mark_digest("<svg><metadata>" + told_mark).empty());
  CHECK(read_mark_digest("<!doctype html><title>" + told_mark + "</title>").empty());
  CHECK(read_mark_digest("{\"file_creator\": \"" + told_mark + "\"}").empty());
  CHECK(read_mark_digest("{\"ridgecraft:model_digest\": 12}").empty());
  CHECK(read_mark_digest("{\"ridgecraft:model_digest\": \"12\\n\"}").empty());
  CHECK(read_mark_digest("%PDF-1.4 nothing").empty());
  // A tEXt chunk behind the pixels, or one that claims to be longer than the file, isn't ours.
  CHECK(read_mark_digest("\x89PNG\r\n\x1a\n" + chunk("IDAT", "x") + chunk("tEXt", told_mark)).empty());
  CHECK(read_mark_digest("\x89PNG\r\n\x1a\n\xff\xff\xff\xfftEXt" + told_mark).empty());
}

TEST_CASE("the mark survives no byte that is cut off, and any bytes are read", "[mark]") {
  for (const std::string& whole : {png, svg, pdf, fold, obj, urdf, dxf, html}) {
    for (std::size_t size = 0; size <= whole.size(); ++size) {
      const std::string found = read_mark_digest(std::string_view(whole).substr(0, size));
      CHECK((found.empty() || of_model.starts_with(found)));
    }
    Random random(7);
    for (int round = 0; round < 2000; ++round) {
      std::string bytes = whole;
      for (int change = 0; change < 4; ++change) {
        bytes[random.below(static_cast<std::uint32_t>(bytes.size()))] = static_cast<char>(random.below(256));
      }
      CHECK(read_mark_digest(bytes).size() <= 64);
    }
  }
}
