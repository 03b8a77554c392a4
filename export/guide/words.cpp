// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/words.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "base/elementary.hpp"
#include "base/text.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::export_ {
namespace {

Text words_at(std::string_view words, Vec2 left, double height, Weight weight) {
  Text text;
  text.layer = weight == Weight::bold ? Layer::piece_name : Layer::mark;
  text.text = words;
  text.centre = left + Vec2{0.5 * text_width(words, height), 0.5 * height};
  text.height = height;
  return text;
}

}  // namespace

Text words_from(std::string_view words, Vec2 at, double height, Weight weight) {
  return words_at(words, at, height, weight);
}

Text words_to(std::string_view words, Vec2 at, double height, Weight weight) {
  return words_at(words, at - Vec2{text_width(words, height), 0.0}, height, weight);
}

std::vector<std::string> wrapped(std::string_view words, double width, double height) {
  std::vector<std::string> rows;
  std::string row;
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(' ', begin), words.size());
    const std::string word(words.substr(begin, end - begin));
    begin = end + 1;
    const std::string longer = row.empty() ? word : row + " " + word;
    if (!row.empty() && text_width(longer, height) > width) {
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

namespace {

constexpr double row_share = 1.55;      ///< distance of rows, of the height of the words
constexpr double word_clearance = 1.0;  ///< between words and their line, mm
constexpr Pen leader_pen{0.1, {0x55, 0x55, 0x55}};
constexpr double dot_radius = 0.45;  ///< mm
constexpr int dot_corners = 12;

/// Names of one column.
struct Column {
  std::vector<Callout> callouts;
  bool left = true;
};

bool leaders_cross(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const auto side = [](Vec2 p, Vec2 q, Vec2 r) { return cross(q - p, r - p); };
  return side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
}

/// Heights of rows, lowest first, each as near to what it wants as its neighbours allow (pools of rows that
/// touch keep the middle of what they want).
std::vector<double> spread(const std::vector<double>& wanted, double step, double low, double high) {
  struct Pool {
    double sum = 0.0;  ///< of what the rows want, each less its place in the pool
    std::size_t count = 0;
    [[nodiscard]] double first() const { return sum / static_cast<double>(count); }
  };
  std::vector<Pool> pools;
  for (const double want : wanted) {
    pools.push_back({want, 1});
    while (pools.size() > 1) {
      Pool& below = pools[pools.size() - 2];
      const Pool& above = pools.back();
      const double shift = step * static_cast<double>(below.count);
      if (below.first() + shift <= above.first()) {
        break;
      }
      below.sum += above.sum - shift * static_cast<double>(above.count);
      below.count += above.count;
      pools.pop_back();
    }
  }
  std::vector<double> heights;
  for (const Pool& pool : pools) {
    for (std::size_t i = 0; i < pool.count; ++i) {
      heights.push_back(pool.first() + step * static_cast<double>(i));
    }
  }
  // Rows beyond the ends are pushed back.
  for (std::size_t i = 0; i < heights.size(); ++i) {
    heights[i] = std::max(heights[i], low + step * static_cast<double>(i));
  }
  for (std::size_t i = heights.size(); i-- > 0;) {
    heights[i] = std::min(heights[i], high - step * static_cast<double>(heights.size() - 1 - i));
  }
  return heights;
}

void add_dot(Vec2 at, Group& group) {
  Area dot{Layer::picture, {}, leader_pen.color};
  for (int k = 0; k < dot_corners; ++k) {
    const double angle = 2.0 * 3.14159265358979323846 * k / dot_corners;
    dot.outline.push_back(at + dot_radius * Vec2{elementary::cos(angle), elementary::sin(angle)});
  }
  group.areas.push_back(std::move(dot));
}

void add_column(Column column, const CalloutColumns& columns, Group& group) {
  std::vector<Callout>& callouts = column.callouts;
  std::stable_sort(callouts.begin(), callouts.end(),
                   [](const Callout& a, const Callout& b) { return a.anchor.y < b.anchor.y; });
  std::vector<double> wanted;
  for (const Callout& callout : callouts) {
    wanted.push_back(callout.anchor.y);
  }
  const double half = 0.5 * columns.height;
  const std::vector<double> heights =
      spread(wanted, row_share * columns.height, columns.box.low.y + half, columns.box.high.y - half);
  const double edge = column.left ? columns.left_edge : columns.right_edge;
  const auto end = [&](std::size_t i) {
    return Vec2{edge + (column.left ? word_clearance : -word_clearance), heights[i]};
  };
  // Two lines that cross are shorter when their words change places, so this comes to an end.
  bool changed = true;
  for (std::size_t round = 0; changed && round < callouts.size(); ++round) {
    changed = false;
    for (std::size_t i = 0; i < callouts.size(); ++i) {
      for (std::size_t j = i + 1; j < callouts.size(); ++j) {
        if (leaders_cross(end(i), callouts[i].anchor, end(j), callouts[j].anchor)) {
          std::swap(callouts[i], callouts[j]);
          changed = true;
        }
      }
    }
  }
  for (std::size_t i = 0; i < callouts.size(); ++i) {
    const Vec2 base{edge, heights[i] - half};
    group.texts.push_back(column.left ? words_to(callouts[i].words, base, columns.height, Weight::bold)
                                      : words_from(callouts[i].words, base, columns.height, Weight::bold));
    Line leader{Layer::mark, {end(i), callouts[i].anchor}};
    leader.pen = leader_pen;
    group.lines.push_back(std::move(leader));
    add_dot(callouts[i].anchor, group);
  }
}

}  // namespace

std::size_t add_callouts(const std::vector<Callout>& callouts, const CalloutColumns& columns, Group& group) {
  const double room = columns.box.size().y;
  const auto most = static_cast<std::size_t>(std::max(0.0, std::floor(room / (row_share * columns.height))));
  Column left{{}, true};
  Column right{{}, false};
  const double middle = 0.5 * (columns.left_edge + columns.right_edge);
  std::size_t placed = 0;
  for (const Callout& callout : callouts) {
    Column& nearer = callout.anchor.x < middle ? left : right;
    Column& other = callout.anchor.x < middle ? right : left;
    if (Column& column = nearer.callouts.size() < most ? nearer : other; column.callouts.size() < most) {
      column.callouts.push_back(callout);
      ++placed;
    }
  }
  add_column(std::move(left), columns, group);
  add_column(std::move(right), columns, group);
  return placed;
}

}  // namespace ridgecraft::export_
