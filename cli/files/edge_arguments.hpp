// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace ridgecraft::cli {

/// Files that name edges to be cut or kept; empty: none.
struct EdgeArguments {
  std::string cuts;  ///< pairs of points
  std::string keep;
  std::string from;  ///< nets made before

  [[nodiscard]] bool any() const { return !cuts.empty() || !keep.empty() || !from.empty(); }
};

}  // namespace ridgecraft::cli
