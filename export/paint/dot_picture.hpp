// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of dots: what is painted dot by dot, and the cells of a piece in their colours.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/context.hpp"
#include "base/vector.hpp"
#include "export/paint/cells.hpp"
#include "export/sheet/drawing.hpp"
#include "mesh/look/look.hpp"
#include "mesh/look/picture.hpp"

namespace ridgecraft::export_ {

/// The dots of a box of the page; rows are counted from below. Dots of all pictures lie on one grid.
class DotRaster {
 public:
  /// `box` in mm.
  DotRaster(const Box2& box, double dots_per_mm);

  /// The middle of a dot on the page.
  [[nodiscard]] Vec2 middle(int x, int y) const {
    return {(low_.x + x + 0.5) / dots_per_mm_, (low_.y + y + 0.5) / dots_per_mm_};
  }
  [[nodiscard]] int column(double x) const;
  [[nodiscard]] int row(double y) const;
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] double dot_mm() const { return 1.0 / dots_per_mm_; }

  [[nodiscard]] bool painted(int x, int y) const { return painted_[index(x, y)] != 0; }
  void paint(int x, int y, const mesh::Rgb& colour) {
    const std::size_t i = index(x, y);
    painted_[i] = 1;
    std::uint8_t* const to = pixels_.get() + 3 * i;
    to[0] = colour[0];
    to[1] = colour[1];
    to[2] = colour[2];
  }

  /// Dots that aren't seen take their neighbour's colour within the square that JPEG packs at a time, so that
  /// borders leave no traces beside them; squares without any other are of one colour, that of a square
  /// beside them, which takes no room.
  void fill_up();

  /// The dots after fill_up(), to be seen through nothing yet (Image::clip). Throws Error(internal).
  [[nodiscard]] Image image() const;

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(height_ - 1 - y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  [[nodiscard]] std::size_t bytes() const {
    return std::size_t{3} * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  }
  void copy(int from_x, int from_y, int x, int y);
  void copy_row(int from, int to, int left, std::size_t across);
  /// Columns and rows of dots, the last ones among them.
  struct Square {
    int left, low, right, high;
  };
  [[nodiscard]] Square square(int column, int row) const;
  /// False where it has no painted dot.
  bool fill_square(const Square& square);
  /// Of a row with a painted dot between these columns.
  void fill_row(int left, int right, int y);

  double dots_per_mm_;
  Vec2 low_;  ///< the lower left corner, in dots from the sheet's
  int width_;
  int height_;
  std::unique_ptr<std::uint8_t[]> pixels_;  ///< three bytes each, not set before they are painted
  std::vector<std::uint8_t> painted_;
};

/// What becomes of each value of each channel when it is printed.
using Shade = std::array<std::uint8_t, 256>;

[[nodiscard]] inline mesh::Rgb shaded(const Shade& shade, const mesh::Rgb& colour) {
  return {shade[colour[0]], shade[colour[1]], shade[colour[2]]};
}

/// Where a place of a cell lies on the surface. Beyond the face, in rims and strips, it is the nearest place
/// of the face.
[[nodiscard]] Vec3 place_on_surface(const mesh::Surface& surface, const Cell& cell, Vec2 on_page);

/// What pictures are painted of.
struct PictureSource {
  const mesh::Surface& surface;
  const mesh::Look& look;
  double dots_per_inch = 300.0;
  const Shade& shade;  ///< has the last word on each colour
};

/// One picture of these cells, with the colours of the original surface's nearest places. O(dots) for faces
/// that lie on one original face, O(dots x log n) for others; neighbouring dots mostly lie on one original
/// face, which makes these quick, too.
[[nodiscard]] Image picture_of(const std::vector<const Cell*>& cells, const PictureSource& source,
                               const Context& context);

}  // namespace ridgecraft::export_
