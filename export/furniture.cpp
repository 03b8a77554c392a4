// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/furniture.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "export/stroke_font.hpp"
#include "export/utf8.hpp"

namespace ridgecraft::paper {
namespace {

constexpr double text_height = 2.0;                   ///< of all but the title, mm
constexpr double title_height = 2.6;                  ///< mm
constexpr double row_gap = 4.0;                       ///< baseline to baseline, mm
constexpr double bar_lengths[] = {50.0, 20.0, 10.0};  ///< the first that fits, mm
/// Distance between neighbours in a row, mm.
constexpr double neighbour_gap = 5.0;

struct LegendItem {
  Layer layer;
  Fold fold;
  std::string_view word;
  std::string_view short_word;
};
constexpr std::array<LegendItem, 4> legend_items{{
    {Layer::cut, Fold::none, "cut", "cut"},
    {Layer::mountain, Fold::mountain, "mountain fold", "mountain"},
    {Layer::valley, Fold::valley, "valley fold", "valley"},
    {Layer::tab_fill, Fold::none, "glue tab", "tab"},
}};

class FurnitureMaker {
 public:
  FurnitureMaker(const Paper& paper, std::string_view title, int page, int page_count)
      : left_(paper.margin),
        right_(paper.size.x - paper.margin),
        bottom_(paper.margin),
        title_(printable_utf8(title)),
        page_(std::to_string(page) + " / " + std::to_string(page_count)) {
    group_.id = "page";
  }

  Group make() {
    const double upper = bottom_ + 1.2 + row_gap;
    if (const double wide = legend_width(true); right_ - left_ >= wide + neighbour_gap + bar_width(50.0)) {
      legend(left_, upper, true);
      bar(right_ - bar_width(50.0), upper, 50.0);
      title_row(bottom_ + 0.7, true);
      rule(upper + 4.2);
    } else {
      three_rows();
    }
    return std::move(group_);
  }

 private:
  [[nodiscard]] double width() const { return right_ - left_; }

  void line(Vec2 a, Vec2 b, Fold fold = Fold::none) {
    group_.lines.push_back({Layer::mark, {a, b}, false, fold});
  }

  /// Text whose lower left corner is given.
  void text(std::string_view words, Vec2 at, double height) {
    const double size = text_width(words, height);
    group_.texts.push_back(
        {Layer::mark, std::string(words), {at.x + 0.5 * size, at.y + 0.5 * height}, height, 0.0, false});
  }

  void rule(double y) { line({left_, y}, {right_, y}); }

  /// Title left, hint in the middle, page number right; the title is shortened to the room that is left.
  void title_row(double y, bool hint) {
    const std::string page_words = "page " + page_;
    double room = width();
    const double page_width = text_width(page_words, text_height);
    if (page_width < 0.5 * room) {
      text(page_words, {right_ - page_width, y}, text_height);
      room -= page_width + neighbour_gap;
    }
    constexpr std::string_view hint_words = "print at 100 %, not fitted to the page";
    const double hint_width = text_width(hint_words, text_height);
    if (hint && hint_width < 0.5 * room) {
      // Under the scale bar's left end on a wide page: what it is about.
      text(hint_words, {right_ - page_width - neighbour_gap - hint_width, y}, text_height);
      room -= hint_width + neighbour_gap;
    }
    title_text(y, room);
  }

  void title_text(double y, double room) {
    std::vector<char32_t> codes = code_points(title_);
    const auto utf8 = [&](std::string_view end) {
      std::string words;
      for (const char32_t code : codes) {
        append_utf8(words, code);
      }
      return words + std::string(end);
    };
    std::string words = utf8("");
    while (!codes.empty() && text_width(words, title_height) > room) {
      codes.pop_back();
      words = utf8("…");
    }
    if (!codes.empty()) {
      text(words, {left_, y}, title_height);
    }
  }

  static double sample_width(bool full, const LegendItem& item) {
    return item.layer == Layer::tab_fill ? 5.0 : full ? 11.0 : 7.5;
  }
  [[nodiscard]] static double legend_width(bool full) {
    double total = -neighbour_gap;
    for (const LegendItem& item : legend_items) {
      total += sample_width(full, item) + 1.5 + text_width(full ? item.word : item.short_word, text_height) +
               (full ? neighbour_gap : 0.6 * neighbour_gap);
    }
    return total;
  }
  void legend(double x, double y, bool full) {
    for (const LegendItem& item : legend_items) {
      const double sample = sample_width(full, item);
      const double middle = y + 0.5 * text_height;
      if (item.layer == Layer::tab_fill) {
        const std::vector<Vec2> tab{{x, middle - 1.2},
                                    {x + sample, middle - 1.2},
                                    {x + sample - 1.4, middle + 1.2},
                                    {x + 1.4, middle + 1.2}};
        group_.areas.push_back({Layer::mark, tab});
        group_.lines.push_back({Layer::mark, tab, true, Fold::none});
      } else {
        line({x, middle}, {x + sample, middle}, item.fold);
      }
      const std::string_view word = full ? item.word : item.short_word;
      text(word, {x + sample + 1.5, y}, text_height);
      x += sample + 1.5 + text_width(word, text_height) + (full ? neighbour_gap : 0.6 * neighbour_gap);
    }
  }

  static std::string bar_word(double size) { return std::to_string(static_cast<int>(size)) + " mm"; }
  static double bar_width(double size) { return size + 1.8 + text_width(bar_word(size), text_height); }
  /// A bar with a tick each ten millimetres, and taller ones at its ends; its length is exact.
  void bar(double x, double y, double size) {
    const double middle = y + 0.5 * text_height;
    line({x, middle}, {x + size, middle});
    for (int i = 0; 10 * i <= static_cast<int>(size); ++i) {
      const double reach = i == 0 || 10 * i == static_cast<int>(size) ? 1.3 : 0.7;
      line({x + 10.0 * i, middle - reach}, {x + 10.0 * i, middle + reach});
    }
    text(bar_word(size), {x + size + 1.8, y}, text_height);
  }

  void three_rows() {
    constexpr double low_row = 0.5;
    constexpr double step = 3.7;
    double upper = bottom_ + low_row + 2.0 * step;
    for (const double size : bar_lengths) {
      if (bar_width(size) <= width()) {
        bar(left_, upper, size);
        for (const std::string_view hint : {"print at 100 %", "100 %"}) {
          const double hint_width = text_width(hint, text_height);
          if (bar_width(size) + neighbour_gap + hint_width <= width()) {
            text(hint, {right_ - hint_width, upper}, text_height);
            break;
          }
        }
        break;
      }
    }
    for (const bool full : {true, false}) {
      if (legend_width(full) <= width()) {
        legend(left_, bottom_ + low_row + step, full);
        break;
      }
    }
    title_row(bottom_ + low_row, false);
  }

  double left_;
  double right_;
  double bottom_;
  std::string title_;
  std::string page_;
  Group group_;
};

}  // namespace

Group furniture(const Paper& paper, std::string_view title, int page, int page_count) {
  return FurnitureMaker(paper, title, page, page_count).make();
}

}  // namespace ridgecraft::paper
