// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/model/file_frame.hpp"

#include <array>
#include <string_view>

#include <fmt/format.h>

namespace ridgecraft::mesh {
namespace {

struct Unit {
  double mm;
  std::string_view name;
};
constexpr std::array units{Unit{0.001, "micrometres"}, Unit{1.0, "millimetres"}, Unit{10.0, "centimetres"},
                           Unit{1000.0, "metres"},     Unit{25.4, "inches"},     Unit{304.8, "feet"}};

}  // namespace

const char* axis_name(Axis axis) {
  constexpr std::array names{"x", "y", "z"};
  return names[static_cast<std::size_t>(axis)];
}

std::string unit_names(double mm_per_unit) {
  for (const Unit& unit : units) {
    if (unit.mm == mm_per_unit) {
      return std::string(unit.name);
    }
  }
  return fmt::format("units of {:g} mm", mm_per_unit);
}

}  // namespace ridgecraft::mesh
