// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "reading.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
using mesh::RepairKind;
using mesh::Soup;

namespace {

const std::string points_header = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string faces_header = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string point_lines = "0 0 0\n1 0 0\n0 1 0.5\n";

std::string ascii(const std::string& header, const std::string& body) {
  return "ply\nformat ascii 1.0\n" + header + "end_header\n" + body;
}

}  // namespace

TEST_CASE("PLY: elements in any order, unknown ones skipped") {
  const std::string thing = "element thing 2\nproperty list int float numbers\nproperty char c\n";
  const std::string things = "2 0.5 nan 7\n0 -3\n";
  for (const auto& [header, body] :
       {std::pair{points_header + faces_header, point_lines + "3 0 1 2\n"},
        std::pair{faces_header + points_header, "3 0 1 2\n" + point_lines},
        std::pair{thing + points_header + faces_header, things + point_lines + "3 0 1 2"},
        std::pair{points_header + thing + faces_header, point_lines + things + "3 0 1 2"},
        std::pair{"element nothing 4000000000\n" + points_header + faces_header, point_lines + "3 0 1 2"},
        std::pair{points_header + "property list uchar int tags\n" + faces_header,
                  std::string("0 0 0 1 9\n1 0 0 0\n0 1 0.5 2 1 1\n3 0 1 2")}}) {
    const Soup soup = parsed(ascii(header, body), "ply");
    REQUIRE(soup.points.size() == 3);
    CHECK(soup.points[2] == Vec3{0, 1, 0.5});
    CHECK(soup.corner_point == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(soup.remarks.entries().size() == soup.remarks.count(RepairKind::feature_ignored));
  }
}

TEST_CASE(
    "PLY: edges mark cuts, wherever they stand, and those without two points of the file are left out") {
  using Lines = std::vector<std::array<std::uint32_t, 2>>;
  const std::string edges_header = "element edge 2\nproperty int vertex1\nproperty int vertex2\n";
  const std::string edges = "0 1\n2 1\n";
  for (const auto& [header, body] :
       {std::pair{points_header + faces_header + edges_header, point_lines + "3 0 1 2\n" + edges},
        std::pair{edges_header + points_header + faces_header, edges + point_lines + "3 0 1 2\n"},
        std::pair{
            points_header +
                "element edge 2\nproperty uchar red\nproperty uint vertex2\nproperty list uchar float w\n"
                "property ushort vertex1\n" +
                faces_header,
            point_lines + "255 1 2 0.5 -1 0\n7 1 0 2\n3 0 1 2"}}) {
    const Soup soup = parsed(ascii(header, body), "ply");
    CHECK(soup.lines == Lines{{0, 1}, {2, 1}});
    CHECK(soup.corner_point == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(soup.remarks.entries().empty());
  }
  const Soup bad = parsed(
      ascii(points_header + faces_header + "element edge 4\nproperty int vertex1\nproperty int vertex2\n",
            point_lines + "3 0 1 2\n0 3\n-1 0\n1 1\n2 0\n"),
      "ply");
  CHECK(bad.lines == Lines{{2, 0}});
  CHECK(bad.remarks.count(RepairKind::element_ignored) == 3);
  // Edges of another kind are skipped, like any element.
  const Soup other = parsed(
      ascii(points_header + faces_header + "element edge 1\nproperty float vertex1\nproperty int vertex2\n",
            point_lines + "3 0 1 2\n0 1\n"),
      "ply");
  CHECK(other.lines.empty());
  CHECK(other.remarks.entries().empty());
  // A file that ends among its edges is cut off.
  CHECK_THROWS(
      parsed(ascii(points_header + faces_header + edges_header, point_lines + "3 0 1 2\n0 1\n2"), "ply"));
}

TEST_CASE("PLY: remarks before the elements that lack the word comment") {
  CHECK(parsed(ascii("Created by somebody: 3 things\n" + points_header + faces_header,
                     point_lines + "3 0 1 2\n"),
               "ply")
            .polygon_count() == 1);
  CHECK(
      refusal(ascii(points_header + "Created by somebody\n" + faces_header, point_lines + "3 0 1 2\n"), "ply")
          .find("doesn't belong") != std::string::npos);
}

TEST_CASE("PLY: headers with other line ends") {
  for (const std::string end : {"\r\n", "\r"}) {
    std::string text;
    for (const char c : ascii(points_header + faces_header, point_lines + "3 0 1 2\n")) {
      text += c == '\n' ? end : std::string(1, c);
    }
    CHECK(parsed(text, "ply").polygon_count() == 1);
  }
  // With CR alone a LF after the header is a value of the body: the list's length 10 of a binary file.
  std::string binary =
      "ply\rformat binary_little_endian 1.0\relement face 1\rproperty list uchar char vertex_indices\r"
      "element vertex 1\rproperty char x\rproperty char y\rproperty char z\rend_header\r\n";
  CHECK(parsed(binary + std::string(10, '\0') + "abc", "ply").corner_point.size() == 10);
}

TEST_CASE("PLY: triangle strips turn every other triangle and end at -1") {
  const Soup soup = parsed(ascii("element vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
                                 "element tristrips 1\nproperty list int int vertex_indices\n",
                                 point_lines + point_lines.substr(6) + "11 0 1 2 3 3 4 -1 1 2 3 4"),
                           "ply");
  CHECK(soup.corner_point == std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3, 1, 2, 3, 3, 2, 4});
}

TEST_CASE("PLY: elements without properties take no bytes and no time") {
  for (const std::string name : {"tristrips", "edge", "nothing"}) {
    const Soup soup = parsed(
        ascii(points_header + "element " + name + " 4294967295\n" + faces_header, point_lines + "3 0 1 2\n"),
        "ply");
    CHECK(soup.polygon_count() == 1);
  }
}

TEST_CASE("PLY: colours and texture coordinates of faces") {
  const std::string colours = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  const Soup coloured =
      parsed(ascii(points_header + faces_header + colours, point_lines + "3 0 1 2 255 0 51"), "ply");
  REQUIRE(coloured.materials.size() == 1);
  CHECK(coloured.materials[0].colour == mesh::Colour{1.0, 0.0, 0.2});
  const Soup wedges = parsed(ascii("comment TextureFile a.png\n" + points_header + faces_header +
                                       "property list uchar float texcoord\n",
                                   point_lines + "3 0 1 2 6 0 0 1 0 0 1"),
                             "ply");
  CHECK(wedges.texture_points == std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}});
  CHECK(wedges.corner_texture == std::vector<std::uint32_t>{0, 1, 2});
  CHECK(wedges.polygon_material == std::vector<std::uint32_t>{0});
  const Soup by_point = parsed(ascii("comment TextureFile a.png\n" + points_header +
                                         "property float s\nproperty float t\n" + faces_header,
                                     "0 0 0 0.5 1\n1 0 0 2 3\n0 1 0 4 5\n3 2 1 0"),
                               "ply");
  CHECK(by_point.texture_points[2] == Vec2{4, 5});
  CHECK(by_point.corner_texture == std::vector<std::uint32_t>{2, 1, 0});
  const Soup bad = parsed(ascii("comment TextureFile a.png\n" + points_header + faces_header +
                                    "property list uchar float texcoord\n",
                                point_lines + "3 0 1 2 4 0 0 1 0"),
                          "ply");
  CHECK(bad.corner_texture.empty());
  CHECK(bad.remarks.count(RepairKind::texture_point_dropped) == 1);
}

TEST_CASE("PLY: a name of any length makes no long message") {
  const std::string name(1000, 'x');
  CHECK(refusal(
            ascii("element " + name + " 1\nproperty float " + name + "\nproperty list int int " + name + "\n",
                  "1 x 1"),
            "ply")
            .size() < 200);
}

TEST_CASE("PLY: refusals") {
  const auto refused = [](const std::string& header, const std::string& body) {
    return refusal(ascii(header, body), "ply");
  };
  const std::string both = points_header + faces_header;
  CHECK(refused(both, point_lines + "3 0 1 2").empty());
  CHECK(refused(both, point_lines + "3 0 1 3") ==
        "3 model.ply, line 13: face 1 of 1: it names point 3, but points are numbered 0 to 2");
  CHECK(refused(both, point_lines + "3 0 1 -1").starts_with("3 model.ply, line 13: "));
  CHECK(refused(both, point_lines + "3 0 1").find("cut off") != std::string::npos);
  CHECK(refused(both, point_lines + "-3 0 1 2").starts_with("3 "));
  CHECK(refused(both, point_lines + "4000000000 0 1 2").find("more than the") != std::string::npos);
  CHECK(refused(both, "0 0 nan\n1 0 0\n0 1 0\n3 0 1 2").starts_with("4 model.ply, line 10: vertex 1 of 3: "));
  CHECK(refused(both, "0 0 x\n1 0 0\n0 1 0\n3 0 1 2").starts_with("3 model.ply, line 10: "));
  CHECK(refused(points_header, point_lines).starts_with("4 "));
  CHECK(refused("element vertex 3\nproperty float x\nproperty float y\n" + faces_header, "")
            .find("x, y and z") != std::string::npos);
  CHECK(refused(points_header + "element face 1\nproperty int vertex_indices\n", point_lines + "1")
            .starts_with("3 "));
  CHECK(
      refused(points_header + "element face 1\nproperty list uchar float vertex_indices\n", point_lines + "0")
          .starts_with("3 "));
  CHECK(refused("property float x\n" + both, point_lines).starts_with("3 model.ply, line 3: "));
  CHECK(refused("element vertex -1\n", "").starts_with("3 model.ply, line 3: "));
  CHECK(refused("element vertex 3\nproperty quad x\n", "").find("\"quad\"") != std::string::npos);
  CHECK(refused(points_header + both, point_lines + point_lines + "3 0 1 2").find("two elements") !=
        std::string::npos);
  CHECK(refusal("ply\nformat ascii 1.0\n" + both, "ply").find("end_header") != std::string::npos);
  CHECK(refusal("ply\n" + both + "end_header\n" + point_lines + "3 0 1 2", "ply").find("no format") !=
        std::string::npos);
  CHECK(refusal("ply\nformat ebcdic 1.0\n", "ply").find("\"ebcdic\"") != std::string::npos);
}
