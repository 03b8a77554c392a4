// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/support.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <catch2/catch.hpp>

#include "mesh/mesh.hpp"
#include "support/program.hpp"

namespace ridgecraft::test {
namespace {

using Json = nlohmann::json;
constexpr double side = 40.0;
constexpr double tab_height = 6.0;

Json frame_2d() {
  return {{"file_spec", 1.2},
          {"file_creator", "a test"},
          {"file_title", "cube"},
          {"file_classes", {"multiModel"}},
          {"frame_classes", {"creasePattern"}},
          {"frame_attributes", {"2D"}},
          {"frame_unit", "mm"},
          {"ridgecraft:settings", Json::object()}};
}

Json frame_3d(const Json& points, const Json& faces, const Json& parts) {
  return {{"frame_classes", {"foldedForm"}}, {"frame_attributes", {"3D", "manifold"}},
          {"frame_inherit", false},          {"frame_unit", "mm"},
          {"vertices_coords", points},       {"faces_vertices", faces},
          {"ridgecraft:faces_part", parts}};
}

using Quad = std::array<int, 4>;

// Seen from outside, counterclockwise; the bottom is the middle of the cross.
constexpr std::array<Quad, 6> model_faces = {
    {{0, 2, 3, 1}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}, {4, 5, 7, 6}}};

// The cross: rows of vertices at y = 0, 1, 2, 3, 4 sides.
constexpr std::array<std::array<int, 2>, 14> net_points = {{{1, 0},
                                                            {2, 0},
                                                            {1, 1},
                                                            {2, 1},
                                                            {0, 2},
                                                            {1, 2},
                                                            {2, 2},
                                                            {3, 2},
                                                            {0, 3},
                                                            {1, 3},
                                                            {2, 3},
                                                            {3, 3},
                                                            {1, 4},
                                                            {2, 4}}};

// Corner k is corner k of the model face: the bottom lies at (1..2, 2..3), its corners 0, 2, 3, 1 at 5, 6,
// 10, 9.
constexpr std::array<Quad, 6> net_faces = {
    {{5, 6, 10, 9}, {5, 9, 8, 4}, {9, 10, 13, 12}, {10, 6, 7, 11}, {6, 5, 2, 3}, {2, 0, 1, 3}}};

}  // namespace

Json cube_file() {
  Json json = frame_2d();
  Json model_points = Json::array();
  for (int i = 0; i < 8; ++i) {
    model_points.push_back({side * (i % 2), side * (i / 2 % 2), side * (i / 4)});
  }
  json["file_frames"] = {frame_3d(model_points, model_faces, std::vector<int>(6, 0))};
  for (const auto& p : net_points) {
    json["vertices_coords"].push_back({20.0 + side * p[0], 20.0 + side * p[1]});
  }
  json["faces_vertices"] = net_faces;
  json["ridgecraft:faces_model"] = {0, 1, 2, 3, 4, 5};
  json["ridgecraft:faces_piece"] = {0, 0, 0, 0, 0, 0};
  json["ridgecraft:pieces"] = {
      {{"name", "A"}, {"part", 0}, {"parts", {0}}, {"page", 0}, {"reason", "component"}}};
  json["ridgecraft:pages"] = {{{"origin", {0, 0}}, {"size", {210, 297}}, {"margins", {10, 10, 10, 10}}}};

  struct Sides {
    std::vector<std::pair<int, int>> directed;  ///< as the faces run
    int model_edge_low = 0, model_edge_high = 0;
  };
  std::map<std::pair<int, int>, Sides> edges;
  for (std::size_t f = 0; f < 6; ++f) {
    const auto corners = net_faces[f];
    for (std::size_t k = 0; k < 4; ++k) {
      const int a = corners[k];
      const int b = corners[(k + 1) % 4];
      Sides& sides = edges[std::minmax(a, b)];
      sides.directed.emplace_back(a, b);
      std::tie(sides.model_edge_low, sides.model_edge_high) =
          std::minmax(model_faces[f][k], model_faces[f][(k + 1) % 4]);
    }
  }
  std::map<std::pair<int, int>, std::vector<int>> cuts;  // by model edge
  std::vector<std::pair<int, int>> direction;
  for (const auto& [ends, sides] : edges) {
    const bool fold = sides.directed.size() == 2;
    if (!fold) {
      cuts[{sides.model_edge_low, sides.model_edge_high}].push_back(static_cast<int>(direction.size()));
    }
    json["edges_vertices"].push_back({ends.first, ends.second});
    json["edges_assignment"].push_back(fold ? "M" : "B");
    json["edges_foldAngle"].push_back(fold ? -90.0 : 0.0);
    direction.push_back(sides.directed[0]);
  }
  int number = 0;
  for (const auto& [model_edge, pair] : cuts) {
    const auto point = [&json](int v) {
      return Vec2{json["vertices_coords"][static_cast<std::size_t>(v)][0],
                  json["vertices_coords"][static_cast<std::size_t>(v)][1]};
    };
    const auto [from, to] = direction[static_cast<std::size_t>(pair[0])];
    const Vec2 a = point(to);
    const Vec2 b = point(from);
    const Vec2 along = (b - a) / side;
    const Vec2 out = perpendicular(along);
    const Vec2 c = b + tab_height * (out - along);
    const Vec2 d = a + tab_height * (out + along);
    json["ridgecraft:tabs"].push_back({{"edge", pair[0]},
                                       {"polygon", {{a.x, a.y}, {b.x, b.y}, {c.x, c.y}, {d.x, d.y}}},
                                       {"joins", {number + 1}}});
    json["ridgecraft:joins"].push_back({{"number", number + 1}, {"edges", pair}, {"tab", number}});
    ++number;
  }
  return json;
}

Json loose_file(const std::vector<std::vector<Vec2>>& polygons) {
  Json json = frame_2d();
  Json points = Json::array();
  Json model_points = Json::array();
  Json faces = Json::array();
  for (std::size_t f = 0; f < polygons.size(); ++f) {
    Json face = Json::array();
    for (std::size_t k = 0; k < polygons[f].size(); ++k) {
      const Vec2 p = polygons[f][k];
      const auto v = static_cast<int>(points.size());
      face.push_back(v);
      points.push_back({p.x, p.y});
      model_points.push_back({p.x, p.y, static_cast<double>(f)});
      const auto next = k + 1 < polygons[f].size() ? v + 1 : v + 1 - static_cast<int>(polygons[f].size());
      json["edges_vertices"].push_back({v, next});
      json["edges_assignment"].push_back("B");
      json["edges_foldAngle"].push_back(0);
    }
    faces.push_back(face);
    json["ridgecraft:faces_model"].push_back(f);
    json["ridgecraft:faces_piece"].push_back(f);
    json["ridgecraft:pieces"].push_back({{"name", "P" + std::to_string(f)},
                                         {"part", 0},
                                         {"parts", {0}},
                                         {"page", 0},
                                         {"reason", "component"}});
  }
  json["vertices_coords"] = points;
  json["faces_vertices"] = faces;
  json["ridgecraft:pages"] = {{{"origin", {0, 0}}, {"size", nullptr}}};
  json["ridgecraft:joins"] = Json::array();
  json["ridgecraft:tabs"] = Json::array();
  json["file_frames"] = {frame_3d(model_points, faces, std::vector<int>(polygons.size(), 0))};
  return json;
}

verify::Report verify_json(const Json& json) {
  return verify::verify(json.dump(), {}, {});
}

std::vector<int> broken(const verify::Report& report) {
  std::set<int> promises;
  for (const verify::Fault& fault : report.faults) {
    promises.insert(static_cast<int>(fault.promise));
  }
  return {promises.begin(), promises.end()};
}

std::vector<int> broken(const Json& json) {
  return broken(verify_json(json));
}

namespace fs = std::filesystem;

WrittenJob::WrittenJob(const fs::path& model, const std::vector<std::string>& options)
    : name(model.stem().string()) {
  std::vector<std::string> arguments{model.string(), "-o", folder.path().string(), "-q"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Outcome outcome = run_program(arguments);
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  fold = read_bytes(folder / (name + ".fold"));
  pdf.push_back(verify::read_pdf(name + ".pdf", read_bytes(folder / (name + ".pdf"))));
  for (const std::string& file : folder.names()) {
    if (file.ends_with(".svg")) {
      verify::PrintedFile read = verify::read_svg(file, read_bytes(folder / file));
      (read.whole ? svg_of_all : svg).push_back(std::move(read));
    }
  }
}

const WrittenJob& whale() {
  static const WrittenJob job(sample("whale.obj"), {"--size", "180mm"});
  return job;
}

fs::path sample(const std::string& name) {
  return fs::path(RIDGECRAFT_SOURCE_DIR) / "samples" / name;
}

verify::ModelSurface surface_of(const fs::path& model) {
  const mesh::Model read = mesh::read(model, {}, {});
  verify::ModelSurface surface;
  surface.points.assign(read.surface.points().begin(), read.surface.points().end());
  for (const FaceId f : ids<FaceId>(read.surface.face_count())) {
    const auto [a, b, c] = read.surface.vertices(f);
    surface.faces.push_back({a.value(), b.value(), c.value()});
  }
  surface.units_per_point_unit = read.file_scale;
  surface.digest = read.digest;
  return surface;
}

verify::Report verify_pages(const std::string& fold, const std::vector<verify::PrintedFile>& pages) {
  return verify::verify(fold, {}, {}, {nullptr, pages});
}

verify::Report verify_model(const std::string& fold, const verify::ModelSurface& surface) {
  return verify::verify(fold, {}, {}, {&surface, {}});
}

std::string first_fault(const verify::Report& report) {
  return report.faults.empty() ? std::string() : report.faults.front().message;
}

}  // namespace ridgecraft::test
