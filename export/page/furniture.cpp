// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/furniture.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "export/page/obstacles.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::export_ {
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

// On pages wide enough: the legend and the scale bar stand in one row over the title. All mm, over the
// bottom.
constexpr double wide_bar = 50.0;           ///< the scale bar in that row: the longest of bar_lengths
constexpr double shortest_wide_line = 7.5;  ///< shorter samples of lines would show too few of their dashes
constexpr double title_lift = 0.7;          ///< of the title's foot
constexpr double upper_lift = 1.2;          ///< of the row over it, less a row_gap: the title is a bit taller
constexpr double rule_lift = 4.2;           ///< of the rule, over the upper row's foot: clear of its letters

// On narrow pages: three rows, closer together, without a rule.
constexpr double low_row = 0.5;   ///< foot of the title, mm
constexpr double row_step = 3.7;  ///< baseline to baseline, mm

constexpr double word_gap = 1.5;         ///< between a sample of the legend and its word, mm
constexpr double tab_sample = 5.0;       ///< length of the legend's tab, mm: short, as tabs are
constexpr double half_tab_height = 1.2;  ///< of that tab, mm: about as high as letters
constexpr double tab_slope = 1.4;        ///< by which its sides lean inwards, mm: the usual shape of tabs

constexpr int tick_step = 10;         ///< of the scale bar, mm: a finger's breadth, as on rulers
constexpr double end_tick = 1.3;      ///< how far ticks reach up and down at the bar's ends, mm ...
constexpr double inner_tick = 0.7;    ///< ... and between them, so that the ends are seen
constexpr double bar_word_gap = 1.8;  ///< between the bar and its length in words, mm
/// What the page number and the hint may take of a row, so that most of it is left for the title.
constexpr double most_of_row = 0.5;

struct LegendItem {
  bool LineKinds::*used;
  Layer layer;  ///< mark for lines, whose fold decides how they look
  Fold fold;
  std::string_view word;
  std::string_view short_word;
};
constexpr std::array<LegendItem, 8> legend_items{{
    {&LineKinds::cut, Layer::mark, Fold::none, "cut", "cut"},
    {&LineKinds::mountain, Layer::mark, Fold::mountain, "mountain fold", "mountain"},
    {&LineKinds::valley, Layer::mark, Fold::valley, "valley fold", "valley"},
    {&LineKinds::tab, Layer::tab_fill, Fold::none, "glue tab", "tab"},
    {&LineKinds::flat_tab, Layer::tab_fold, Fold::none, "tab edge, not folded", "no fold"},
    {&LineKinds::glue, Layer::glue, Fold::none, "glue a piece here", "glue here"},
    {&LineKinds::leader, Layer::label, Fold::none, "name or number of the edge", "its number"},
    {&LineKinds::detail, Layer::paint, Fold::none, "only printed", "printed"},
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
  FurnitureMaker(const Paper& paper, const Drawing& page, const LineKinds& used, const LineKinds& anywhere)
      : left_(std::max(paper.margin, side_inset)),
        right_(paper.size.x - left_),
        bottom_(std::max(paper.margin, foot_inset)),
        title_(printable_utf8(page.title)),
        page_("page " + std::to_string(page.page) + " / " + std::to_string(page.page_count)) {
    group_.id = "page";
    items_ = items_of(used);
    items_anywhere_ = items_of(anywhere);
  }

  Group make() {
    const double upper = bottom_ + upper_lift + row_gap;
    const double room = width() - neighbour_gap - bar_width(wide_bar);
    const auto fits = [&](const LegendSize& size) {
      return size.sample >= shortest_wide_line && legend_width(size, items_anywhere_) <= room;
    };
    if (const auto size = std::ranges::find_if(legend_sizes, fits); size != legend_sizes.end()) {
      legend(left_, upper, *size, items_);
      bar(right_ - bar_width(wide_bar), upper, wide_bar);
      title_row(bottom_ + title_lift, true);
      rule(upper + rule_lift);
    } else {
      three_rows();
    }
    return std::move(group_);
  }

  Group make_back() {
    group_.id = "back";
    page_ = "back of " + page_;
    title_row(bottom_ + title_lift, false);
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
    double room = width();
    const double page_width = text_width(page_, text_height);
    if (page_width < most_of_row * room) {
      text(page_, {right_ - page_width, y}, text_height);
      room -= page_width + neighbour_gap;
    }
    constexpr std::string_view hint_words = "print at 100 %, not fitted to the page";
    const double hint_width = text_width(hint_words, text_height);
    if (hint && hint_width < most_of_row * room) {
      // Under the scale bar's left end on a wide page: what it is about.
      text(hint_words, {right_ - page_width - neighbour_gap - hint_width, y}, text_height);
      room -= hint_width + neighbour_gap;
    }
    const std::string words = shortened(title_, room, title_height);
    if (text_width(words, title_height) <= room) {
      text(words, {left_, y}, title_height);
    }
  }

  static double sample_width(const LegendSize& size, const LegendItem& item) {
    return item.layer == Layer::tab_fill ? tab_sample : size.sample;
  }
  static std::string_view word(const LegendSize& size, const LegendItem& item) {
    return size.full ? item.word : item.short_word;
  }
  static double item_width(const LegendSize& size, const LegendItem& item) {
    return sample_width(size, item) + word_gap + text_width(word(size, item), text_height);
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
        const std::vector<Vec2> tab{{x, middle - half_tab_height},
                                    {x + sample, middle - half_tab_height},
                                    {x + sample - tab_slope, middle + half_tab_height},
                                    {x + tab_slope, middle + half_tab_height}};
        group_.areas.push_back({Layer::mark, tab});
        group_.lines.push_back({Layer::mark, tab, true, Fold::none});
      } else if (item.layer == Layer::mark) {
        line({x, middle}, {x + sample, middle}, item.fold);
      } else {
        sample_line({x, middle}, {x + sample, middle}, item.layer);
      }
      text(word(size, item), {x + sample + word_gap, y}, text_height);
      x += item_width(size, item) + size.gap;
    }
  }

  static std::string bar_word(double size) { return std::to_string(static_cast<int>(size)) + " mm"; }
  static double bar_width(double size) {
    return size + bar_word_gap + text_width(bar_word(size), text_height);
  }
  /// A bar with a tick each ten millimetres, and taller ones at its ends; its length is exact.
  void bar(double x, double y, double size) {
    const double middle = y + 0.5 * text_height;
    line({x, middle}, {x + size, middle});
    for (int at = 0; at <= static_cast<int>(size); at += tick_step) {
      const double reach = at == 0 || at == static_cast<int>(size) ? end_tick : inner_tick;
      line({x + at, middle - reach}, {x + at, middle + reach});
    }
    text(bar_word(size), {x + size + bar_word_gap, y}, text_height);
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
    double upper = bottom_ + low_row + 2.0 * row_step;
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
    legend(left_, bottom_ + low_row + row_step, *size, items.first(count));
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
  std::string page_;  ///< "page 1 / 2"
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
      kinds.glue = kinds.glue || line.layer == Layer::glue;
      kinds.leader = kinds.leader || line.layer == Layer::label;
      kinds.detail = kinds.detail || (line.layer == Layer::paint && line.like == Layer::paint);
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

Group furniture(const Paper& paper, const Drawing& page, const LineKinds& used, const LineKinds& anywhere) {
  return FurnitureMaker(paper, page, used, anywhere).make();
}

Group foot_of_back(const Paper& paper, const Drawing& page) {
  return FurnitureMaker(paper, page, {}, {}).make_back();
}

namespace {

/// Where the front of a sheet lies when it is seen from its back.
class Turn {
 public:
  Turn(Vec2 sheet, TurnedOver over)
      : sheet_(sheet), sideways_((over == TurnedOver::long_edge) == (sheet.y >= sheet.x)) {}

  [[nodiscard]] Vec2 operator()(Vec2 p) const {
    return sideways_ ? Vec2{sheet_.x - p.x, p.y} : Vec2{p.x, sheet_.y - p.y};
  }
  [[nodiscard]] Text operator()(Text text) const {
    text.centre = (*this)(text.centre);
    text.angle = upright(sideways_ ? std::numbers::pi - text.angle : -text.angle);
    return text;
  }
  [[nodiscard]] Line operator()(Line line) const {
    std::ranges::transform(line.points, line.points.begin(), *this);
    return line;
  }

 private:
  Vec2 sheet_;
  bool sideways_;  ///< turned over an edge that is upright
};

bool is_word_line(const Line& line) {
  return line.layer == Layer::label || line.layer == Layer::shadow ||
         (line.layer == Layer::mark && line.like == Layer::label);
}

bool on_a_tab(const PieceDrawing& piece, Vec2 p) {
  return std::ranges::any_of(piece.seams, [&](const Seam& seam) {
    for (std::size_t i = 0; i < seam.tab.size(); ++i) {
      const Vec2 a = seam.tab[i];
      if (cross(seam.tab[(i + 1) % seam.tab.size()] - a, p - a) < 0.0) {
        return false;
      }
    }
    return !seam.tab.empty();
  });
}

template <class Items, class Taken>
void move_if(Items& from, Items& to, const Turn& turn, Taken taken) {
  const auto rest =
      std::stable_partition(from.begin(), from.end(), [&](const auto& item) { return !taken(item); });
  std::transform(rest, from.end(), std::back_inserter(to), [&](const auto& item) { return turn(item); });
  from.erase(rest, from.end());
}

}  // namespace

std::vector<Group> take_to_back(std::vector<PieceDrawing>& pieces, Vec2 sheet, TurnedOver turned_over) {
  const Turn turn(sheet, turned_over);
  std::vector<Group> backs;
  for (PieceDrawing& piece : pieces) {
    Group back;
    back.id = "back-" + piece.group.id;
    move_if(piece.group.lines, back.lines, turn, is_word_line);
    move_if(piece.group.texts, back.texts, turn,
            [&](const Text& text) { return !on_a_tab(piece, text.centre); });
    if (!back.lines.empty() || !back.texts.empty()) {
      backs.push_back(std::move(back));
    }
  }
  return backs;
}

}  // namespace ridgecraft::export_
