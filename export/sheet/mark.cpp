// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/sheet/mark.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/encodings.hpp"

namespace ridgecraft::export_ {
namespace {

constexpr std::string_view word_start = "ridgecraft-model:";
constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n";
/// Meshes and robot descriptions carry the word in a comment in or after their first lines.
constexpr std::size_t mesh_header_size = 512;
/// So does a page for browsers, before anything else but what kind of text it is.
constexpr std::size_t html_header_size = 256;
/// mesh::Model::digest has 16 digits; longer ones may come.
constexpr std::size_t longest_digest = 64;

bool is_hexadecimal(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
}

/// The hexadecimal digits at the start of `text`; nothing where there are none or too many.
std::string leading_digest(std::string_view text) {
  const auto end = std::find_if_not(text.begin(), text.end(), is_hexadecimal);
  const auto count = static_cast<std::size_t>(end - text.begin());
  return count <= longest_digest ? std::string(text.substr(0, count)) : std::string();
}

std::string digest_after_word(std::string_view text) {
  const auto at = text.find(word_start);
  return at == std::string_view::npos ? std::string() : leading_digest(text.substr(at + word_start.size()));
}

std::uint32_t big_endian(std::string_view four_bytes) {
  std::uint32_t value = 0;
  for (const char byte : four_bytes.substr(0, 4)) {
    value = (value << 8U) | static_cast<unsigned char>(byte);
  }
  return value;
}

/// Chunks: length, type, data, checksum (PNG specification, section 5.3).
std::string png_digest(std::string_view bytes) {
  bytes.remove_prefix(png_signature.size());
  while (bytes.size() >= 12) {
    const std::size_t size = big_endian(bytes);
    const std::string_view type = bytes.substr(4, 4);
    if (type == "IDAT" || size > bytes.size() - 12) {
      break;
    }
    if (type == "tEXt") {
      if (auto digest = digest_after_word(bytes.substr(8, size)); !digest.empty()) {
        return digest;
      }
    }
    bytes.remove_prefix(size + 12);
  }
  return {};
}

std::string svg_digest(std::string_view bytes) {
  const auto start = bytes.find("<metadata");
  if (start == std::string_view::npos) {
    return {};
  }
  const auto end = bytes.find("</metadata>", start);
  return end == std::string_view::npos ? std::string() : digest_after_word(bytes.substr(start, end - start));
}

/// Pages for browsers tell it in their head, before anything that came from a model.
std::string html_digest(std::string_view bytes) {
  constexpr std::string_view name = "<meta name=\"ridgecraft-model\" content=\"";
  const std::string_view head = bytes.substr(0, html_header_size);
  const auto at = head.find(name);
  return at == std::string_view::npos ? std::string() : digest_after_word(head.substr(at + name.size()));
}

/// Robot descriptions and LightBurn projects have it in a comment before their first element.
std::string comment_digest(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, mesh_header_size);
  const auto element = std::min(head.find("<robot"), head.find("<LightBurnProject"));
  return element == std::string_view::npos ? std::string() : digest_after_word(bytes.substr(0, element));
}

std::string json_digest(std::string_view bytes) {
  const std::string quoted_key = '"' + std::string(mark_key) + '"';
  const auto key = bytes.find(quoted_key);
  if (key == std::string_view::npos) {
    return {};
  }
  bytes.remove_prefix(key + quoted_key.size());
  for (const char expected : {':', '"'}) {
    bytes.remove_prefix(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
    if (bytes.empty() || bytes.front() != expected) {
      return {};
    }
    bytes.remove_prefix(1);
  }
  std::string digest = leading_digest(bytes);
  return bytes.substr(digest.size()).starts_with('"') ? digest : std::string();
}

}  // namespace

std::string settings_json(const Settings& settings) {
  std::string text = "{";
  for (const auto& [name, value] : settings) {
    text += (text.size() == 1 ? "" : ", ") + json_string(name) + ": " + value;
  }
  return text + "}";
}

std::string mark_word(const Mark& mark) {
  return std::string(word_start) + mark.digest;
}

std::string read_mark_digest(std::string_view bytes) {
  if (bytes.starts_with("%PDF-")) {
    return digest_after_word(bytes);
  }
  if (bytes.starts_with(png_signature)) {
    return png_digest(bytes);
  }
  if (bytes.starts_with("ply\n") || bytes.starts_with("OFF\n")) {
    return digest_after_word(bytes.substr(0, mesh_header_size));
  }
  if (bytes.starts_with("# ") && bytes.substr(2).starts_with(word_start)) {
    return leading_digest(bytes.substr(2 + word_start.size()));  // OBJ
  }
  if (bytes.starts_with("#usda ") || bytes.starts_with("glTF")) {
    return digest_after_word(bytes.substr(0, mesh_header_size));
  }
  if (bytes.starts_with("999\n")) {
    return digest_after_word(bytes.substr(0, mesh_header_size));  // DXF
  }
  if (bytes.starts_with("%!PS-Adobe")) {
    return digest_after_word(bytes.substr(0, mesh_header_size));  // EPS
  }
  if (bytes.starts_with("IN;")) {  // HPGL: at the end
    return digest_after_word(bytes.substr(bytes.size() - std::min(bytes.size(), mesh_header_size)));
  }
  if (bytes.starts_with("PK\x03\x04")) {  // projects: in the first file, which is stored as it is
    return json_digest(bytes.substr(0, mesh_header_size));
  }
  const auto first = bytes.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) {
    return {};
  }
  if (bytes[first] == '{') {
    return json_digest(bytes);
  }
  if (bytes[first] != '<') {
    return {};
  }
  if (bytes.substr(first).starts_with("<!doctype html>")) {
    return html_digest(bytes.substr(first));
  }
  std::string in_comment = comment_digest(bytes);
  return in_comment.empty() ? svg_digest(bytes) : in_comment;
}

}  // namespace ridgecraft::export_
