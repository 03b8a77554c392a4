// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/detect_format.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include <fmt/format.h>

#include "base/printable.hpp"
#include "base/sentence.hpp"
#include "mesh/reading/foreign_content.hpp"
#include "mesh/reading/stl_layout.hpp"
#include "mesh/reading/text_scanner.hpp"
#include "mesh/reading/zip_archive.hpp"

namespace ridgecraft::mesh {
namespace {

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
  if (is_off_keyword(word.substr(0, word.find('#')))) {
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

}  // namespace

bool is_off_keyword(std::string_view word) {
  if (!word.ends_with("OFF")) {
    return false;
  }
  std::string_view prefix = word.substr(0, word.size() - 3);
  for (const std::string_view part : {"ST", "C", "N", "4", "n"}) {
    if (prefix.starts_with(part)) {
      prefix.remove_prefix(part.size());
    }
  }
  return prefix.empty();
}

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

bool suffix_contradicts(std::string_view file_name, FileFormat format) {
  const std::string_view ending = suffix(file_name);
  for (const std::string& known : format_names()) {
    if (equal_ignoring_case(ending, known)) {
      return known != format_name(format);
    }
  }
  return false;
}

}  // namespace ridgecraft::mesh
