// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/furniture.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/utf8.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::paper {
namespace {

constexpr double text_height = 2.0;                   ///< of all but the title, mm
constexpr double title_height = 2.6;                  ///< mm
constexpr double row_gap = 4.0;                       ///< baseline to baseline, mm
constexpr double bar_lengths[] = {50.0, 20.0, 10.0};  ///< the first that fits, mm
/// Distance between neighbours in a row, mm.
constexpr double neighbour_gap = 5.0;

/// What furniture keeps from the sheet's edge where the margin is smaller: a pen and the tails of letters,
/// mm.
constexpr double side_inset = 2.0;
constexpr double foot_inset = 1.5;

struct LegendItem {
  bool LineKinds::*used;
  Layer layer;  ///< mark for lines, whose fold decides how they look
  Fold fold;
  std::string_view word;
  std::string_view short_word;
};
constexpr std::array<LegendItem, 6> legend_items{{
    {&LineKinds::cut, Layer::mark, Fold::none, "cut", "cut"},
    {&LineKinds::mountain, Layer::mark, Fold::mountain, "mountain fold", "mountain"},
    {&LineKinds::valley, Layer::mark, Fold::valley, "valley fold", "valley"},
    {&LineKinds::tab, Layer::tab_fill, Fold::none, "glue tab", "tab"},
    {&LineKinds::flat_tab, Layer::tab_fold, Fold::none, "tab edge, not folded", "no fold"},
    {&LineKinds::leader, Layer::label, Fold::none, "name or number of the edge", "its number"},
}};

/// How much room a legend takes: the first that fits is chosen.
struct LegendSize {
  bool full;      ///< words
  double sample;  ///< length of a sample line, mm
  double gap;     ///< between items, mm
};
constexpr std::array<LegendSize, 4> legend_sizes{
    {{true, 11.0, 5.0}, {true, 9.0, 3.2}, {false, 7.5, 3.0}, {false, 5.5, 2.4}}};

class FurnitureMaker {
 public:
  FurnitureMaker(const Paper& paper, std::string_view title, int page, int page_count, const LineKinds& used,
                 const LineKinds& anywhere)
      : left_(std::max(paper.margin, side_inset)),
        right_(paper.size.x - left_),
        bottom_(std::max(paper.margin, foot_inset)),
        title_(printable_utf8(title)),
        page_(std::to_string(page) + " / " + std::to_string(page_count)) {
    group_.id = "page";
    items_ = items_of(used);
    items_anywhere_ = items_of(anywhere);
  }

  Group make() {
    const double upper = bottom_ + 1.2 + row_gap;
    const double room = width() - neighbour_gap - bar_width(50.0);
    const auto fits = [&](const LegendSize& size) {
      return size.sample >= 7.5 && legend_width(size, items_anywhere_) <= room;
    };
    if (const auto size = std::ranges::find_if(legend_sizes, fits); size != legend_sizes.end()) {
      legend(left_, upper, *size, items_);
      bar(right_ - bar_width(50.0), upper, 50.0);
      title_row(bottom_ + 0.7, true);
      rule(upper + 4.2);
    } else {
      three_rows();
    }
    return std::move(group_);
  }

 private:
  static std::vector<LegendItem> items_of(const LineKinds& kinds) {
    std::vector<LegendItem> items;
    std::ranges::copy_if(legend_items, std::back_inserter(items),
                         [&](const LegendItem& item) { return kinds.*item.used; });
    return items;
  }

  [[nodiscard]] double width() const { return right_ - left_; }

  void line(Vec2 a, Vec2 b, Fold fold = Fold::none) {
    group_.lines.push_back({Layer::mark, {a, b}, false, fold});
  }
  /// A sample of a class of line that looks like none of the marks: drawn as one of its own layer would be,
  /// but as page furniture.
  void sample_line(Vec2 a, Vec2 b, Layer like) {
    Line sample{Layer::mark, {a, b}, false, Fold::none};
    sample.like = like;
    group_.lines.push_back(std::move(sample));
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

  static double sample_width(const LegendSize& size, const LegendItem& item) {
    return item.layer == Layer::tab_fill ? 5.0 : size.sample;
  }
  static std::string_view word(const LegendSize& size, const LegendItem& item) {
    return size.full ? item.word : item.short_word;
  }
  static double item_width(const LegendSize& size, const LegendItem& item) {
    return sample_width(size, item) + 1.5 + text_width(word(size, item), text_height);
  }
  static double legend_width(const LegendSize& size, const std::vector<LegendItem>& items) {
    double total = -size.gap;
    for (const LegendItem& item : items) {
      total += item_width(size, item) + size.gap;
    }
    return total;
  }
  void legend(double x, double y, const LegendSize& size, std::span<const LegendItem> items) {
    const double middle = y + 0.5 * text_height;
    for (const LegendItem& item : items) {
      const double sample = sample_width(size, item);
      if (item.layer == Layer::tab_fill) {
        const std::vector<Vec2> tab{{x, middle - 1.2},
                                    {x + sample, middle - 1.2},
                                    {x + sample - 1.4, middle + 1.2},
                                    {x + 1.4, middle + 1.2}};
        group_.areas.push_back({Layer::mark, tab});
        group_.lines.push_back({Layer::mark, tab, true, Fold::none});
      } else if (item.layer == Layer::mark) {
        line({x, middle}, {x + sample, middle}, item.fold);
      } else {
        sample_line({x, middle}, {x + sample, middle}, item.layer);
      }
      text(word(size, item), {x + sample + 1.5, y}, text_height);
      x += item_width(size, item) + size.gap;
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

  /// The longest bar that fits; where the room behind it begins.
  double bar_row(double y) {
    for (const double size : bar_lengths) {
      if (bar_width(size) <= width()) {
        bar(left_, y, size);
        return left_ + bar_width(size) + neighbour_gap;
      }
    }
    return left_;
  }

  void hint(double y, double free_from) {
    for (const std::string_view words : {"print at 100 %", "100 %"}) {
      const double size = text_width(words, text_height);
      if (free_from + size <= right_) {
        text(words, {right_ - size, y}, text_height);
        return;
      }
    }
  }

  void three_rows() {
    constexpr double low_row = 0.5;
    constexpr double step = 3.7;
    double upper = bottom_ + low_row + 2.0 * step;
    const LegendSize* size = std::ranges::find_if(
        legend_sizes, [&](const LegendSize& s) { return legend_width(s, items_anywhere_) <= width(); });
    const bool whole = size != legend_sizes.end();
    size = whole ? size : &legend_sizes.back();
    std::size_t count = items_.size();
    double used = legend_width(*size, items_);
    while (used > width() && count > 0) {
      used -= item_width(*size, items_[--count]) + size->gap;
    }
    const std::span<const LegendItem> items(items_);
    legend(left_, bottom_ + low_row + step, *size, items.first(count));
    double free_from = bar_row(upper);
    // What the legend's row has no room for stands behind the bar.
    for (; count < items_.size() && free_from + item_width(*size, items_[count]) <= right_; ++count) {
      legend(free_from, upper, *size, items.subspan(count, 1));
      free_from += item_width(*size, items_[count]) + size->gap;
    }
    hint(upper, free_from);
    title_row(bottom_ + low_row, false);
  }

  std::vector<LegendItem> items_;           ///< those used on the page
  std::vector<LegendItem> items_anywhere_;  ///< those used on any page
  double left_;
  double right_;
  double bottom_;
  std::string title_;
  std::string page_;
  Group group_;
};

}  // namespace

LineKinds line_kinds(const std::vector<Group>& groups) {
  LineKinds kinds;
  for (const Group& group : groups) {
    kinds.tab = kinds.tab || !group.areas.empty();
    for (const Line& line : group.lines) {
      kinds.cut = kinds.cut || line.layer == Layer::cut;
      kinds.mountain = kinds.mountain || line.fold == Fold::mountain;
      kinds.valley = kinds.valley || line.fold == Fold::valley;
      kinds.flat_tab = kinds.flat_tab || (line.layer == Layer::tab_fold && line.fold == Fold::none);
      kinds.leader = kinds.leader || line.layer == Layer::label;
    }
  }
  return kinds;
}

LineKinds operator|(LineKinds a, const LineKinds& b) {
  for (const LegendItem& item : legend_items) {
    a.*item.used = a.*item.used || b.*item.used;
  }
  return a;
}

Group furniture(const Paper& paper, std::string_view title, int page, int page_count, const LineKinds& used,
                const LineKinds& anywhere) {
  return FurnitureMaker(paper, title, page, page_count, used, anywhere).make();
}

}  // namespace ridgecraft::paper
