// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a PNG or JPEG file.
#include <cstdint>
#include <string_view>

#include "mesh/look/picture.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  (void)ridgecraft::mesh::unpack_picture({reinterpret_cast<const char*>(data), size});
  return 0;
}
