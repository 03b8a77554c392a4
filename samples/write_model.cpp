// SPDX-License-Identifier: GPL-3.0-or-later
#include "samples/write_model.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

namespace ridgecraft::samples {
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
  const auto byte = [](double share) { return static_cast<int>(std::lround(255.0 * share)); };
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
