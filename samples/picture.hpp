// SPDX-License-Identifier: GPL-3.0-or-later
// Flat shaded pictures of surfaces for the documentation.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/vector.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::samples {

/// Directions of a picture in the model's space, unit and at right angles.
struct View {
  Vec3 right, up, towards_eye;
};

/// Seen from this direction (degrees; 0 0 looks at the front of a model that stands on the xy plane, 90 0 at
/// its left side).
[[nodiscard]] View view_from(double azimuth_degrees, double elevation_degrees);

/// A square picture of one surface; colours have components from 0 to 1.
class Picture {
 public:
  /// Finds what is seen; the surface must outlive this. `pixels` from 16 to 4000.
  Picture(const mesh::Surface& surface, const View& view, int pixels);
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  /// Paints the faces in this light, those seen from behind in a dull paper tone, with darker lines where
  /// faces of different regions meet and along outlines. Both per face.
  void paint(std::span<const Vec3> colours, std::span<const std::uint32_t> regions);
  /// A line along points of the model's space over what was painted: where something is before it, faint.
  void line(std::span<const Vec3> points, Vec3 colour, double width_in_pixels);
  /// A round spot, where nothing is before it.
  void spot(Vec3 point, Vec3 colour, double radius_in_pixels);
  /// False when the file can't be written.
  [[nodiscard]] bool write_png(const std::string& file);

 private:
  class Canvas;
  struct Image;

  [[nodiscard]] Vec3 turned(Vec3 p) const;
  [[nodiscard]] Vec3 seen(Vec3 p) const;
  [[nodiscard]] bool hidden(Vec3 p) const;

  const mesh::Surface* surface_;
  View view_;
  int pixels_;
  double scale_ = 1.0;
  Vec3 middle_;
  std::unique_ptr<Canvas> canvas_;
  std::unique_ptr<Image> image_;
};

}  // namespace ridgecraft::samples
