// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/style/stroke_font.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <string>

#include "base/elementary.hpp"
#include "base/text.hpp"
#include "export/style/glyph_table.hpp"

namespace ridgecraft::export_ {
namespace {

constexpr double units_per_height = 10.0;
constexpr double spacing = 2.1;      ///< between two letters, units
constexpr double space_width = 2.2;  ///< of a blank, without the spacing after it
constexpr double arc_step =
    std::numbers::pi / 9.0;              ///< 20 degrees: a chord error of 0.02 mm in a 5 mm letter
constexpr char32_t cached_codes = 0x80;  ///< ASCII; other letters are rare
constexpr double capital_lift = 2.6;     ///< accents stand so much higher on capitals, units

using Strokes = std::vector<std::vector<Vec2>>;

/// Reads a glyph's path (glyph_table.hpp) into polylines, units.
class PathReader {
 public:
  explicit PathReader(std::string_view path) : text_(path) {}

  Strokes read() {
    while (const char command = next_command()) {
      switch (command) {
        case 'M':
          strokes_.push_back({point()});
          break;
        case 'L':
          strokes_.back().push_back(point());
          break;
        case 'A':
          arc();
          break;
        default:
          pen_up_ = true;
          continue;
      }
      pen_up_ = false;
    }
    return std::move(strokes_);
  }

 private:
  char next_command() {
    while (!text_.empty() && text_.front() == ' ') {
      text_.remove_prefix(1);
    }
    if (text_.empty()) {
      return 0;
    }
    const char command = text_.front();
    text_.remove_prefix(1);
    return command;
  }
  /// Numbers of the table are plain decimals: no locale, no exponent.
  double number() {
    while (!text_.empty() && text_.front() == ' ') {
      text_.remove_prefix(1);
    }
    const bool negative = text_.starts_with('-');
    double value = 0.0;
    double unit = 0.0;
    std::size_t at = negative ? 1 : 0;
    for (; at < text_.size() && text_[at] != ' '; ++at) {
      if (text_[at] == '.') {
        unit = 1.0;
      } else {
        value = 10.0 * value + (text_[at] - '0');
        unit *= 10.0;
      }
    }
    text_.remove_prefix(at);
    value = unit > 1.0 ? value / unit : value;
    return negative ? -value : value;
  }
  Vec2 point() {
    const double x = number();
    return {x, number()};
  }
  void arc() {
    const Vec2 centre = point();
    const Vec2 radius = point();
    const double from = number() * std::numbers::pi / 180.0;
    const double to = number() * std::numbers::pi / 180.0;
    if (pen_up_) {
      strokes_.emplace_back();
    }
    const int steps = std::max(2, static_cast<int>(std::ceil(std::abs(to - from) / arc_step)));
    for (int i = 0; i <= steps; ++i) {
      const double angle = from + (to - from) * i / steps;
      const Vec2 p{centre.x + radius.x * elementary::cos(angle),
                   centre.y + radius.y * elementary::sin(angle)};
      if (strokes_.back().empty() || length(p - strokes_.back().back()) > 1e-6) {
        strokes_.back().push_back(p);
      }
    }
  }

  std::string_view text_;
  Strokes strokes_;
  bool pen_up_ = true;
};

/// Moves strokes so that they begin at x = 0; gives their width.
double justify(Strokes& strokes) {
  Box2 box;
  for (const auto& stroke : strokes) {
    for (const Vec2 p : stroke) {
      box.add(p);
    }
  }
  for (auto& stroke : strokes) {
    for (Vec2& p : stroke) {
      p.x -= box.low.x;
    }
  }
  return box.size().x;
}

struct Shape {
  Strokes strokes;
  double width = 0.0;  ///< units
};

bool known(char32_t code) {
  const auto look_up = [](char32_t c) { return glyph_path(split_accent(c).base).data() != nullptr; };
  static const auto common = [&] {
    std::array<bool, cached_codes> all{};
    for (char32_t c = 0; c < cached_codes; ++c) {
      all[c] = look_up(c);
    }
    return all;
  }();
  return code < cached_codes ? common[code] : look_up(code);
}

Shape make_shape(char32_t code) {
  const Composed parts = split_accent(code);
  Shape letter{PathReader(glyph_path(parts.base)).read(), 0.0};
  if (letter.strokes.empty()) {
    letter.width = space_width;
    return letter;
  }
  letter.width = justify(letter.strokes);
  if (parts.accent != 0) {
    Strokes accent = PathReader(glyph_path(parts.accent)).read();
    const double width = justify(accent);
    const bool capital = parts.base < U'a';
    const bool below = parts.accent == 0xB8;
    const Vec2 shift{(letter.width - width) / 2.0, capital && !below ? capital_lift : 0.0};
    for (auto& stroke : accent) {
      for (Vec2& p : stroke) {
        p += shift;
      }
      letter.strokes.push_back(std::move(stroke));
    }
  }
  return letter;
}

/// The letters of ASCII, each read once.
const Shape& common_shape(char32_t code) {
  static const std::vector<Shape> shapes = [] {
    std::vector<Shape> all;
    for (char32_t c = 0; c < cached_codes; ++c) {
      all.push_back(known(c) ? make_shape(c) : Shape{});
    }
    return all;
  }();
  return shapes[code];
}

Shape shape(char32_t code) {
  return code < cached_codes ? common_shape(code) : make_shape(code);
}

double shape_width(char32_t code) {
  return code < cached_codes ? common_shape(code).width : make_shape(code).width;
}

/// Width of a character of an unknown font, as a share of the em.
double estimated_em(char32_t code) {
  const bool combining =
      (code >= 0x300 && code < 0x370) || (code >= 0xFE00 && code < 0xFE10) || code == 0x200D;
  if (combining) {
    return 0.0;
  }
  return code >= 0x1100 ? 1.05 : 0.68;
}

/// Width of a text of known letters of ASCII alone; none of another one.
std::optional<double> units_of_common(std::string_view text) {
  double units = text.empty() ? 0.0 : -spacing;
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    if (code >= cached_codes || !known(code)) {
      return std::nullopt;
    }
    units += common_shape(code).width + spacing;
  }
  return units;
}

}  // namespace

double pen_width(const Text& text) {
  return text.height * (text.layer == Layer::piece_name ? 0.14 : 0.105);
}

bool stroke_font_covers(std::string_view utf8) {
  return std::ranges::all_of(code_points(utf8), known);
}

double text_width(std::string_view utf8, double height) {
  // Numbers and names, which are measured wherever they might stand.
  if (const auto units = units_of_common(utf8)) {
    return *units * height / units_per_height;
  }
  const std::vector<char32_t> codes = code_points(utf8);
  if (!std::ranges::all_of(codes, known)) {
    double ems = 0.0;
    for (const char32_t code : codes) {
      ems += estimated_em(code);
    }
    return ems * height * font_size_per_height;
  }
  double units = codes.empty() ? 0.0 : -spacing;
  for (const char32_t code : codes) {
    units += shape_width(code) + spacing;
  }
  return units * height / units_per_height;
}

std::vector<std::vector<Vec2>> text_strokes(const Text& text) {
  const std::vector<char32_t> codes = code_points(text.text);
  Strokes result;
  if (!std::ranges::all_of(codes, known)) {
    return result;
  }
  const double scale = text.height / units_per_height;
  const double width = text_width(text.text, text.height);
  const Vec2 along{elementary::cos(text.angle), elementary::sin(text.angle)};
  const Vec2 up = perpendicular(along);
  const Vec2 start = text.centre - 0.5 * width * along - 0.5 * text.height * up;
  double x = 0.0;
  for (const char32_t code : codes) {
    const Shape letter = shape(code);
    for (const auto& stroke : letter.strokes) {
      std::vector<Vec2>& placed = result.emplace_back();
      for (const Vec2 p : stroke) {
        placed.push_back(start + scale * ((x + p.x) * along + p.y * up));
      }
    }
    x += letter.width + spacing;
  }
  if (text.underlined) {
    const Vec2 drop = -underline_drop * text.height * up;
    result.push_back({start + drop, start + drop + width * along});
  }
  return result;
}

}  // namespace ridgecraft::export_
