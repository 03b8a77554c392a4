// SPDX-License-Identifier: GPL-3.0-or-later
// What a file says of the space that its numbers are in.
#pragma once

#include <optional>
#include <string>

namespace ridgecraft::mesh {

enum class Axis { x, y, z };

/// Formats without a word for one of these say nothing of it.
struct FileFrame {
  std::optional<double> mm_per_unit;  ///< millimetres in one unit of the file
  std::optional<Axis> up;             ///< the axis that points up

  friend bool operator==(const FileFrame&, const FileFrame&) = default;
};

/// "x", "y" or "z".
[[nodiscard]] const char* axis_name(Axis axis);

/// "metres", "millimetres", "inches" and so on; "units of 0.5 mm" for one without a name.
[[nodiscard]] std::string unit_names(double mm_per_unit);

}  // namespace ridgecraft::mesh
