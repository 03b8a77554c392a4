// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/style/stroke_font.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>

#include "base/elementary.hpp"
#include "base/text.hpp"

namespace ridgecraft::export_ {
namespace {

// The shapes of the stroke font: one line of pen movements for each letter.

/// Capitals are 10 units high and begin at x = 0; the baseline is y = 0. A path is a list of
///   M x y               lift the pen and go to
///   L x y               draw a line to
///   A cx cy rx ry a b   draw along an ellipse from angle a to b (degrees, counterclockwise), first a line to
///   its
///                       start if the pen is down
/// Every stroke begins with M or, where the pen is up (at the start and after /), with A.
struct Glyph {
  char32_t code;
  std::string_view path;
};

/// A letter with an accent as its base letter and the accent's own glyph; {code, 0} for any other character.
struct Composed {
  char32_t base;
  char32_t accent;
};

constexpr Glyph glyphs[] = {
    // Ascending by code, for the binary search.
    {U' ', ""},
    {U'!', "M 0.6 10 L 0.6 3.4 / M 0.6 0.2 L 0.6 0"},
    {U'"', "M 0 10 L 0 7 / M 2 10 L 2 7"},
    {U'#', "M 2.6 9.4 L 1.2 0.6 / M 5.8 9.4 L 4.4 0.6 / M 0.4 6.6 L 6.8 6.6 / M 0 3.4 L 6.4 3.4"},
    {U'$', "A 2.8 7 2.6 2 35 270 A 2.8 3 2.8 2 90 -145 / M 2.8 10.4 L 2.8 -0.4"},
    {U'%', "A 1.5 8 1.5 2 0 360 / A 6.3 2 1.5 2 0 360 / M 6.6 10 L 1.2 0"},
    {U'&',
     "M 6.6 0 L 1.9 6.1 A 3.2 7.9 1.8 2.1 215 -35 L 1.4 5 A 2.5 2.6 2.5 2.6 120 300 A 3.4 4.4 3.2 4.4 285 "
     "360"},
    {U'\'', "M 0 10 L 0 7"},
    {U'(', "A 4.6 4.2 4.6 7 130 230"},
    {U')', "A -2.9 4.2 4.6 7 50 -50"},
    {U'*', "M 2 9.8 L 2 5.4 / M 0 8.7 L 4 6.5 / M 0 6.5 L 4 8.7"},
    {U'+', "M 0 4.2 L 5.4 4.2 / M 2.7 6.9 L 2.7 1.5"},
    {U',', "M 0.8 0.5 L 0 -2"},
    {U'-', "M 0 4.2 L 3.2 4.2"},
    {U'.', "A 0.4 0.4 0.4 0.4 0 360"},
    {U'/', "M 0 -1 L 4 10.6"},
    {U'0', "A 3 5 3 5 90 450"},
    {U'1', "M 0 7.6 L 2.7 10 L 2.7 0"},
    {U'2', "A 3 7.05 2.95 2.95 160 -38 L 0 0 L 6 0"},
    {U'3', "A 2.7 7.55 2.55 2.45 155 -90 A 2.7 2.55 3 2.55 90 -155"},
    {U'4', "M 4.5 0 L 4.5 10 L 0 3 L 6.2 3"},
    {U'5', "M 5.3 10 L 1.1 10 L 0.7 5.5 A 2.8 3.2 3.1 3.2 132 -150"},
    {U'6', "A 5.2 3.2 5.2 6.8 97 180 A 3 3.2 3 3.2 180 540"},
    {U'7', "M 0 10 L 6 10 L 2 0"},
    {U'8', "A 3 7.55 2.6 2.45 270 -90 A 3 2.55 3 2.55 90 450"},
    {U'9', "A 0.8 6.8 5.2 6.8 -83 0 A 3 6.8 3 3.2 0 360"},
    {U':', "M 0 5.4 L 0 5.2 / M 0 0.2 L 0 0"},
    {U';', "M 0.8 5.4 L 0.8 5.2 / M 0.8 0.5 L 0 -2"},
    {U'<', "M 5 7.2 L 0 4.2 L 5 1.2"},
    {U'=', "M 0 5.6 L 5.4 5.6 / M 0 2.8 L 5.4 2.8"},
    {U'>', "M 0 7.2 L 5 4.2 L 0 1.2"},
    {U'?', "A 2.4 7.6 2.4 2.4 165 -45 L 2.4 4.2 L 2.4 3.2 / M 2.4 0.2 L 2.4 0"},
    {U'@', "A 4 3.8 1.8 2.2 0 360 / M 5.8 6 L 5.8 2.8 A 7 2.8 1.2 1.4 180 360 L 8.2 4 A 4.1 4 4.1 5 0 300"},
    {U'A', "M 0 0 L 3.4 10 L 6.8 0 / M 1.16 3.4 L 5.64 3.4"},
    {U'B',
     "M 0 5.3 L 0 10 L 3.1 10 A 3.1 7.65 2.35 2.35 90 -90 L 0 5.3 L 0 0 L 3.4 0 A 3.4 2.65 2.65 2.65 -90 90"},
    {U'C', "A 3.8 5 3.8 5 48 312"},
    {U'D', "M 0 0 L 0 10 L 2.6 10 A 2.6 5 3.9 5 90 -90 L 0 0"},
    {U'E', "M 5.3 10 L 0 10 L 0 0 L 5.3 0 / M 0 5.2 L 4.5 5.2"},
    {U'F', "M 5.3 10 L 0 10 L 0 0 / M 0 5.2 L 4.5 5.2"},
    {U'G', "A 3.8 5 3.8 5 48 330 L 7.1 4.6 L 4.1 4.6"},
    {U'H', "M 0 0 L 0 10 / M 6.3 0 L 6.3 10 / M 0 5.2 L 6.3 5.2"},
    {U'I', "M 0 0 L 3 0 / M 0 10 L 3 10 / M 1.5 0 L 1.5 10"},
    {U'J', "M 4.3 10 L 4.3 2.4 A 2.15 2.4 2.15 2.4 0 -165"},
    {U'K', "M 0 0 L 0 10 / M 5.8 10 L 0 4 / M 2.1 6.17 L 6.2 0"},
    {U'L', "M 0 10 L 0 0 L 5.1 0"},
    {U'M', "M 0 0 L 0 10 L 3.8 2.6 L 7.6 10 L 7.6 0"},
    {U'N', "M 0 0 L 0 10 L 6.3 0 L 6.3 10"},
    {U'O', "A 3.9 5 3.9 5 90 450"},
    {U'P', "M 0 0 L 0 10 L 3.2 10 A 3.2 7.3 2.7 2.7 90 -90 L 0 4.6"},
    {U'Q', "A 3.9 5 3.9 5 90 450 / M 4.8 2.4 L 7.6 -0.8"},
    {U'R', "M 0 0 L 0 10 L 3.2 10 A 3.2 7.3 2.7 2.7 90 -90 L 0 4.6 / M 3.1 4.6 L 6.1 0"},
    {U'S', "A 3.1 7.5 2.7 2.5 35 270 A 3.1 2.5 3 2.5 90 -147"},
    {U'T', "M 0 10 L 6.4 10 / M 3.2 10 L 3.2 0"},
    {U'U', "M 0 10 L 0 3.1 A 3.1 3.1 3.1 3.1 180 360 L 6.2 10"},
    {U'V', "M 0 10 L 3.3 0 L 6.6 10"},
    {U'W', "M 0 10 L 2.4 0 L 4.8 9.2 L 7.2 0 L 9.6 10"},
    {U'X', "M 0 10 L 6.2 0 / M 6.2 10 L 0 0"},
    {U'Y', "M 0 10 L 3.2 4.8 L 6.4 10 / M 3.2 4.8 L 3.2 0"},
    {U'Z', "M 0 10 L 6 10 L 0 0 L 6 0"},
    {U'[', "M 1.8 11 L 0 11 L 0 -2.6 L 1.8 -2.6"},
    {U'\\', "M 0 10.6 L 4 -1"},
    {U']', "M 0 11 L 1.8 11 L 1.8 -2.6 L 0 -2.6"},
    {U'^', "M 0 7 L 2.2 10 L 4.4 7"},
    {U'_', "M 0 -1.4 L 5.4 -1.4"},
    {U'`', "M 0 10 L 1.4 8.4"},
    {U'a', "A 2.6 3.4 2.6 3.4 0 360 / M 5.2 6.8 L 5.2 0"},
    {U'b', "M 0 10 L 0 0 / A 2.6 3.4 2.6 3.4 180 540"},
    {U'c', "A 2.7 3.4 2.7 3.4 50 310"},
    {U'd', "A 2.6 3.4 2.6 3.4 0 360 / M 5.2 10 L 5.2 0"},
    {U'e', "M 0 3.5 L 5.3 3.5 A 2.65 3.4 2.65 3.4 0 312"},
    {U'f', "A 3.5 8 2 2 60 180 L 1.5 0 / M 0 6.8 L 3.9 6.8"},
    {U'g', "A 2.6 3.4 2.6 3.4 0 360 / M 5.2 6.8 L 5.2 -0.6 A 2.6 -0.6 2.6 2.4 0 -150"},
    {U'h', "M 0 10 L 0 0 / A 2.4 4.4 2.4 2.4 180 0 L 4.8 0"},
    {U'i', "M 0 6.8 L 0 0 / M 0 9.5 L 0 9.3"},
    {U'j', "M 1.6 6.8 L 1.6 -1 A 0 -1 1.6 2 0 -75 / M 1.6 9.5 L 1.6 9.3"},
    {U'k', "M 0 10 L 0 0 / M 4.4 6.8 L 0 2.6 / M 1.6 4.13 L 4.7 0"},
    {U'l', "M 0 10 L 0 1.6 A 1.6 1.6 1.6 1.6 180 275"},
    {U'm', "M 0 6.8 L 0 0 / A 2 4.7 2 2.1 180 0 L 4 0 / A 6 4.7 2 2.1 180 0 L 8 0"},
    {U'n', "M 0 6.8 L 0 0 / A 2.4 4.4 2.4 2.4 180 0 L 4.8 0"},
    {U'o', "A 2.7 3.4 2.7 3.4 90 450"},
    {U'p', "M 0 6.8 L 0 -3 / A 2.6 3.4 2.6 3.4 180 540"},
    {U'q', "A 2.6 3.4 2.6 3.4 0 360 / M 5.2 6.8 L 5.2 -3"},
    {U'r', "M 0 6.8 L 0 0 / A 2.6 4.2 2.6 2.6 180 65"},
    {U's', "A 2.3 5.1 2 1.7 35 270 A 2.3 1.7 2.2 1.7 90 -147"},
    {U't', "M 1.5 9.2 L 1.5 1.7 A 3.2 1.7 1.7 1.7 180 285 / M 0 6.8 L 3.8 6.8"},
    {U'u', "M 0 6.8 L 0 2.4 A 2.4 2.4 2.4 2.4 180 360 / M 4.8 6.8 L 4.8 0"},
    {U'v', "M 0 6.8 L 2.6 0 L 5.2 6.8"},
    {U'w', "M 0 6.8 L 1.9 0 L 3.8 6.2 L 5.7 0 L 7.6 6.8"},
    {U'x', "M 0 6.8 L 4.8 0 / M 4.8 6.8 L 0 0"},
    {U'y', "M 0 6.8 L 2.6 0 / M 5.2 6.8 L 1.45 -3"},
    {U'z', "M 0 6.8 L 4.8 6.8 L 0 0 L 4.8 0"},
    {U'{', "M 2.4 11 A 2.4 9.6 1.4 1.4 90 180 L 1 5.4 L 0 4.2 L 1 3 L 1 -1.2 A 2.4 -1.2 1.4 1.4 180 270"},
    {U'|', "M 0 11 L 0 -2.6"},
    {U'}', "M 0 11 A 0 9.6 1.4 1.4 90 0 L 1.4 5.4 L 2.4 4.2 L 1.4 3 L 1.4 -1.2 A 0 -1.2 1.4 1.4 0 -90"},
    {U'~', "A 1.4 3.9 1.4 1.1 160 20 A 4.1 4.5 1.4 1.1 200 340"},
    {0xA0, ""},
    {0xA8, "M 0 9.3 L 0 9.1 / M 2.4 9.3 L 2.4 9.1"},
    {0xAF, "M 0 9 L 2.6 9"},
    {0xB0, "A 1.5 8.5 1.5 1.5 0 360"},
    {0xB2, "A 1.5 8.5 1.5 1.5 160 -38 L 0 5 L 3 5"},
    {0xB4, "M 1.4 10 L 0 8.4"},
    {0xB7, "M 0 4.3 L 0 4.1"},
    {0xB8, "M 0.9 0 L 0.9 -0.7 A 0.9 -1.7 1 1 90 -140"},
    {0xC6, "M 0 0 L 4.6 10 L 9 10 / M 4.6 10 L 4.6 0 L 9 0 / M 4.6 5.2 L 8.4 5.2 / M 1.5 3.4 L 4.6 3.4"},
    {0xD7, "M 0 6.4 L 4.4 2 / M 4.4 6.4 L 0 2"},
    {0xD8, "A 3.9 5 3.9 5 90 450 / M 7.2 10.4 L 0.6 -0.4"},
    {0xDF, "M 0 0 L 0 7.6 A 2.4 7.6 2.4 2.4 180 0 L 2.6 5.6 A 2.6 2.8 2.6 2.8 90 -110"},
    {0xE6, "A 2.6 3.4 2.6 3.4 0 360 / M 5.2 3.5 L 9.8 3.5 A 7.5 3.4 2.3 3.4 0 312 / M 5.2 6.8 L 5.2 0"},
    {0xF8, "A 2.7 3.4 2.7 3.4 90 450 / M 5.2 7.4 L 0.2 -0.6"},
    {0x131, "M 0 6.8 L 0 0"},
    {0x2C6, "M 0 8.5 L 1.4 10 L 2.8 8.5"},
    {0x2C7, "M 0 10 L 1.4 8.5 L 2.8 10"},
    {0x2DA, "A 1 9.4 1 1 0 360"},
    {0x2DC, "A 0.7 8.9 0.7 0.6 160 20 A 2.1 9.2 0.7 0.6 200 340"},
    {0x2013, "M 0 4.2 L 5 4.2"},
    {0x2014, "M 0 4.2 L 8 4.2"},
    {0x2018, "M 0.8 10 L 0 7.6"},
    {0x2019, "M 0.8 10 L 0 7.6"},
    {0x2026, "M 0 0.2 L 0 0 / M 2.6 0.2 L 2.6 0 / M 5.2 0.2 L 5.2 0"},
};

struct Accented {
  char32_t code;
  char32_t base;
  char32_t accent;
};

constexpr char32_t grave = U'`', acute = 0xB4, hat = 0x2C6, tilde = 0x2DC, dots = 0xA8, ring = 0x2DA,
                   cedilla = 0xB8, caron = 0x2C7, dotless_i = 0x131;

constexpr Accented accented[] = {
    {0xC0, U'A', grave},     {0xC1, U'A', acute},      {0xC2, U'A', hat},        {0xC3, U'A', tilde},
    {0xC4, U'A', dots},      {0xC5, U'A', ring},       {0xC7, U'C', cedilla},    {0xC8, U'E', grave},
    {0xC9, U'E', acute},     {0xCA, U'E', hat},        {0xCB, U'E', dots},       {0xCC, U'I', grave},
    {0xCD, U'I', acute},     {0xCE, U'I', hat},        {0xCF, U'I', dots},       {0xD1, U'N', tilde},
    {0xD2, U'O', grave},     {0xD3, U'O', acute},      {0xD4, U'O', hat},        {0xD5, U'O', tilde},
    {0xD6, U'O', dots},      {0xD9, U'U', grave},      {0xDA, U'U', acute},      {0xDB, U'U', hat},
    {0xDC, U'U', dots},      {0xDD, U'Y', acute},      {0xE0, U'a', grave},      {0xE1, U'a', acute},
    {0xE2, U'a', hat},       {0xE3, U'a', tilde},      {0xE4, U'a', dots},       {0xE5, U'a', ring},
    {0xE7, U'c', cedilla},   {0xE8, U'e', grave},      {0xE9, U'e', acute},      {0xEA, U'e', hat},
    {0xEB, U'e', dots},      {0xEC, dotless_i, grave}, {0xED, dotless_i, acute}, {0xEE, dotless_i, hat},
    {0xEF, dotless_i, dots}, {0xF1, U'n', tilde},      {0xF2, U'o', grave},      {0xF3, U'o', acute},
    {0xF4, U'o', hat},       {0xF5, U'o', tilde},      {0xF6, U'o', dots},       {0xF9, U'u', grave},
    {0xFA, U'u', acute},     {0xFB, U'u', hat},        {0xFC, U'u', dots},       {0xFD, U'y', acute},
    {0xFF, U'y', dots},      {0x10C, U'C', caron},     {0x10D, U'c', caron},     {0x11A, U'E', caron},
    {0x11B, U'e', caron},    {0x158, U'R', caron},     {0x159, U'r', caron},     {0x160, U'S', caron},
    {0x161, U's', caron},    {0x17D, U'Z', caron},     {0x17E, U'z', caron},
};

/// The path of a character, or a null view. Composed letters are looked up by split_accent first.
std::string_view glyph_path(char32_t code) {
  const auto* const found = std::lower_bound(std::begin(glyphs), std::end(glyphs), code,
                                             [](const Glyph& glyph, char32_t c) { return glyph.code < c; });
  return found != std::end(glyphs) && found->code == code ? found->path : std::string_view();
}

Composed split_accent(char32_t code) {
  const auto* const found =
      std::lower_bound(std::begin(accented), std::end(accented), code,
                       [](const Accented& entry, char32_t c) { return entry.code < c; });
  return found != std::end(accented) && found->code == code ? Composed{found->base, found->accent}
                                                            : Composed{code, 0};
}

constexpr double units_per_height = 10.0;
constexpr double spacing = 2.1;      ///< between two letters, units
constexpr double space_width = 2.2;  ///< of a blank, without the spacing after it
constexpr double arc_step =
    std::numbers::pi / 9.0;              ///< 20 degrees: a chord error of 0.02 mm in a 5 mm letter
constexpr char32_t cached_codes = 0x80;  ///< ASCII; other letters are rare
constexpr double capital_lift = 2.6;     ///< accents stand so much higher on capitals, units

using Strokes = std::vector<std::vector<Vec2>>;

/// Reads a glyph's path into polylines, units.
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

std::vector<std::string> wrapped(std::string_view words, double width, double height, double hanging) {
  std::vector<std::string> rows;
  std::string row;
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(' ', begin), words.size());
    const std::string word(words.substr(begin, end - begin));
    begin = end + 1;
    const std::string longer = row.empty() ? word : row + " " + word;
    if (!row.empty() && text_width(longer, height) > width - (rows.empty() ? 0.0 : hanging)) {
      rows.push_back(row);
      row = word;
    } else {
      row = longer;
    }
  }
  if (!row.empty()) {
    rows.push_back(row);
  }
  return rows;
}

std::string shortened(std::string_view words, double width, double height) {
  if (text_width(words, height) <= width) {
    return std::string(words);
  }
  const std::vector<char32_t> codes = code_points(words);
  const auto first_codes = [&](std::size_t count) {
    std::string first;
    for (const char32_t code : std::span(codes).subspan(0, count)) {
      append_utf8(first, code);
    }
    return first + "…";
  };
  // By halves: the words may be a list of ten thousand names.
  std::size_t fitting = 0;
  for (std::size_t too_many = codes.size(); fitting + 1 < too_many;) {
    const std::size_t middle = std::midpoint(fitting, too_many);
    (text_width(first_codes(middle), height) <= width ? fitting : too_many) = middle;
  }
  return first_codes(fitting);
}

}  // namespace ridgecraft::export_
