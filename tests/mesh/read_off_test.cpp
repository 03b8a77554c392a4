// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "reading.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
using mesh::RepairKind;
using mesh::Soup;

namespace {

constexpr std::string_view body = "3 1 0\n0 0 0\n1 0 0\n0 1 0.5\n3 0 1 2\n";

}

TEST_CASE("OFF: all forms of the header") {
  for (const std::string start : {"OFF\n", "OFF ", "OFF# c\n\n", "# c\nOFF\n# c\n", "COFF\n", "NOFF\n",
                                  "STCNOFF\n", "\xef\xbb\xbfOFF\r\n", "", "OFF", "off\n", "COFF"}) {
    INFO(start);
    const Soup soup = parsed(start + std::string(body), "off");
    CHECK(soup.format == mesh::FileFormat::off);
    REQUIRE(soup.points.size() == 3);
    CHECK(soup.points[2] == Vec3{0, 1, 0.5});
    CHECK(soup.corner_point == std::vector<std::uint32_t>{0, 1, 2});
  }
  CHECK(refusal("4OFF\n" + std::string(body), "off").starts_with("3 model.off is a 4OFF file"));
  CHECK(refusal("SCOFF\n" + std::string(body), "off").starts_with("3 model.off, line 1: "));
  CHECK(refusal("OFF BINARY\n\0\0\0", "off").find("binary") != std::string::npos);
}

TEST_CASE("OFF: what follows points is skipped, colours of faces become materials") {
  const Soup soup = parsed(
      "COFF\n3 6 0\n0 0 0 255 0 0\n1 0 0 0.5 # c\n0 1 0 1 1 1 1 1 1\n"
      "3 0 1 2 255 0 51\n3 0 1 2 1.0 0.0 0.2 0.5\n3 0 1 2\n3 0 1 2 7\n3 0 1 2 9.5 -1. nan\n3 2 1 0 255 0 51 "
      "255\n",
      "off");
  REQUIRE(soup.materials.size() == 2);
  CHECK(soup.materials[0].colour == mesh::Colour{1.0, 0.0, 0.2});
  CHECK(soup.materials[1].colour == mesh::Colour{1.0, 0.0, 1.0});
  CHECK(soup.polygon_material == std::vector<std::uint32_t>{0, 0, Soup::none, Soup::none, 1, 0});
}

TEST_CASE("OFF: a face may go on in the next lines, where it ends with one") {
  const std::string start = "OFF\n4 2 0\n0 0 0\n10 0 0\n0 10 0\n0 0 10\n";
  const Soup soup = parsed(start + "3 0\n1 # c\n\n2\n4 3 2 \n1 \n0 \n", "off");
  CHECK(soup.corner_point == std::vector<std::uint32_t>{0, 1, 2, 3, 2, 1, 0});
  CHECK(soup.first_corner == std::vector<std::uint32_t>{0, 3, 7});
  // The next face's count is no corner.
  CHECK(refusal(start + "4 0 1 2\n3 1 2 3\n", "off") == "3 model.off, line 7: a corner is missing");
}

TEST_CASE("OFF: an incomplete file is refused") {
  const std::string text = "OFF\n4 3 0\n0 0 0\n10 0 0\n0 10 0\n0 0 10\n3 0 1 2\n3 0 1 3\n3 1 2 3\n";
  for (std::size_t size = 4; size < text.size() - 1; ++size) {
    INFO(size);
    CHECK(refusal(text.substr(0, size), "off").starts_with("3 "));
  }
  CHECK(refusal(text.substr(0, text.size() - 1), "off").empty());
  CHECK(parsed(text + "rest", "off").remarks.count(RepairKind::trailing_data_ignored) == 4);
}

TEST_CASE("OFF: refusals name the line") {
  const auto refused = [](const std::string& point, const std::string& face) {
    return refusal("OFF\n3 1 0\n0 0 0\n1 0 0\n" + point + "\n" + face + "\n", "off");
  };
  CHECK(refused("0 1 0", "3 0 1 2").empty());
  CHECK(refused("0 1 0", "3 0 1 3") ==
        "3 model.off, line 6: a face names point 3, but points are numbered 0 to 2");
  CHECK(refused("0 1 0", "3 0 1 -1").starts_with("3 model.off, line 6: "));
  CHECK(refused("0 1 0", "3 0 1") == "3 model.off, line 6: a corner is missing");
  CHECK(refused("0 1 0", "4294967295 0 1 2") == "3 model.off, line 6: a corner is missing");
  CHECK(refused("0 1 0", "-1 0 1 2").starts_with("3 model.off, line 6: "));
  CHECK(refused("0 1", "3 0 1 2") == "3 model.off, line 5: a coordinate is missing");
  CHECK(refused("0 a 1", "3 0 1 2") == "3 model.off, line 5: \"a\" is no number");
  CHECK(refused("0 inf 1", "3 0 1 2").starts_with("4 model.off, line 5: "));
  CHECK(refusal("OFF\n4000000000 4000000000 0\n0 0 0\n", "off").find("4000000000 points") !=
        std::string::npos);
  CHECK(refusal("OFF\n-3 1 0\n", "off").starts_with("3 "));
  CHECK(refusal("OFF\n99999999999999999999 1 0\n", "off").starts_with("3 "));
  CHECK(refusal("OFF\n", "off").starts_with("3 "));
}

TEST_CASE("OFF: counts may follow the keyword without a blank, and be on lines of their own") {
  CHECK(parsed("OFF3\n1 0\n0 0 0\n1 0 0\n0 1 0.5\n3 0 1 2\n", "off").points.size() == 3);
  CHECK(refusal("OFFSET 3 1 0\n", "off").starts_with("3 "));
}
