// SPDX-License-Identifier: GPL-3.0-or-later
// render_model MODEL PICTURE.png [AZIMUTH ELEVATION [PIXELS]]: a flat shaded picture of a model for the
// documentation, seen from the given direction (degrees; 0 0 looks at its front, 90 0 at its left side).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <cairo.h>

#include "mesh/foundation/error.hpp"
#include "mesh/mesh.hpp"

namespace {

using namespace ridgecraft;

/// Fine points per pixel and direction, averaged in the end: smooth borders.
constexpr int fineness = 4;
/// Folds below this are flat regions, radians: they get no line, as on paper.
constexpr double faint_fold = 3.0 * std::numbers::pi / 180.0;
constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();

struct View {
  Vec3 right, up, towards_eye;
};

View view_from(double azimuth_degrees, double elevation_degrees) {
  const double azimuth = azimuth_degrees * std::numbers::pi / 180.0;
  const double elevation = elevation_degrees * std::numbers::pi / 180.0;
  const Vec3 eye{std::sin(azimuth) * std::cos(elevation), -std::cos(azimuth) * std::cos(elevation),
                 std::sin(elevation)};
  const Vec3 right{std::cos(azimuth), std::sin(azimuth), 0.0};
  return {right, cross(eye, right), eye};
}

/// The flat region of each face, named by its smallest face; regions end where the material changes.
std::vector<std::uint32_t> regions(const mesh::Model& model) {
  const mesh::Surface& surface = model.surface;
  std::vector<std::uint32_t> region(surface.face_count(), nothing);
  const auto material = [&model](FaceId f) { return model.material.empty() ? 0U : model.material[f]; };
  for (const FaceId first : ids<FaceId>(surface.face_count())) {
    std::vector<FaceId> open;
    if (region[first.value()] == nothing) {
      region[first.value()] = first.value();
      open.push_back(first);
    }
    while (!open.empty()) {
      const FaceId f = open.back();
      open.pop_back();
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId side = mesh::corner(f, k);
        const FaceId g = surface.neighbor(side);
        if (g.valid() && region[g.value()] == nothing && material(f) == material(g) &&
            std::abs(surface.fold_angle(surface.edge(side))) < faint_fold) {
          region[g.value()] = first.value();
          open.push_back(g);
        }
      }
    }
  }
  return region;
}

/// The nearest face behind each fine point of a square picture.
class Canvas {
 public:
  explicit Canvas(int size) : size_(size), face_(area(), nothing), depth_(area(), -INFINITY) {}

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
    return x < 0 || y < 0 || x >= size_ || y >= size_ ? nothing : face_[at(x, y)];
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

Canvas look(const mesh::Surface& surface, const View& view, int size) {
  std::vector<Vec3> seen;
  Box3 box;
  for (const Vec3 p : surface.points()) {
    seen.push_back({dot(p, view.right), -dot(p, view.up), dot(p, view.towards_eye)});
    box.add(seen.back());
  }
  Canvas canvas(size);
  const double scale = 0.94 * size / std::max(box.size().x, box.size().y);
  const Vec3 middle = 0.5 * (box.low + box.high);
  for (Vec3& p : seen) {
    p = scale * (p - middle) + Vec3{0.5 * size, 0.5 * size, 0.0};
  }
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto v = surface.vertices(f);
    canvas.fill(f.value(), {seen[v[0].value()], seen[v[1].value()], seen[v[2].value()]});
  }
  return canvas;
}

/// Colours of the faces in this light, those seen from behind in a dull paper tone.
std::vector<Vec3> shade(const mesh::Model& model, const View& view) {
  const Vec3 light = normalized(-0.45 * view.right + 0.65 * view.up + 0.75 * view.towards_eye);
  std::vector<Vec3> colours;
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    mesh::Colour colour = {0.82, 0.84, 0.88};
    if (!model.material.empty() && model.material[f] != mesh::Soup::none) {
      colour = model.materials[model.material[f]].colour.value_or(colour);
    }
    Vec3 normal = model.surface.normal(f);
    if (dot(normal, view.towards_eye) < 0.0) {
      normal = -normal;
      colour = {0.72, 0.68, 0.6};
    }
    const double brightness = 0.4 + 0.6 * std::max(0.0, dot(normal, light));
    colours.push_back(brightness * Vec3{colour[0], colour[1], colour[2]});
  }
  return colours;
}

/// Mean colour and cover of the fine points of a pixel; folds and outlines are darker.
std::array<double, 4> pixel(const Canvas& canvas, const std::vector<Vec3>& colours,
                            const std::vector<std::uint32_t>& region, int x, int y) {
  const auto region_at = [&](int i, int j) {
    const std::uint32_t face = canvas.face(i, j);
    return face == nothing ? nothing : region[face];
  };
  Vec3 sum;
  double cover = 0.0;
  for (int j = y * fineness; j < (y + 1) * fineness; ++j) {
    for (int i = x * fineness; i < (x + 1) * fineness; ++i) {
      const std::uint32_t face = canvas.face(i, j);
      if (face == nothing) {
        continue;
      }
      const std::uint32_t own = region[face];
      bool border = false;
      for (int step = -1; step <= 1; ++step) {
        border = border || region_at(i + step, j) != own || region_at(i, j + step) != own;
      }
      sum += (border ? 0.55 : 1.0) * colours[face];
      cover += 1.0;
    }
  }
  constexpr double all = fineness * fineness;
  return {sum.x / all, sum.y / all, sum.z / all, cover / all};
}

bool write_png(const Canvas& canvas, const std::vector<Vec3>& colours,
               const std::vector<std::uint32_t>& region, const std::string& file) {
  const int size = canvas.size() / fineness;
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> image(
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, size, size), cairo_surface_destroy);
  unsigned char* data = cairo_image_surface_get_data(image.get());
  const int stride = cairo_image_surface_get_stride(image.get());
  const auto byte = [](double share) {
    return static_cast<std::uint32_t>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
  };
  cairo_surface_flush(image.get());
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      // Colours are premultiplied in both.
      const auto [r, g, b, a] = pixel(canvas, colours, region, x, y);
      const std::uint32_t value = byte(a) << 24U | byte(r) << 16U | byte(g) << 8U | byte(b);
      std::copy_n(reinterpret_cast<const unsigned char*>(&value), 4, data + y * stride + 4 * x);
    }
  }
  cairo_surface_mark_dirty(image.get());
  return cairo_surface_write_to_png(image.get(), file.c_str()) == CAIRO_STATUS_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 5 && argc != 6) {
    std::fputs("usage: render_model MODEL PICTURE.png [AZIMUTH ELEVATION [PIXELS]]\n", stderr);
    return 2;
  }
  try {
    const mesh::Model model = mesh::read(argv[1], {}, {});
    const View view = argc > 3 ? view_from(std::atof(argv[3]), std::atof(argv[4])) : view_from(35.0, 20.0);
    const int pixels = argc > 5 ? std::clamp(std::atoi(argv[5]), 16, 4000) : 480;
    const Canvas canvas = look(model.surface, view, pixels * fineness);
    if (!write_png(canvas, shade(model, view), regions(model), argv[2])) {
      std::fprintf(stderr, "render_model: can't write %s\n", argv[2]);
      return 1;
    }
  } catch (const Error& error) {
    std::fprintf(stderr, "render_model: %s\n", error.what());
    return 1;
  }
  return 0;
}
