// SPDX-License-Identifier: GPL-3.0-or-later
#include "package_writer.hpp"

#include <bit>

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

}  // namespace ridgecraft::test
