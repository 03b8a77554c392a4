// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/mesh/file_writers.hpp"

#include <algorithm>
#include <bit>
#include <cstdio>

#include <zlib.h>

namespace ridgecraft::test {
namespace {

std::uint32_t checksum(const std::string& bytes) {
  return static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

std::string deflated(const std::string& bytes) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  std::string in = bytes;
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = static_cast<uInt>(in.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

}  // namespace

std::string bytes4(std::uint32_t value) {
  return bytes2(value) + bytes2(value >> 16U);
}

std::string bytes2(std::uint32_t value) {
  return {static_cast<char>(value & 0xffU), static_cast<char>(value >> 8U & 0xffU)};
}

std::string float_bytes(const std::vector<float>& values) {
  std::string bytes;
  for (const float value : values) {
    bytes += bytes4(std::bit_cast<std::uint32_t>(value));
  }
  return bytes;
}

std::string glb(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const auto part = [](const std::string& kind, const std::string& bytes) {
    return bytes4(static_cast<std::uint32_t>(bytes.size())) + kind + bytes;
  };
  const std::string parts =
      part("JSON", json) + (binary.empty() ? std::string() : part(std::string("BIN\0", 4), binary));
  return "glTF" + bytes4(2) + bytes4(static_cast<std::uint32_t>(12 + parts.size())) + parts;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      three = three << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? digits[three >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

std::string zip(const ZipFiles& files, Packing packing) {
  std::string archive;
  std::string directory;
  for (const auto& [name, bytes] : files) {
    const std::string packed = packing == Packing::stored ? bytes : deflated(bytes);
    const std::string common = bytes2(20) + bytes2(0) + bytes2(packing == Packing::stored ? 0 : 8) +
                               bytes4(0) + bytes4(checksum(bytes)) +
                               bytes4(static_cast<std::uint32_t>(packed.size())) +
                               bytes4(static_cast<std::uint32_t>(bytes.size())) +
                               bytes2(static_cast<std::uint32_t>(name.size())) + bytes2(0);
    directory += "PK\x01\x02" + bytes2(20) + common + bytes2(0) + bytes2(0) + bytes2(0) + bytes4(0) +
                 bytes4(static_cast<std::uint32_t>(archive.size())) + name;
    archive += "PK\x03\x04" + common + name + packed;
  }
  const auto count = bytes2(static_cast<std::uint32_t>(files.size()));
  const auto at = static_cast<std::uint32_t>(archive.size());
  return archive + directory + "PK\x05\x06" + bytes4(0) + count + count +
         bytes4(static_cast<std::uint32_t>(directory.size())) + bytes4(at) + bytes2(0);
}

std::string threemf(const std::string& model, const ZipFiles& more, Packing packing) {
  ZipFiles files{{"_rels/.rels",
                  "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
                  "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
                  "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>"},
                 {"3D/3dmodel.model", model}};
  files.insert(files.end(), more.begin(), more.end());
  return zip(files, packing);
}

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

namespace {

std::string decimal(Vec3 p) {
  char text[100];
  std::snprintf(text, sizeof text, "%.17g %.17g %.17g\n", p.x, p.y, p.z);
  return text;
}

template <class Unsigned>
void append_bytes(std::string& bytes, Unsigned value, bool big_endian) {
  std::string more;
  for (std::size_t i = 0; i < sizeof value; ++i) {
    more += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
  }
  if (big_endian) {
    std::reverse(more.begin(), more.end());
  }
  bytes += more;
}

std::string obj(const mesh::Soup& soup) {
  std::string text;
  for (const Vec3 p : soup.points) {
    text += "v " + decimal(p);
  }
  for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
    text += 'f';
    for (const std::uint32_t p : soup.polygon(i)) {
      // All forms in turn; what stands after the slashes refers to texture points that aren't there or to
      // normals.
      text += ' ' + (p % 3 == 0
                         ? std::to_string(p + 1) + "//7"
                         : std::to_string(std::int64_t{p} - static_cast<std::int64_t>(soup.points.size())));
    }
    text += '\n';
  }
  return text;
}

std::string indexed_text(const mesh::Soup& soup) {
  std::string text;
  for (const Vec3 p : soup.points) {
    text += decimal(p);
  }
  for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
    text += std::to_string(soup.polygon(i).size());
    for (const std::uint32_t p : soup.polygon(i)) {
      text += ' ' + std::to_string(p);
    }
    text += '\n';
  }
  return text;
}

std::string ply(const mesh::Soup& soup, SoupFormat format) {
  const bool big_endian = format == SoupFormat::ply_big_endian;
  std::string bytes = format == SoupFormat::ply_ascii ? "ply\nformat ascii 1.0\n"
                      : big_endian                    ? "ply\nformat binary_big_endian 1.0\n"
                                                      : "ply\nformat binary_little_endian 1.0\n";
  bytes += "element vertex " + std::to_string(soup.points.size()) +
           "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
           std::to_string(soup.polygon_count()) + "\nproperty list ushort uint vertex_index\nend_header\n";
  if (format == SoupFormat::ply_ascii) {
    return bytes + indexed_text(soup);
  }
  for (const Vec3 p : soup.points) {
    for (const double coordinate : {p.x, p.y, p.z}) {
      append_bytes(bytes, std::bit_cast<std::uint64_t>(coordinate), big_endian);
    }
  }
  for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
    append_bytes(bytes, static_cast<std::uint16_t>(soup.polygon(i).size()), big_endian);
    for (const std::uint32_t p : soup.polygon(i)) {
      append_bytes(bytes, p, big_endian);
    }
  }
  return bytes;
}

std::string stl_ascii(const mesh::Soup& soup) {
  std::string text = "solid test\n";
  for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t p : soup.polygon(i)) {
      text += "vertex " + decimal(soup.points[p]);
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid test\n";
}

std::string stl_binary(const mesh::Soup& soup) {
  std::string bytes(80, ' ');
  append_bytes(bytes, static_cast<std::uint32_t>(soup.polygon_count()), false);
  for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
    bytes += std::string(12, '\0');
    for (const std::uint32_t p : soup.polygon(i)) {
      for (const double coordinate : {soup.points[p].x, soup.points[p].y, soup.points[p].z}) {
        append_bytes(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(coordinate)), false);
      }
    }
    bytes += "ab";
  }
  return bytes;
}

}  // namespace

std::string written(const mesh::Soup& soup, SoupFormat format) {
  switch (format) {
    case SoupFormat::obj:
      return obj(soup);
    case SoupFormat::off:
      return "OFF\n" + std::to_string(soup.points.size()) + ' ' + std::to_string(soup.polygon_count()) +
             " 0\n" + indexed_text(soup);
    case SoupFormat::stl_ascii:
      return stl_ascii(soup);
    case SoupFormat::stl_binary:
      return stl_binary(soup);
    default:
      return ply(soup, format);
  }
}

}  // namespace ridgecraft::test
