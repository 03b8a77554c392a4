// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes to the checker of .fold files: a report, with figures or one fault of form.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "verify/verify.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ridgecraft;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const verify::Report report = verify::verify(bytes, {.max_faults = 20, .folding = true}, {});
  const bool form_fault = report.faults.size() == 1 && report.faults[0].promise == verify::Promise::form;
  if (report.figures.has_value() == form_fault) {
    std::abort();
  }
  return 0;
}
