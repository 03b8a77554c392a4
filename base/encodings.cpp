// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/encodings.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/text.hpp"

namespace ridgecraft {

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  char* out = text.data();
  for (std::size_t i = 0; i < bytes.size(); i += 3, out += 4) {
    const auto byte = [&](std::size_t k) {
      return k < bytes.size() ? static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[k])) : 0U;
    };
    const std::uint32_t three = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
    for (std::size_t k = 0; k < 4 && i + k <= bytes.size(); ++k) {
      out[k] = letters[three >> (18U - 6U * k) & 63U];
    }
  }
  return text;
}

std::string xml_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

namespace {

// A 64-bit hash in the manner of xxHash and MurmurHash: eight bytes at a time, multiplied and rotated, then
// the finaliser of splitmix64.

constexpr std::uint64_t first_factor = 0x9e3779b185ebca87ULL;
constexpr std::uint64_t second_factor = 0xc2b2ae3d27d4eb4fULL;

std::uint64_t mix(std::uint64_t state, std::uint64_t word) {
  return std::rotl(state ^ (std::rotl(word * first_factor, 31) * second_factor), 27) * first_factor +
         second_factor;
}

}  // namespace

std::string digest(std::string_view bytes) {
  std::uint64_t state = mix(second_factor, bytes.size());
  for (; bytes.size() >= 8; bytes.remove_prefix(8)) {
    state = mix(state, little_endian(bytes.substr(0, 8)));
  }
  state = mix(state, little_endian(bytes));
  state = (state ^ (state >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  state = (state ^ (state >> 27U)) * 0x94d049bb133111ebULL;
  return fmt::format("{:016x}", state ^ (state >> 31U));
}

std::string json_string(std::string_view text) {
  std::string quoted = "\"";
  while (!text.empty()) {
    const auto [code, size] = first_character(text);
    const char c = text.front();
    if (code == replacement_character && size == 1) {
      quoted += "\\ufffd";
    } else if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (static_cast<unsigned char>(c) < 0x20U || c == '\x7f') {
      fmt::format_to(std::back_inserter(quoted), "\\u{:04x}", static_cast<unsigned>(c));
    } else {
      quoted += text.substr(0, size);
    }
    text.remove_prefix(size);
  }
  return quoted += '"';
}

void JsonText::number(double value) {
  RIDGECRAFT_ASSERT(std::isfinite(value));
  fmt::format_to(std::back_inserter(text_), "{}", value == 0.0 ? 0.0 : value);
}

void JsonText::point(Vec2 p) {
  text_ += '[';
  number(p.x);
  text_ += ',';
  number(p.y);
  text_ += ']';
}

void JsonText::point(Vec3 p) {
  text_ += '[';
  number(p.x);
  text_ += ',';
  number(p.y);
  text_ += ',';
  number(p.z);
  text_ += ']';
}

void JsonText::key(std::string_view name) {
  text_ += text_.empty() || text_.back() == '{' ? "\n" : ",\n";
  text_ += '"';
  text_ += name;
  text_ += "\": ";
}

}  // namespace ridgecraft
