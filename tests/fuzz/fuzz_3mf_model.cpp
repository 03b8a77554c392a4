// SPDX-License-Identifier: GPL-3.0-or-later
// Any text as the model within a 3MF package.
#include "fuzz_reader.hpp"
#include "mesh/file_writers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string file = ridgecraft::test::threemf(std::string(reinterpret_cast<const char*>(data), size));
  return ridgecraft::test::fuzz_reader(reinterpret_cast<const std::uint8_t*>(file.data()), file.size(),
                                       "model.3mf");
}
