// SPDX-License-Identifier: GPL-3.0-or-later
// The files that people take for meshes, or that were given a mesh's name, known by their first bytes.
#include "mesh/reading/foreign_content.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "mesh/reading/text_scanner.hpp"

namespace ridgecraft::mesh {
namespace {

using namespace std::string_view_literals;

struct Signature {
  std::string_view start;
  std::string_view what;
};

constexpr std::array signatures{
    Signature{"\x1f\x8b"sv, "a gzip-compressed file; unpack it first"},
    Signature{"BZh"sv, "a bzip2-compressed file; unpack it first"},
    Signature{"\xfd"
              "7zXZ\0"sv,
              "an xz-compressed file; unpack it first"},
    Signature{"\x28\xb5\x2f\xfd"sv, "a zstd-compressed file; unpack it first"},
    Signature{"7z\xbc\xaf\x27\x1c"sv, "a 7-Zip archive; unpack it first"},
    Signature{"Rar!\x1a\x07"sv, "a RAR archive; unpack it first"},
    Signature{"\x89PNG\r\n\x1a\n"sv, "a PNG picture"},
    Signature{"\xff\xd8\xff"sv, "a JPEG picture"},
    Signature{"GIF87a"sv, "a GIF picture"},
    Signature{"GIF89a"sv, "a GIF picture"},
    Signature{"II*\0"sv, "a TIFF picture"},
    Signature{"MM\0*"sv, "a TIFF picture"},
    Signature{"8BPS"sv, "a Photoshop picture"},
    Signature{"%PDF-"sv, "a PDF document"},
    Signature{"%!PS"sv, "a PostScript document"},
    Signature{"Kaydara FBX Binary"sv, "an FBX model"},
    Signature{"; FBX"sv, "an FBX model"},
    Signature{"BLENDER"sv, "a Blender file"},
    Signature{"ISO-10303-21"sv, "a STEP model"},
    Signature{"PXR-USDC"sv, "a USD model"},
    Signature{"#usda"sv, "a USD model"},
    Signature{"#VRML"sv, "a VRML model"},
    Signature{"#Inventor"sv, "an Open Inventor model"},
    Signature{"# vtk DataFile"sv, "a VTK file"},
    Signature{"DRACO"sv, "a Draco-compressed model"},
    Signature{"xof 0"sv, "a DirectX model"},
    Signature{"3D Geometry File Format"sv, "a Rhino model"},
    Signature{"AutoCAD Binary DXF"sv, "a DXF drawing"},
    Signature{"AC10"sv, "an AutoCAD drawing"},
    Signature{"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"sv, "a document of an office or CAD program"},
    Signature{"version https://git-lfs"sv,
              "a Git LFS pointer, not the file it stands for; fetch the file first"},
    Signature{"\x7f"
              "ELF"sv,
              "a program"},
    Signature{"SQLite format 3"sv, "a database"},
    Signature{"\xff\xfe\0\0"sv, "text in UTF-32; save it as UTF-8 or ASCII"},
    Signature{"\0\0\xfe\xff"sv, "text in UTF-32; save it as UTF-8 or ASCII"},
    Signature{"\xff\xfe"sv, "text in UTF-16; save it as UTF-8 or ASCII"},
    Signature{"\xfe\xff"sv, "text in UTF-16; save it as UTF-8 or ASCII"},
};

/// Words by which files of markup are known, looked for near their start, more telling ones first.
constexpr std::array markup{
    Signature{"<collada", "a COLLADA model"},
    Signature{"<x3d", "an X3D model"},
    Signature{"<amf", "an AMF model"},
    Signature{"<svg", "an SVG picture"},
    Signature{"<!doctype html", "an HTML page"},
    Signature{"<html", "an HTML page"},
    Signature{"<head", "an HTML page"},
    Signature{"<vtkfile", "a VTK file"},
    Signature{"<error", "an error message from a server (XML)"},
    Signature{"<?xml", "an XML file"},
};

/// As far as we look for telling words.
constexpr std::size_t searched_bytes = 4096;

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4 && at + i < bytes.size(); ++i) {
    value |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  }
  return value;
}

bool contains_ignoring_case(std::string_view text, std::string_view word) {
  for (std::size_t i = 0; i + word.size() <= text.size(); ++i) {
    if (equal_ignoring_case(text.substr(i, word.size()), word)) {
      return true;
    }
  }
  return false;
}

std::optional<std::string_view> archive(std::string_view bytes) {
  if (!bytes.starts_with("PK\x03\x04"sv) && !bytes.starts_with("PK\x05\x06"sv)) {
    return std::nullopt;
  }
  return "a ZIP archive; unpack it first";
}

/// Formats whose signature is too short to be trusted without their length.
std::optional<std::string_view> known_by_length(std::string_view bytes) {
  if (bytes.starts_with("BM") && bytes.size() > 26 && little_endian(bytes, 2) == bytes.size()) {
    return "a BMP picture";
  }
  if (bytes.starts_with("MM") && bytes.size() > 6 && little_endian(bytes, 2) == bytes.size()) {
    return "a 3DS model";
  }
  if (bytes.starts_with("RIFF") && bytes.size() > 12) {
    return bytes.substr(8, 4) == "WEBP" ? "a WebP picture" : "a media file";
  }
  if (bytes.starts_with("FORM") && bytes.size() > 12 && bytes.substr(8, 3) == "LWO") {
    return "a LightWave model";
  }
  if (bytes.size() > 12 && bytes.substr(4, 4) == "ftyp") {
    return "a media file";
  }
  return std::nullopt;
}

std::optional<std::string_view> markup_or_json(std::string_view bytes) {
  TextScanner text(bytes);
  text.skip_space('\0');
  const std::string_view start = text.rest().substr(0, searched_bytes);
  if (start.starts_with('<')) {
    for (const Signature& known : markup) {
      if (contains_ignoring_case(start, known.start)) {
        return known.what;
      }
    }
  }
  if (start.starts_with('{')) {
    return start.find("\"file_spec\"") != start.npos ? "a FOLD file of nets or another JSON file"
                                                     : "a JSON file";
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string_view> foreign_content(std::string_view bytes) {
  for (const Signature& known : signatures) {
    if (bytes.starts_with(known.start)) {
      return known.what;
    }
  }
  if (bytes.find_first_not_of('\0') == bytes.npos) {
    return "a file of zero bytes only, perhaps from a failed copy";
  }
  if (const auto found = archive(bytes)) {
    return found;
  }
  if (const auto found = known_by_length(bytes)) {
    return found;
  }
  return markup_or_json(bytes);
}

}  // namespace ridgecraft::mesh
