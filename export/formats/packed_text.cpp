// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/formats/packed_text.hpp"

#include <cstddef>
#include <cstdint>

#include <zlib.h>

#include "base/error.hpp"

namespace ridgecraft::paper {
namespace {

std::string dense_letters(std::string_view bytes) {
  constexpr std::string_view taken("\0\r<", 3);
  std::string text;
  text.reserve(bytes.size() + bytes.size() / 6 + 2);
  std::size_t at = 0;
  std::uint32_t held = 0;
  unsigned bits = 0;
  const auto seven = [&] {
    if (bits < 7) {
      held = held << 8U | (at < bytes.size() ? static_cast<unsigned char>(bytes[at]) : 0U);
      ++at;
      bits += 8;
    }
    bits -= 7;
    return held >> bits & 0x7fU;
  };
  while (at < bytes.size() || (at == bytes.size() && bits > 0)) {
    const std::uint32_t code = seven();
    const std::size_t which = taken.find(static_cast<char>(code));
    if (which == std::string_view::npos) {
      text.push_back(static_cast<char>(code));
    } else {
      const std::uint32_t letter = 0x100U + 0x80U * static_cast<std::uint32_t>(which) + seven();
      text.push_back(static_cast<char>(0xc0U | letter >> 6U));
      text.push_back(static_cast<char>(0x80U | (letter & 0x3fU)));
    }
  }
  return text;
}

}  // namespace

std::string packed_text(std::string_view text) {
  uLongf size = compressBound(static_cast<uLong>(text.size()));
  std::string packed(size, '\0');
  const int failed =
      compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(text.data()),
                static_cast<uLong>(text.size()), Z_BEST_COMPRESSION);
  RIDGECRAFT_ASSERT(failed == Z_OK);
  packed.resize(size);
  return dense_letters(packed);
}

}  // namespace ridgecraft::paper
