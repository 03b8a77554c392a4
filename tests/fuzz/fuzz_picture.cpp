// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a picture that a model has: looked at from outside first, as its readers do.
#include <cstdint>
#include <string_view>

#include "mesh/look/picture.hpp"
#include "mesh/reading/files.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (ridgecraft::mesh::picture_fault(bytes).empty()) {
    (void)ridgecraft::mesh::unpack_picture(bytes);
  }
  return 0;
}
