// SPDX-License-Identifier: GPL-3.0-or-later
#include "pdo_writer.hpp"

#include <algorithm>
#include <bit>

#include <zlib.h>

#include "package_writer.hpp"

namespace ridgecraft::test {
namespace {

std::string bytes8(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return bytes4(static_cast<std::uint32_t>(bits)) + bytes4(static_cast<std::uint32_t>(bits >> 32U));
}

std::string size4(std::size_t size) {
  return bytes4(static_cast<std::uint32_t>(size));
}

std::string zlib_packed(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
           static_cast<uLong>(bytes.size()));
  packed.resize(size);
  return packed;
}

class Writer {
 public:
  explicit Writer(const PdoStyle& style) : style_(style) {}

  std::string file(const PdoTestFile& file) {
    header();
    out_ += size4(file.objects.size());
    for (const PdoTestObject& o : file.objects) {
      object(o);
    }
    out_ += size4(file.materials.size());
    for (const PdoTestMaterial& m : file.materials) {
      material(m);
    }
    out_ += file.scale ? '\1' : '\0';
    if (file.scale) {
      // No parts, texts and pictures besides.
      out_ += bytes8(*file.scale) + '\0' + std::string(32, '\0') + std::string(16, '\0');
    }
    out_ += std::string(40, '\0') + bytes4(0x270f);
    return out_;
  }

 private:
  /// With an end mark.
  void string(const std::string& text, std::uint32_t shift) {
    const std::size_t letters = text.size() + 1;
    out_ += size4(style_.wide && style_.length_in_bytes ? 2 * letters : letters);
    for (const char c : text + '\0') {
      const std::uint32_t stored = static_cast<unsigned char>(c) + shift;
      out_ += style_.wide ? bytes2(stored) : std::string(1, static_cast<char>(stored));
    }
  }
  void string(const std::string& text) { string(text, style_.version > 4 ? style_.shift : 0); }

  void header() {
    out_ = "version 3\n" + bytes4(style_.version) + bytes4(style_.wide ? 1 : 0) + bytes4(1234);
    if (style_.version > 4) {
      string("Pepakura Designer 4", 0);
      out_ += bytes4(style_.shift);
    }
    string("en-US");
    string("us-ascii");
    out_ += bytes4(0);
    const char locked = style_.locked ? '\1' : '\0';
    if (style_.version == 6) {
      out_ += std::string{locked, '\0'};
    }
    string("0123456789abcdef0123456789abcdef");
    if (style_.version == 6) {
      out_ += bytes4(2) + bytes8(1) + bytes8(2);
    } else if (style_.version > 4) {
      out_ += std::string{'\0', locked};
    }
    out_ += bytes8(2) + bytes8(0) + bytes8(0) + bytes8(0);
  }

  void object(const PdoTestObject& object) {
    string(object.name);
    out_ += object.visible ? '\1' : '\0';
    out_ += size4(object.points.size());
    for (const Vec3 p : object.points) {
      out_ += bytes8(p.x) + bytes8(p.y) + bytes8(p.z);
    }
    out_ += size4(object.faces.size());
    for (const PdoTestFace& face : object.faces) {
      out_ += bytes4(static_cast<std::uint32_t>(face.material)) +
              bytes4(static_cast<std::uint32_t>(face.piece)) + std::string(32, '\0') +
              size4(face.points.size());
      for (std::size_t k = 0; k < face.points.size(); ++k) {
        const Vec2 flat = face.flat.empty() ? Vec2{} : face.flat[k];
        const Vec2 texture = face.texture.empty() ? Vec2{} : face.texture[k];
        out_ += bytes4(face.points[k]) + bytes8(flat.x) + bytes8(flat.y) + bytes8(texture.x) +
                bytes8(texture.y) + '\1' + bytes8(5) + bytes8(0.7) + bytes8(0.7) + std::string(24, '\0');
      }
    }
    // One edge, of which nothing is asked.
    out_ += bytes4(1) + std::string(22, '\0');
  }

  void material(const PdoTestMaterial& material) {
    string(material.name);
    out_ += std::string(64, '\0') + float_bytes({1}) + float_bytes(material.colour);
    out_ += material.pixels ? '\1' : '\0';
    if (material.pixels) {
      const std::string packed = zlib_packed(*material.pixels);
      out_ += bytes4(material.width) + bytes4(material.height) + size4(packed.size()) + packed;
    }
  }

  PdoStyle style_;
  std::string out_;
};

}  // namespace

std::string pdo(const PdoTestFile& file, const PdoStyle& style) {
  return Writer(style).file(file);
}

PdoTestObject pdo_cube() {
  PdoTestObject cube;
  cube.name = "cube";
  for (int i = 0; i < 8; ++i) {
    cube.points.push_back({2.0 * (i & 1), 1.0 * (i & 2), 0.5 * (i & 4)});
  }
  cube.faces = {{{0, 1, 5, 4}, {{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {}},
                {{1, 3, 7, 5}, {{2, 0}, {4, 0}, {4, 2}, {2, 2}}, {}},
                {{2, 6, 7, 3}, {{6, 0}, {6, 2}, {4, 2}, {4, 0}}, {}},
                {{0, 4, 6, 2}, {{0, 0}, {0, 2}, {-2, 2}, {-2, 0}}, {}},
                {{4, 5, 7, 6}, {{0, 2}, {2, 2}, {2, 4}, {0, 4}}, {}},
                {{0, 2, 3, 1}, {{0, 0}, {0, -2}, {2, -2}, {2, 0}}, {}, 1}};
  return cube;
}

PdoTestFile rich_pdo_file() {
  PdoTestFile file;
  file.objects = {pdo_cube(),
                  {"hidden", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}, {}, {}, -1}}, false}};
  file.materials = {{"red", {1, 0.5F, 0.25F}, 0, 0, {}},
                    {"picture", {1, 1, 1}, 2, 2, std::string("\xff\0\0\0\xff\0\0\0\xff\xff\xff\xff", 12)}};
  std::vector<PdoTestFace>& faces = file.objects[0].faces;
  faces[0].material = 1;
  faces[0].texture = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  faces[1].material = 0;
  file.scale = 2.5;
  return file;
}

}  // namespace ridgecraft::test
