// SPDX-License-Identifier: GPL-3.0-or-later
// A 64-bit hash in the manner of xxHash and MurmurHash: eight bytes at a time, multiplied and rotated, then
// the finaliser of splitmix64.
#include "base/digest.hpp"

#include <bit>
#include <cstdint>

#include <fmt/format.h>

namespace ridgecraft {
namespace {

constexpr std::uint64_t first_factor = 0x9e3779b185ebca87ULL;
constexpr std::uint64_t second_factor = 0xc2b2ae3d27d4eb4fULL;

/// Up to eight bytes as a little-endian number, on any machine.
std::uint64_t load(std::string_view bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    value |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
  }
  return value;
}

std::uint64_t mix(std::uint64_t state, std::uint64_t word) {
  return std::rotl(state ^ (std::rotl(word * first_factor, 31) * second_factor), 27) * first_factor +
         second_factor;
}

}  // namespace

std::string digest(std::string_view bytes) {
  std::uint64_t state = mix(second_factor, bytes.size());
  for (; bytes.size() >= 8; bytes.remove_prefix(8)) {
    state = mix(state, load(bytes.substr(0, 8)));
  }
  state = mix(state, load(bytes));
  state = (state ^ (state >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  state = (state ^ (state >> 27U)) * 0x94d049bb133111ebULL;
  return fmt::format("{:016x}", state ^ (state >> 31U));
}

}  // namespace ridgecraft
