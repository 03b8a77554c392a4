// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/json_text.hpp"

#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "base/error.hpp"

namespace ridgecraft {
namespace {

bool is_continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U;
}

/// Bytes of the well-formed UTF-8 sequence at the start of `text`; 0 where there is none (Unicode standard,
/// table 3-7).
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(text[i])); };
  const unsigned first = byte(0);
  const std::size_t size = first < 0x80U                      ? 1
                           : first >= 0xc2U && first <= 0xdfU ? 2
                           : first >= 0xe0U && first <= 0xefU ? 3
                           : first >= 0xf0U && first <= 0xf4U ? 4
                                                              : 0;
  if (size == 0 || size > text.size()) {
    return 0;
  }
  for (std::size_t i = 1; i < size; ++i) {
    if (!is_continuation(text[i])) {
      return 0;
    }
  }
  // Overlong forms, surrogates and what lies beyond U+10FFFF.
  const bool bad = (first == 0xe0U && byte(1) < 0xa0U) || (first == 0xedU && byte(1) > 0x9fU) ||
                   (first == 0xf0U && byte(1) < 0x90U) || (first == 0xf4U && byte(1) > 0x8fU);
  return bad ? 0 : size;
}

}  // namespace

std::string json_string(std::string_view text) {
  std::string quoted = "\"";
  while (!text.empty()) {
    const std::size_t size = sequence_length(text);
    const char c = text.front();
    if (size == 0) {
      quoted += "\\ufffd";
    } else if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (static_cast<unsigned char>(c) < 0x20U || c == '\x7f') {
      fmt::format_to(std::back_inserter(quoted), "\\u{:04x}", static_cast<unsigned>(c));
    } else {
      quoted += text.substr(0, size);
    }
    text.remove_prefix(size == 0 ? 1 : size);
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
