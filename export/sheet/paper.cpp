// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/sheet/paper.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/text.hpp"

namespace ridgecraft::export_ {
namespace {

constexpr double mm_per_inch = 25.4;

struct NamedSize {
  std::string_view name;
  double width;   ///< mm, upright
  double height;  ///< mm
};

/// ISO 216, JIS P 0138 (its B series is not ISO's), ANSI in exact inches, the mats of hobby cutters.
constexpr std::array named_sizes{
    NamedSize{"A0", 841, 1189},
    NamedSize{"A1", 594, 841},
    NamedSize{"A2", 420, 594},
    NamedSize{"A3", 297, 420},
    NamedSize{"A4", 210, 297},
    NamedSize{"A5", 148, 210},
    NamedSize{"A6", 105, 148},
    NamedSize{"A7", 74, 105},
    NamedSize{"B0", 1000, 1414},
    NamedSize{"B1", 707, 1000},
    NamedSize{"B2", 500, 707},
    NamedSize{"B3", 353, 500},
    NamedSize{"B4", 250, 353},
    NamedSize{"B5", 176, 250},
    NamedSize{"B6", 125, 176},
    NamedSize{"JIS-B4", 257, 364},
    NamedSize{"JIS-B5", 182, 257},
    NamedSize{"Letter", 8.5 * mm_per_inch, 11 * mm_per_inch},
    NamedSize{"Legal", 8.5 * mm_per_inch, 14 * mm_per_inch},
    NamedSize{"Tabloid", 11 * mm_per_inch, 17 * mm_per_inch},
    NamedSize{"Mat-8x12", 8 * mm_per_inch, 12 * mm_per_inch},
    NamedSize{"Mat-8.5x12", 8.5 * mm_per_inch, 12 * mm_per_inch},
    NamedSize{"Mat-12x12", 12 * mm_per_inch, 12 * mm_per_inch},
    NamedSize{"Mat-12x24", 12 * mm_per_inch, 24 * mm_per_inch},
    NamedSize{"Mat-15x15", 15 * mm_per_inch, 15 * mm_per_inch},
    NamedSize{"Mat-24x24", 24 * mm_per_inch, 24 * mm_per_inch},
};

/// Sides of a sheet beyond these are slips of the pen: a visiting card, and a roll for the widest plotters.
constexpr double smallest_side_mm = 40.0;
constexpr double largest_side_mm = 20000.0;
/// Nothing that can be folded fits a smaller rectangle.
constexpr double smallest_piece_area_mm = 20.0;
char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::string lowered(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), lower);
  return result;
}

/// "210x297mm": width, x (or the multiplication sign), height; a unit on the second number holds for both.
std::optional<Vec2> parse_numbers(std::string_view text) {
  const auto width = take_length(text);
  if (!width) {
    return std::nullopt;
  }
  constexpr std::string_view times = "\xC3\x97";
  if (text.starts_with("x") || text.starts_with("*")) {
    text.remove_prefix(1);
  } else if (text.starts_with(times)) {
    text.remove_prefix(times.size());
  } else {
    return std::nullopt;
  }
  const auto height = take_length(text);
  if (!height || !text.empty()) {
    return std::nullopt;
  }
  const double of_height = height->mm_per_unit.value_or(width->mm_per_unit.value_or(1.0));
  const double of_width = width->mm_per_unit.value_or(of_height);
  return Vec2{width->number * of_width, height->number * of_height};
}

std::string as_text(double value) {
  return fmt::format("{}", value);
}

void check_side(std::string_view text, double side) {
  if (!(side > 0.0) || !std::isfinite(side)) {
    throw Error(ErrorKind::usage,
                Message("paper_side", {{"text", std::string(text)}, {"mm", as_text(side)}}));
  }
  if (side < smallest_side_mm) {
    throw Error(ErrorKind::usage, Message("paper_small", {{"text", std::string(text)},
                                                          {"mm", as_text(side)},
                                                          {"least", as_text(smallest_side_mm)}}));
  }
  if (side > largest_side_mm) {
    throw Error(ErrorKind::usage, Message("paper_large", {{"text", std::string(text)},
                                                          {"m", as_text(side / 1000.0)},
                                                          {"most", as_text(largest_side_mm / 1000.0)}}));
  }
}

[[noreturn]] void refuse_name(std::string_view text, std::string_view name) {
  // 'a44' is a slip for A4; 'A9' is no slip for A0, but another size.
  const std::string nearest = nearest_word(name, paper_names());
  const bool other_number = name.size() <= 3 && nearest.size() == name.size();
  if (!nearest.empty() && !other_number) {
    throw Error(ErrorKind::usage,
                Message("paper_nearest", {{"text", std::string(text)}, {"nearest", nearest}}));
  }
  throw Error(ErrorKind::usage, Message("paper_unknown", {{"text", std::string(text)}}));
}

}  // namespace

Paper parse_paper(std::string_view text) {
  std::string name = lowered(trimmed(text));
  std::replace(name.begin(), name.end(), '_', '-');
  std::optional<bool> landscape;
  for (const auto& [suffix, wide] :
       {std::pair<std::string_view, bool>{"landscape", true}, {"portrait", false}}) {
    if (name.size() > suffix.size() + 1 && name.ends_with(suffix) &&
        (name[name.size() - suffix.size() - 1] == '-' || name[name.size() - suffix.size() - 1] == ' ')) {
      name.resize(name.size() - suffix.size() - 1);
      landscape = wide;
    }
  }
  Paper paper;
  const auto named = std::find_if(named_sizes.begin(), named_sizes.end(),
                                  [&](const NamedSize& size) { return lowered(size.name) == name; });
  if (named != named_sizes.end()) {
    paper.size = {named->width, named->height};
  } else if (const auto numbers = parse_numbers(name)) {
    paper.size = *numbers;
    check_side(text, paper.size.x);
    check_side(text, paper.size.y);
  } else {
    refuse_name(text, name);
  }
  if (landscape && *landscape != (paper.size.x > paper.size.y)) {
    std::swap(paper.size.x, paper.size.y);
  }
  return paper;
}

std::vector<std::string> paper_names() {
  std::vector<std::string> names;
  for (const NamedSize& size : named_sizes) {
    names.emplace_back(size.name);
  }
  return names;
}

void check_paper(const Paper& paper) {
  if (!(paper.margin >= 0.0) || !std::isfinite(paper.margin)) {
    throw Error(ErrorKind::usage, Message("paper_margin", {{"mm", as_text(paper.margin)}}));
  }
  if (!(paper.gap >= 0.0) || !std::isfinite(paper.gap)) {
    throw Error(ErrorKind::usage, Message("paper_gap", {{"mm", as_text(paper.gap)}}));
  }
  const Vec2 area = piece_area(paper);
  if (!(std::min(area.x, area.y) >= smallest_piece_area_mm) || !std::isfinite(area.x) ||
      !std::isfinite(area.y)) {
    throw Error(ErrorKind::usage, Message("paper_full", {{"width", fmt::format("{:.4g}", paper.size.x)},
                                                         {"height", fmt::format("{:.4g}", paper.size.y)},
                                                         {"margin", fmt::format("{:.4g}", paper.margin)}}));
  }
}

Box2 piece_box(const Paper& paper) {
  Box2 box;
  box.low = {paper.margin, paper.margin + paper.foot};
  box.high = {paper.size.x - paper.margin, paper.size.y - paper.margin - paper.head};
  return box;
}

Vec2 piece_area(const Paper& paper) {
  // Not Box2::size(), which is zero for a box turned inside out: check_paper wants to see that.
  const Box2 box = piece_box(paper);
  return box.high - box.low;
}

}  // namespace ridgecraft::export_
