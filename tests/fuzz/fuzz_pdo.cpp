// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a file with the suffix .pdo, for its model and for its nets.
#include "fuzz_reader.hpp"
#include "mesh/reading/pdo/read_pdo.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ridgecraft;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (mesh::may_have_seams(bytes)) {
    try {
      (void)mesh::read_seams(bytes, "model.pdo", {});
    } catch (const Error&) {
    }
  }
  return test::fuzz_reader(data, size, "model.pdo");
}
