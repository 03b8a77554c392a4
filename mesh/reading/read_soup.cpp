// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/read_soup.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <new>
#include <optional>
#include <set>
#include <string>

#include <fmt/format.h>

#include "base/encodings.hpp"
#include "base/text.hpp"
#include "mesh/reading/files.hpp"
#include "mesh/reading/source.hpp"
#include "mesh/reading/text_scanner.hpp"
#include "mesh/reading/zip_archive.hpp"

namespace ridgecraft::mesh {
namespace {

// The files that people take for meshes, or that were given a mesh's name, known by their first bytes.

using namespace std::string_view_literals;

/// How somebody who has such a file gets one that is read.
enum class Way {
  none,
  blender,
  cad,
  sketchup,
  pepakura,
  source,
  mmd,
  voxels,
  blockbench,
  cityjson,
  citygml,
  ldraw,
  by_suffix
};

struct Signature {
  std::string_view start;
  std::string_view what;
  Way way = Way::none;  ///< by_suffix: many things are packed so, and the suffix may tell which
  std::optional<FileFormat> imported = std::nullopt;  ///< what a program beside this one reads
};

constexpr std::array signatures{
    Signature{"\x1f\x8b"sv, "a gzip-compressed file; unpack it first", Way::by_suffix},
    Signature{"BZh"sv, "a bzip2-compressed file; unpack it first", Way::by_suffix},
    Signature{"\xfd"
              "7zXZ\0"sv,
              "an xz-compressed file; unpack it first", Way::by_suffix},
    Signature{"\x28\xb5\x2f\xfd"sv, "a zstd-compressed file; unpack it first", Way::by_suffix},
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
    Signature{"Kaydara FBX Binary"sv, "an FBX model", Way::blender, FileFormat::fbx},
    Signature{"; FBX"sv, "an FBX model", Way::blender, FileFormat::fbx},
    Signature{"BLENDER"sv, "a Blender file", Way::blender, FileFormat::blend},
    Signature{"ISO-10303-21"sv, "a STEP model", Way::cad},
    Signature{"Metasequoia Document"sv, "a Metasequoia model", Way::source},
    Signature{"PMX "sv, "a model of MikuMikuDance (PMX)", Way::mmd},
    Signature{"Pmd"sv, "a model of MikuMikuDance (PMD)", Way::mmd},
    Signature{"VOX "sv, "a MagicaVoxel model", Way::voxels},
    Signature{"0 FILE "sv, "an LDraw model", Way::ldraw},
    Signature{"0 !LDRAW"sv, "an LDraw model", Way::ldraw},
    Signature{"PXR-USDC"sv, "a USD model", Way::blender},
    Signature{"#usda"sv, "a USD model", Way::blender},
    Signature{"#VRML"sv, "a VRML model", Way::blender},
    Signature{"#Inventor"sv, "an Open Inventor model", Way::blender},
    Signature{"# vtk DataFile"sv, "a VTK file"},
    Signature{"DRACO"sv, "a Draco-compressed model", Way::blender},
    Signature{"xof 0"sv, "a DirectX model", Way::blender},
    Signature{"3D Geometry File Format"sv, "a Rhino model", Way::cad},
    Signature{"AutoCAD Binary DXF"sv, "a DXF drawing", Way::cad},
    Signature{"AC10"sv, "an AutoCAD drawing", Way::cad},
    Signature{"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"sv, "a document of an office or CAD program", Way::by_suffix},
    Signature{"version https://git-lfs"sv,
              "a Git LFS pointer, not the file it stands for; fetch the file first"},
    Signature{"\x7f"
              "ELF"sv,
              "a program"},
    Signature{"SQLite format 3"sv, "a database"},
    Signature{"\xff\xfe\xff\x0eS\0k\0e\0t\0c\0h\0U\0p\0"sv, "a SketchUp model", Way::sketchup},
    Signature{"**ABCDEFGHIJKLMNOPQRSTUVWXYZ"sv, "a Parasolid model", Way::cad},
    Signature{"\xff\xfe\0\0"sv, "text in UTF-32; save it as UTF-8 or ASCII"},
    Signature{"\0\0\xfe\xff"sv, "text in UTF-32; save it as UTF-8 or ASCII"},
    Signature{"\xff\xfe"sv, "text in UTF-16; save it as UTF-8 or ASCII", Way::by_suffix},
    Signature{"\xfe\xff"sv, "text in UTF-16; save it as UTF-8 or ASCII", Way::by_suffix},
};

/// Words by which files of markup are known, looked for near their start, more telling ones first.
constexpr std::array markup{
    Signature{"<collada", "a COLLADA model", Way::blender, FileFormat::dae},
    Signature{"<x3d", "an X3D model", Way::blender},
    Signature{"<amf", "an AMF model", Way::blender},
    Signature{"citymodel", "a CityGML city model", Way::citygml},
    Signature{"<svg", "an SVG picture"},
    Signature{"<!doctype html", "an HTML page"},
    Signature{"<html", "an HTML page"},
    Signature{"<head", "an HTML page"},
    Signature{"<vtkfile", "a VTK file"},
    Signature{"<error", "an error message from a server (XML)"},
    Signature{"<?xml", "an XML file", Way::by_suffix},
};

/// What files are called whose content says less.
constexpr std::array suffixes{
    Signature{"skp", "a SketchUp model", Way::sketchup},
    Signature{"step", "a STEP model", Way::cad},
    Signature{"stp", "a STEP model", Way::cad},
    Signature{"igs", "an IGES model", Way::cad},
    Signature{"iges", "an IGES model", Way::cad},
    Signature{"dxf", "a DXF drawing", Way::cad},
    Signature{"dwg", "an AutoCAD drawing", Way::cad},
    Signature{"3dm", "a Rhino model", Way::cad},
    Signature{"sldprt", "a SolidWorks model", Way::cad},
    Signature{"sldasm", "a SolidWorks model", Way::cad},
    Signature{"ipt", "an Inventor model", Way::cad},
    Signature{"iam", "an Inventor model", Way::cad},
    Signature{"f3d", "a Fusion model", Way::cad},
    Signature{"fcstd", "a FreeCAD model", Way::cad},
    Signature{"catpart", "a CATIA model", Way::cad},
    Signature{"x_t", "a Parasolid model", Way::cad},
    Signature{"x_b", "a Parasolid model", Way::cad},
    Signature{"sat", "an ACIS model", Way::cad},
    Signature{"ifc", "a building model (IFC)", Way::cad},
    Signature{"scad", "an OpenSCAD program", Way::cad},
    Signature{"fbx", "an FBX model", Way::blender, FileFormat::fbx},
    Signature{"blend", "a Blender file", Way::blender, FileFormat::blend},
    Signature{"dae", "a COLLADA model", Way::blender, FileFormat::dae},
    Signature{"3ds", "a 3DS model", Way::blender, FileFormat::max3ds},
    Signature{"usdz", "a USD model", Way::blender},
    Signature{"usd", "a USD model", Way::blender},
    Signature{"x3d", "an X3D model", Way::blender},
    Signature{"wrl", "a VRML model", Way::blender},
    Signature{"amf", "an AMF model", Way::blender},
    Signature{"lwo", "a LightWave model", Way::blender},
    Signature{"max", "a scene of 3ds Max", Way::source},
    Signature{"ma", "a scene of Maya", Way::source},
    Signature{"mb", "a scene of Maya", Way::source},
    Signature{"c4d", "a scene of Cinema 4D", Way::source},
    Signature{"pdo", "a Pepakura file of another version", Way::pepakura},
    Signature{"mqo", "a Metasequoia model", Way::source},
    Signature{"mqoz", "a Metasequoia model", Way::source},
    Signature{"pmx", "a model of MikuMikuDance (PMX)", Way::mmd},
    Signature{"pmd", "a model of MikuMikuDance (PMD)", Way::mmd},
    Signature{"vox", "a MagicaVoxel model", Way::voxels},
    Signature{"bbmodel", "a Blockbench model", Way::blockbench},
    Signature{"ldr", "an LDraw model", Way::ldraw},
    Signature{"mpd", "an LDraw model", Way::ldraw},
    Signature{"gml", "a CityGML city model", Way::citygml},
    Signature{"gcode", "a print that was sliced already", Way::source},
};

std::string_view words(Way way) {
  static constexpr std::array<std::string_view, static_cast<std::size_t>(Way::by_suffix) + 1> of_way{
      "",
      "open it in Blender and export it as glTF (.glb) or OBJ",
      "open it in FreeCAD, or in the program that it was made with, and export it as OBJ, STL or 3MF",
      "export it from SketchUp as glTF (.glb), OBJ or STL",
      "export it from Pepakura Designer as OBJ",
      "export it from the program that it was made with as glTF (.glb), OBJ or STL",
      "open it in Blender with the add-on MMD Tools and export it as glTF (.glb) or OBJ",
      "export it from MagicaVoxel as OBJ or PLY",
      "export it from Blockbench as glTF or OBJ",
      "'cjio FILE export obj FILE.obj' makes an OBJ file of it",
      "citygml-tools makes CityJSON of it, and 'cjio FILE export obj FILE.obj' an OBJ file of that",
      "open it in LeoCAD and export it as OBJ",
      ""};
  return of_way[static_cast<std::size_t>(way)];
}

/// As far as we look for telling words.
constexpr std::size_t searched_bytes = 4096;

bool contains_ignoring_case(std::string_view text, std::string_view word) {
  for (std::size_t i = 0; i + word.size() <= text.size(); ++i) {
    if (equal_ignoring_case(text.substr(i, word.size()), word)) {
      return true;
    }
  }
  return false;
}

std::optional<Signature> archive(std::string_view bytes) {
  if (!bytes.starts_with("PK\x03\x04"sv) && !bytes.starts_with("PK\x05\x06"sv)) {
    return std::nullopt;
  }
  return Signature{{}, "a ZIP archive; unpack it first", Way::by_suffix};
}

/// Formats whose signature is too short to be trusted without their length.
std::optional<Signature> known_by_length(std::string_view bytes) {
  if (bytes.starts_with("BM") && bytes.size() > 26 && little_endian(bytes.substr(2, 4)) == bytes.size()) {
    return Signature{{}, "a BMP picture"};
  }
  if (bytes.starts_with("MM") && bytes.size() > 6 && little_endian(bytes.substr(2, 4)) == bytes.size()) {
    return Signature{{}, "a 3DS model", Way::blender, FileFormat::max3ds};
  }
  if (bytes.starts_with("RIFF") && bytes.size() > 12) {
    return Signature{{}, bytes.substr(8, 4) == "WEBP" ? "a WebP picture" : "a media file"};
  }
  if (bytes.starts_with("FORM") && bytes.size() > 12 && bytes.substr(8, 3) == "LWO") {
    return Signature{{}, "a LightWave model", Way::blender};
  }
  if (bytes.size() > 12 && bytes.substr(4, 4) == "ftyp") {
    return Signature{{}, "a media file"};
  }
  return std::nullopt;
}

std::optional<Signature> markup_or_json(std::string_view bytes) {
  TextScanner text(bytes);
  text.skip_space('\0');
  const std::string_view start = text.rest().substr(0, searched_bytes);
  if (start.starts_with('<')) {
    for (const Signature& known : markup) {
      if (contains_ignoring_case(start, known.start)) {
        return known;
      }
    }
  }
  if (start.starts_with('{')) {
    if (bytes.find("\"CityJSON\"") != bytes.npos) {
      return Signature{{}, "a CityJSON city model", Way::cityjson};
    }
    return contains_ignoring_case(start, "\"model_format\"")
               ? Signature{{}, "a Blockbench model", Way::blockbench}
               : Signature{{}, "a JSON file", Way::by_suffix};
  }
  return std::nullopt;
}

std::optional<Signature> by_content(std::string_view bytes) {
  for (const Signature& known : signatures) {
    if (bytes.starts_with(known.start)) {
      return known;
    }
  }
  if (bytes.find_first_not_of('\0') == bytes.npos) {
    return Signature{{}, "a file of zero bytes only, perhaps from a failed copy"};
  }
  if (const auto found = archive(bytes)) {
    return found;
  }
  if (const auto found = known_by_length(bytes)) {
    return found;
  }
  return markup_or_json(bytes);
}

std::optional<Signature> by_suffix(std::string_view suffix) {
  for (const Signature& known : suffixes) {
    if (equal_ignoring_case(suffix, known.start)) {
      return known;
    }
  }
  return std::nullopt;
}

std::string sentence_of(const Signature& known) {
  const std::string_view way = words(known.way);
  if (known.imported) {
    return fmt::format(
        "is {}, and ridgecraft-import, which reads those, is missing beside this program: it is built where "
        "libassimp-dev is installed; without it {}",
        known.what, way);
  }
  return way.empty() ? "is no mesh but " + std::string(known.what)
                     : fmt::format("is {}, which isn't read: {}", known.what, way);
}

/// As "is no mesh but a PNG picture", or "is a STEP model, which isn't read: open it in ..."; of formats that
/// Assimp reads, that what reads them is missing. By the suffix alone (without its dot).
std::optional<std::string> foreign_suffix(std::string_view suffix) {
  const auto found = by_suffix(suffix);
  return found ? std::optional(sentence_of(*found)) : std::nullopt;
}

/// "3.4" of a file that Blender saved, where that is a version that Assimp doesn't read; empty for older ones
/// and all other files. From 3.0 on files are packed by zstd, and the version isn't seen.
std::string newer_blender(std::string_view bytes, std::string_view suffix) {
  constexpr std::string_view zstd = "\x28\xb5\x2f\xfd";
  if (bytes.starts_with(zstd) && equal_ignoring_case(suffix, "blend")) {
    return "3.0 or later";
  }
  constexpr std::string_view mark = "BLENDER";
  if (!bytes.starts_with(mark)) {
    return {};
  }
  const std::string_view header = bytes.substr(mark.size(), 10);
  const std::size_t v = header.find_first_of("vV");
  std::string digits(v == header.npos ? std::string_view() : header.substr(v + 1, 4));
  digits.resize(std::min(digits.size(), digits.find_first_not_of("0123456789")));
  const int version =
      digits.empty() ? 0 : std::stoi(digits.size() == 4 ? digits.substr(1) : digits.substr(0, 3));
  constexpr int last_read = 279;
  return version > last_read ? fmt::format("{}.{}", version / 100, version % 100) : std::string();
}

/// The same for content; nothing where that can't be seen. The suffix helps with what many formats are packed
/// in.
std::optional<std::string> foreign_content(std::string_view bytes, std::string_view suffix) {
  const auto found = by_content(bytes);
  if (!found) {
    return std::nullopt;
  }
  const auto told = found->way == Way::by_suffix ? foreign_suffix(suffix) : std::nullopt;
  return told ? told : sentence_of(*found);
}

/// The format that a file is in, of those that Assimp reads; nothing for all others.
std::optional<FileFormat> imported_format(std::string_view suffix) {
  const auto found = by_suffix(suffix);
  return found ? found->imported : std::nullopt;
}

/// The same by content; the suffix helps in the same way.
std::optional<FileFormat> imported_format(std::string_view bytes, std::string_view suffix) {
  const auto found = by_content(bytes);
  if (!found) {
    return std::nullopt;
  }
  return found->way == Way::by_suffix ? imported_format(suffix) : found->imported;
}

/// As far as bytes are looked at to tell text from binary data.
constexpr std::size_t start_length = 1024;

constexpr std::array obj_keywords{"v",      "vt",     "vn",     "vp",    "f",    "fo",       "l",
                                  "p",      "o",      "g",      "s",     "mg",   "usemtl",   "mtllib",
                                  "usemap", "maplib", "cstype", "deg",   "bmat", "step",     "curv",
                                  "curv2",  "surf",   "parm",   "bevel", "lod",  "c_interp", "d_interp"};

std::string_view suffix(std::string_view file_name) {
  const std::size_t slash = file_name.find_last_of("/\\");
  const std::string_view name = slash == file_name.npos ? file_name : file_name.substr(slash + 1);
  const std::size_t dot = name.rfind('.');
  return dot == name.npos ? std::string_view() : name.substr(dot + 1);
}

/// True where the first bytes hold no control characters but white space; zero bytes at the very end don't
/// count.
bool looks_like_text(std::string_view bytes) {
  const std::string_view text = bytes.substr(0, bytes.find_last_not_of(std::string_view("\0\x1a", 2)) + 1);
  return std::none_of(text.begin(),
                      text.begin() + static_cast<std::ptrdiff_t>(std::min(text.size(), start_length)),
                      [](char c) {
                        const auto byte = static_cast<unsigned char>(c);
                        return byte < 0x20 && !is_blank(c) && !is_line_end(c) && c != '\x1b';
                      });
}

/// A text in which "facet" or "endsolid" follows the line that begins with "solid".
bool is_ascii_stl(std::string_view text) {
  TextScanner scanner(text);
  scanner.skip_space('\0');
  if (!equal_ignoring_case(scanner.word(), "solid")) {
    return false;
  }
  (void)scanner.rest_of_line();
  scanner.skip_space('\0');
  const std::string_view next = scanner.word();
  return next.empty() || equal_ignoring_case(next, "facet") || equal_ignoring_case(next, "endsolid") ||
         equal_ignoring_case(next, "color");
}

/// What the first word of a text says that isn't in a comment.
std::optional<FileFormat> by_first_word(std::string_view text) {
  TextScanner scanner(text);
  scanner.skip_space('#');
  const std::string_view word = scanner.peek_word();
  if (!off_keyword(word).empty()) {
    return FileFormat::off;
  }
  if (std::find(obj_keywords.begin(), obj_keywords.end(), word) != obj_keywords.end()) {
    return FileFormat::obj;
  }
  return std::nullopt;
}

/// JSON with the key that every glTF file has, or at least with its suffix.
bool is_gltf_text(std::string_view bytes, std::string_view file_name) {
  TextScanner scanner(bytes);
  scanner.skip_space('\0');
  return scanner.peek() == '{' &&
         (equal_ignoring_case(suffix(file_name), "gltf") || bytes.find("\"asset\"") != bytes.npos);
}

/// What the suffix says, for content that could be several things.
FileFormat by_suffix(const Source& source, std::string_view file_name, bool text) {
  const std::string_view ending = suffix(file_name);
  if (text && equal_ignoring_case(ending, "obj")) {
    return FileFormat::obj;
  }
  if (text && equal_ignoring_case(ending, "off")) {
    return FileFormat::off;
  }
  if (equal_ignoring_case(ending, "stl")) {
    if (source.bytes.size() < stl_header_size) {
      source.refuse(
          ErrorKind::unreadable_input,
          fmt::format("is no STL file: it doesn't begin with \"solid\", and a binary one has {} bytes or "
                      "more, not {}",
                      stl_header_size, source.bytes.size()));
    }
    if (!text) {
      return FileFormat::stl_binary;
    }
  }
  if (const auto format = imported_format(ending); format && !source.importer.empty()) {
    return *format;
  }
  if (const auto sentence = foreign_suffix(ending)) {
    source.refuse(ErrorKind::unreadable_input, *sentence);
  }
  source.refuse(ErrorKind::unreadable_input,
                "is in no known mesh format (" + listed(format_names(), "or") + ")");
}

/// The mark that editors put before UTF-8 text; it means nothing.
constexpr std::string_view utf8_mark = "\xef\xbb\xbf";

Soup read_as(FileFormat format, const Source& source) {
  switch (format) {
    case FileFormat::obj:
      return read_obj(source);
    case FileFormat::stl_ascii:
      return read_stl_ascii(source);
    case FileFormat::stl_binary:
      return read_stl_binary(source);
    case FileFormat::ply_ascii:
    case FileFormat::ply_binary:
      return read_ply(source);
    case FileFormat::gltf:
      return read_gltf(source);
    case FileFormat::glb:
      return read_glb(source);
    case FileFormat::threemf:
      return read_3mf(source);
    case FileFormat::pdo:
      return read_pdo(source);
    case FileFormat::dae:
    case FileFormat::fbx:
    case FileFormat::max3ds:
    case FileFormat::blend:
      return read_imported(format, source);
    case FileFormat::off:
      break;
  }
  return read_off(source);
}

/// The format of the content; the suffix of the name decides only where the content could be several. PLY
/// files are distinguished as far as ASCII and binary. Throws Error(unreadable_input) that says what the file
/// is instead, where that can be seen. Reads a few lines at the start, and comments before them.
FileFormat detect_format(const Source& source, std::string_view file_name) {
  const std::string_view bytes = source.bytes;
  if (bytes.empty()) {
    source.refuse(ErrorKind::unreadable_input, "is empty");
  }
  // The size decides before any word: many binary STL files begin with "solid" or with a name.
  if (bytes.size() >= stl_header_size && bytes.size() == stl_file_size(stl_facet_count(bytes))) {
    return FileFormat::stl_binary;
  }
  if (bytes.starts_with("glTF")) {
    return FileFormat::glb;
  }
  if (bytes.starts_with("version 3\n")) {
    return FileFormat::pdo;
  }
  if (is_zip(bytes) &&
      (bytes.find(".model") != bytes.npos || equal_ignoring_case(suffix(file_name), "3mf"))) {
    return FileFormat::threemf;
  }
  if (is_gltf_text(bytes, file_name)) {
    return FileFormat::gltf;
  }
  if (const std::string version = newer_blender(bytes, suffix(file_name)); !version.empty()) {
    source.refuse(ErrorKind::unreadable_input,
                  fmt::format("was saved by Blender {}, and files up to 2.79 are read: {}", version,
                              words(Way::blender)));
  }
  if (!source.importer.empty()) {
    if (const auto format = imported_format(bytes, suffix(file_name))) {
      return *format;
    }
  }
  if (const auto sentence = foreign_content(bytes, suffix(file_name))) {
    source.refuse(ErrorKind::unreadable_input, *sentence);
  }
  if (bytes.size() > 4 && equal_ignoring_case(bytes.substr(0, 3), "ply") &&
      (is_line_end(bytes[3]) || is_blank(bytes[3]))) {
    return FileFormat::ply_binary;
  }
  const bool text = looks_like_text(bytes);
  if (text && is_ascii_stl(bytes)) {
    return FileFormat::stl_ascii;
  }
  if (text || bytes.find("BINARY") < start_length) {
    if (const auto format = by_first_word(bytes)) {
      return *format;
    }
  }
  return by_suffix(source, file_name, text);
}

/// True where the suffix of a file name is that of a mesh format other than this one.
bool suffix_contradicts(std::string_view file_name, FileFormat format) {
  const std::string_view ending = suffix(file_name);
  for (const std::string& known : format_names()) {
    if (equal_ignoring_case(ending, known)) {
      return known != format_name(format);
    }
  }
  return false;
}

}  // namespace

std::string_view way_by_blender() {
  return words(Way::blender);
}

std::string_view off_keyword(std::string_view word) {
  for (const std::string_view keyword : {"OFF", "off", "Off"}) {
    const std::size_t at = word.find(keyword);
    if (at == word.npos) {
      continue;
    }
    std::string_view prefix = word.substr(0, at);
    const std::string_view rest = word.substr(at + keyword.size());
    for (const std::string_view part : {"ST", "C", "N", "4", "n"}) {
      if (prefix.starts_with(part)) {
        prefix.remove_prefix(part.size());
      }
    }
    const bool ends = rest.empty() || rest.front() == '#' || (rest.front() >= '0' && rest.front() <= '9');
    return prefix.empty() && ends ? word.substr(0, at + keyword.size()) : std::string_view();
  }
  return {};
}

namespace {

void add_pictures_beside(const std::filesystem::path& folder, Soup& soup) {
  std::set<std::string> files(soup.files_beside.begin(), soup.files_beside.end());
  for (const Material& material : soup.materials) {
    if (material.has_picture() && !material.texture_file.empty()) {
      files.insert((folder / material.texture_file).string());
    }
  }
  soup.files_beside.assign(files.begin(), files.end());
}

}  // namespace

Soup parse_soup(std::string_view bytes, std::string_view file_name,
                const std::filesystem::path& folder_for_materials, const Context& context,
                const std::filesystem::path& importer) {
  if (bytes.starts_with(utf8_mark)) {
    bytes.remove_prefix(utf8_mark.size());
  }
  const Source source{bytes, printable(file_name), folder_for_materials, context, importer};
  try {
    const FileFormat format = detect_format(source, file_name);
    Soup soup = read_as(format, source);
    complete(soup);
    if (suffix_contradicts(file_name, format)) {
      soup.remarks.add(RepairKind::content_is_other_format, 1,
                       fmt::format("the content is {}", format_name(format)));
    }
    if (soup.polygon_count() == 0) {
      source.refuse(ErrorKind::unusable_mesh,
                    soup.points.empty() ? "has no faces" : "has points but no faces that could be unfolded");
    }
    add_pictures_beside(folder_for_materials, soup);
    return soup;
  } catch (const std::bad_alloc&) {
    source.refuse(ErrorKind::unusable_mesh, "needs more memory than this machine has");
  }
}

Soup read_soup(const std::filesystem::path& file, const Context& context,
               const std::filesystem::path& importer) {
  std::string bytes;
  try {
    bytes = read_file(file);
  } catch (const std::bad_alloc&) {
    const std::string name = printable(file.string());
    throw Error(ErrorKind::unusable_mesh, fmt::format("{} needs more memory than this machine has", name),
                name);
  }
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  return parse_soup(bytes, file.string(), folder, context, importer);
}

}  // namespace ridgecraft::mesh
