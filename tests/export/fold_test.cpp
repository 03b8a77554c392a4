// SPDX-License-Identifier: GPL-3.0-or-later
// nets.fold is held to the contract by the contract's own checker, and read back key by key.
#include <cmath>
#include <numbers>
#include <set>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "base/encodings.hpp"
#include "base/random.hpp"
#include "export/export.hpp"
#include "support/check_nets.hpp"
#include "support/shapes.hpp"
#include "support/simple_nets.hpp"

using namespace ridgecraft;
using mesh::Surface;
using nlohmann::json;

namespace {

const export_::Mark model_mark{"ridgecraft 0.1.0", "model", "00c0ffee00c0ffee", {{"seed", "1"}}};

prepare::Prepared prepared(const Surface& surface, double scale = 1.0, Vec3 shift = {}) {
  std::vector<Vec3> points;
  for (const Vec3 p : surface.points()) {
    points.push_back(scale * p + shift);
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faces.push_back(surface.vertices(f));
  }
  prepare::Prepared model;
  model.model.surface = Surface(std::move(points), std::move(faces));
  model.panels = prepare::Panels{};
  return model;
}

IdVector<FaceId, PartId> one_part(const Surface& surface) {
  return IdVector<FaceId, PartId>(surface.face_count(), PartId(0));
}

/// Polygons over points, fanned from their first corner.
Surface polygons(std::vector<Vec3> points, const std::vector<std::vector<int>>& faces) {
  std::vector<std::array<VertexId, 3>> triangles;
  for (const auto& face : faces) {
    for (std::size_t k = 2; k < face.size(); ++k) {
      triangles.push_back({VertexId(face[0]), VertexId(face[k - 1]), VertexId(face[k])});
    }
  }
  return {std::move(points), std::move(triangles)};
}

/// A flat square ring with a hole: one face thick, border inside and outside.
Surface ring() {
  return polygons({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}},
                  {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

Surface open_box() {
  return polygons({{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {0, 0, 1}, {2, 0, 1}, {2, 3, 1}, {0, 3, 1}},
                  {{0, 3, 2, 1}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

Surface torus(int around, int along) {
  std::vector<Vec2> profile;
  for (int k = 0; k <= along; ++k) {
    const double angle = 2.0 * std::numbers::pi * (k % along) / along;
    profile.push_back({3.0 + std::cos(angle), std::sin(angle)});
  }
  return test::revolve(profile, around);
}

std::vector<EdgeId> each_edge(const Surface& surface) {
  std::vector<EdgeId> edges;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    edges.push_back(e);
  }
  return edges;
}

/// Pages by hand: the pieces stand on pages of their own, turned by some angle.
export_::Pages one_piece_a_page(const unfold::Nets& nets) {
  export_::Pages pages;
  pages.paper.size = {400.0, 400.0};
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    export_::Placement placement;
    placement.page = PageId(pages.count++);
    placement.cosine = std::cos(0.3 + p.value());
    placement.sine = std::sin(0.3 + p.value());
    Box2 box;
    for (const FaceId f : nets.pieces[p].faces) {
      for (const Vec2 corner : nets.flat[f]) {
        box.add(placement(corner));
      }
    }
    placement.shift = Vec2{200.0, 200.0} - 0.5 * (box.low + box.high);
    pages.placements.push_back(placement);
  }
  return pages;
}

void check_contract(const std::string& name, const std::string& fold) {
  INFO(name);
  const auto report = test::check_nets(fold);
  if (report.ran) {
    INFO(report.output);
    CHECK(report.exit_code == 0);
  }
}

std::string write(const prepare::Prepared& model, const unfold::Nets& nets,
                  const export_::Pages* pages = nullptr) {
  return export_::write_fold(
      {model, one_part(model.model.surface), nets, export_::assembly_order(model.model.surface, nets), pages},
      model_mark);
}

}  // namespace

TEST_CASE("simple shapes keep the contract, with pages and without", "[fold]") {
  const std::vector<std::pair<std::string, Surface>> shapes{
      {"cube", test::cube()},
      {"L-shaped prism with a valley fold", test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})},
      {"tetrahedron", test::tetrahedron()},
      {"open box", open_box()},
      {"square ring", ring()},
  };
  for (const auto& [name, shape] : shapes) {
    const prepare::Prepared model = prepared(shape, 40.0, {-3.7, 1e3, 2.0});
    const unfold::Nets nets = test::simple_nets(model.model.surface);
    check_contract(name, write(model, nets));
    const export_::Pages pages = one_piece_a_page(nets);
    check_contract(name + " on pages", write(model, nets, &pages));
  }
}

TEST_CASE("many pieces: every face of a torus its own, and a sphere in slices", "[fold]") {
  const prepare::Prepared ring = prepared(torus(9, 6), 10.0);
  const unfold::Nets nets = test::simple_nets(ring.model.surface, each_edge(ring.model.surface));
  CHECK(nets.pieces.size() == 108);
  check_contract("torus", write(ring, nets));
  const export_::Pages pages = one_piece_a_page(nets);
  check_contract("torus on pages", write(ring, nets, &pages));

  const prepare::Prepared ball = prepared(test::sphere(12, 6), 50.0);
  std::vector<EdgeId> meridians;
  for (const EdgeId e : ids<EdgeId>(ball.model.surface.edge_count())) {
    const CornerId c = ball.model.surface.sides(e)[0];
    const Vec3 p = ball.model.surface.point(ball.model.surface.vertex(c));
    const Vec3 q = ball.model.surface.point(ball.model.surface.vertex(mesh::next(c)));
    if (std::abs(p.x * q.y - p.y * q.x) < 1e-9 * 2500.0) {
      meridians.push_back(e);
    }
  }
  const unfold::Nets slices = test::simple_nets(ball.model.surface, meridians);
  CHECK(slices.pieces.size() == 12);
  check_contract("sphere in slices", write(ball, slices));
}

TEST_CASE("sizes far from the usual keep all their digits", "[fold]") {
  for (const double scale : {1e-3, 1e-5, 1e4}) {
    const prepare::Prepared model = prepared(test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), scale);
    check_contract("scale " + std::to_string(scale), write(model, test::simple_nets(model.model.surface)));
  }
}

TEST_CASE("the keys of the contract, their classes and lengths", "[fold]") {
  const prepare::Prepared model = prepared(test::cube(), 40.0);
  const unfold::Nets nets = test::simple_nets(model.model.surface);
  const export_::Pages pages = one_piece_a_page(nets);
  const json file = json::parse(write(model, nets, &pages));
  CHECK(file["file_spec"] == 1.2);
  CHECK(file["file_creator"] == model_mark.producer);
  CHECK(file["file_title"] == "model");
  CHECK(file["file_classes"] == json{"multiModel"});
  CHECK(file["frame_classes"] == json{"creasePattern"});
  CHECK(file["frame_unit"] == "mm");
  CHECK(file["ridgecraft:model_digest"] == model_mark.digest);
  CHECK(file["ridgecraft:settings"] == json{{"seed", 1}});
  CHECK(file["faces_vertices"].size() == 12);
  // 12 faces in a tree with 11 folds.
  CHECK(file["edges_vertices"].size() == 11 + 2 * 7);
  CHECK(file["vertices_coords"].size() == 14);
  int folds = 0;
  for (std::size_t e = 0; e < file["edges_vertices"].size(); ++e) {
    const std::string kind = file["edges_assignment"][e];
    const double angle = file["edges_foldAngle"][e];
    folds += kind == "B" ? 0 : 1;
    CHECK((kind == "M" ? angle == Approx(-90.0) : kind != "V" && angle == 0.0 && !std::signbit(angle)));
  }
  CHECK(folds == 11);
  CHECK(file["ridgecraft:joins"].size() == 7);
  CHECK(file["ridgecraft:pages"][0]["size"] == json{400.0, 400.0});
  CHECK(file["ridgecraft:pages"][0]["margins"] == json{10.0, 10.0, 10.0, 10.0});
  CHECK(file["ridgecraft:pieces"][0]["part"] == 0);
  CHECK(file["file_frames"][0]["ridgecraft:faces_part"].size() == 12);
  CHECK(export_::read_mark_digest(write(model, nets)) == model_mark.digest);
}

TEST_CASE("folds below 1e-4 degrees are flat, with angle 0", "[fold]") {
  for (const double degrees : {0.0, 0.9e-4, 1.1e-4}) {
    const double rise = std::tan(degrees * std::numbers::pi / 180.0);
    for (const double sign : {1.0, -1.0}) {
      const Surface surface =
          polygons({{0, -1, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, sign * rise}}, {{0, 3, 1}, {0, 1, 2}});
      const prepare::Prepared model = prepared(surface, 50.0);
      const json file = json::parse(write(model, test::simple_nets(model.model.surface)));
      const auto kinds = file["edges_assignment"].get<std::vector<std::string>>();
      const auto fold =
          std::find_if(kinds.begin(), kinds.end(), [](const std::string& kind) { return kind != "B"; });
      CHECK(*fold == (degrees < 1e-4 ? "F" : sign > 0.0 ? "V" : "M"));
      const double angle = file["edges_foldAngle"][static_cast<std::size_t>(fold - kinds.begin())];
      CHECK((degrees < 1e-4 ? angle == 0.0 : angle == Approx(sign * degrees).epsilon(1e-3)));
    }
  }
}

TEST_CASE("a slit in a flat region becomes a fold and loses its join", "[fold]") {
  // A flat square fan of 16 faces round an inner ring: the edge between two inner vertices can be cut on its
  // own.
  std::vector<Vec3> points;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      points.push_back({20.0 * x, 20.0 * y, 0.0});
    }
  }
  std::vector<std::vector<int>> squares;
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 3; ++x) {
      const int at = 4 * y + x;
      squares.push_back({at, at + 1, at + 5, at + 4});
    }
  }
  const prepare::Prepared model = prepared(polygons(points, squares));
  const Surface& surface = model.model.surface;
  unfold::Nets nets = test::simple_nets(surface);
  REQUIRE(nets.pieces.size() == 1);
  REQUIRE(nets.joins.empty());
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const CornerId c = surface.sides(e)[0];
    const std::set<VertexId> ends{surface.vertex(c), surface.vertex(mesh::next(c))};
    if (ends == std::set<VertexId>{VertexId(5), VertexId(6)}) {
      nets.use[e] = unfold::EdgeUse::cut;
      nets.joins.push_back({e, 1, {}});
    }
  }
  REQUIRE(nets.joins.size() == 1);
  const std::string fold = write(model, nets);
  CHECK(json::parse(fold)["ridgecraft:joins"].empty());
  check_contract("slit", fold);
}

TEST_CASE("tabs and joins name each other", "[fold]") {
  const prepare::Prepared model = prepared(test::cube(), 40.0);
  const Surface& surface = model.model.surface;
  unfold::Nets nets = test::simple_nets(surface);
  for (const JoinId j : ids<JoinId>(nets.joins.size())) {
    unfold::Join& join = nets.joins[j];
    const CornerId side = surface.sides(join.edge)[1];
    const auto& corners = nets.flat[mesh::face_of(side)];
    const Vec2 a = corners[mesh::next(side).value() % 3];
    const Vec2 b = corners[side.value() % 3];
    const Vec2 along = (b - a) / length(b - a);
    // Outside of the face is to the left of a b. Low enough to meet nothing on either side.
    const Vec2 up = 0.5 * perpendicular(along);
    join.tab = nets.tabs.push_back({side, j, {a, b, b - 0.5 * along + up, a + 0.5 * along + up}});
    join.no_tab = unfold::NoTab::has_tab;
  }
  const export_::Pages pages = one_piece_a_page(nets);
  const std::string fold = write(model, nets, &pages);
  const json file = json::parse(fold);
  REQUIRE(file["ridgecraft:tabs"].size() == 7);
  check_contract("cube with tabs", fold);
  // Also where no pages are: each piece on an unbounded one.
  const std::string bare = write(model, nets);
  CHECK(json::parse(bare)["ridgecraft:tabs"].size() == 7);
  check_contract("cube with tabs, no pages", bare);
}

TEST_CASE("several parts: pieces name theirs, faces theirs", "[fold]") {
  const prepare::Prepared model = prepared(test::cube(), 40.0);
  const Surface& surface = model.model.surface;
  IdVector<FaceId, PartId> part(surface.face_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    part[f] = PartId(std::abs(surface.normal(f).z) > 0.5 ? 3 : 1);
  }
  const unfold::Nets whole = test::simple_nets(surface, {}, part);
  const std::string fold = export_::write_fold({model, part, whole, {}}, model_mark);
  check_contract("piece of two parts", fold);
  const json file = json::parse(fold);
  CHECK(file["ridgecraft:pieces"][0]["part"].is_null());
  CHECK(file["ridgecraft:pieces"][0]["parts"] == json{1, 3});
}

TEST_CASE("titles of any bytes make valid JSON", "[fold]") {
  CHECK(json_string("wh\xC3\xA9\"\\\n\x01\x7f") == "\"wh\xC3\xA9\\\"\\\\\\u000a\\u0001\\u007f\"");
  CHECK(json_string("\xFF\xC3") == "\"\\ufffd\\ufffd\"");
  CHECK(json_string("\xED\xA0\x80") == "\"\\ufffd\\ufffd\\ufffd\"");
  CHECK(json_string("\xF0\x9F\x90\xB3") == "\"\xF0\x9F\x90\xB3\"");
  Random random(3);
  for (int round = 0; round < 3000; ++round) {
    std::string bytes;
    for (std::uint32_t n = random.below(12); n > 0; --n) {
      bytes += static_cast<char>(random.below(4) == 0 ? random.below(128) : 128 + random.below(128));
    }
    CHECK_NOTHROW(json::parse(json_string(bytes)));
  }
  const prepare::Prepared model = prepared(test::tetrahedron(), 40.0);
  export_::Mark odd = model_mark;
  odd.title = "a\xFF\"b\\";
  const std::string fold = export_::write_fold(
      {model, one_part(model.model.surface), test::simple_nets(model.model.surface), {}}, odd);
  CHECK(json::parse(fold)["file_title"] == "a\xEF\xBF\xBD\"b\\");
}

TEST_CASE("numbers read back as they were", "[fold]") {
  Random random(5);
  for (int round = 0; round < 5000; ++round) {
    const double value = std::ldexp(random.unit() - 0.5, static_cast<int>(random.below(200)) - 100);
    JsonText text;
    text.number(value);
    CHECK(json::parse(std::move(text).take()).get<double>() == value);
  }
  JsonText zero;
  zero.number(-0.0);
  CHECK(std::move(zero).take() == "0");
}
