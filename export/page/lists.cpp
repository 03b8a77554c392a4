// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/lists.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "export/page/lines.hpp"
#include "export/page/obstacles.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::export_ {
namespace {

constexpr double text_height_mm = 1.9;
constexpr double row_height_mm = 3.1;  ///< baseline to baseline
/// Of rows after the first one of an entry.
constexpr double indent_mm = 2.4;
/// Narrower or lower paper holds no list, mm.
constexpr double least_width = 40.0;
constexpr double least_height = 20.0;

constexpr std::string_view closing_words = "an edge without a number is glued to the one beside it";
constexpr std::string_view brief_heading = "where the other edges are";

std::string text_of(const ListRow& row) {
  const std::string words = fmt::format("{}", fmt::join(row.words, "; "));
  return row.of.empty() ? words : row.of + ": " + words;
}

/// Rows of a page's lists.
struct PageLists {
  std::vector<ListRow> unmarked;   ///< numbers that stand nowhere on their pieces
  std::vector<ListRow> partners;   ///< where the other edges are
  std::vector<std::string> kinds;  ///< which pieces are alike
};

/// All that is drawn on a page, and where its pieces are. Keeps a reference to these.
class FreeSpace {
 public:
  FreeSpace(const Paper& paper, const std::vector<PieceDrawing>& pieces)
      : area_(piece_box(paper)), obstacles_(paper.size), pieces_(pieces) {
    for (const PieceDrawing& piece : pieces) {
      for (const Line& line : piece.group.lines) {
        for (const Segment2& segment : segments_of(line)) {
          obstacles_.add(segment, Obstacles::Kind::cut);
        }
      }
      add(piece.group.texts);
    }
  }

  /// The paragraphs in one column, at the lowest place that has room for it in one of some widths, the
  /// leftmost of those. Empty where there is none. O(places tried x texts).
  [[nodiscard]] std::vector<Text> place(const std::vector<std::string>& paragraphs) {
    constexpr std::array widths{0.95, 0.62, 0.42, 0.28, 0.2, 0.16};  // shares of the printable width
    constexpr std::size_t most_rows = 40;  // a longer list would be a page of its own
    for (const double fraction : widths) {
      const std::vector<Text> column = column_of(paragraphs, fraction * area_.size().x);
      if (column.size() <= most_rows) {
        if (std::vector<Text> texts = lowest(column); !texts.empty()) {
          add(texts);
          return texts;
        }
      }
    }
    return {};
  }

 private:
  void add(const std::vector<Text>& texts) {
    for (const Text& text : texts) {
      obstacles_.add(text);
    }
  }

  /// Rows below each other, their upper left corner at the origin.
  static std::vector<Text> column_of(const std::vector<std::string>& paragraphs, double width) {
    std::vector<Text> texts;
    double y = -0.5 * text_height_mm;
    for (const std::string& paragraph : paragraphs) {
      double left = 0.0;
      for (const std::string& row : wrapped(paragraph, width, text_height_mm, indent_mm)) {
        const double middle = left + 0.5 * text_width(row, text_height_mm);
        texts.push_back({Layer::mark, row, {middle, y}, text_height_mm});
        y -= row_height_mm;
        left = indent_mm;
      }
    }
    return texts;
  }

  [[nodiscard]] std::vector<Text> lowest(std::vector<Text> texts) const {
    constexpr double step = 5.0;  // between places that are tried, mm
    Box2 box;
    std::vector<TurnedBox> from_centre;  // what each text covers around its own centre
    for (const Text& text : texts) {
      TurnedBox own = box_of(text);
      box.add(own.bounds().low);
      box.add(own.bounds().high);
      own.centre = own.centre - text.centre;
      from_centre.push_back(own);
    }
    for (double y = area_.low.y; y + box.size().y <= area_.high.y; y += step) {
      for (double x = area_.low.x; x + box.size().x <= area_.high.x; x += step) {
        const Vec2 shift = Vec2{x, y} - box.low;
        std::size_t free = 0;
        while (free < texts.size() && is_free(from_centre[free], texts[free].centre + shift)) {
          ++free;
        }
        if (free == texts.size()) {
          std::ranges::for_each(texts, [&](Text& text) { text.centre += shift; });
          return texts;
        }
      }
    }
    return {};
  }

  /// Whether there is room for a text that covers `text` around its centre.
  [[nodiscard]] bool is_free(TurnedBox text, Vec2 centre) const {
    constexpr double clearance = 2.5;  // from lines and texts of the page, mm
    text.centre += centre;
    // The foot lies below the area: it needs no more than the distance to a line.
    return obstacles_.is_free(text, text_height_mm, 0.5 * row_height_mm, clearance) &&
           std::ranges::none_of(pieces_, [&](const PieceDrawing& piece) { return lies_on(piece, centre); });
  }

  Box2 area_;
  Obstacles obstacles_;
  const std::vector<PieceDrawing>& pieces_;
};

/// Puts all lists where pages have room.
class ListPlacer {
 public:
  explicit ListPlacer(const ListedNets& listed)
      : listed_(listed),
        nets_(listed.nets),
        neighbours_(find_neighbours(listed.surface, listed.nets)),
        texts_(listed.pages.count) {}

  /// What no page has room for is left in `unplaced`.
  std::vector<std::vector<Text>> place(PageLists& unplaced) {
    std::optional<FreeSpace> space;
    for (std::size_t page = 0; page < texts_.size(); ++page) {
      space.emplace(listed_.pages.paper, listed_.pieces[page]);
      place_page(page, *space, unplaced);
    }
    if (texts_.size() > 1) {
      place_rest(*space, unplaced);
    } else if (unplaced.unmarked.empty()) {
      unplaced = {};  // where all pieces lie on one page, it is seen where an edge goes on
    }
    return std::move(texts_);
  }

 private:
  void place_page(std::size_t page, FreeSpace& space, PageLists& unplaced) {
    std::vector<ListRow> unmarked;
    for (const PieceDrawing& piece : listed_.pieces[page]) {
      if (ListRow row = unmarked_row(piece); !row.words.empty()) {
        unmarked.push_back(std::move(row));
      }
    }
    if (!put(unmarked_paragraphs(unmarked), page, space)) {
      keep(unmarked, page, unplaced.unmarked);
    }
    const std::vector<std::string> kinds = kinds_on(PageId(page));
    std::vector<ListRow> partners = partners_on(PageId(page), true);
    if (!put(index_paragraphs(page, kinds, partners, partner_list_heading), page, space) &&
        !put(index_paragraphs(page, kinds, partners_on(PageId(page), false), brief_heading), page, space)) {
      keep(partners, page, unplaced.partners);
      for (const std::string& kind : kinds) {
        if (std::ranges::find(unplaced.kinds, kind) == unplaced.kinds.end()) {
          unplaced.kinds.push_back(kind);
        }
      }
    }
  }

  /// On the last page, where it has room for all of it.
  void place_rest(FreeSpace& space, PageLists& unplaced) {
    std::vector<std::string> all = unmarked_paragraphs(unplaced.unmarked);
    const std::vector<std::string> index =
        index_paragraphs({}, unplaced.kinds, unplaced.partners, partner_list_heading);
    all.insert(all.end(), index.begin(), index.end());
    if (put(all, texts_.size() - 1, space)) {
      unplaced = {};
    }
  }

  bool put(const std::vector<std::string>& paragraphs, std::size_t page, FreeSpace& space) {
    const std::vector<Text> texts = space.place(paragraphs);
    texts_[page].insert(texts_[page].end(), texts.begin(), texts.end());
    return !texts.empty() || paragraphs.empty();
  }

  void keep(std::vector<ListRow>& rows, std::size_t page, std::vector<ListRow>& unplaced) const {
    for (ListRow& row : rows) {
      row.of = texts_.size() > 1 ? fmt::format("page {}, {}", page + 1, row.of) : row.of;
      unplaced.push_back(std::move(row));
    }
  }

  static std::vector<std::string> unmarked_paragraphs(const std::vector<ListRow>& rows) {
    std::vector<std::string> paragraphs;
    std::ranges::transform(rows, std::back_inserter(paragraphs), text_of);
    return paragraphs;
  }

  [[nodiscard]] std::vector<std::string> index_paragraphs(std::optional<std::size_t> page,
                                                          const std::vector<std::string>& kinds,
                                                          const std::vector<ListRow>& partners,
                                                          std::string_view heading) const {
    std::vector<std::string> paragraphs = kinds;
    if (page && std::ranges::any_of(listed_.pieces[*page], has_closing_edges)) {
      paragraphs.emplace_back(closing_words);
    }
    if (!partners.empty()) {
      paragraphs.emplace_back(heading);
    }
    std::ranges::transform(partners, std::back_inserter(paragraphs), text_of);
    return paragraphs;
  }

  static bool has_closing_edges(const PieceDrawing& piece) {
    return std::ranges::any_of(piece.seams, [](const Seam& s) { return s.at == NumberAt::closing; });
  }

  /// Which pieces of the page there are several of, on whatever page.
  [[nodiscard]] std::vector<std::string> kinds_on(PageId page) const {
    constexpr std::size_t most_names = 12;
    std::vector<std::string> rows;
    for (std::size_t i = 0; i < listed_.kinds.size(); ++i) {
      const bool here = std::ranges::any_of(nets_.equal[i], [&](const unfold::EqualPiece& equal) {
        return listed_.pages.placements[equal.piece].page == page;
      });
      if (here) {
        rows.push_back(kind_words(nets_, listed_.kinds[i], most_names));
      }
    }
    return rows;
  }

  [[nodiscard]] std::vector<ListRow> partners_on(PageId page, bool with_numbers) const {
    std::vector<ListRow> rows;
    for (const PieceId piece : ids<PieceId>(nets_.pieces.size())) {
      if (listed_.pages.placements[piece].page == page && !neighbours_[piece].empty()) {
        rows.push_back(partners_of(piece, with_numbers));
      }
    }
    return rows;
  }

  /// "B 5-9, 13", "page 2: C 60-67; D 3": the page's own pieces first.
  [[nodiscard]] ListRow partners_of(PieceId piece, bool with_numbers) const {
    const PageId here = listed_.pages.placements[piece].page;
    std::map<std::pair<bool, PageId>, std::vector<std::string>> of_page;
    for (const Neighbour& other : neighbours_[piece]) {
      const PageId page = listed_.pages.placements[other.piece].page;
      of_page[{page != here, page}].push_back(nets_.pieces[other.piece].name +
                                              (with_numbers ? " " + number_ranges(other.numbers) : ""));
    }
    ListRow row{nets_.pieces[piece].name, {}};
    for (const auto& [page, names] : of_page) {
      row.words.push_back((page.first ? fmt::format("page {}: ", page.second.value() + 1) : "") +
                          fmt::format("{}", fmt::join(names, with_numbers ? "; " : ", ")));
    }
    return row;
  }

  const ListedNets& listed_;
  const unfold::Nets& nets_;
  IdVector<PieceId, std::vector<Neighbour>> neighbours_;
  std::vector<std::vector<Text>> texts_;
};

/// A line of a page that has nothing but lists.
struct ListLine {
  std::string text;
  double height = 0.0;  ///< of letters
  double indent = 0.0;
  double above = 0.0;          ///< kept free, but for the first line of a column
  bool has_followers = false;  ///< the next one belongs to it
};

/// Lists in columns, page after page, in letters of a given height.
class ListSetter {
 public:
  ListSetter(const Paper& paper, double letters) : area_(piece_box(paper)), letters_(letters) {
    constexpr double least_column_mm = 75.0;
    const double width = area_.size().x;
    columns_ = std::max(1.0, std::floor((width + gap_mm) / (least_column_mm + gap_mm)));
    width_ = (width - (columns_ - 1.0) * gap_mm) / columns_;
  }

  [[nodiscard]] std::vector<std::vector<Text>> set(const PageLists& lists) {
    add_rows("numbers that stand nowhere on their pieces", lists.unmarked);
    add_rows(partner_list_heading, lists.partners);
    if (!lists.kinds.empty()) {
      add_rows("which pieces are alike", {{"", lists.kinds}});
    }
    return in_columns();
  }

 private:
  static constexpr double gap_mm = 8.0;  ///< between columns

  void add_rows(std::string_view heading, const std::vector<ListRow>& rows) {
    if (rows.empty()) {
      return;
    }
    add(heading, {{}, 1.15 * letters_, 0.0, 3.0 * letters_, true});
    for (const ListRow& row : rows) {
      if (!row.of.empty()) {
        add(row.of + ":", {{}, 1.3 * letters_, 0.0, 0.75 * letters_, true});
      }
      for (const std::string& words : row.words) {
        add(words, {{}, letters_, 2.0 * letters_, 0.0, false});
      }
    }
  }

  void add(std::string_view words, ListLine line) {
    const double hanging = 2.0 * letters_;
    bool first = true;
    for (const std::string& row : wrapped(words, width_ - line.indent, line.height, hanging)) {
      line.text = row;
      lines_.push_back(line);
      line.indent += std::exchange(first, false) ? hanging : 0.0;
      line.above = 0.0;
    }
  }

  [[nodiscard]] std::vector<std::vector<Text>> in_columns() const {
    std::vector<std::vector<Text>> pages;
    double column = columns_;
    double y = area_.low.y;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const ListLine& line = lines_[i];
      double needed = line.above;
      for (std::size_t k = i; k < lines_.size() && (k == i || lines_[k - 1].has_followers); ++k) {
        needed += row_of(lines_[k]);
      }
      y -= line.above;
      if (pages.empty() || y - needed < area_.low.y) {
        column += 1.0;
        if (column >= columns_) {
          column = 0.0;
          pages.emplace_back();
        }
        y = area_.high.y;
      }
      const double left = area_.low.x + column * (width_ + gap_mm) + line.indent;
      const Vec2 middle{left + 0.5 * text_width(line.text, line.height), y - 0.5 * line.height};
      pages.back().push_back({Layer::mark, line.text, middle, line.height});
      y -= row_of(line);
    }
    return pages;
  }

  static double row_of(const ListLine& line) { return row_height_mm / text_height_mm * line.height; }

  Box2 area_;
  double letters_;
  double columns_ = 1.0;
  double width_ = 0.0;
  std::vector<ListLine> lines_;
};

/// What pages have no room for, on pages of its own: letters are as large as costs no page.
std::vector<std::vector<Text>> list_pages(const PageLists& lists, const Paper& paper) {
  std::vector<std::vector<Text>> pages = ListSetter(paper, text_height_mm).set(lists);
  for (const double larger : {2.2, 2.6}) {
    if (auto others = ListSetter(paper, larger).set(lists); others.size() <= pages.size()) {
      pages = std::move(others);
    }
  }
  return pages;
}

}  // namespace

ListRow unmarked_row(const PieceDrawing& piece) {
  ListRow row{piece.name, {}};
  std::set<std::uint32_t> numbers;
  for (const Seam& seam : piece.seams) {
    if (seam.at == NumberAt::list) {
      numbers.insert(seam.number);
    }
  }
  if (!numbers.empty()) {
    row.words.push_back(number_ranges({numbers.begin(), numbers.end()}) + " unmarked");
  }
  std::vector<std::string_view> names;
  for (const GlueMark& spot : piece.spots) {
    if (!spot.named) {
      names.push_back(spot.name);
    }
  }
  if (!names.empty()) {
    row.words.push_back(fmt::format("within short dashes {}", fmt::join(names, ", ")));
  }
  return row;
}

bool has_room_for_lists(const Paper& paper) {
  const Vec2 area = piece_area(paper);
  return area.x >= least_width && area.y >= least_height;
}

std::vector<std::vector<Text>> place_lists(const ListedNets& listed) {
  PageLists unplaced;
  std::vector<std::vector<Text>> texts = ListPlacer(listed).place(unplaced);
  if (has_room_for_lists(listed.pages.paper)) {
    for (std::vector<Text>& page : list_pages(unplaced, listed.pages.paper)) {
      texts.push_back(std::move(page));
    }
  }
  return texts;
}

}  // namespace ridgecraft::export_
