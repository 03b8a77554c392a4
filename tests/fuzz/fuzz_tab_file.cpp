// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a file of tabs: values within their limits, or one sentence that tells the line.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "cli/files/input_files.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ridgecraft;
  const auto require = [](bool holds) {
    if (!holds) {
      std::abort();
    }
  };
  try {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    for (const unfold::EdgeTab& tab : cli::read_tab_file("tabs.txt", bytes)) {
      require(tab.number > 0);
      require(!tab.height_mm || (*tab.height_mm >= 1.5 && *tab.height_mm <= 50.0));
      require(!tab.angle || (*tab.angle > 0.0 && *tab.angle < 1.6));
      require(tab.wanted || (!tab.both && tab.piece.empty()));
    }
  } catch (const Error& error) {
    require(error.kind() == ErrorKind::unreadable_input);
    require(std::string(error.what()).find("tabs.txt, line ") != std::string::npos);
  }
  return 0;
}
