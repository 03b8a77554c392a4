// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/look/picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace ridgecraft::mesh {
namespace {

/// Copies end where a side has this many pixels: beyond, colours of places far from each other would mix.
constexpr std::uint32_t shortest_side = 4;

/// A number in [0, size) for any whole number: pictures repeat.
std::uint32_t wrapped(double index, std::uint32_t size) {
  if (index >= 0.0 && index < size) {
    return static_cast<std::uint32_t>(index);
  }
  const double rest = index - std::floor(index / size) * size;
  return std::min(static_cast<std::uint32_t>(std::max(rest, 0.0)), size - 1);
}

/// The three bytes of a pixel, 16 bits apart.
std::uint64_t spread(const std::uint8_t* pixel) {
  return std::uint64_t{pixel[0]} | std::uint64_t{pixel[1]} << 16U | std::uint64_t{pixel[2]} << 32U;
}

}  // namespace

Picture::Picture(std::uint32_t width, std::uint32_t height, std::vector<std::uint8_t> pixels) {
  levels_.push_back({width, height, std::move(pixels)});
  while (std::min(levels_.back().width, levels_.back().height) >= 2 * shortest_side) {
    const Level& fine = levels_.back();
    Level coarse{fine.width / 2, fine.height / 2, {}};
    coarse.pixels.resize(std::size_t{3} * coarse.width * coarse.height);
    for (std::size_t y = 0; y < coarse.height; ++y) {
      const std::uint8_t* const above = fine.pixels.data() + 2 * y * fine.width * 3;
      const std::uint8_t* const below = above + std::size_t{3} * fine.width;
      std::uint8_t* const out = coarse.pixels.data() + y * coarse.width * 3;
      for (std::size_t x = 0; x < coarse.width; ++x) {
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t at = 6 * x + k;
          out[3 * x + k] =
              static_cast<std::uint8_t>((above[at] + above[at + 3] + below[at] + below[at + 3] + 2) / 4);
        }
      }
    }
    levels_.push_back(std::move(coarse));
  }
}

unsigned Picture::level_for(double pixels_per_dot) const {
  unsigned level = 0;
  while (level + 1 < levels_.size() && pixels_per_dot >= 2.0) {
    pixels_per_dot /= 2.0;
    ++level;
  }
  return level;
}

Rgb Picture::at(Vec2 uv, unsigned level) const {
  constexpr std::uint32_t whole = 256;  // shares of pixels are counted in this
  const Level& in = levels_[level];
  const double x = uv.x * in.width - 0.5;
  const double y = (1.0 - uv.y) * in.height - 0.5;
  // Most places lie within, where no number is negative.
  const bool within = x >= 0.0 && y >= 0.0 && x < in.width && y < in.height;
  const double left = within ? static_cast<double>(static_cast<std::uint32_t>(x)) : std::floor(x);
  const double top = within ? static_cast<double>(static_cast<std::uint32_t>(y)) : std::floor(y);
  const auto right_share = static_cast<std::uint32_t>((x - left) * whole);
  const auto low_share = static_cast<std::uint32_t>((y - top) * whole);
  const std::size_t x0 = within ? static_cast<std::size_t>(left) : wrapped(left, in.width);
  const std::size_t x1 = x0 + 1 == in.width ? 0 : x0 + 1;
  const std::size_t y0 = within ? static_cast<std::size_t>(top) : wrapped(top, in.height);
  const std::size_t y1 = y0 + 1 == in.height ? 0 : y0 + 1;
  const std::uint8_t* const above = in.pixels.data() + 3 * y0 * in.width;
  const std::uint8_t* const below = in.pixels.data() + 3 * y1 * in.width;
  // All channels at a time: mixed along a row each takes 16 bits, mixed across rows 24.
  const auto along = [&](const std::uint8_t* row) {
    return spread(row + 3 * x0) * (whole - right_share) + spread(row + 3 * x1) * right_share;
  };
  const std::uint64_t high = along(above);
  const std::uint64_t low = along(below);
  constexpr std::uint64_t outer = 0xffff0000ffffU;  // red and blue
  const auto across = [&](std::uint64_t up, std::uint64_t down, std::uint64_t rounding) {
    return up * (whole - low_share) + down * low_share + rounding;
  };
  constexpr std::uint64_t half = std::uint64_t{whole} * whole / 2;
  const std::uint64_t red_blue = across(high & outer, low & outer, half | half << 32U);
  const std::uint64_t green = across(high >> 16U & 0xffffU, low >> 16U & 0xffffU, half);
  return {static_cast<std::uint8_t>(red_blue >> 16U), static_cast<std::uint8_t>(green >> 16U),
          static_cast<std::uint8_t>(red_blue >> 48U)};
}

}  // namespace ridgecraft::mesh
