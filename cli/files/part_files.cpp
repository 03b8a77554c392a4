// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/part_files.hpp"

#include <algorithm>
#include <cmath>

namespace ridgecraft::cli {
namespace {

/// Hue, saturation and value, each in [0, 1].
mesh::ByteColour from_hsv(double hue, double saturation, double value) {
  const auto channel = [&](double offset) {
    const double k = std::fmod(offset + hue * 6.0, 6.0);
    const double share = value - value * saturation * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0);
    return static_cast<std::uint8_t>(std::lround(255.0 * share));
  };
  return {channel(5.0), channel(3.0), channel(1.0)};
}

}  // namespace

mesh::FaceColours part_colours(const segment::Segmentation& segmentation) {
  // Hues in golden-ratio steps: any few consecutive numbers lie far apart on the wheel.
  constexpr double golden = 0.6180339887498949;
  mesh::FaceColours colours(segmentation.part.size());
  for (const FaceId f : ids<FaceId>(segmentation.part.size())) {
    const std::uint32_t number = segmentation.part[f].value();
    const double hue = std::fmod(0.08 + golden * number, 1.0);
    colours[f] = from_hsv(hue, number % 3 == 1 ? 0.45 : 0.7, number % 2 == 1 ? 0.8 : 0.95);
  }
  return colours;
}

std::string with_comment(std::string mesh_file, const std::string& comment) {
  // PLY wants the format in its second line; an OFF comment may stand anywhere after the keyword.
  const bool ply = mesh_file.starts_with("ply\n");
  std::size_t at = mesh_file.find('\n') + 1;
  if (ply) {
    at = mesh_file.find('\n', at) + 1;
  }
  mesh_file.insert(at, (ply ? "comment " : "# ") + comment + "\n");
  return mesh_file;
}

}  // namespace ridgecraft::cli
