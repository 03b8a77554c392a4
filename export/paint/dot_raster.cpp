// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/paint/dot_raster.hpp"

#include <cmath>
#include <cstring>
#include <memory>
#include <string>

namespace ridgecraft::paper {

DotRaster::DotRaster(const Box2& box, double dots_per_mm)
    : dots_per_mm_(dots_per_mm),
      low_{std::floor(box.low.x * dots_per_mm) - 2.0, std::floor(box.low.y * dots_per_mm) - 2.0},
      width_(static_cast<int>(std::ceil(box.high.x * dots_per_mm) + 2.0 - low_.x)),
      height_(static_cast<int>(std::ceil(box.high.y * dots_per_mm) + 2.0 - low_.y)),
      pixels_(new std::uint8_t[bytes()]),  // std::make_unique_for_overwrite isn't in emscripten's library
      painted_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0) {}

int DotRaster::column(double x) const {
  return static_cast<int>(std::floor(x * dots_per_mm_ - low_.x));
}

int DotRaster::row(double y) const {
  return static_cast<int>(std::floor(y * dots_per_mm_ - low_.y));
}

void DotRaster::fill_up() {
  int last_row = -1;
  for (int y = 0; y < height_; ++y) {
    int last = -1;
    for (int x = 0; x < width_; ++x) {
      if (painted(x, y)) {
        for (int i = last + 1; i < x; ++i) {
          copy(last < 0 || x - i < i - last ? x : last, y, i, y);
        }
        last = x;
      }
    }
    for (int i = last + 1; last >= 0 && i < width_; ++i) {
      copy(last, y, i, y);
    }
    if (last >= 0) {
      for (int i = last_row + 1; i < y; ++i) {
        copy_row(y, i);
      }
      last_row = y;
    }
  }
  if (last_row < 0) {
    std::memset(pixels_.get(), 0xff, bytes());
    return;
  }
  for (int i = last_row + 1; i < height_; ++i) {
    copy_row(last_row, i);
  }
}

Image DotRaster::image() const {
  Image image;
  image.place.low = {low_.x / dots_per_mm_, low_.y / dots_per_mm_};
  image.place.high = {(low_.x + width_) / dots_per_mm_, (low_.y + height_) / dots_per_mm_};
  image.width = static_cast<std::uint32_t>(width_);
  image.height = static_cast<std::uint32_t>(height_);
  image.jpeg = std::make_shared<const std::string>(
      mesh::pack_jpeg(image.width, image.height, {pixels_.get(), bytes()}));
  return image;
}

void DotRaster::copy(int from_x, int from_y, int x, int y) {
  std::memcpy(pixels_.get() + 3 * index(x, y), pixels_.get() + 3 * index(from_x, from_y), 3);
}

void DotRaster::copy_row(int from, int to) {
  std::memcpy(pixels_.get() + 3 * index(0, to), pixels_.get() + 3 * index(0, from),
              std::size_t{3} * static_cast<std::size_t>(width_));
}

}  // namespace ridgecraft::paper
