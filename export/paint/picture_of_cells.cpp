// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/paint/picture_of_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/segment.hpp"

namespace ridgecraft::paper {
namespace {

/// Dots whose corners and middle lie on one original face are worked out together: so many in each direction,
/// 0.7 mm on usual pages, or a quarter as many where they don't.
constexpr int block = 8;
constexpr int smallest_block = 4;
/// Fewer dots are looked up one by one, and so are those that have more faces near them.
constexpr std::size_t worth_a_list = 4;
constexpr std::size_t most_listed = 24;
/// Beyond a cell's border dots are painted, too, so many: what mixes dots finds the same colour there.
constexpr double overhang_dots = 1.5;
/// How far inside its face the place lies whose colour a rim takes, mm, and as a share of the way to the
/// middle.
constexpr double inside_mm = 0.8;
constexpr double inside_share = 0.3;
/// JPEG has no longer sides.
constexpr double longest_side = 65000.0;
/// More dots in one picture take more than 200 MB: larger pictures are coarser.
constexpr double most_dots = 5e7;

class Raster {
 public:
  Raster(const Box2& box, double dots_per_mm)
      : dots_per_mm_(dots_per_mm),
        low_{std::floor(box.low.x * dots_per_mm) - 2.0, std::floor(box.low.y * dots_per_mm) - 2.0},
        width_(static_cast<int>(std::ceil(box.high.x * dots_per_mm) + 2.0 - low_.x)),
        height_(static_cast<int>(std::ceil(box.high.y * dots_per_mm) + 2.0 - low_.y)),
        pixels_(std::size_t{3} * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)),
        painted_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0) {}

  /// The middle of a dot on the page; rows are counted from below here.
  [[nodiscard]] Vec2 middle(int x, int y) const {
    return {(low_.x + x + 0.5) / dots_per_mm_, (low_.y + y + 0.5) / dots_per_mm_};
  }
  [[nodiscard]] int column(double x) const { return static_cast<int>(std::floor(x * dots_per_mm_ - low_.x)); }
  [[nodiscard]] int row(double y) const { return static_cast<int>(std::floor(y * dots_per_mm_ - low_.y)); }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] double dot_mm() const { return 1.0 / dots_per_mm_; }

  [[nodiscard]] bool painted(int x, int y) const { return painted_[index(x, y)] != 0; }
  void paint(int x, int y, const mesh::Rgb& colour) {
    const std::size_t i = index(x, y);
    painted_[i] = 1;
    std::memcpy(pixels_.data() + 3 * i, colour.data(), 3);
  }

  /// Dots that nobody sees take their neighbour's colour: an even ground packs best, and its borders leave no
  /// traces beside them.
  void fill_up() {
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
    for (int i = last_row + 1; last_row >= 0 && i < height_; ++i) {
      copy_row(last_row, i);
    }
  }

  [[nodiscard]] Image image() const {
    Image image;
    image.place.low = {low_.x / dots_per_mm_, low_.y / dots_per_mm_};
    image.place.high = {(low_.x + width_) / dots_per_mm_, (low_.y + height_) / dots_per_mm_};
    image.width = static_cast<std::uint32_t>(width_);
    image.height = static_cast<std::uint32_t>(height_);
    image.jpeg = std::make_shared<const std::string>(mesh::pack_jpeg(image.width, image.height, pixels_));
    return image;
  }

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(height_ - 1 - y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  void copy(int from_x, int from_y, int x, int y) {
    std::memcpy(pixels_.data() + 3 * index(x, y), pixels_.data() + 3 * index(from_x, from_y), 3);
  }
  void copy_row(int from, int to) {
    std::memcpy(pixels_.data() + 3 * index(0, to), pixels_.data() + 3 * index(0, from),
                std::size_t{3} * static_cast<std::size_t>(width_));
  }

  double dots_per_mm_;
  Vec2 low_;  ///< the lower left corner, in dots from the sheet's
  int width_;
  int height_;
  std::vector<std::uint8_t> pixels_;
  std::vector<std::uint8_t> painted_;
};

class CellPainter {
 public:
  CellPainter(Raster& raster, const Cell& cell, const mesh::Surface& surface, const mesh::Look& look,
              const Shade& shade, double overhang_mm)
      : raster_(raster),
        cell_(cell),
        surface_(surface),
        look_(look),
        shade_(shade),
        normal_(surface.normal(cell.face)),
        overhang_mm_(overhang_mm) {
    for (std::size_t i = 0; i < cell.polygon.size(); ++i) {
      const Vec2 side = cell.polygon[(i + 1) % cell.polygon.size()] - cell.polygon[i];
      if (const double size = length(side); size > 0.0) {
        sides_.push_back({cell.polygon[i], -perpendicular(side) / size});
      }
    }
  }

  void paint() {
    const int left = std::max(0, raster_.column(cell_.box.low.x - overhang_mm_));
    const int right = std::min(raster_.width() - 1, raster_.column(cell_.box.high.x + overhang_mm_));
    const int low = std::max(0, raster_.row(cell_.box.low.y - overhang_mm_));
    const int high = std::min(raster_.height() - 1, raster_.row(cell_.box.high.y + overhang_mm_));
    for (int y = low; y <= high; y += block) {
      for (int x = left; x <= right; x += block) {
        paint_block(x, y, std::min(x + block - 1, right), std::min(y + block - 1, high));
      }
    }
  }

 private:
  struct Side {
    Vec2 at;
    Vec2 out;
  };
  struct Dot {
    int x = 0;
    int y = 0;
    Vec3 at;  ///< on the surface
  };

  [[nodiscard]] bool contains(Vec2 p) const {
    return std::all_of(sides_.begin(), sides_.end(),
                       [&](const Side& side) { return dot(p - side.at, side.out) <= overhang_mm_; });
  }
  [[nodiscard]] bool wanted(int x, int y) const {
    return !raster_.painted(x, y) && contains(raster_.middle(x, y));
  }
  [[nodiscard]] mesh::LookPlace look_up(int x, int y) {
    const Vec3 p = place_on_surface(surface_, cell_, raster_.middle(x, y));
    const mesh::LookPlace place = look_.nearest(p, normal_, hint_);
    hint_ = place.face;
    return place;
  }
  void put(int x, int y, const mesh::LookPlace& place) {
    raster_.paint(x, y, shade_(look_.colour_at(place, raster_.dot_mm())));
  }

  void paint_block(int left, int low, int right, int high) {
    int count = 0;
    for (int y = low; y <= high; ++y) {
      for (int x = left; x <= right; ++x) {
        count += wanted(x, y) ? 1 : 0;
      }
    }
    if (count == 0) {
      return;
    }
    if (count > smallest_block && cell_.kind == CellKind::face) {
      const std::array<mesh::LookPlace, 4> corners{look_up(left, low), look_up(right, low),
                                                   look_up(left, high), look_up(right, high)};
      const mesh::LookPlace middle = look_up((left + right) / 2, (low + high) / 2);
      if (std::all_of(corners.begin(), corners.end(),
                      [&](const mesh::LookPlace& c) { return c.face == middle.face; })) {
        paint_between(corners, left, low, right, high);
        return;
      }
      if (right - left >= smallest_block && high - low >= smallest_block) {
        const int x = left + smallest_block;
        const int y = low + smallest_block;
        paint_block(left, low, x - 1, y - 1);
        paint_block(x, low, right, y - 1);
        paint_block(left, y, x - 1, high);
        paint_block(x, y, right, high);
        return;
      }
    }
    paint_each(left, low, right, high);
  }

  /// Dot by dot: few faces are near all of them, and those are looked for once.
  void paint_each(int left, int low, int right, int high) {
    dots_.clear();
    Box3 box;
    for (int y = low; y <= high; ++y) {
      for (int x = left; x <= right; ++x) {
        if (wanted(x, y)) {
          dots_.push_back({x, y, place_on_surface(surface_, cell_, raster_.middle(x, y))});
          box.add(dots_.back().at);
        }
      }
    }
    const Vec3 middle = 0.5 * (box.low + box.high);
    const std::vector<std::uint32_t> near =
        dots_.size() >= worth_a_list
            ? look_.faces_near(middle, normal_, 0.5 * length(box.size()), most_listed)
            : std::vector<std::uint32_t>();
    for (const Dot& dot : dots_) {
      const mesh::LookPlace place = near.empty() ? look_.nearest(dot.at, normal_, hint_)
                                                 : look_.nearest_among(near, dot.at, normal_, hint_);
      hint_ = place.face;
      put(dot.x, dot.y, place);
    }
  }

  void paint_between(const std::array<mesh::LookPlace, 4>& corners, int left, int low, int right, int high) {
    for (int y = low; y <= high; ++y) {
      const double up = high > low ? static_cast<double>(y - low) / (high - low) : 0.0;
      for (int x = left; x <= right; ++x) {
        if (!wanted(x, y)) {
          continue;
        }
        const double over = right > left ? static_cast<double>(x - left) / (right - left) : 0.0;
        mesh::LookPlace place{corners[0].face, {}};
        for (std::size_t k = 0; k < 3; ++k) {
          const double below = corners[0].weights[k] + over * (corners[1].weights[k] - corners[0].weights[k]);
          const double above = corners[2].weights[k] + over * (corners[3].weights[k] - corners[2].weights[k]);
          place.weights[k] = below + up * (above - below);
        }
        put(x, y, place);
      }
    }
  }

  Raster& raster_;
  const Cell& cell_;
  const mesh::Surface& surface_;
  const mesh::Look& look_;
  const Shade& shade_;
  Vec3 normal_;
  double overhang_mm_;
  std::vector<Side> sides_;
  std::vector<Dot> dots_;  ///< space to work in
  std::uint32_t hint_ = 0;
};

}  // namespace

Vec3 place_on_surface(const mesh::Surface& surface, const Cell& cell, Vec2 on_page) {
  std::array<double, 3> weights = weights_at(cell.at, on_page);
  if (cell.kind != CellKind::face && std::min({weights[0], weights[1], weights[2]}) < 0.0) {
    Vec2 nearest = cell.at[0];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 p = nearest_on_segment(on_page, cell.at[k], cell.at[(k + 1) % 3]);
      nearest = length(on_page - p) < length(on_page - nearest) ? p : nearest;
    }
    // Right on an edge the face beyond it is as near: a little inside it isn't.
    const Vec2 middle = (cell.at[0] + cell.at[1] + cell.at[2]) / 3.0;
    const double way = length(middle - nearest);
    const double share = way > 0.0 ? std::min(inside_mm / way, inside_share) : 0.0;
    weights = weights_at(cell.at, nearest + share * (middle - nearest));
  }
  const auto vertices = surface.vertices(cell.face);
  return weights[0] * surface.point(vertices[0]) + weights[1] * surface.point(vertices[1]) +
         weights[2] * surface.point(vertices[2]);
}

Image picture_of(const std::vector<const Cell*>& cells, const mesh::Surface& surface, const mesh::Look& look,
                 double dots_per_inch, const Shade& shade, const Context& context) {
  Box2 box;
  for (const Cell* const cell : cells) {
    box.add(cell->box.low);
    box.add(cell->box.high);
  }
  const Vec2 size = box.high - box.low;
  const double dots_per_mm = std::min({dots_per_inch / 25.4, longest_side / std::max({size.x, size.y, 1.0}),
                                       std::sqrt(most_dots / std::max(size.x * size.y, 1.0))});
  Raster raster(box, dots_per_mm);
  // Each face's own dots first, then what lies beyond its borders.
  for (const double overhang : {0.0, overhang_dots / dots_per_mm}) {
    for (const CellKind kind : {CellKind::face, CellKind::tab, CellKind::bleed}) {
      for (const Cell* const cell : cells) {
        if (cell->kind == kind) {
          context.check();
          CellPainter(raster, *cell, surface, look, shade, overhang).paint();
        }
      }
    }
  }
  raster.fill_up();
  Image image = raster.image();
  for (const Cell* const cell : cells) {
    image.clip.push_back(cell->polygon);
  }
  return image;
}

}  // namespace ridgecraft::paper
