// SPDX-License-Identifier: GPL-3.0-or-later
// Printed pages against the model's file, which is read here by other means: dots of a page lead back to the
// model by the file of nets, and have its colours.
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "base/vector.hpp"
#include "cli/program_checks.hpp"
#include "mesh/look/picture.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
namespace fs = std::filesystem;
using mesh::Picture;
using mesh::Rgb;

namespace {

constexpr double dots_per_inch = 150.0;
constexpr double dots_per_mm = dots_per_inch / 25.4;
/// A region is flat where all faces around a place, so near, mm, have one colour.
constexpr double flat_mm = 1.0;

/// CIE 1976 of sRGB under D65.
std::array<double, 3> lab(const Rgb& colour) {
  std::array<double, 3> light{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double shown = colour[k] / 255.0;
    light[k] = shown <= 0.04045 ? shown / 12.92 : std::pow((shown + 0.055) / 1.055, 2.4);
  }
  const auto f = [](double t) {
    return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
  };
  const double x = f((0.4124 * light[0] + 0.3576 * light[1] + 0.1805 * light[2]) / 0.9505);
  const double y = f(0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2]);
  const double z = f((0.0193 * light[0] + 0.1192 * light[1] + 0.9505 * light[2]) / 1.089);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

double delta_e(const Rgb& a, const Rgb& b) {
  const auto p = lab(a);
  const auto q = lab(b);
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

/// Triangles of an OBJ file with their materials: as much of the format as the models here have.
class ColouredObj {
 public:
  explicit ColouredObj(const fs::path& file) {
    std::ifstream in(file);
    std::vector<Vec3> points;
    std::vector<Vec2> places;
    std::string material;
    for (std::string line; std::getline(in, line);) {
      std::istringstream words(line);
      std::string word;
      words >> word;
      if (word == "mtllib") {
        words >> word;
        read_materials(file.parent_path() / word);
      } else if (word == "v") {
        Vec3& p = points.emplace_back();
        words >> p.x >> p.y >> p.z;
        box.add(p);
      } else if (word == "vt") {
        Vec2& p = places.emplace_back();
        words >> p.x >> p.y;
      } else if (word == "usemtl") {
        words >> material;
      } else if (word == "f") {
        std::vector<std::pair<Vec3, Vec2>> corners;
        while (words >> word) {
          const auto slash = word.find('/');
          const Vec2 place = slash == word.npos || word[slash + 1] == '/'
                                 ? Vec2{}
                                 : places[std::stoul(word.substr(slash + 1)) - 1];
          corners.emplace_back(points[std::stoul(word) - 1], place);
        }
        for (std::size_t i = 2; i < corners.size(); ++i) {
          Face face{{corners[0].first, corners[i - 1].first, corners[i].first},
                    {corners[0].second, corners[i - 1].second, corners[i].second},
                    {},
                    &materials_[material]};
          face.normal = normalized(cross(face.at[1] - face.at[0], face.at[2] - face.at[0]));
          faces_.push_back(face);
        }
      }
    }
  }

  /// The colour at a place of a face that looks to this side; nothing where another colour is so near.
  [[nodiscard]] std::optional<Rgb> flat_colour(Vec3 p, Vec3 normal, double near) const {
    double nearest = INFINITY;
    std::optional<Rgb> found;
    std::vector<Rgb> around;
    for (const Face& face : faces_) {
      if (dot(face.normal, normal) < 0.3) {
        continue;
      }
      const auto [distance, place] = nearest_of(face, p);
      if (distance < near) {
        for (const Vec2 step : {Vec2{0, 0}, {near, 0}, {-near, 0}, {0, near}, {0, -near}}) {
          const Vec3 u = normalized(face.at[1] - face.at[0]);
          const auto [ignored, beside] = nearest_of(face, p + step.x * u + step.y * cross(face.normal, u));
          around.push_back(colour_of(face, beside));
        }
      }
      if (distance < nearest) {
        nearest = distance;
        found = colour_of(face, place);
      }
    }
    for (const Rgb& other : around) {
      if (found && delta_e(other, *found) > 1.0) {
        return std::nullopt;
      }
    }
    return found;
  }

  Box3 box;

 private:
  struct Material {
    Rgb colour{255, 255, 255};
    std::optional<Picture> picture;
  };
  struct Face {
    std::array<Vec3, 3> at;
    std::array<Vec2, 3> places;
    Vec3 normal;
    const Material* material;
  };

  void read_materials(const fs::path& file) {
    std::ifstream in(file);
    std::string name;
    for (std::string line; std::getline(in, line);) {
      std::istringstream words(line);
      std::string word;
      words >> word;
      if (word == "newmtl") {
        words >> name;
      } else if (word == "Kd") {
        for (std::uint8_t& channel : materials_[name].colour) {
          double value = 0.0;
          words >> value;
          channel = static_cast<std::uint8_t>(std::lround(255.0 * value));
        }
      } else if (word == "map_Kd") {
        words >> word;
        materials_[name].picture = mesh::unpack_picture(read_bytes(file.parent_path() / word));
        REQUIRE(materials_[name].picture);
      }
    }
  }

  /// Dense sampling would do; projection onto the plane and its sides is as plain.
  static std::pair<double, std::array<double, 3>> nearest_of(const Face& face, Vec3 p) {
    const auto& [a, b, c] = face.at;
    const Vec3 n = cross(b - a, c - a);
    const double area = dot(n, n);
    const std::array<double, 3> inside{dot(cross(b - p, c - p), n) / area, dot(cross(c - p, a - p), n) / area,
                                       dot(cross(a - p, b - p), n) / area};
    if (inside[0] >= 0.0 && inside[1] >= 0.0 && inside[2] >= 0.0) {
      return {std::abs(dot(p - a, face.normal)), inside};
    }
    std::pair<double, std::array<double, 3>> best{INFINITY, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 from = face.at[k];
      const Vec3 side = face.at[(k + 1) % 3] - from;
      const double t = std::clamp(dot(p - from, side) / dot(side, side), 0.0, 1.0);
      const double distance = length(p - (from + t * side));
      if (distance < best.first) {
        best = {distance, {}};
        best.second[k] = 1.0 - t;
        best.second[(k + 1) % 3] = t;
      }
    }
    return best;
  }

  static Rgb colour_of(const Face& face, const std::array<double, 3>& weights) {
    if (!face.material->picture) {
      return face.material->colour;
    }
    const Vec2 uv = weights[0] * face.places[0] + weights[1] * face.places[1] + weights[2] * face.places[2];
    const Picture& picture = *face.material->picture;
    const auto pixel = [](double share, std::uint32_t size) {
      return std::min(static_cast<std::size_t>(std::max(share * size, 0.0)), std::size_t{size} - 1);
    };
    const std::size_t at =
        3 * (pixel(1.0 - uv.y, picture.height()) * picture.width() + pixel(uv.x, picture.width()));
    return {picture.pixels()[at], picture.pixels()[at + 1], picture.pixels()[at + 2]};
  }

  std::map<std::string, Material> materials_;
  std::vector<Face> faces_;
};

struct Difference {
  std::size_t places = 0;
  double sum = 0.0;
  double largest = 0.0;
  std::size_t far = 0;  ///< places that are off by more than 5

  [[nodiscard]] double mean() const { return sum / static_cast<double>(places); }
};

std::vector<Picture> printed(const TemporaryFolder& folder, const std::string& pdf) {
  REQUIRE(run_command({"pdftoppm", "-r", "150", "-png", pdf, pdf}, in(folder)).exit_code == 0);
  std::vector<Picture> pages;
  for (const std::string& name : folder.names()) {
    if (name.starts_with(pdf + "-")) {
      pages.push_back(mesh::unpack_picture(read_bytes(folder / name)).value());
    }
  }
  return pages;
}

Rgb dot_at(const Picture& page, int x, int y) {
  const auto at = static_cast<std::size_t>(3 * (y * static_cast<int>(page.width()) + x));
  return {page.pixels()[at], page.pixels()[at + 1], page.pixels()[at + 2]};
}

/// Whether lines or letters are near a dot of the page that has nothing else.
bool has_lines(const Picture& page, int x, int y) {
  for (int dy = -3; dy <= 3; ++dy) {
    for (int dx = -3; dx <= 3; ++dx) {
      const Rgb dot = dot_at(page, x + dx, y + dy);
      if (dot[0] < 250) {
        return true;
      }
    }
  }
  return false;
}

Vec3 point(const nlohmann::json& coordinates) {
  return {coordinates[0], coordinates[1], coordinates[2]};
}

/// Of all dots inside faces, away from lines, in regions of one colour.
Difference difference(const TemporaryFolder& folder, const fs::path& model,
                      std::vector<std::string> options) {
  options.insert(options.begin(), {model.string(), "-o", "nets.fold", "--overwrite"});
  for (const std::string ink : {"lines", "colour"}) {
    std::vector<std::string> words = options;
    words.insert(words.end(), {"--ink", ink, "-o", ink + ".pdf"});
    REQUIRE(run_program(words, in(folder)).exit_code == 0);
  }
  const std::vector<Picture> pages = printed(folder, "colour.pdf");
  const std::vector<Picture> lines = printed(folder, "lines.pdf");
  REQUIRE(pages.size() == lines.size());

  const auto nets = nlohmann::json::parse(read_bytes(folder / "nets.fold"));
  const auto& shape = nets["file_frames"][0];
  const ColouredObj original(model);
  Box3 box;
  for (const auto& p : shape["vertices_coords"]) {
    box.add(point(p));
  }
  const double scale = original.box.largest_extent() / box.largest_extent();
  const Vec3 shift = 0.5 * (original.box.low + original.box.high) - scale * 0.5 * (box.low + box.high);
  Difference result;
  for (std::size_t f = 0; f < nets["faces_vertices"].size(); ++f) {
    const auto& piece = nets["ridgecraft:pieces"][nets["ridgecraft:faces_piece"][f].get<std::size_t>()];
    const auto page = piece["page"].get<std::size_t>();
    const auto& sheet = nets["ridgecraft:pages"][page];
    std::array<Vec2, 3> flat{};
    std::array<Vec3, 3> solid{};
    Box2 room;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& p = nets["vertices_coords"][nets["faces_vertices"][f][k].get<std::size_t>()];
      flat[k] = {p[0].get<double>() - sheet["origin"][0].get<double>(),
                 sheet["size"][1].get<double>() - (p[1].get<double>() - sheet["origin"][1].get<double>())};
      room.add(flat[k]);
      const auto face = nets["ridgecraft:faces_model"][f].get<std::size_t>();
      solid[k] =
          scale * point(shape["vertices_coords"][shape["faces_vertices"][face][k].get<std::size_t>()]) +
          shift;
    }
    const Vec3 normal = normalized(cross(solid[1] - solid[0], solid[2] - solid[0]));
    const double area = cross(flat[1] - flat[0], flat[2] - flat[0]);
    constexpr double step = 1.3;  // mm
    for (double y = room.low.y; y < room.high.y; y += step) {
      for (double x = room.low.x; x < room.high.x; x += step) {
        const int column = static_cast<int>(x * dots_per_mm);
        const int row = static_cast<int>(y * dots_per_mm);
        const Vec2 middle{(column + 0.5) / dots_per_mm, (row + 0.5) / dots_per_mm};
        const double v = cross(middle - flat[0], flat[2] - flat[0]) / area;
        const double w = cross(flat[1] - flat[0], middle - flat[0]) / area;
        if (v < 0.02 || w < 0.02 || v + w > 0.98 || has_lines(lines[page], column, row)) {
          continue;
        }
        const Vec3 at = (1.0 - v - w) * solid[0] + v * solid[1] + w * solid[2];
        const auto wanted = original.flat_colour(at, normal, flat_mm * scale);
        if (!wanted) {
          continue;
        }
        const double off = delta_e(*wanted, dot_at(pages[page], column, row));
        ++result.places;
        result.sum += off;
        result.largest = std::max(result.largest, off);
        result.far += off > 5.0 ? 1U : 0U;
      }
    }
  }
  return result;
}

/// `most_far`: the share of places that may be off, where pictures have details that the look around misses.
void check(const std::string& name, const Difference& difference, double most_far = 0.02) {
  WARN(name << ": " << difference.places << " places, mean difference " << difference.mean() << ", largest "
            << difference.largest << ", " << difference.far << " above 5");
  REQUIRE(difference.places > 200);
  CHECK(difference.mean() <= 2.0);
  CHECK(static_cast<double>(difference.far) <= most_far * static_cast<double>(difference.places));
}

fs::path sample(const std::string& name) {
  return fs::path(RIDGECRAFT_SOURCE_DIR) / "samples" / name;
}

}  // namespace

TEST_CASE("Printed colours are those of the model's file", "[slow]") {
  for (const std::string name : {"whale.obj", "house.obj", "penguin.obj", "fox_head.obj"}) {
    const TemporaryFolder folder;
    check(name, difference(folder, sample(name), {}));
  }
}

TEST_CASE("Printed pictures lie as on the model, neither turned nor mirrored", "[slow]") {
  const TemporaryFolder folder;
  // Four colours in four quarters, and a box whose sides bear them in different ways.
  std::vector<std::uint8_t> pixels;
  for (std::uint32_t y = 0; y < 128; ++y) {
    for (std::uint32_t x = 0; x < 128; ++x) {
      const Rgb colour = y < 64 ? (x < 64 ? Rgb{220, 40, 40} : Rgb{40, 180, 60})
                                : (x < 64 ? Rgb{40, 70, 200} : Rgb{240, 210, 60});
      pixels.insert(pixels.end(), colour.begin(), colour.end());
    }
  }
  write_bytes(folder / "quarters.jpg", mesh::pack_jpeg(128, 128, pixels));
  write_bytes(folder / "box.mtl", "newmtl skin\nmap_Kd quarters.jpg\n");
  write_bytes(folder / "box.obj",
              "mtllib box.mtl\nv 0 0 0\nv 5 0 0\nv 5 4 0\nv 0 4 0\nv 0 0 3\nv 5 0 3\nv 5 4 3\nv 0 4 3\n"
              "vt 0.05 0.05\nvt 0.95 0.05\nvt 0.95 0.95\nvt 0.05 0.95\nusemtl skin\n"
              "f 1/1 4/2 3/3 2/4\nf 5/1 6/2 7/3 8/4\nf 1/4 2/1 6/2 5/3\nf 2/2 3/3 7/4 6/1\n"
              "f 3/1 4/2 8/3 7/4\nf 4/3 1/4 5/1 8/2\n");
  for (const auto& options : std::vector<std::vector<std::string>>{{}, {"--size", "80"}}) {
    check("box", difference(folder, folder / "box.obj", options));
  }
}

TEST_CASE("Printed colours of makers' models", "[slow]") {
  const fs::path makers = fs::path(RIDGECRAFT_SHARED_DIR) / "models" / "makers";
  if (!fs::exists(makers)) {
    WARN("the models aren't here: nothing was checked");
    return;
  }
  for (const std::string name : {"fox.obj", "car.obj", "spot.obj", "lantern.obj", "rocket.obj", "trex.obj"}) {
    const TemporaryFolder folder;
    check(name, difference(folder, makers / name, {}), 0.05);
  }
}

TEST_CASE("Colours are printed as they are, pale or not at all") {
  const TemporaryFolder folder;
  write_bytes(folder / "a.mtl", "newmtl red\nKd 0.8 0.1 0.1\n");
  write_bytes(folder / "a.obj", "mtllib a.mtl\nusemtl red\n" + std::string(house));
  const auto page = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"a.obj", "-o", "a.svg", "--overwrite", "--size", "80"});
    const Outcome outcome = run_program(options, in(folder));
    INFO(outcome.err);
    CHECK(outcome.exit_code == 0);
    return read_bytes(folder / "a.svg");
  };
  const std::string colour = page({});
  CHECK(colour.find("fill=\"#cc1a1a\"") != std::string::npos);
  CHECK(page({"--ink", "colour"}) == colour);
  CHECK(page({"--ink", "pale"}).find("fill=\"#edafaf\"") != std::string::npos);
  const std::string lines = page({"--ink", "lines"});
  CHECK(lines.find("id=\"paint\"") == std::string::npos);
  // The same pages as without a material file.
  write_bytes(folder / "a.mtl", "");
  CHECK(page({}) == lines);

  check_refusal(run_program({"a.obj", "--ink", "purple"}, in(folder)), 2, "purple");
  check_refusal(run_program({"a.obj", "--dpi", "10"}, in(folder)), 2, "--dpi");
  check_refusal(run_program({"a.obj", "--dpi", "300", "--ink", "lines"}, in(folder)), 2, "--dpi");
  check_refusal(run_program({"a.obj", "--dpi", "300", "--preset", "laser"}, in(folder)), 2, "--dpi");
}

TEST_CASE("a picture that can't be unpacked is told without being asked for", "[printed_colours]") {
  const TemporaryFolder folder;
  // Whole from outside, and nothing within.
  write_bytes(folder / "skin.png", std::string("\x89PNG\r\n\x1a\n", 8) +
                                       std::string("\0\0\0\1IDATxcrcc", 13) +
                                       std::string("\0\0\0\0IENDcrcc", 12));
  write_bytes(folder / "a.mtl", "newmtl a\nKd 1 0 0\nmap_Kd skin.png\n");
  write_bytes(folder / "a.obj",
              "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\n"
              "f 1/1 3/2 2/3\nf 1/1 2/2 4/3\nf 2/1 3/2 4/3\nf 3/1 1/2 4/3\n");
  const Outcome made = run_program({"a.obj", "-o", "a.fold"}, in(folder));
  CHECK(made.exit_code == 0);
  CHECK(
      made.err.find(
          "note: a texture picture is missing or can't be used (the picture of material \"a\" is damaged") !=
      std::string::npos);
}
