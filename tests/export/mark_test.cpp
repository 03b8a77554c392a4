// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/sheet/mark.hpp"

#include <string>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/random.hpp"

using namespace ridgecraft;
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
