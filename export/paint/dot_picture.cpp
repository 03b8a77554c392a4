// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/paint/dot_picture.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string>

#include "base/geometry.hpp"

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

namespace {

/// Dots whose corners and middle lie on one original face are worked out together: so many in each direction,
/// 0.7 mm on usual pages, or a quarter as many where they don't.
constexpr int block = 8;
constexpr int smallest_block = 4;
static_assert(block * block <= 64, "a block's dots are bits of one number");
/// Fewer dots are looked up one by one, and so are those that have more faces near them.
constexpr std::size_t worth_a_list = 4;
constexpr std::size_t most_listed = 24;
/// Beyond a cell's border dots are painted, too, so many: what mixes dots finds the same colour there.
constexpr double overhang_dots = 1.5;
/// How far inside its face the place lies whose colour a rim takes, mm, and as a share of the way to the
/// middle.
constexpr double inside_mm = 0.8;
constexpr double inside_fraction = 0.3;
/// JPEG has no longer sides.
constexpr double longest_side = 65000.0;
/// More dots in one picture take more than 200 MB: larger pictures are coarser.
constexpr double most_dots = 5e7;

bool is_outside(const std::array<double, 3>& weights) {
  return weights[0] < 0.0 || weights[1] < 0.0 || weights[2] < 0.0;
}

/// Of the place of a cell's face that is nearest to one beside it.
std::array<double, 3> weights_inside(const Cell& cell, Vec2 on_page) {
  Vec2 nearest = cell.at[0];
  double least = dot(on_page - nearest, on_page - nearest);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 p = nearest_on_segment(on_page, cell.at[k], cell.at[(k + 1) % 3]);
    if (const double squared = dot(on_page - p, on_page - p); squared < least) {
      nearest = p;
      least = squared;
    }
  }
  // Right on an edge the face beyond it is as near: a little inside it isn't.
  const Vec2 middle = (cell.at[0] + cell.at[1] + cell.at[2]) / 3.0;
  const double way = length(middle - nearest);
  const double fraction = way > 0.0 ? std::min(inside_mm / way, inside_fraction) : 0.0;
  return weights_at(cell.at, nearest + fraction * (middle - nearest));
}

/// What lies beyond a face takes its weights from inside it.
std::array<double, 3> weights_near_face(const Cell& cell, Vec2 on_page) {
  const std::array<double, 3> weights = weights_at(cell.at, on_page);
  return cell.kind != CellKind::face && is_outside(weights) ? weights_inside(cell, on_page) : weights;
}

/// Of a dot of a cell whose face lies on one original face. A picture is looked at under the face alone: what
/// it has beside it belongs to others.
std::array<double, 3> weights_on_face(const Cell& cell, Vec2 on_page) {
  const std::array<double, 3> weights = weights_near_face(cell, on_page);
  return cell.kind == CellKind::face ? kept_within(weights) : weights;
}

class CellPainter {
 public:
  CellPainter(DotRaster& raster, const Cell& cell, const PictureSource& source, double overhang_mm)
      : raster_(raster),
        cell_(cell),
        surface_(source.surface),
        look_(source.look),
        shade_(source.shade),
        normal_(surface_.normal(cell.face)),
        overhang_mm_(overhang_mm) {
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = surface_.point(surface_.vertices(cell.face)[k]);
    }
    if (const auto under = look_.face_under(corners, normal_)) {
      colours_ = look_.colours_of(*under, corners, raster.dot_mm());
    }
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
    if (colours_) {
      for (int y = low; y <= high; ++y) {
        paint_row(y, left, right);
      }
      return;
    }
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

  /// Of a cell whose face lies on one original face: nothing has to be looked for.
  void paint_row(int y, int left, int right) {
    const Vec2 step = raster_.middle(1, y) - raster_.middle(0, y);
    for (const Side& side : sides_) {
      // Dots with before + x * slope <= 0 lie on the side's inner side.
      const double before = dot(raster_.middle(0, y) - side.at, side.out) - overhang_mm_;
      const double slope = step.x * side.out.x;
      if (std::abs(slope) > 0.0) {
        const double at = std::clamp(-before / slope, left - 1.0, right + 1.0);
        const int below = static_cast<int>(std::floor(at));
        left = slope < 0.0 ? std::max(left, below < at ? below + 1 : below) : left;
        right = slope > 0.0 ? std::min(right, below) : right;
      } else if (before > 0.0) {
        return;
      }
    }
    if (cell_.kind == CellKind::face && overhang_mm_ == 0.0 && left <= right) {
      row_.resize(static_cast<std::size_t>(right - left) + 1);
      colours_->along(kept_within(weights_at(cell_.at, raster_.middle(left, y))),
                      kept_within(weights_at(cell_.at, raster_.middle(right, y))), row_);
      for (int x = left; x <= right; ++x) {
        if (!raster_.painted(x, y)) {
          raster_.paint(x, y, shaded(shade_, row_[static_cast<std::size_t>(x - left)]));
        }
      }
      return;
    }
    for (int x = left; x <= right; ++x) {
      if (!raster_.painted(x, y)) {
        raster_.paint(x, y, shaded(shade_, colours_->at(weights_on_face(cell_, raster_.middle(x, y)))));
      }
    }
  }

  /// How far outside of a side of the cell the dots of a block lie, least and most.
  struct Reach {
    double least = 0.0;
    double most = 0.0;
  };
  [[nodiscard]] Reach reach(const Side& side, Vec2 low, Vec2 high) const {
    const double x0 = (low.x - side.at.x) * side.out.x;
    const double x1 = (high.x - side.at.x) * side.out.x;
    const double y0 = (low.y - side.at.y) * side.out.y;
    const double y1 = (high.y - side.at.y) * side.out.y;
    return {std::min(x0, x1) + std::min(y0, y1), std::max(x0, x1) + std::max(y0, y1)};
  }
  [[nodiscard]] bool contains(Vec2 p) const {
    return std::all_of(sides_.begin(), sides_.end(),
                       [&](const Side& side) { return dot(p - side.at, side.out) <= overhang_mm_; });
  }

  /// Which dots of a block are the cell's and not painted yet: a bit for each, row by row. The sides' reaches
  /// tell of most blocks that all are inside or outside.
  [[nodiscard]] std::uint64_t wanted_dots(int left, int low, int right, int high) const {
    double most = -INFINITY;
    for (const Side& side : sides_) {
      const Reach found = reach(side, raster_.middle(left, low), raster_.middle(right, high));
      if (found.least > overhang_mm_) {
        return 0;
      }
      most = std::max(most, found.most);
    }
    if (overhang_mm_ > 0.0 && most <= 0.0) {
      return 0;  // the first round has painted what lies inside
    }
    std::uint64_t dots = 0;
    for (int y = low; y <= high; ++y) {
      for (int x = left; x <= right; ++x) {
        if (!raster_.painted(x, y) && (most <= overhang_mm_ || contains(raster_.middle(x, y)))) {
          dots |= bit_of(x - left, y - low);
        }
      }
    }
    return dots;
  }
  [[nodiscard]] static std::uint64_t bit_of(int column, int row) {
    return std::uint64_t{1} << static_cast<unsigned>(block * row + column);
  }

  [[nodiscard]] mesh::LookPlace look_up(int x, int y) {
    const Vec3 p = place_on_surface(surface_, cell_, raster_.middle(x, y));
    const mesh::LookPlace place = look_.nearest(p, normal_, hint_);
    hint_ = place.face;
    return place;
  }
  void put(int x, int y, const mesh::LookPlace& place) {
    raster_.paint(x, y, shaded(shade_, look_.colour_at(place, raster_.dot_mm())));
  }

  void paint_block(int left, int low, int right, int high) {
    const std::uint64_t wanted = wanted_dots(left, low, right, high);
    if (wanted == 0) {
      return;
    }
    if (std::popcount(wanted) > smallest_block && cell_.kind == CellKind::face) {
      const std::array<mesh::LookPlace, 4> corners{look_up(left, low), look_up(right, low),
                                                   look_up(left, high), look_up(right, high)};
      const mesh::LookPlace middle = look_up((left + right) / 2, (low + high) / 2);
      if (std::all_of(corners.begin(), corners.end(),
                      [&](const mesh::LookPlace& c) { return c.face == middle.face; })) {
        paint_between(corners, wanted, left, low, right, high);
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
    paint_each(wanted, left, low, right, high);
  }

  /// Dot by dot: few faces are near all of them, and those are looked for once.
  void paint_each(std::uint64_t wanted, int left, int low, int right, int high) {
    dots_.clear();
    Box3 box;
    for (int y = low; y <= high; ++y) {
      for (int x = left; x <= right; ++x) {
        if ((wanted & bit_of(x - left, y - low)) != 0) {
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

  void paint_between(const std::array<mesh::LookPlace, 4>& corners, std::uint64_t wanted, int left, int low,
                     int right, int high) {
    for (int y = low; y <= high; ++y) {
      const double up = high > low ? static_cast<double>(y - low) / (high - low) : 0.0;
      for (int x = left; x <= right; ++x) {
        if ((wanted & bit_of(x - left, y - low)) == 0) {
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

  DotRaster& raster_;
  const Cell& cell_;
  const mesh::Surface& surface_;
  const mesh::Look& look_;
  const Shade& shade_;
  Vec3 normal_;
  double overhang_mm_;
  std::vector<Side> sides_;
  std::optional<mesh::TriangleColours> colours_;  ///< of the face, where it lies on one original face
  std::vector<Dot> dots_;                         ///< space to work in
  std::vector<mesh::Rgb> row_;                    ///< the same
  std::uint32_t hint_ = 0;
};

}  // namespace

Vec3 place_on_surface(const mesh::Surface& surface, const Cell& cell, Vec2 on_page) {
  const std::array<double, 3> weights = weights_near_face(cell, on_page);
  const auto vertices = surface.vertices(cell.face);
  return weights[0] * surface.point(vertices[0]) + weights[1] * surface.point(vertices[1]) +
         weights[2] * surface.point(vertices[2]);
}

Image picture_of(const std::vector<const Cell*>& cells, const PictureSource& source, const Context& context) {
  Box2 box;
  for (const Cell* const cell : cells) {
    box.add(cell->box.low);
    box.add(cell->box.high);
  }
  const Vec2 size = box.high - box.low;
  const double dots_per_mm =
      std::min({source.dots_per_inch / 25.4, longest_side / std::max({size.x, size.y, 1.0}),
                std::sqrt(most_dots / std::max(size.x * size.y, 1.0))});
  DotRaster raster(box, dots_per_mm);
  // Each face's own dots first, then what lies beyond its borders.
  for (const double overhang : {0.0, overhang_dots / dots_per_mm}) {
    for (const CellKind kind : {CellKind::face, CellKind::tab, CellKind::bleed}) {
      for (const Cell* const cell : cells) {
        if (cell->kind == kind) {
          context.check();
          CellPainter(raster, *cell, source, overhang).paint();
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

}  // namespace ridgecraft::export_
