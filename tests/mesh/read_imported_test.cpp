// SPDX-License-Identifier: GPL-3.0-or-later
// Formats that a program beside ours reads: what comes through the pipe, and what happens where it breaks
// down.
#include "mesh/reading/imported/read_imported.hpp"

#include <array>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/random.hpp"
#include "base/vector.hpp"
#include "mesh/mesh.hpp"
#include "mesh/reading/files.hpp"
#include "mesh/reading/imported/stream.hpp"
#include "mesh/seeds.hpp"
#include "reading.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
using mesh::RepairKind;
using mesh::Soup;

namespace {

const std::filesystem::path importer = RIDGECRAFT_IMPORTER;

bool is_built() {
  if (importer.empty()) {
    WARN("ridgecraft-import isn't built (libassimp-dev is missing): skipped");
  }
  return !importer.empty();
}

Soup imported(std::string_view bytes, const std::string& name,
              const std::filesystem::path& program = importer) {
  return mesh::parse_soup(bytes, name, {}, {}, program);
}

std::string import_refusal(std::string_view bytes, const std::string& name,
                           const std::filesystem::path& program = importer) {
  try {
    (void)imported(bytes, name, program);
  } catch (const Error& error) {
    CHECK((error.kind() == ErrorKind::unreadable_input || error.kind() == ErrorKind::unusable_mesh));
    return error.what();
  }
  return {};
}

/// A program that stands in for the importer.
std::filesystem::path script(const TemporaryFolder& folder, const std::string& text) {
  const std::filesystem::path file = folder / "stand-in";
  std::ofstream(file) << "#!/bin/sh\n" << text << "\n";
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  return file;
}

/// What the importer would say of a triangle with a material and a name.
std::string triangle_stream() {
  std::string bytes(mesh::imported::start);
  const auto index = [&](std::uint32_t value) {
    bytes.append(std::string(reinterpret_cast<const char*>(&value), sizeof value));
  };
  const auto number = [&](double value) {
    bytes.append(std::string(reinterpret_cast<const char*>(&value), sizeof value));
  };
  const auto text = [&](const std::string& value) {
    index(static_cast<std::uint32_t>(value.size()));
    bytes += value;
  };
  index(mesh::imported::kind_soup);
  number(25.4);
  index(2);
  index(1);  // moves
  index(1);
  text("paint");
  index(1);
  for (const double channel : {0.5, 2.0, 0.0}) {
    number(channel);
  }
  index(mesh::imported::picture_bytes);
  text("no picture");
  index(3);
  for (const double x : {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0}) {
    number(x);
  }
  index(3);
  for (const double x : {0.0, 0.0, 1.0, 0.0, 0.0, 1e9}) {
    number(x);
  }
  index(1);
  index(0);
  text("sail");
  index(1);
  index(3);
  index(3);
  // Points, texture points and colours of its corners.
  for (const std::uint32_t corner :
       {0U, 1U, 2U, 0U, 1U, 2U, 0xff0000U, 0x00ff00U, mesh::imported::no_index}) {
    index(corner);
  }
  index(0);
  return bytes + std::string(mesh::imported::end);
}

Soup from_stream(const std::string& stream) {
  const Context context;
  return mesh::read_stream(stream, mesh::FileFormat::fbx, {stream, "model.fbx", {}, context});
}

}  // namespace

TEST_CASE("FBX, COLLADA and 3DS: shape, polygons, unit, up, colours and names come through", "[imported]") {
  if (!is_built()) {
    return;
  }
  struct Case {
    const char* name;
    std::string bytes;
    std::size_t polygons;
    double unit_mm;  ///< 0: not told
    mesh::Axis up;
    double height;  ///< along that axis, in units
    const char* object;
  };
  // Assimp turns what has z up so that y is, where it knows.
  for (const Case& c : {Case{"tower.fbx", fbx_tower(), 6, 25.4, mesh::Axis::z, 3.0, "tower"},
                        Case{"tower.dae", dae_tower(), 6, 1000.0, mesh::Axis::y, 0.03, "tower"},
                        Case{"tower.3ds", max3ds_tower(), 12, 0.0, mesh::Axis::y, 3.0, ""}}) {
    INFO(c.name);
    const Soup soup = imported(c.bytes, c.name);
    CHECK(soup.polygon_count() == c.polygons);
    CHECK(soup.frame.mm_per_unit.value_or(0.0) == Approx(c.unit_mm));
    REQUIRE(soup.frame.up == c.up);
    REQUIRE(soup.materials.size() == 1);
    CHECK(soup.materials[0].name == "stone");
    REQUIRE(soup.materials[0].colour);
    CHECK((*soup.materials[0].colour)[1] == Approx(0.5).margin(0.01));
    CHECK(soup.remarks.entries().empty());
    mesh::ReadOptions options;
    options.importer = importer;
    const mesh::Model model = mesh::read(mesh::ModelFile{c.bytes, c.name, "tower", {}}, options, {});
    CHECK(model.surface.vertex_count() == 8);
    CHECK(model.surface.component_count() == 1);
    CHECK(model.repairs.entries().empty());
    const Vec3 size = model.surface.bounds().size();
    CHECK((c.up == mesh::Axis::y ? size.y : size.z) == Approx(c.height));
    CHECK(model.object_name(FaceId(0)) == c.object);
    // Outside is outside.
    double volume = 0.0;
    for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
      const auto [a, b, d] = model.surface.vertices(f);
      volume += dot(model.surface.point(a), cross(model.surface.point(b), model.surface.point(d))) / 6.0;
    }
    CHECK(volume == Approx(6.0 * std::pow(c.height / 3.0, 3)));
  }
}

TEST_CASE("The content decides, and without the importer such files are refused with a way out",
          "[imported]") {
  CHECK(
      import_refusal(fbx_tower(), "a.obj", {}) ==
      "a.obj is an FBX model, and ridgecraft-import, which reads those, is missing beside this program: it "
      "is "
      "built where libassimp-dev is installed; without it open it in Blender and export it as glTF (.glb) or "
      "OBJ");
  // What is OBJ stays so, whatever it is called.
  CHECK(imported("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a.fbx").format == mesh::FileFormat::obj);
  if (is_built()) {
    CHECK(imported(dae_tower(), "a.xml").format == mesh::FileFormat::dae);
    CHECK(import_refusal("; FBX 7.3.0 project file\n", "a.fbx").starts_with("a.fbx can't be read as FBX"));
    CHECK(import_refusal("no model at all", "a.dae").starts_with("a.dae can't be read as DAE"));
  }
}

TEST_CASE("A reader that breaks down costs one sentence", "[imported]") {
  const TemporaryFolder folder;
  const std::string bytes = fbx_tower();
  const std::string way = "; open it in Blender and export it as glTF (.glb) or OBJ";
  CHECK(import_refusal(bytes, "a.fbx", script(folder, "kill -SEGV $$")) ==
        "a.fbx can't be read: what reads FBX files broke down over it" + way);
  CHECK(import_refusal(bytes, "a.fbx", script(folder, "exit 3")) ==
        "a.fbx can't be read: what reads FBX files broke down over it" + way);
  CHECK(import_refusal(bytes, "a.fbx", script(folder, "kill -XCPU $$")) ==
        "a.fbx can't be read: what reads FBX files took too long over it" + way);
  CHECK(import_refusal(bytes, "a.fbx", script(folder, "cat >/dev/null; echo nonsense")) ==
        "a.fbx can't be read: what reads FBX files broke off");
  CHECK(import_refusal(bytes, "a.fbx", folder / "missing").find("can't be started") != std::string::npos);
  // It ends before it has read all that there is for it.
  CHECK(import_refusal(bytes + std::string(4 << 20, ' '), "a.fbx", script(folder, "exit 0")) ==
        "a.fbx can't be read: what reads FBX files broke off");
  // Who waits for it can stop.
  Context context;
  StopSource stop;
  context.stop = stop.get_token();
  stop.request_stop();
  CHECK_THROWS_AS(mesh::parse_soup(bytes, "a.fbx", {}, context, script(folder, "sleep 100")), Error);
}

TEST_CASE("A terminal's signals reach the reader through us alone", "[imported]") {
  const TemporaryFolder folder;
  const std::string told = (folder / "group").string();
  (void)import_refusal(
      fbx_tower(), "a.fbx",
      script(folder, "read -r id name state parent group rest </proc/self/stat; echo $group >" + told));
  int group = 0;
  REQUIRE(std::ifstream(told) >> group);
  CHECK(group != ::getpgrp());
}

TEST_CASE("The reader can open nothing and start nothing", "[imported]") {
#if defined(RIDGECRAFT_SANITIZED)
  WARN("sanitizers open files of their own: skipped");
#else
  if (!is_built()) {
    return;
  }
  // It waits for its input for as long as the shell holds the other end.
  const TemporaryFolder folder;
  const auto file = script(folder, "cd " + folder.path().string() + "\nmkfifo hold\n" + importer.string() +
                                       " FBX <hold >/dev/null &\nexec 3>hold\n"
                                       "for i in $(seq 500); do\n"
                                       "  sleep 0.02\n"
                                       "  grep -q '^Max open files  *0 ' /proc/$!/limits &&\n"
                                       "    grep -q '^Max processes  *0 ' /proc/$!/limits &&\n"
                                       "    grep -q '^NoNewPrivs:.*1' /proc/$!/status && exit 0\n"
                                       "done\n"
                                       "exit 1");
  CHECK(std::system(file.c_str()) == 0);
#endif
}

TEST_CASE("What comes through the pipe is checked as a file is", "[imported]") {
  const std::string whole = triangle_stream();
  const Soup soup = from_stream(whole);
  CHECK(soup.polygon_count() == 1);
  CHECK(soup.corner_colour == std::vector<std::uint32_t>{0xff0000, 0x00ff00, Soup::none});
  CHECK(soup.frame.mm_per_unit == 25.4);
  CHECK(soup.frame.up == mesh::Axis::z);
  CHECK(soup.objects == std::vector<std::pair<std::uint32_t, std::string>>{{0, "sail"}});
  CHECK(soup.remarks.count(RepairKind::motion_ignored) == 1);
  CHECK(soup.remarks.count(RepairKind::material_value_corrected) == 1);
  CHECK(soup.remarks.count(RepairKind::texture_missing) == 1);
  CHECK(soup.remarks.count(RepairKind::texture_point_dropped) == 1);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    CHECK_THROWS_AS(from_stream(whole.substr(0, length)), Error);
  }
  CHECK_THROWS_AS(from_stream(whole + "x"), Error);
  Random random(7);
  for (int i = 0; i < 4000; ++i) {
    std::string changed = whole;
    for (int k = 0; k < 3; ++k) {
      changed[random.below(static_cast<std::uint32_t>(changed.size()))] =
          static_cast<char>(random.below(256));
    }
    try {
      const Soup read = from_stream(changed);
      REQUIRE(read.first_corner.back() == read.corner_point.size());
      for (const std::uint32_t p : read.corner_point) {
        REQUIRE(p < read.points.size());
      }
    } catch (const Error& error) {
      REQUIRE((error.kind() == ErrorKind::unreadable_input || error.kind() == ErrorKind::unusable_mesh));
    }
  }
}

TEST_CASE("Damaged files of these formats are read or refused, never more", "[imported]") {
  if (!is_built()) {
    return;
  }
  Random random(11);
  for (const auto& [name, seed] : std::map<std::string, std::string>{
           {"a.fbx", fbx_tower()}, {"a.dae", dae_tower()}, {"a.3ds", max3ds_tower()}}) {
    for (int i = 0; i < 25; ++i) {
      std::string changed = seed;
      const auto at = [&] { return random.below(static_cast<std::uint32_t>(changed.size())); };
      if (i % 5 == 0) {
        changed.resize(at());
      }
      for (int k = 0; k < 4 && !changed.empty(); ++k) {
        changed[at()] = static_cast<char>(random.below(256));
      }
      const std::string told = import_refusal(changed, name);
      CHECK((told.empty() || told.starts_with(name)));
      CHECK(told.find('\n') == std::string::npos);
    }
  }
}

namespace {

/// A skin in COLLADA: a cube whose points a joint holds.
std::string dae_skin(const std::string& id, const std::string& joint, const std::string& bind_shape,
                     const std::string& inverse_bind) {
  return fmt::format(
      R"(<controller id="c{0}"><skin source="#cube"><bind_shape_matrix>{2}</bind_shape_matrix>)"
      R"(<source id="{0}j"><Name_array id="{0}ja" count="1">{1}</Name_array><technique_common>)"
      R"(<accessor source="#{0}ja" count="1" stride="1"><param name="JOINT" type="name"/></accessor></technique_common>)"
      R"(</source><source id="{0}b"><float_array id="{0}ba" count="16">{3}</float_array><technique_common>)"
      R"(<accessor source="#{0}ba" count="1" stride="16"><param name="TRANSFORM" type="float4x4"/></accessor>)"
      R"(</technique_common></source><source id="{0}w"><float_array id="{0}wa" count="1">1</float_array>)"
      R"(<technique_common><accessor source="#{0}wa" count="1" stride="1"><param name="WEIGHT" type="float"/></accessor>)"
      R"(</technique_common></source><joints><input semantic="JOINT" source="#{0}j"/>)"
      R"(<input semantic="INV_BIND_MATRIX" source="#{0}b"/></joints><vertex_weights count="8">)"
      R"(<input semantic="JOINT" source="#{0}j" offset="0"/><input semantic="WEIGHT" source="#{0}w" offset="1"/>)"
      R"(<vcount>1 1 1 1 1 1 1 1</vcount><v>0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0</v></vertex_weights></skin></controller>)",
      id, joint, bind_shape, inverse_bind);
}

}  // namespace

TEST_CASE("COLLADA: skins are where their joints hold them at rest", "[imported]") {
  if (!is_built()) {
    return;
  }
  const std::string identity = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
  const std::string dae =
      R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>)"
      R"(<unit meter="1" name="meter"/><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id="cube"><mesh>)"
      R"(<source id="p"><float_array id="pa" count="24">-1 -1 -1 1 -1 -1 1 1 -1 -1 1 -1 -1 -1 1 1 -1 1 1 1 1 -1 1 1)"
      R"(</float_array><technique_common><accessor count="8" source="#pa" stride="3"><param name="X" type="float"/>)"
      R"(<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>)"
      R"(<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><polylist count="6">)"
      R"(<input offset="0" semantic="VERTEX" source="#v"/><vcount>4 4 4 4 4 4</vcount>)"
      R"(<p>0 3 2 1 4 5 6 7 0 1 5 4 1 2 6 5 2 3 7 6 3 0 4 7</p></polylist></mesh></geometry></library_geometries>)"
      R"(<library_controllers>)" +
      dae_skin("b", "hip", identity, identity) +
      dae_skin("h", "neck", ".5 0 0 0 0 .5 0 2.5 0 0 .5 0 0 0 0 1", "1 0 0 0 0 1 0 -2 0 0 1 0 0 0 0 1") +
      R"(</library_controllers><library_visual_scenes><visual_scene id="s"><node id="rig" name="rig">)"
      R"(<node id="hip" sid="hip" name="hip" type="JOINT"><matrix>)" +
      identity +
      R"(</matrix><node id="neck" sid="neck" name="neck" type="JOINT"><matrix>1 0 0 0 0 1 0 2 0 0 1 0 0 0 0 1</matrix>)"
      R"(</node></node><node id="n1" name="body"><instance_controller url="#cb"><skeleton>#hip</skeleton>)"
      R"(</instance_controller></node><node id="n2" name="head"><instance_controller url="#ch"><skeleton>#hip</skeleton>)"
      R"(</instance_controller></node></node></visual_scene></library_visual_scenes>)"
      R"(<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
  const Soup soup = imported(dae, "skin.dae");
  REQUIRE(soup.polygon_count() == 12);
  Box3 body;
  Box3 head;
  for (std::size_t i = 0; i < 12; ++i) {
    for (const std::uint32_t p : soup.polygon(i)) {
      (i < 6 ? body : head).add(soup.points[p]);
    }
  }
  // The body is the cube, the head half as large and above it, as its bind_shape_matrix says.
  CHECK(length(body.low - Vec3{-1, -1, -1}) < 1e-6);
  CHECK(length(body.high - Vec3{1, 1, 1}) < 1e-6);
  CHECK(length(head.low - Vec3{-0.5, 2.0, -0.5}) < 1e-6);
  CHECK(length(head.high - Vec3{0.5, 3.0, 0.5}) < 1e-6);
}

TEST_CASE("FBX: a rotation of the axes is taken back before the object's own one", "[imported]") {
  if (!is_built()) {
    return;
  }
  std::string fbx = fbx_tower();
  const std::string model = "\"Mesh\" {\n\t\tVersion: 232\n";
  REQUIRE(fbx.find(model) != std::string::npos);
  fbx.insert(fbx.find(model) + model.size(),
             "\t\tProperties70:  {\n"
             "\t\t\tP: \"RotationActive\", \"bool\", \"\", \"\",1\n"
             "\t\t\tP: \"PostRotation\", \"Vector3D\", \"Vector\", \"\",0,0,90\n"
             "\t\t\tP: \"Lcl Rotation\", \"Lcl Rotation\", \"\", \"A\",0,0,90\n"
             "\t\t}\n");
  const Soup turned = imported(fbx, "tower.fbx");
  const Soup plain = imported(fbx_tower(), "tower.fbx");
  REQUIRE(turned.points.size() == plain.points.size());
  for (std::size_t i = 0; i < plain.points.size(); ++i) {
    CHECK(length(turned.points[i] - plain.points[i]) < 1e-5);
  }
}

TEST_CASE("COLLADA: colours of points count on grey materials, unless all are white", "[imported]") {
  if (!is_built()) {
    return;
  }
  const std::string grey = "0.5 0.5 0.5";
  const auto tower_in = [](const std::string& colours, const std::string& material) {
    std::string dae = dae_tower();
    const std::string orange = "1 0.5 0";
    dae.replace(dae.find(orange), orange.size(), material);
    const auto put = [&](const std::string& before, const std::string& what) {
      dae.insert(dae.find(before), what);
    };
    put("<vertices",
        R"(<source id="c"><float_array id="ca" count="24">)" + colours +
            R"(</float_array><technique_common><accessor source="#ca" count="8" stride="3">)"
            R"(<param name="R" type="float"/><param name="G" type="float"/><param name="B" type="float"/>)"
            R"(</accessor></technique_common></source>)");
    put("<vcount>", R"(<input semantic="COLOR" source="#c" offset="0" set="0"/>)");
    return imported(dae, "tower.dae");
  };
  const Soup painted = tower_in("0 0 1 0 0 1 0 0 1 0 0 1 1 0 0 1 0 0 1 0 0 1 0 0", grey);
  REQUIRE(painted.corner_colour.size() == painted.corner_point.size());
  for (std::size_t i = 0; i < painted.corner_point.size(); ++i) {
    const Vec3 p = painted.points[painted.corner_point[i]];
    CHECK(painted.corner_colour[i] == (std::max({p.x, p.y, p.z}) > 0.025 ? 0xff0000U : 0x0000ffU));
  }
  CHECK(tower_in("1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1", grey).corner_colour.empty());
  CHECK(tower_in("0 0 1 0 0 1 0 0 1 0 0 1 1 0 0 1 0 0 1 0 0 1 0 0", "1 0.5 0").corner_colour.empty());
}

TEST_CASE("COLLADA: polygons with holes are refused in words of our own", "[imported]") {
  if (!is_built()) {
    return;
  }
  std::string dae = dae_tower();
  const std::size_t at = dae.find("<p>");
  REQUIRE(at != std::string::npos);
  dae.replace(at, 3, "<ph><h>1</h></ph><p>");
  const std::string why = import_refusal(dae, "a.dae");
  CHECK(why.starts_with("a.dae can't be read as DAE: "));
  CHECK(why.ends_with("; open it in Blender and export it as glTF (.glb) or OBJ"));
}

TEST_CASE("The importer has its two streams and no more, and the system refuses it all else", "[imported]") {
  if (!is_built()) {
    return;
  }
  std::array<int, 2> in{};
  std::array<int, 2> out{};
  REQUIRE(::pipe(in.data()) == 0);
  REQUIRE(::pipe(out.data()) == 0);
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    // Descriptors that aren't closed on exec: the importer must not keep them.
    ::dup2(in[0], STDIN_FILENO);
    ::dup2(out[1], STDOUT_FILENO);
    ::execl(importer.c_str(), importer.c_str(), "FBX", static_cast<char*>(nullptr));
    ::_exit(127);
  }
  const std::string process = "/proc/" + std::to_string(child);
  std::string status;
  for (int i = 0; i < 2000 && status.find("Seccomp:\t2") == std::string::npos; ++i) {
    ::usleep(1000);
    std::ifstream file(process + "/status");
    status.assign(std::istreambuf_iterator<char>(file), {});
  }
  std::set<std::string> open;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(process + "/fd", ignored)) {
    open.insert(entry.path().filename().string());
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  for (const int end : {in[0], in[1], out[0], out[1]}) {
    ::close(end);
  }
#if !defined(RIDGECRAFT_SANITIZED)
  CHECK(status.find("Seccomp:\t2") != std::string::npos);
  CHECK(open == std::set<std::string>{"0", "1", "2"});
#endif
}
