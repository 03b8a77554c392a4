// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/jobs/early_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

namespace ridgecraft::cli {
namespace {

/// Shorter folds can't be made by hand; folds of the second length are no trouble, mm.
constexpr double shortest_fold_mm = 3.0;
constexpr double easy_fold_mm = 6.0;
/// Smaller folds aren't drawn by default.
constexpr double drawn_fold = 3.0 * std::numbers::pi / 180.0;
/// What nearly every printer reaches, mm from the sheet's edge.
constexpr double printer_margin_mm = 3.0;
/// Hardly anybody folds smaller models, mm.
constexpr double tiny_mm = 30.0;
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
  return surface.bounds().largest_extent() * std::sqrt(few_pages / paper);
}

std::vector<double> fold_lengths(const prepare::Prepared& prepared) {
  const mesh::Surface& surface = prepared.model.surface;
  const auto& panel = prepared.panels.panel;
  std::vector<double> lengths;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [c, d] = surface.sides(e);
    if (d.valid() && panel[mesh::face_of(c)] != panel[mesh::face_of(d)] &&
        std::abs(surface.fold_angle(e)) >= drawn_fold) {
      lengths.push_back(surface.length(e));
    }
  }
  return lengths;
}

}  // namespace

double expected_pages(const prepare::Prepared& prepared, Vec2 printable) {
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

std::optional<std::string> too_small_warning(const prepare::Prepared& prepared) {
  std::vector<double> lengths = fold_lengths(prepared);
  if (lengths.empty()) {
    return std::nullopt;
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  if (*middle >= shortest_fold_mm) {
    return std::nullopt;
  }
  const double size = prepared.model.surface.bounds().largest_extent() * easy_fold_mm / *middle;
  return fmt::format(
      "half of the folds are shorter than {:.1f} mm, too short for fingers; --size {:.0f}mm makes half of "
      "them "
      "{:g} mm and longer",
      *middle, std::ceil(size), easy_fold_mm);
}

std::optional<std::string> assumed_unit_warning(const SizeArguments& size) {
  const double mm = size.size.largest_extent_mm;
  if (!size.unit_assumed || mm >= tiny_mm) {
    return std::nullopt;
  }
  return fmt::format("{} has no unit, so it means {:g} mm; --size {:g}cm makes a model ten times as large",
                     size.asked, mm, mm);
}

std::optional<std::string> narrow_margin_warning(const paper::Paper& paper) {
  if (paper.margin >= printer_margin_mm) {
    return std::nullopt;
  }
  return fmt::format(
      "most printers don't reach the outer {:g} mm of a sheet: a margin of {:g} mm is for cutting machines",
      printer_margin_mm, paper.margin);
}

}  // namespace ridgecraft::cli
