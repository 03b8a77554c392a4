// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <string_view>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "base/random.hpp"
#include "mesh/file_writers.hpp"
#include "mesh/seeds.hpp"
#include "reading.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
using mesh::Colour;
using mesh::RepairKind;
using mesh::Soup;

namespace {

const std::string points =
    R"(<vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/></vertices>)";
const std::string triangle = R"(<triangles><triangle v1="0" v2="1" v3="2"/></triangles>)";

std::string model(const std::string& resources, const std::string& build, const std::string& keys = {}) {
  return "<model " + keys + "><resources>" + resources + "</resources><build>" + build + "</build></model>";
}

std::string object(int id, const std::string& mesh, const std::string& keys = {}) {
  return fmt::format("<object id=\"{}\" {}><mesh>{}</mesh></object>", id, keys, mesh);
}

std::string one(const std::string& keys = {}) {
  return model(object(1, points + triangle), R"(<item objectid="1"/>)", keys);
}

std::string why(const std::string& xml) {
  return refusal(threemf(xml), "3mf");
}

}  // namespace

TEST_CASE("3MF: random triangles come back bit for bit, stored and packed") {
  Random random(31);
  for (int round = 0; round < 40; ++round) {
    Soup soup;
    std::string vertices;
    std::string triangles;
    const std::uint32_t count = 3 + random.below(60);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Vec3 p{random.unit() * 100 - 50, random.unit(), random.unit() * 1e-7};
      soup.points.push_back(p);
      vertices += fmt::format("<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>", p.x, p.y, p.z);
    }
    for (std::uint32_t i = 0; i <= random.below(60); ++i) {
      const std::array t{random.below(count), random.below(count), random.below(count)};
      soup.corner_point.insert(soup.corner_point.end(), t.begin(), t.end());
      triangles += fmt::format("<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>", t[0], t[1], t[2]);
    }
    const std::string xml =
        model(object(1, "<vertices>" + vertices + "</vertices><triangles>" + triangles + "</triangles>"),
              R"(<item objectid="1"/>)");
    for (const Packing packing : {Packing::stored, Packing::deflated}) {
      const Soup back = parsed(threemf(xml, {}, packing), "3mf");
      REQUIRE(back.points == soup.points);
      REQUIRE(back.corner_point == soup.corner_point);
    }
  }
}

TEST_CASE("3MF: the unit is the file's, and z points up") {
  const std::vector<std::pair<std::string, double>> units{{"", 1.0},
                                                          {"unit=\"micron\"", 0.001},
                                                          {"unit=\"millimeter\"", 1.0},
                                                          {"unit=\"centimeter\"", 10.0},
                                                          {"unit=\"inch\"", 25.4},
                                                          {"unit=\"foot\"", 304.8},
                                                          {"unit=\"meter\"", 1000.0}};
  for (const auto& [key, mm] : units) {
    CHECK(parsed(threemf(one(key)), "3mf").frame == mesh::FileFrame{mm, mesh::Axis::z});
  }
  CHECK(why(one("unit=\"furlong\"")) == "3 model.3mf, 3D/3dmodel.model: the unit \"furlong\" isn't known");
}

TEST_CASE("3MF: components and items place, scale and mirror") {
  const Soup soup = parsed(rich_3mf(), "3mf");
  REQUIRE(soup.polygon_count() == 13);
  const double large = 8.0 / 6.0;
  CHECK(signed_volume(soup, 0, 4) == Approx(large));
  CHECK(signed_volume(soup, 4, 8) == Approx(large));
  CHECK(signed_volume(soup, 9, 13) == Approx(1.0 / 6.0));
  CHECK(soup.points[0] == Vec3{1, 1, 1});
  // Mirrored, moved by 5, then twice as large and moved by 1.
  CHECK(soup.points[5] == Vec3{9, 1, 1});
  CHECK(soup.objects ==
        std::vector<std::pair<std::uint32_t, std::string>>{{0, "t"}, {4, "t"}, {8, "b"}, {9, "t"}});
  CHECK(soup.frame.mm_per_unit == 25.4);
}

TEST_CASE("3MF: faces have the colours, materials and pictures of the file") {
  const Soup soup = parsed(rich_3mf(), "3mf");
  const auto material = [&](std::size_t polygon) {
    return soup.materials.at(soup.polygon_material[polygon]);
  };
  CHECK(material(0).name == "grey");
  CHECK(material(0).colour == Colour{128 / 255.0, 128 / 255.0, 128 / 255.0});
  // One green corner, two blue ones.
  CHECK(material(1).colour == Colour{0, 85 / 255.0, 170 / 255.0});
  REQUIRE(material(2).picture);
  CHECK(*material(2).picture == tiny_png());
  CHECK(soup.texture_points[soup.corner_texture[7]] == Vec2{1, 0});
  CHECK(material(3).name == "grey");
  CHECK(soup.polygon_material[8] == Soup::none);
  CHECK(soup.corner_texture[0] == Soup::none);
  // The mirrored copy turns its corners, and what belongs to them.
  CHECK(soup.texture_points[soup.corner_texture[19]] == Vec2{0, 1});
}

TEST_CASE("3MF: archives with 64-bit sizes, without relations, with bytes in front of names") {
  CHECK(refusal(zip({{"3D/3dmodel.model", one()}}), "3mf").empty());
  CHECK(refusal(zip({{"/3d/3DModel.model", one()}}), "3mf").empty());
  CHECK(refusal(zip({{"a.model", one()}}), "zip").empty());
  // The sizes of the only file stand in an extra field.
  const std::string name = "3D/3dmodel.model";
  const std::string xml = one();
  std::string archive = zip({{name, xml}});
  const std::size_t directory = archive.rfind("PK\x01\x02");
  std::string entry = archive.substr(directory, 46 + name.size());
  const std::string size = entry.substr(24, 4) + std::string(4, '\0');
  entry.replace(20, 8, std::string(8, '\xff'));
  const std::string extra = bytes2(1) + bytes2(16) + size + size;
  entry.replace(30, 2, bytes2(static_cast<std::uint32_t>(extra.size())));
  entry += extra;
  std::string end = archive.substr(archive.rfind("PK\x05\x06"));
  end.replace(12, 4, bytes4(static_cast<std::uint32_t>(entry.size())));
  CHECK(refusal(archive.substr(0, directory) + entry + end, "3mf").empty());
}

TEST_CASE("3MF: what can't be read is refused with its place") {
  const std::string at = "3 model.3mf, 3D/3dmodel.model";
  CHECK(why("<model><a></model>").starts_with("3 model.3mf can't be read: at byte "));
  CHECK(why("<html/>") == at + ": it isn't a 3MF model");
  CHECK(why(model({}, {})) == "4 model.3mf has no faces");
  CHECK(why(model({}, R"(<item objectid="4"/>)")) ==
        "3 model.3mf names object 4 of its part \"3D/3dmodel.model\", which isn't there");
  CHECK(why(model({}, "<item/>")) == at + ", build: \"objectid\" of \"item\" is missing");
  CHECK(why(model(object(1, points + R"(<triangles><triangle v1="0" v2="1" v3="3"/></triangles>)"), {})) ==
        at + ", object 1: triangle 0 names point 3, but there are 3");
  CHECK(why(model(object(1, points + R"(<triangles><triangle v1="0" v2="-1" v3="1"/></triangles>)"), {})) ==
        at + ", object 1: \"-1\" in triangle 0 is no whole number");
  CHECK(why(model(object(1, points + R"(<triangles><triangle v1="0" v2="1"/></triangles>)"), {})) ==
        at + ", object 1: triangle 0 has no \"v3\"");
  CHECK(why(model(object(1, R"(<vertices><vertex x="0" y="0,5" z="0"/></vertices>)"), {})) ==
        at + ", object 1: \"0,5\" is no number");
  CHECK(why(model(object(1, R"(<vertices><vertex x="0" y="1e999" z="0"/></vertices>)"), {})) ==
        "4 model.3mf, 3D/3dmodel.model, object 1: a coordinate of point 0 is not finite");
  CHECK(why(model(object(1, points + triangle), R"(<item objectid="1" transform="1 0 0"/>)")) ==
        at + ", build: a transform has 3 numbers instead of 12");
  CHECK(why(model(object(1, points + triangle) + object(1, points), {})) ==
        at + ", object 1: there are two of this number");
  CHECK(why(model("<colorgroup id=\"2\"><color color=\"#000000\"/></colorgroup>" +
                      object(1, points + triangle, "pid=\"2\" pindex=\"9\""),
                  R"(<item objectid="1"/>)"))
            .find("names colour or material 9 of group 2") != std::string::npos);
  CHECK(why(one("requiredextensions=\"bl\" xmlns:bl=\"http://x/beamlattice/2017\"")).find("beamlattice") !=
        std::string::npos);
  CHECK(why(one("requiredextensions=\"s\" xmlns:s=\"http://x/slice/2015/07\"")).empty());
}

TEST_CASE("3MF: archives that are damaged, packed strangely, or no models") {
  CHECK(refusal(zip({{"a.txt", "hello"}}), "3mf") ==
        "3 model.3mf is no mesh but a ZIP archive; unpack it first");
  CHECK(refusal(zip({{"a.txt", "hello"}}), "zip") ==
        "3 model.zip is no mesh but a ZIP archive; unpack it first");
  const std::string whole = threemf(one(), {}, Packing::deflated);
  for (std::size_t size = 100; size < whole.size(); size += 7) {
    INFO(size);
    REQUIRE(refusal(whole.substr(0, size), "3mf").starts_with("3 model.3mf is cut off or damaged: "));
  }
  std::string flipped = threemf(one());
  const std::size_t inside = flipped.find("vertices");
  flipped[inside] ^= 1;
  CHECK(refusal(flipped, "3mf") ==
        "3 model.3mf is cut off or damaged: its part \"3D/3dmodel.model\" can't be unpacked");
  std::string locked = zip({{"3D/3dmodel.model", one()}});
  locked[locked.rfind("PK\x01\x02") + 8] = 1;
  CHECK(refusal(locked, "3mf") ==
        "3 model.3mf can't be unpacked: its part \"3D/3dmodel.model\" is encrypted");
}

TEST_CASE("3MF: a few bytes can't ask for much", "[slow]") {
  // Objects that hold the one before twice.
  std::string doubling = object(1, points + triangle);
  for (int i = 2; i < 60; ++i) {
    doubling += fmt::format(
        R"(<object id="{}"><components><component objectid="{}"/><component objectid="{}"/></components></object>)",
        i, i - 1, i - 1);
  }
  CHECK(why(model(doubling, R"(<item objectid="59"/>)")) ==
        "3 model.3mf has objects that hold each other, or repeats them too often");
  CHECK(why(model(R"(<object id="1"><components><component objectid="1"/></components></object>)",
                  R"(<item objectid="1"/>)")) ==
        "3 model.3mf has objects that hold each other, or repeats them too often");
  // A few packed kilobytes that name many small things.
  const auto many = [](std::string_view text) {
    std::string repeated;
    for (int i = 0; i < 1'000'001; ++i) {
      repeated += text;
    }
    return repeated;
  };
  const std::string too_many =
      "3 model.3mf is too large: its part \"3D/3dmodel.model\" has more than 1000000 objects and materials";
  const auto packed = [](const std::string& xml) {
    return refusal(threemf(xml, {}, Packing::deflated), "3mf");
  };
  CHECK(packed(model(object(1, points + triangle), many(R"(<item objectid="1"/>)"))) == too_many);
  CHECK(packed(model(
            "<object id=\"1\"><components>" + many(R"(<component objectid="2"/>)") + "</components></object>",
            R"(<item objectid="1"/>)")) == too_many);
  CHECK(packed(model("<basematerials id=\"1\">" + many("<base/>") + "</basematerials>", {})) == too_many);
  // A third of a gigabyte of blanks, in 330 kB.
  const std::string blanks = threemf(one() + std::string(300'000'000, ' '), {}, Packing::deflated);
  CHECK(refusal(blanks, "3mf").starts_with("3 model.3mf is too large: its part \"3D/3dmodel.model\" has "));
}

TEST_CASE("3MF: supports for printing are no part of the model") {
  const Soup soup =
      parsed(threemf(model(object(1, points + triangle) + object(2, points + triangle, "type=\"support\""),
                           R"(<item objectid="1"/><item objectid="2"/>)")),
             "3mf");
  CHECK(soup.polygon_count() == 1);
  CHECK(soup.remarks.count(RepairKind::object_left_out) == 1);
}

namespace {

/// A closed tetrahedron for each of these corners, in one mesh.
std::string tetrahedra(const std::vector<Vec3>& at, const std::string& keys_of_first = {}) {
  std::string vertices;
  std::string triangles;
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (const Vec3 p : {at[i], at[i] + Vec3{4, 0, 0}, at[i] + Vec3{0, 4, 0}, at[i] + Vec3{0, 0, 4}}) {
      vertices += fmt::format("<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>", p.x, p.y, p.z);
    }
    using Corners = std::array<std::size_t, 3>;
    for (const Corners& t : {Corners{0, 2, 1}, Corners{0, 1, 3}, Corners{0, 3, 2}, Corners{1, 2, 3}}) {
      triangles += fmt::format("<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\" {}/>", 4 * i + t[0], 4 * i + t[1],
                               4 * i + t[2], triangles.empty() ? keys_of_first : std::string());
    }
  }
  return "<vertices>" + vertices + "</vertices><triangles>" + triangles + "</triangles>";
}

/// What a soup says it left out.
std::string left_out(const Soup& soup) {
  for (const mesh::Repair& remark : soup.remarks.entries()) {
    if (remark.kind == RepairKind::object_left_out) {
      return fmt::format("{}: {}", remark.count, remark.detail);
    }
  }
  return {};
}

std::string volume(int first, int last, const std::string& type, int extruder) {
  return fmt::format(R"(<volume firstid="{}" lastid="{}"><metadata type="volume" key="name" value="{}"/>)"
                     R"(<metadata type="volume" key="volume_type" value="{}"/>)"
                     R"(<metadata type="volume" key="extruder" value="{}"/></volume>)",
                     first, last, type, type, extruder);
}

Colour colour_at(const Soup& soup, std::size_t polygon) {
  return soup.materials.at(soup.polygon_material.at(polygon)).colour.value();
}

double area(const Soup& soup, std::size_t polygon) {
  const auto corners = soup.polygon(polygon);
  Vec3 sum;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    sum = sum + cross(soup.points[corners[i]] - soup.points[corners[0]],
                      soup.points[corners[i + 1]] - soup.points[corners[0]]);
  }
  return length(sum) / 2.0;
}

}  // namespace

TEST_CASE("3MF: what PrusaSlicer marks as no part of the model is left out and counted") {
  const std::string config =
      "<config><object id=\"1\"><metadata type=\"object\" key=\"name\" value=\"thing\"/>" +
      volume(0, 3, "ModelPart", 1) + volume(4, 7, "ParameterModifier", 0) +
      volume(8, 11, "SupportBlocker", 0) + volume(12, 15, "NegativeVolume", 0) +
      volume(16, 19, "ModelPart", 2) + "</object></config>";
  const std::string xml =
      model(object(1, tetrahedra({{0, 0, 0}, {9, 0, 0}, {18, 0, 0}, {27, 0, 0}, {36, 0, 0}})),
            R"(<item objectid="1" printable="1"/><item objectid="1" printable="0"/>)");
  const Soup soup =
      parsed(threemf(xml, {{"Metadata/Slic3r_PE_model.config", config},
                           {"Metadata/Slic3r_PE.config",
                            "; extruder_colour = ;#00FF00\n; filament_colour = #FF8000;#112233\n"}}),
             "3mf");
  REQUIRE(soup.polygon_count() == 8);
  CHECK(left_out(soup) == "4: 1 negative part, 1 modifier, 1 support and 1 not to be printed");
  CHECK(colour_at(soup, 0) == Colour{1.0, 128 / 255.0, 0.0});
  CHECK(colour_at(soup, 4) == Colour{0.0, 1.0, 0.0});
  CHECK(signed_volume(soup, 0, 4) == Approx(64.0 / 6.0));
  CHECK(soup.points[soup.polygon(4)[0]].x == 36.0);
  // Nothing at all is a sentence, and without its side file the object is whole.
  CHECK(why(model(object(1, tetrahedra({{0, 0, 0}})), R"(<item objectid="1" printable="0"/>)")) ==
        "4 model.3mf has nothing to build: all it holds is 1 not to be printed");
  CHECK(parsed(threemf(xml, {{"Metadata/Slic3r_PE_model.config", "<config><obj"}}), "3mf").polygon_count() ==
        20);
}

TEST_CASE("3MF: parts of Bambu Studio's objects keep their roles, names, filaments and plates") {
  const std::string config =
      R"(<config><object id="9"><metadata key="name" value="thing"/><metadata key="extruder" value="1"/>)"
      R"(<part id="1" subtype="normal_part"><metadata key="name" value="body"/></part>)"
      R"(<part id="2" subtype="negative_part"/><part id="3" subtype="support_enforcer"/>)"
      R"(<part id="4" subtype="normal_part"><metadata key="name" value="lid"/><metadata key="extruder" value="2"/>)"
      R"(</part></object>)"
      R"(<plate><metadata key="plater_id" value="1"/><model_instance><metadata key="object_id" value="9"/>)"
      R"(<metadata key="instance_id" value="0"/></model_instance></plate>)"
      R"(<plate><metadata key="plater_id" value="2"/><model_instance><metadata key="object_id" value="9"/>)"
      R"(<metadata key="instance_id" value="1"/></model_instance></plate></config>)";
  std::string resources;
  std::string components;
  for (const int id : {1, 2, 3, 4}) {
    resources += object(id, tetrahedra({{9.0 * id, 0, 0}}), id == 2 || id == 3 ? "type=\"other\"" : "");
    components += fmt::format("<component objectid=\"{}\"/>", id);
  }
  resources += "<object id=\"9\"><components>" + components + "</components></object>";
  const std::string xml =
      model(resources, R"(<item objectid="9"/><item objectid="9" transform="1 0 0 0 1 0 0 0 1 0 90 0"/>)");
  const ZipFiles more{
      {"Metadata/model_settings.config", config},
      {"Metadata/project_settings.config", R"({"filament_colour": ["#FF0000", "#0000FF"], "x": 1})"}};
  const Soup soup = parsed(threemf(xml, more), "3mf");
  REQUIRE(soup.polygon_count() == 16);
  CHECK(left_out(soup) == "4: 2 negative parts and 2 supports");
  CHECK(soup.objects == std::vector<std::pair<std::uint32_t, std::string>>{
                            {0, "plate1/body"}, {4, "plate1/lid"}, {8, "plate2/body"}, {12, "plate2/lid"}});
  CHECK(colour_at(soup, 0) == Colour{1, 0, 0});
  CHECK(colour_at(soup, 4) == Colour{0, 0, 1});
}

TEST_CASE("3MF: a brush's strokes divide triangles as the slicer does") {
  // The painted triangle has the area 8. Digits come last first.
  const auto painted = [&](const std::string& code) {
    const std::string key = GENERATE(std::string("paint_color"), std::string("slic3rpe:mmu_segmentation"));
    const ZipFiles more{
        {"Metadata/project_settings.config", R"({"filament_colour":["#FF0000","#00FF00","#0000FF"]})"},
        {"Metadata/model_settings.config", "<config><object id=\"1\"/></config>"}};
    return parsed(threemf(model(object(1, tetrahedra({{0, 0, 0}}, fmt::format("{}=\"{}\"", key, code))),
                                R"(<item objectid="1"/>)"),
                          more),
                  "3mf");
  };
  const auto blue = [](const Soup& soup) {
    double sum = 0.0;
    for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
      sum += colour_at(soup, i) == Colour{0, 0, 1} ? area(soup, i) : 0.0;
    }
    return sum;
  };
  // "0C" is filament 3: state 3 follows in a digit of its own.
  CHECK(blue(painted("0C")) == Approx(8.0));
  CHECK(blue(painted("40C1")) == Approx(4.0));    // half of it
  CHECK(blue(painted("440C2")) == Approx(4.0));   // what is left of it beyond a corner
  CHECK(blue(painted("0C442")) == Approx(2.0));   // the corner
  CHECK(blue(painted("4440C3")) == Approx(2.0));  // the middle one of four
  CHECK(blue(painted("440C43")) == Approx(2.0));  // a corner of four
  // The triangle that shares a divided side has its middle as a corner, so that nothing gapes.
  const Soup soup = painted("40C1");
  CHECK(soup.polygon_count() == 5);
  std::size_t four = 0;
  for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
    four += soup.polygon(i).size() == 4 ? 1U : 0U;
  }
  CHECK(four == 1);
  // Codes that end early or go too deep leave the triangle whole and unpainted.
  for (const std::string& code : {std::string("1"), std::string("xyz"), std::string(100000, '3')}) {
    CHECK(painted(code).polygon_count() == 4);
    CHECK(painted(code).materials.empty());
  }
}
