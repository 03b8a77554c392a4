// SPDX-License-Identifier: GPL-3.0-or-later
// Four numbers worked at a time: in the vector form that GCC and Clang share, or the portable way where a
// compiler has none or the build asks for it. Both give the same bits as one number after the other.
#pragma once

#include <cstdint>

#if defined(__GNUC__) && !defined(RIDGECRAFT_PORTABLE)

namespace ridgecraft::unfold {

using FloatLanes = float __attribute__((vector_size(16)));
using IntLanes = std::int32_t __attribute__((vector_size(16)));
using DoubleLanes = double __attribute__((vector_size(16)));  ///< two

/// Bit k: lane k of a comparison's result holds.
[[nodiscard]] inline std::uint32_t bits_of(IntLanes holds) {
  const IntLanes bits = holds & IntLanes{1, 2, 4, 8};
  return static_cast<std::uint32_t>((bits[0] | bits[1]) | (bits[2] | bits[3]));
}

[[nodiscard]] inline FloatLanes smaller(FloatLanes a, FloatLanes b) {
  return a < b ? a : b;
}
[[nodiscard]] inline FloatLanes larger(FloatLanes a, FloatLanes b) {
  return a > b ? a : b;
}
[[nodiscard]] inline DoubleLanes smaller(DoubleLanes a, DoubleLanes b) {
  return a < b ? a : b;
}
[[nodiscard]] inline DoubleLanes larger(DoubleLanes a, DoubleLanes b) {
  return a > b ? a : b;
}

}  // namespace ridgecraft::unfold

#else

#include "unfold/search/portable_lanes.hpp"

namespace ridgecraft::unfold {

using FloatLanes = PortableFloatLanes;
using IntLanes = PortableIntLanes;
using DoubleLanes = PortableDoubleLanes;  ///< two

}  // namespace ridgecraft::unfold

#endif
