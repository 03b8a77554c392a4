// SPDX-License-Identifier: GPL-3.0-or-later
#include "samples/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <cairo.h>

#include "base/no_index.hpp"

namespace ridgecraft::samples {
namespace {

/// Fine points per pixel and direction, averaged in the end: smooth borders.
constexpr int fineness = 4;
/// Share of the picture that the model fills.
constexpr double filled = 0.94;
/// How far before a line something must be to hide it, in pixels: the surface that it runs on doesn't.
constexpr double hiding = 3.0;
/// How much of a hidden line is seen.
constexpr double faint = 0.25;
constexpr Vec3 paper_tone{0.72, 0.68, 0.6};

}  // namespace

View view_from(double azimuth_degrees, double elevation_degrees) {
  const double azimuth = azimuth_degrees * std::numbers::pi / 180.0;
  const double elevation = elevation_degrees * std::numbers::pi / 180.0;
  const Vec3 eye{std::sin(azimuth) * std::cos(elevation), -std::cos(azimuth) * std::cos(elevation),
                 std::sin(elevation)};
  const Vec3 right{std::cos(azimuth), std::sin(azimuth), 0.0};
  return {right, cross(eye, right), eye};
}

/// The nearest face behind each fine point of a square picture.
class Picture::Canvas {
 public:
  explicit Canvas(int size) : size_(size), face_(area(), no_index), depth_(area(), -INFINITY) {}

  /// Corners in fine points, y downwards, z towards the eye.
  void fill(std::uint32_t face, const std::array<Vec3, 3>& p) {
    const double doubled = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
    if (doubled == 0.0) {
      return;
    }
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
    for (int y = std::max(0, static_cast<int>(top)); y <= std::min(size_ - 1, static_cast<int>(bottom) + 1);
         ++y) {
      for (int x = std::max(0, static_cast<int>(left)); x <= std::min(size_ - 1, static_cast<int>(right) + 1);
           ++x) {
        const double b = ((x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (y - p[0].y)) / doubled;
        const double c = ((p[1].x - p[0].x) * (y - p[0].y) - (x - p[0].x) * (p[1].y - p[0].y)) / doubled;
        const double z = p[0].z + b * (p[1].z - p[0].z) + c * (p[2].z - p[0].z);
        if (b >= 0.0 && c >= 0.0 && b + c <= 1.0 && z > depth_[at(x, y)]) {
          depth_[at(x, y)] = z;
          face_[at(x, y)] = face;
        }
      }
    }
  }

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] std::uint32_t face(int x, int y) const {
    return x < 0 || y < 0 || x >= size_ || y >= size_ ? no_index : face_[at(x, y)];
  }

  /// Mean colour and cover of the fine points of a pixel; where regions meet and along outlines darker.
  [[nodiscard]] std::array<double, 4> pixel(std::span<const Vec3> colours,
                                            std::span<const std::uint32_t> region, int x, int y) const {
    const auto region_at = [&](int i, int j) {
      const std::uint32_t at_point = face(i, j);
      return at_point == no_index ? no_index : region[at_point];
    };
    Vec3 sum;
    double cover = 0.0;
    for (int j = y * fineness; j < (y + 1) * fineness; ++j) {
      for (int i = x * fineness; i < (x + 1) * fineness; ++i) {
        const std::uint32_t at_point = face(i, j);
        if (at_point == no_index) {
          continue;
        }
        const std::uint32_t own = region[at_point];
        bool border = false;
        for (int step = -1; step <= 1; ++step) {
          border = border || region_at(i + step, j) != own || region_at(i, j + step) != own;
        }
        sum += (border ? 0.55 : 1.0) * colours[at_point];
        cover += 1.0;
      }
    }
    constexpr double all = fineness * fineness;
    return {sum.x / all, sum.y / all, sum.z / all, cover / all};
  }
  /// Minus infinity where nothing is.
  [[nodiscard]] double depth(int x, int y) const {
    return x < 0 || y < 0 || x >= size_ || y >= size_ ? -static_cast<double>(INFINITY) : depth_[at(x, y)];
  }

 private:
  [[nodiscard]] std::size_t area() const {
    return static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_);
  }
  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(x);
  }

  int size_;
  std::vector<std::uint32_t> face_;
  std::vector<double> depth_;
};

struct Picture::Image {
  explicit Image(int size)
      : surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, size, size), cairo_surface_destroy),
        context(cairo_create(surface.get()), cairo_destroy) {}

  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface;
  std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context;
};

Picture::Picture(const mesh::Surface& surface, const View& view, int pixels)
    : surface_(&surface),
      view_(view),
      pixels_(pixels),
      canvas_(std::make_unique<Canvas>(pixels * fineness)),
      image_(std::make_unique<Image>(pixels)) {
  Box3 box;
  for (const Vec3 p : surface.points()) {
    box.add(turned(p));
  }
  scale_ = filled * canvas_->size() / std::max(box.size().x, box.size().y);
  middle_ = 0.5 * (box.low + box.high);
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto v = surface.vertices(f);
    canvas_->fill(f.value(),
                  {seen(surface.point(v[0])), seen(surface.point(v[1])), seen(surface.point(v[2]))});
  }
}

Picture::~Picture() = default;

/// Along the picture's directions: y downwards, z towards the eye.
Vec3 Picture::turned(Vec3 p) const {
  return {dot(p, view_.right), -dot(p, view_.up), dot(p, view_.towards_eye)};
}

/// In fine points.
Vec3 Picture::seen(Vec3 p) const {
  return scale_ * (turned(p) - middle_) + Vec3{0.5 * canvas_->size(), 0.5 * canvas_->size(), 0.0};
}

/// Whether the surface is before a point that seen() gave.
bool Picture::hidden(Vec3 p) const {
  return canvas_->depth(static_cast<int>(p.x), static_cast<int>(p.y)) > p.z + hiding * fineness;
}

void Picture::paint(std::span<const Vec3> colours, std::span<const std::uint32_t> regions) {
  const Vec3 light = normalized(-0.45 * view_.right + 0.65 * view_.up + 0.75 * view_.towards_eye);
  std::vector<Vec3> shaded;
  for (const FaceId f : ids<FaceId>(surface_->face_count())) {
    const Vec3 normal = surface_->normal(f);
    const bool from_behind = dot(normal, view_.towards_eye) < 0.0;
    const double brightness = 0.4 + 0.6 * std::max(0.0, dot(from_behind ? -normal : normal, light));
    shaded.push_back(brightness * (from_behind ? paper_tone : colours[f.value()]));
  }
  unsigned char* data = cairo_image_surface_get_data(image_->surface.get());
  const int stride = cairo_image_surface_get_stride(image_->surface.get());
  const auto byte = [](double fraction) {
    return static_cast<std::uint32_t>(std::lround(255.0 * std::clamp(fraction, 0.0, 1.0)));
  };
  cairo_surface_flush(image_->surface.get());
  for (int y = 0; y < pixels_; ++y) {
    for (int x = 0; x < pixels_; ++x) {
      // Colours are premultiplied in both.
      const auto [r, g, b, a] = canvas_->pixel(shaded, regions, x, y);
      const std::uint32_t value = byte(a) << 24U | byte(r) << 16U | byte(g) << 8U | byte(b);
      std::copy_n(reinterpret_cast<const unsigned char*>(&value), 4, data + y * stride + 4 * x);
    }
  }
  cairo_surface_mark_dirty(image_->surface.get());
}

void Picture::line(std::span<const Vec3> points, Vec3 colour, double width_in_pixels) {
  cairo_t* cairo = image_->context.get();
  cairo_set_line_width(cairo, width_in_pixels);
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
  // Pieces of a fine point's length, each either seen or hidden, are drawn in as few strokes as possible.
  bool drawing = false;
  bool is_hidden = false;
  const auto stroke = [&] {
    if (drawing) {
      cairo_set_source_rgba(cairo, colour.x, colour.y, colour.z, is_hidden ? faint : 1.0);
      cairo_stroke(cairo);
    }
    drawing = false;
  };
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vec3 from = seen(points[i - 1]);
    const Vec3 to = seen(points[i]);
    const int steps = 1 + static_cast<int>(length(to - from) / fineness);
    for (int k = 0; k < steps; ++k) {
      const Vec3 a = from + (to - from) * (static_cast<double>(k) / steps);
      const Vec3 b = from + (to - from) * (static_cast<double>(k + 1) / steps);
      if (!drawing || hidden(b) != is_hidden) {
        stroke();
        drawing = true;
        is_hidden = hidden(b);
        cairo_move_to(cairo, a.x / fineness, a.y / fineness);
      }
      cairo_line_to(cairo, b.x / fineness, b.y / fineness);
    }
  }
  stroke();
}

void Picture::spot(Vec3 point, Vec3 colour, double radius_in_pixels) {
  const Vec3 p = seen(point);
  if (hidden(p)) {
    return;
  }
  cairo_t* cairo = image_->context.get();
  cairo_arc(cairo, p.x / fineness, p.y / fineness, radius_in_pixels, 0.0, 2.0 * std::numbers::pi);
  cairo_set_source_rgb(cairo, colour.x, colour.y, colour.z);
  cairo_fill_preserve(cairo);
  cairo_set_source_rgb(cairo, 0.2, 0.2, 0.2);
  cairo_set_line_width(cairo, 0.25 * radius_in_pixels);
  cairo_stroke(cairo);
}

bool Picture::write_png(const std::string& file) {
  return cairo_surface_write_to_png(image_->surface.get(), file.c_str()) == CAIRO_STATUS_SUCCESS;
}

}  // namespace ridgecraft::samples
