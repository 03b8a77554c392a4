// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/remark.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "prepare/prepare.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::job {
namespace {

/// Shorter folds can't be made by hand; folds of the second length are no trouble, mm.
constexpr double shortest_fold_mm = 3.0;
constexpr double easy_fold_mm = 6.0;
/// From here on a user is warned.
constexpr double warned_pages = 100.0;
/// From here on that is certain before the model is brought to its size, which takes a while then.
constexpr double certain_pages = 1000.0;
/// Tiny bodies come about so many to a page, counting those with lists of names and numbers (59, 70 and 77
/// with 1000, 3000 and 10,000 tetrahedra).
constexpr double bodies_on_page = 80.0;
/// As many pages as a maker finishes.
constexpr double few_pages = 10.0;
/// A model of this extent and area, in mm. Paper grows with the square of the size. A model on few pages has
/// hardly a flat region that takes one for itself, so those of this size don't count more than their area.
std::optional<ManyPages> many_pages(double extent, double area, Vec2 printable, double pages, bool counted) {
  if (pages < warned_pages) {
    return std::nullopt;
  }
  const double paper = std::max(pages, prepare::pages_filled(area, printable));
  return ManyPages{pages, counted, extent, few_pages, extent * std::sqrt(few_pages / paper)};
}

std::vector<double> fold_lengths(const prepare::Prepared& prepared, double hidden_fold_angle) {
  const mesh::Surface& surface = prepared.model.surface;
  const auto& panel = prepared.panels.panel;
  std::vector<double> lengths;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [c, d] = surface.sides(e);
    if (d.valid() && panel[mesh::face_of(c)] != panel[mesh::face_of(d)] &&
        std::abs(surface.fold_angle(e)) >= hidden_fold_angle && !prepared.rolls.bends(e)) {
      lengths.push_back(surface.length(e));
    }
  }
  return lengths;
}

}  // namespace

std::optional<ManyPages> many_pages(const mesh::Surface& surface, Vec2 printable, double pages,
                                    bool counted) {
  return many_pages(surface.bounds().largest_extent(), mesh::total_area(surface), printable, pages, counted);
}

std::optional<ManyPages> many_pages(const mesh::Model& model, const prepare::SizeOptions& size,
                                    Vec2 printable) {
  const double extent = model.surface.bounds().largest_extent();
  if (size.adapts || !(extent > 0.0)) {
    return std::nullopt;
  }
  const double factor =
      size.mm_per_unit ? *size.mm_per_unit * model.file_scale : size.largest_extent_mm / extent;
  const double area = factor * factor * mesh::total_area(model.surface);
  const double pages = prepare::pages_filled(area, printable);
  // What is larger than paper models can be is refused when it is brought to its size.
  if (pages < certain_pages || factor * extent > prepare::largest_size_mm) {
    return std::nullopt;
  }
  return many_pages(factor * extent, area, printable, pages, false);
}

std::optional<ManyBodies> many_bodies(const mesh::Surface& surface) {
  const ManyBodies many{surface.component_count(),
                        static_cast<double>(surface.component_count()) / bodies_on_page};
  return many.pages < warned_pages ? std::nullopt : std::optional(many);
}

std::optional<ShortFolds> short_folds(const prepare::Prepared& prepared, double hidden_fold_angle) {
  std::vector<double> lengths = fold_lengths(prepared, hidden_fold_angle);
  if (lengths.empty()) {
    return std::nullopt;
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  if (*middle >= shortest_fold_mm) {
    return std::nullopt;
  }
  return ShortFolds{*middle, easy_fold_mm,
                    prepared.model.surface.bounds().largest_extent() * easy_fold_mm / *middle};
}

std::optional<Message> verdict(const prepare::Prepared& prepared, const std::vector<Remedy>& remedies) {
  std::vector<Message> ways;
  for (const Remedy& remedy : remedies) {
    const char* const code = remedy.kind == RemedyKind::size    ? "other_size"
                             : remedy.kind == RemedyKind::faces ? "fewer_faces"
                                                                : "without_name";
    ways.push_back(Message(code, {{"value", remedy.value}, {"hours", fmt::format("{:.1f}", remedy.hours)}}));
  }
  if (prepare::can_be_folded(prepared)) {
    return ways.empty() ? std::nullopt : std::optional(Message("no_evening", {{"ways", std::move(ways)}}));
  }
  std::vector<Message> reasons;
  const auto add_reason = [&](const char* code, double share, double mm) {
    reasons.push_back(
        Message(code, {{"percent", fmt::format("{:.0f}", 100.0 * share)}, {"mm", fmt::format("{:g}", mm)}}));
  };
  if (prepare::is_too_fine(prepared)) {
    add_reason("short_folds_share", prepared.work.short_share(), prepare::tweezers_mm);
  }
  if (prepare::has_many_slivers(prepared)) {
    add_reason("narrow_faces_share", prepared.sliver_fraction, prepare::sliver_mm);
  }
  Message help =
      ways.empty() ? Message("nothing_helps") : Message("options_help", {{"ways", std::move(ways)}});
  const double extent = prepared.model.surface.bounds().largest_extent();
  return Message("unbuildable", {{"mm", fmt::format("{:.4g}", extent)},
                                 {"reasons", std::move(reasons)},
                                 {"help", std::vector{std::move(help)}}});
}

}  // namespace ridgecraft::job
