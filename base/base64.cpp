// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/base64.hpp"

#include <cstddef>
#include <cstdint>

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

}  // namespace ridgecraft
