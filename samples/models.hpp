// SPDX-License-Identifier: GPL-3.0-or-later
// The samples, each as a finished shape.
#pragma once

#include <span>

#include "samples/shape.hpp"

namespace ridgecraft::samples {

// animals.cpp
[[nodiscard]] Shape whale();
[[nodiscard]] Shape fish();
[[nodiscard]] Shape dinosaur();
[[nodiscard]] Shape penguin();
// fox.cpp
[[nodiscard]] Shape fox_head();
// buildings.cpp
[[nodiscard]] Shape house();
[[nodiscard]] Shape lighthouse();
// things.cpp
[[nodiscard]] Shape rocket();
[[nodiscard]] Shape mug();
[[nodiscard]] Shape vase();
[[nodiscard]] Shape chess_rook();
[[nodiscard]] Shape torus();
[[nodiscard]] Shape heart();
// solids.cpp
[[nodiscard]] Shape gem();
[[nodiscard]] Shape star();
// packaging.cpp; the only one with a border
[[nodiscard]] Shape packaging_box();

struct Sample {
  const char* file;  ///< its suffix says the format
  Shape (*make)();
  bool closed = true;  ///< a surface without border
};

/// All of them.
[[nodiscard]] std::span<const Sample> all();

}  // namespace ridgecraft::samples
