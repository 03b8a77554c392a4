// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/expected_pages.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "mesh/extent.hpp"

namespace ridgecraft::cli {
namespace {

/// As many pages as a maker finishes.
constexpr double few_pages = 10.0;
/// Share of the printable area that pieces fill.
constexpr double filled = 0.6;

double area_of(const mesh::Surface& surface, const std::vector<FaceId>& faces) {
  double area = 0.0;
  for (const FaceId f : faces) {
    area += surface.area(f);
  }
  return area;
}

double pages_filled(double area, Vec2 printable) {
  return area / (filled * printable.x * printable.y);
}

double two_digits(double value) {
  const double unit = std::pow(10.0, std::max(0.0, std::floor(std::log10(value)) - 1.0));
  return std::round(value / unit) * unit;
}

/// Paper grows with the square of the size. A model on few pages has hardly a flat region that takes one for
/// itself, so those of this size don't count more than their area.
double size_on_few_pages(const mesh::Surface& surface, Vec2 printable, double pages) {
  const double paper = std::max(pages, pages_filled(mesh::total_area(surface), printable));
  return mesh::largest_extent(surface.bounds()) * std::sqrt(few_pages / paper);
}

}  // namespace

double expected_pages(const mesh::Prepared& prepared, Vec2 printable) {
  double alone = 0.0;
  double area_of_others = 0.0;
  for (const auto& faces : prepared.panels.faces) {
    const double area = area_of(prepared.model.surface, faces);
    if (area > 0.5 * printable.x * printable.y) {
      alone += 1.0;
    } else {
      area_of_others += area;
    }
  }
  return alone + pages_filled(area_of_others, printable);
}

std::string many_pages_warning(const mesh::Surface& surface, Vec2 printable, double pages, bool counted) {
  return fmt::format("this takes {}{:.0f} pages; --size {:.0f}mm would take about {:.0f}",
                     counted ? "" : "about ", counted ? pages : two_digits(pages),
                     two_digits(size_on_few_pages(surface, printable, pages)), few_pages);
}

}  // namespace ridgecraft::cli
