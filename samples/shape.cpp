// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "samples/samples.hpp"

namespace ridgecraft::samples {
namespace {

/// Places behind the point in the files: flat regions stay flat to far less than paper shows.
constexpr double grain = 1e6;
/// A polygon is plane when no corner is farther from its plane than rounding can bring it.
constexpr double plane_tolerance = 1.0 / grain;

double rounded(double x) {
  const double result = std::round(x * grain) / grain;
  return result == 0.0 ? 0.0 : result;  // no negative zero in the files
}

Vec3 area_vector(const Ring& ring) {
  Vec3 sum;
  for (std::size_t i = 2; i < ring.size(); ++i) {
    sum += cross(ring[i - 1] - ring[0], ring[i] - ring[0]);
  }
  return sum;
}

/// The ring, begun at the corner that brings it nearest to another one, corner by corner.
Ring nearest_turn(Ring ring, const Ring& other) {
  Ring best = ring;
  const auto distance = [&other](const Ring& r) {
    double sum = 0.0;
    for (std::size_t k = 0; k < r.size(); ++k) {
      sum += length(r[k] - other[k]);
    }
    return sum;
  };
  for (std::size_t k = 0; k < other.size(); ++k) {
    std::rotate(ring.begin(), ring.begin() + 1, ring.end());
    best = distance(ring) < distance(best) ? ring : best;
  }
  return best;
}

}  // namespace

Index Shape::material(const std::string& name, Vec3 colour) {
  materials_.push_back({name, colour});
  return static_cast<Index>(materials_.size() - 1);
}

Index Shape::face(const Ring& corners, Index material) {
  Face face{{}, material};
  for (const Vec3 p : corners) {
    face.corners.push_back(static_cast<Index>(points_.size()));
    points_.push_back(p);
  }
  faces_.push_back(std::move(face));
  return static_cast<Index>(faces_.size() - 1);
}

void Shape::raise(Index number, const Ring& corners, Index wall_material) {
  const Ring old = ring(number);
  const Index own = faces_[number].material;
  for (std::size_t k = 0; k < old.size(); ++k) {
    const std::size_t next = (k + 1) % old.size();
    face({old[k], old[next], corners[next], corners[k]}, wall_material);
  }
  face(corners, own);
  std::swap(faces_[number], faces_.back());
  faces_.pop_back();
}

void Shape::raise_to_point(Index number, Vec3 tip, Index material) {
  raise(number, Ring(faces_[number].corners.size(), tip), material);
}

void Shape::bridge(Index from, Index to, const std::vector<Ring>& between, Index material) {
  std::vector<Ring> rings = {ring(from)};
  rings.insert(rings.end(), between.begin(), between.end());
  rings.push_back(nearest_turn(reversed(ring(to)), rings.back()));
  faces_[from].corners.clear();
  faces_[to].corners.clear();
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    for (std::size_t k = 0; k < rings[i].size(); ++k) {
      const std::size_t next = (k + 1) % rings[i].size();
      face({rings[i][k], rings[i][next], rings[i + 1][next], rings[i + 1][k]}, material);
    }
  }
}

Ring Shape::ring(Index number) const {
  Ring result;
  for (const Index p : faces_[number].corners) {
    result.push_back(points_[p]);
  }
  return result;
}

Vec3 Shape::centre(Index number) const {
  return mean(ring(number));
}

Vec3 Shape::normal(Index number) const {
  return normalized(area_vector(ring(number)));
}

void Shape::mirror_x() {
  const std::size_t count = faces_.size();
  for (std::size_t f = 0; f < count; ++f) {
    Ring corners = reversed(ring(static_cast<Index>(f)));
    for (Vec3& p : corners) {
      p.x = -p.x;
    }
    face(corners, faces_[f].material);
  }
}

void Shape::add(const Shape& other) {
  const auto shift = static_cast<Index>(points_.size());
  const auto material_shift = static_cast<Index>(materials_.size());
  points_.insert(points_.end(), other.points_.begin(), other.points_.end());
  materials_.insert(materials_.end(), other.materials_.begin(), other.materials_.end());
  for (Face face : other.faces_) {
    for (Index& corner : face.corners) {
      corner += shift;
    }
    face.material += material_shift;
    faces_.push_back(std::move(face));
  }
}

void Shape::join_equal_points() {
  std::map<std::array<double, 3>, Index> known;
  std::vector<Vec3> points;
  for (Face& face : faces_) {
    std::vector<Index> corners;
    for (const Index corner : face.corners) {
      const Vec3 p = points_[corner];
      const Vec3 q{rounded(p.x), rounded(p.y), rounded(p.z)};
      const auto [place, is_new] = known.try_emplace({q.x, q.y, q.z}, static_cast<Index>(points.size()));
      if (is_new) {
        points.push_back(q);
      }
      if (corners.empty() || corners.back() != place->second) {
        corners.push_back(place->second);
      }
    }
    while (corners.size() > 1 && corners.front() == corners.back()) {
      corners.pop_back();
    }
    face.corners = std::move(corners);
  }
  points_ = std::move(points);
  std::erase_if(faces_, [](const Face& face) { return face.corners.size() < 3; });
}

void Shape::split_bent_faces() {
  std::vector<Face> result;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Ring corners = ring(static_cast<Index>(f));
    const Vec3 up = normal(static_cast<Index>(f));
    const Vec3 middle = mean(corners);
    const bool plane = std::all_of(corners.begin(), corners.end(),
                                   [&](Vec3 p) { return std::abs(dot(p - middle, up)) <= plane_tolerance; });
    if (plane) {
      result.push_back(faces_[f]);
      continue;
    }
    if (corners.size() != 4) {
      throw std::logic_error("a polygon with " + std::to_string(corners.size()) + " corners isn't plane");
    }
    // Is the fourth corner behind the plane of the first three? Then the diagonal between first and third is
    // a ridge.
    const bool ridge = dot(area_vector({corners[0], corners[1], corners[2]}), corners[3] - corners[0]) < 0.0;
    const std::vector<Index>& c = faces_[f].corners;
    const std::size_t s = ridge ? 0 : 1;
    result.push_back({{c[s], c[s + 1], c[s + 2]}, faces_[f].material});
    result.push_back({{c[s], c[s + 2], c[(s + 3) % 4]}, faces_[f].material});
  }
  faces_ = std::move(result);
}

void Shape::finish() {
  join_equal_points();
  split_bent_faces();
}

Grid loft(Shape& shape, const std::vector<Ring>& rings, bool closed, Index material) {
  const std::size_t points = rings.front().size();
  const std::size_t columns = closed ? points : points - 1;
  const Grid grid{shape.face_count(), static_cast<Index>(columns)};
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    for (std::size_t k = 0; k < columns; ++k) {
      const std::size_t next = (k + 1) % points;
      shape.face({rings[i][k], rings[i + 1][k], rings[i + 1][next], rings[i][next]}, material);
    }
  }
  return grid;
}

Grid revolve(Shape& shape, const std::vector<Vec2>& profile, int steps, Index material, double start) {
  std::vector<Ring> rings;
  for (const Vec2 p : profile) {
    // Upwards on the outside, seen from there, is to the right when the rings run clockwise.
    rings.push_back(reversed(circle(p.x, p.y, steps, start)));
  }
  return loft(shape, rings, true, material);
}

Ring circle(double radius, double height, int steps, double start) {
  Ring ring;
  for (int k = 0; k < steps; ++k) {
    const double angle = start + 2.0 * std::numbers::pi * k / steps;
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle), height});
  }
  return ring;
}

Ring reversed(Ring ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

Ring scaled(const Ring& ring, Vec3 centre, double factor, Vec3 shift) {
  Ring result;
  for (const Vec3 p : ring) {
    result.push_back(centre + factor * (p - centre) + shift);
  }
  return result;
}

Ring patch(const Ring& quad, Vec2 low, Vec2 high) {
  const auto at = [&quad](double u, double v) {
    return (1.0 - v) * ((1.0 - u) * quad[0] + u * quad[1]) + v * ((1.0 - u) * quad[3] + u * quad[2]);
  };
  return {at(low.x, low.y), at(high.x, low.y), at(high.x, high.y), at(low.x, high.y)};
}

Ring shifted(const Ring& ring, Vec3 by) {
  return scaled(ring, {}, 1.0, by);
}

Vec3 mean(const Ring& ring) {
  Vec3 sum;
  for (const Vec3 p : ring) {
    sum += p / static_cast<double>(ring.size());
  }
  return sum;
}

namespace {

constexpr std::string_view note = "A sample of Ridgecraft, made by samples/generate.cpp; GPL-3.0-or-later";

/// Up to six digits behind the point, none that are zero.
std::string number(double x) {
  std::string text = fmt::format("{:.6f}", x);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') {
    text.pop_back();
  }
  return text;
}

std::string point_line(Vec3 p) {
  return number(p.x) + ' ' + number(p.y) + ' ' + number(p.z);
}

std::string colour_bytes(Vec3 colour) {
  const auto byte = [](double fraction) { return static_cast<int>(std::lround(255.0 * fraction)); };
  return fmt::format("{} {} {}", byte(colour.x), byte(colour.y), byte(colour.z));
}

void save(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream out(file, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) {
    throw std::runtime_error("can't write " + file.string());
  }
}

void write_obj(const Shape& shape, const std::filesystem::path& file) {
  const std::filesystem::path materials = std::filesystem::path(file).replace_extension(".mtl");
  std::string text = fmt::format("# {}\n", note);
  for (const Material& material : shape.materials()) {
    text += fmt::format("newmtl {}\nKd {} {} {}\n", material.name, number(material.colour.x),
                        number(material.colour.y), number(material.colour.z));
  }
  save(materials, text);
  text = fmt::format("# {}\nmtllib {}\n", note, materials.filename().string());
  for (const Vec3 p : shape.points()) {
    text += "v " + point_line(p) + '\n';
  }
  for (Index m = 0; m < shape.materials().size(); ++m) {
    text += "usemtl " + shape.materials()[m].name + '\n';
    for (const Face& face : shape.faces()) {
      if (face.material == m) {
        text += 'f';
        for (const Index corner : face.corners) {
          text += fmt::format(" {}", corner + 1);
        }
        text += '\n';
      }
    }
  }
  save(file, text);
}

void append_float(std::string& bytes, double value) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  for (unsigned shift = 0; shift < 32; shift += 8) {
    bytes += static_cast<char>((bits >> shift) & 0xffU);
  }
}

/// Convex polygons become fans; the samples that are written as STL have no others.
void write_stl(const Shape& shape, const std::filesystem::path& file) {
  std::string bytes(note);
  bytes.resize(84, '\0');
  std::uint32_t count = 0;
  for (Index f = 0; f < shape.face_count(); ++f) {
    const Ring ring = shape.ring(f);
    for (std::size_t k = 2; k < ring.size(); ++k, ++count) {
      for (const Vec3 p : {shape.normal(f), ring[0], ring[k - 1], ring[k]}) {
        append_float(bytes, p.x);
        append_float(bytes, p.y);
        append_float(bytes, p.z);
      }
      bytes.append(2, '\0');
    }
  }
  for (unsigned i = 0; i < 4; ++i) {
    bytes[80 + i] = static_cast<char>((count >> (8 * i)) & 0xffU);
  }
  save(file, bytes);
}

std::string list_faces(const Shape& shape) {
  std::string text;
  for (const Face& face : shape.faces()) {
    text += fmt::format("{}", face.corners.size());
    for (const Index corner : face.corners) {
      text += fmt::format(" {}", corner);
    }
    text += ' ' + colour_bytes(shape.materials()[face.material].colour) + '\n';
  }
  return text;
}

std::string list_points(const Shape& shape) {
  std::string text;
  for (const Vec3 p : shape.points()) {
    text += point_line(p) + '\n';
  }
  return text;
}

void write_ply(const Shape& shape, const std::filesystem::path& file) {
  save(file, fmt::format(
                 "ply\nformat ascii 1.0\ncomment {}\nelement vertex {}\nproperty float x\nproperty float y\n"
                 "property float z\nelement face {}\nproperty list uchar int vertex_indices\n"
                 "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
                 note, shape.points().size(), shape.face_count()) +
                 list_points(shape) + list_faces(shape));
}

void write_off(const Shape& shape, const std::filesystem::path& file) {
  save(file, fmt::format("OFF\n# {}\n{} {} 0\n", note, shape.points().size(), shape.face_count()) +
                 list_points(shape) + list_faces(shape));
}

}  // namespace

void write_model(const Shape& shape, const std::filesystem::path& file) {
  const std::string suffix = file.extension().string();
  if (suffix == ".obj") {
    write_obj(shape, file);
  } else if (suffix == ".stl") {
    write_stl(shape, file);
  } else if (suffix == ".ply") {
    write_ply(shape, file);
  } else if (suffix == ".off") {
    write_off(shape, file);
  } else {
    throw std::runtime_error("no such format: " + file.string());
  }
}

}  // namespace ridgecraft::samples
