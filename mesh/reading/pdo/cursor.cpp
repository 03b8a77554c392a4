// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/pdo/cursor.hpp"

#include <bit>
#include <optional>

#include <fmt/format.h>

#include "base/printable.hpp"
#include "base/utf8.hpp"

namespace ridgecraft::mesh {
namespace {

/// Two characters of UTF-16 that stand for one letter beyond the first 65,536 make it; halves alone stay what
/// they are, and aren't printable afterwards.
std::string utf8_of(const std::u16string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::uint32_t letter = text[i];
    if (letter >= 0xd800U && letter < 0xdc00U && i + 1 < text.size() && text[i + 1] >= 0xdc00U &&
        text[i + 1] < 0xe000U) {
      letter = 0x10000U + ((letter - 0xd800U) << 10U) + (text[++i] - 0xdc00U);
    }
    append_utf8(out, letter);
  }
  return out;
}

/// Up to the end mark, which may be shifted like the characters or not.
std::string unshifted(std::string_view raw, std::uint32_t shift) {
  std::string text(raw.substr(0, raw.find_last_not_of('\0') + 1));
  for (char& c : text) {
    c = static_cast<char>(static_cast<unsigned char>(c) - shift);
  }
  return text.substr(0, text.find('\0'));
}

std::string unshifted_wide(std::string_view raw, std::uint32_t shift) {
  std::u16string text;
  for (std::size_t i = 0; i + 1 < raw.size(); i += 2) {
    const std::uint32_t stored = static_cast<unsigned char>(raw[i]) |
                                 static_cast<std::uint32_t>(static_cast<unsigned char>(raw[i + 1])) << 8U;
    const auto letter = static_cast<char16_t>(stored - shift);
    if (stored == 0 || letter == 0) {
      break;
    }
    text += letter;
  }
  return utf8_of(text);
}

}  // namespace

void PdoCursor::refuse(std::string_view reason, ErrorKind kind) const {
  source_.refuse_byte(kind, source_.bytes.data() + at_, fmt::format("{}: {}", place_, reason));
}

std::string_view PdoCursor::bytes(std::size_t size) {
  if (size > source_.bytes.size() - at_) {
    source_.refuse(ErrorKind::unreadable_input,
                   fmt::format("is cut off or damaged: it ends after {} bytes, within {}",
                               source_.bytes.size(), place_));
  }
  const std::string_view found = source_.bytes.substr(at_, size);
  at_ += size;
  return found;
}

std::uint64_t PdoCursor::little_endian(std::size_t size) {
  std::uint64_t value = 0;
  std::uint32_t bits = 0;
  for (const char c : bytes(size)) {
    value |= std::uint64_t{static_cast<unsigned char>(c)} << bits;
    bits += 8;
  }
  return value;
}

std::uint8_t PdoCursor::byte() {
  return static_cast<std::uint8_t>(little_endian(1));
}

std::uint32_t PdoCursor::whole() {
  return static_cast<std::uint32_t>(little_endian(4));
}

std::int32_t PdoCursor::number() {
  return static_cast<std::int32_t>(whole());
}

double PdoCursor::real() {
  return std::bit_cast<double>(little_endian(8));
}

double PdoCursor::short_real() {
  return static_cast<double>(std::bit_cast<float>(whole()));
}

std::size_t PdoCursor::count(std::size_t least_size, std::string_view things) {
  const std::uint32_t told = whole();
  if (told > (source_.bytes.size() - at_) / least_size) {
    refuse(fmt::format("it says {} {}, more than the {} bytes that follow can hold", told, things,
                       source_.bytes.size() - at_));
  }
  return told;
}

std::string_view PdoCursor::raw_string() {
  return bytes(count(strings.length_size, "letters") * strings.length_size);
}

std::string PdoCursor::string() {
  const std::string_view raw = raw_string();
  std::string text = strings.wide ? unshifted_wide(raw, strings.shift) : unshifted(raw, strings.shift);
  return printable(text) == text ? text : std::string();
}

}  // namespace ridgecraft::mesh
