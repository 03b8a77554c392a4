// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a file with the suffix .gltf; those that begin as GLB does are read as that.
#include "fuzz_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return ridgecraft::test::fuzz_reader(data, size, "model.gltf");
}
