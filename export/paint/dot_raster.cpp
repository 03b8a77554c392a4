// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/paint/dot_raster.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>

namespace ridgecraft::export_ {
namespace {

/// JPEG packs squares of so many dots, counted from the picture's upper left corner.
constexpr int packed_square = 8;

}  // namespace

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

/// From the picture's upper left corner; rows of dots are counted from below.
DotRaster::Square DotRaster::square(int column, int row) const {
  const int top = height_ - 1 - row * packed_square;
  return {column * packed_square, std::max(0, top - packed_square + 1),
          std::min(width_ - 1, (column + 1) * packed_square - 1), top};
}

void DotRaster::fill_up() {
  const int columns = (width_ + packed_square - 1) / packed_square;
  const int rows = (height_ + packed_square - 1) / packed_square;
  // Squares from which others take their colour, as places in rows of `columns`; those first that have their
  // own.
  std::vector<int> filled;
  std::vector<bool> is_filled(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), false);
  const auto add = [&](int place) {
    is_filled[static_cast<std::size_t>(place)] = true;
    filled.push_back(place);
  };
  for (int place = 0; place < columns * rows; ++place) {
    if (fill_square(square(place % columns, place / columns))) {
      add(place);
    }
  }
  if (filled.empty()) {
    std::memset(pixels_.get(), 0xff, bytes());
    return;
  }
  for (std::size_t next = 0; next < filled.size(); ++next) {
    const int column = filled[next] % columns;
    const int row = filled[next] / columns;
    const Square from = square(column, row);
    const auto spread = [&](int beside_column, int beside_row) {
      const int place = beside_row * columns + beside_column;
      if (beside_column >= 0 && beside_row >= 0 && beside_column < columns && beside_row < rows &&
          !is_filled[static_cast<std::size_t>(place)]) {
        const Square to = square(beside_column, beside_row);
        for (int y = to.low; y <= to.high; ++y) {
          for (int x = to.left; x <= to.right; ++x) {
            copy(from.right, from.low, x, y);
          }
        }
        add(place);
      }
    };
    spread(column - 1, row);
    spread(column + 1, row);
    spread(column, row - 1);
    spread(column, row + 1);
  }
}

bool DotRaster::fill_square(const Square& square) {
  const std::size_t across = static_cast<std::size_t>(square.right - square.left) + 1;
  int last_row = -1;  // of those with a painted dot
  for (int y = square.low; y <= square.high; ++y) {
    const std::uint8_t* const row = &painted_[index(square.left, y)];
    if (std::memchr(row, 1, across) == nullptr) {
      continue;
    }
    if (std::memchr(row, 0, across) != nullptr) {
      fill_row(square.left, square.right, y);
    }
    for (int i = last_row < 0 ? square.low : last_row + 1; i < y; ++i) {
      copy_row(y, i, square.left, across);
    }
    last_row = y;
  }
  for (int i = last_row + 1; last_row >= 0 && i <= square.high; ++i) {
    copy_row(last_row, i, square.left, across);
  }
  return last_row >= 0;
}

void DotRaster::fill_row(int left, int right, int y) {
  int last = left - 1;
  for (int x = left; x <= right; ++x) {
    if (painted(x, y)) {
      for (int i = last + 1; i < x; ++i) {
        copy(last < left || x - i < i - last ? x : last, y, i, y);
      }
      last = x;
    }
  }
  for (int i = last + 1; i <= right; ++i) {
    copy(last, y, i, y);
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

void DotRaster::copy_row(int from, int to, int left, std::size_t across) {
  std::memcpy(pixels_.get() + 3 * index(left, to), pixels_.get() + 3 * index(left, from), 3 * across);
}

}  // namespace ridgecraft::export_
