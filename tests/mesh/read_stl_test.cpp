// SPDX-License-Identifier: GPL-3.0-or-later
#include <bit>

#include <catch2/catch.hpp>

#include "mesh/file_writers.hpp"
#include "reading.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
using mesh::FileFormat;
using mesh::RepairKind;
using mesh::Soup;

namespace {

void append(std::string& bytes, std::uint32_t value) {
  for (unsigned i = 0; i < 4; ++i) {
    bytes += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
  }
}

/// Facets whose coordinates count up, under a header that says `count`.
std::string binary(std::uint32_t count, int facets, const std::string& header = "binary") {
  std::string bytes = header;
  bytes.resize(80, '\0');
  append(bytes, count);
  float next = 0.25F;
  for (int i = 0; i < facets; ++i) {
    for (int k = 0; k < 12; ++k) {
      append(bytes, std::bit_cast<std::uint32_t>(k < 3 ? 0.0F : next++));
    }
    bytes += "xx";
  }
  return bytes;
}

constexpr std::string_view facet =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n endloop\nendfacet\n";

}  // namespace

TEST_CASE("STL: binary facets have points of their own") {
  const Soup soup = parsed(binary(2, 2), "stl");
  CHECK(soup.format == FileFormat::stl_binary);
  REQUIRE(soup.points.size() == 6);
  CHECK(soup.points[5] == Vec3{15.25, 16.25, 17.25});
  CHECK(soup.corner_point == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5});
  CHECK(soup.remarks.entries().empty());
  CHECK(parsed(binary(2, 2, "solid of facets"), "stl").format == FileFormat::stl_binary);
  CHECK(parsed(binary(2, 2, "OFF"), "").format == FileFormat::stl_binary);
  CHECK(parsed(binary(2, 2, "\x89PNG\r\n\x1a\n"), "").format == FileFormat::stl_binary);
}

TEST_CASE("STL: the count of a binary file is held against its size") {
  for (const std::uint32_t count : {0U, 1U, 4U}) {
    const Soup soup = parsed(binary(count, 5), "stl");
    CHECK(soup.polygon_count() == 5);
    CHECK(soup.remarks.count(RepairKind::count_corrected) == 1);
  }
  const Soup longer = parsed(binary(2, 2) + "end", "stl");
  CHECK(longer.polygon_count() == 2);
  CHECK(longer.remarks.count(RepairKind::trailing_data_ignored) == 3);
  const std::string whole = binary(3, 3);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    INFO(size);
    CHECK(refusal(whole.substr(0, size), "stl").starts_with("3 "));
  }
  CHECK(refusal(binary(4294967295U, 2), "stl").find("4294967295 facets") != std::string::npos);
  CHECK(refusal(binary(0, 0), "stl") == "4 model.stl has no faces");
  std::string bad = binary(2, 2);
  bad.replace(84 + 50 + 24, 4, std::string("\x00\x00\xc0\x7f", 4));
  CHECK(refusal(bad, "stl") == "4 model.stl, byte 158: a coordinate of facet 2 is not finite");
}

TEST_CASE("STL: ASCII files of one solid or several, in any case") {
  const std::string one = "solid a b\n" + std::string(facet) + "endsolid a b\n";
  CHECK(parsed(one, "stl").format == FileFormat::stl_ascii);
  CHECK(parsed(one + one, "stl").polygon_count() == 2);
  std::string upper = one;
  std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return std::toupper(c); });
  CHECK(parsed(upper, "stl").points == parsed(one, "stl").points);
  CHECK(parsed("solid\nfacet\nouter loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet endsolid",
               "stl")
            .polygon_count() == 1);
  CHECK(parsed("solid endsolid facet\n" + std::string(facet) + "endsolid", "stl").polygon_count() == 1);
  CHECK(parsed("solid a\n" + std::string(facet), "stl").remarks.count(RepairKind::missing_end) == 1);
  CHECK(parsed(one + "more\n", "stl").remarks.count(RepairKind::trailing_data_ignored) > 0);
}

TEST_CASE("STL: an ASCII file that is cut off anywhere is refused or whole") {
  const std::string text = "solid a\n" + std::string(facet) + std::string(facet);
  for (std::size_t size = 8; size < text.size(); ++size) {
    INFO(text.substr(0, size));
    const std::string_view start = std::string_view(text).substr(0, size);
    const bool between = start.ends_with("endfacet") || start.ends_with("endfacet\n");
    CHECK(refusal(start, "stl").empty() == between);
  }
}

TEST_CASE("STL: blanks after the last facet are no reason to refuse a file, a facet's indentation is") {
  const std::string indented = "solid a\n  " + std::string(facet);
  for (const std::string_view end : {" ", "\t", "\n\t", "\n   ", "\n  \n"}) {
    CHECK(parsed(indented.substr(0, indented.size() - 1) + std::string(end), "stl")
              .remarks.count(RepairKind::missing_end) == 1);
  }
  CHECK(refusal(indented + "  ", "stl").starts_with("3 "));
  CHECK(refusal(indented + " ", "stl").starts_with("3 "));
}

TEST_CASE("STL: refusals of ASCII files name the line") {
  const auto with = [&](std::string_view word, std::string_view other) {
    std::string text = "solid a\n" + std::string(facet) + "endsolid\n";
    return text.replace(text.find(word), word.size(), other);
  };
  CHECK(refusal(with("vertex 1 0 0", "vertex 1 x 0"), "stl") ==
        "3 model.stl, line 5: a number is expected, not \"x\"");
  CHECK(refusal(with("vertex 1 0 0", "vertex 1 nan 0"), "stl").starts_with("4 model.stl, line 5: "));
  CHECK(refusal(with("  vertex 1 0 0\n", ""), "stl") ==
        "3 model.stl, line 2: facet 1 has 2 corners instead of 3");
  CHECK(refusal(with("vertex 1 0 0", "vertex 1 0"), "stl").starts_with("3 "));
  CHECK(refusal(with("endloop", "endlop"), "stl").starts_with("3 model.stl, line 7: "));
  CHECK(refusal(with("outer", "inner"), "stl").starts_with("3 model.stl, line 3: "));
}

TEST_CASE("STL: attribute bytes are the colours that VisCAM or Magics write") {
  const auto painted = [](const std::string& header, const std::vector<unsigned>& attributes) {
    std::string bytes = header;
    bytes.resize(80, ' ');
    bytes += bytes4(static_cast<std::uint32_t>(attributes.size()));
    for (const unsigned attribute : attributes) {
      bytes += float_bytes({0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0}) + bytes2(attribute);
    }
    return parsed(bytes, "stl");
  };
  const auto colour = [](const Soup& soup, std::size_t facet) {
    return soup.materials.at(soup.polygon_material.at(facet)).colour;
  };
  const mesh::Colour red{1, 0, 0};
  const mesh::Colour blue{0, 0, 1};
  // Bit 15 marks a colour, blue is in the lowest bits.
  const Soup viscam = painted("VisCAM", {0xfc00, 0x801f, 0});
  CHECK(colour(viscam, 0) == red);
  CHECK(colour(viscam, 1) == blue);
  CHECK(colour(viscam, 2) == std::nullopt);
  // Magics has one for the whole, and bit 15 marks facets that have it; red is in the lowest bits.
  const Soup magics = painted(std::string("COLOR=\x00\x00\xff\xff", 10) + " from Magics", {0x001f, 0x8000});
  CHECK(colour(magics, 0) == red);
  CHECK(colour(magics, 1) == blue);
  // Numbers that some programs leave there are none.
  CHECK(painted("export", {3, 0xffff, 0}).materials.empty());
  CHECK(painted("export", {0, 0}).materials.empty());
}

TEST_CASE("STL: commas in numbers are named") {
  CHECK(refusal("solid a\nfacet normal 0 0 1\nouter loop\nvertex -10,5 0 0\n", "stl") ==
        "3 model.stl, line 4: a number is expected (numbers need a decimal point, not a comma: export it "
        "again with "
        "English number formats), not \"-10,5\"");
}
