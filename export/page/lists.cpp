// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/lists.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "export/page/glue_outlines.hpp"
#include "export/page/list_rows.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::export_ {
namespace {

/// Widths of lists that are tried, shares of the printable width.
constexpr std::array<double, 4> index_widths{0.95, 0.62, 0.42, 0.28};
constexpr std::array<double, 6> number_widths{0.95, 0.62, 0.42, 0.28, 0.2, 0.16};
/// A longer list would be a page of its own.
constexpr std::size_t most_rows = 40;
constexpr std::string_view closing_words = "an edge without a number is glued to the one beside it";
constexpr std::string_view brief_heading = "where the other edges are";

/// How much an index says.
struct IndexForm {
  bool numbers = true;  ///< by which each piece is glued to the others
  bool closing = true;  ///< what edges without a number are
};
/// In the order in which they are tried.
constexpr std::array<IndexForm, 4> index_forms{{{true, true}, {true, false}, {false, true}, {false, false}}};

/// "B 5-9, 13; page 2: C 60-67; D 3": the page's own pieces first. `each_page`: "page 2: D 3", since each
/// stands in a line of its own.
std::string partners(const ListedPage& from, std::vector<Neighbour> neighbours, bool with_numbers,
                     bool each_page) {
  const auto page_of = [&](const Neighbour& n) { return from.pages.placements[n.piece].page; };
  std::stable_sort(neighbours.begin(), neighbours.end(), [&](const Neighbour& a, const Neighbour& b) {
    return std::pair(page_of(a) != from.page, page_of(a)) < std::pair(page_of(b) != from.page, page_of(b));
  });
  std::string text;
  PageId page = from.page;
  for (const Neighbour& neighbour : neighbours) {
    const bool other_page = page_of(neighbour) != page || (each_page && page_of(neighbour) != from.page);
    page = page_of(neighbour);
    text += text.empty() ? "" : other_page || with_numbers ? "; " : ", ";
    text += other_page ? "page " + std::to_string(page.value() + 1) + ": " : "";
    text += from.nets.pieces[neighbour.piece].name;
    text += with_numbers ? " " + number_ranges(neighbour.numbers) : "";
  }
  return text;
}

/// Which pieces of the page there are several of, on whatever page.
std::vector<std::string> kinds_on_page(const ListedPage& from) {
  constexpr std::size_t most_names = 12;
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < from.kinds.size(); ++i) {
    const bool here = std::ranges::any_of(from.nets.equal[i], [&](const unfold::EqualPiece& equal) {
      return from.pages.placements[equal.piece].page == from.page;
    });
    if (here) {
      rows.push_back(kind_words(from.nets, from.kinds[i], most_names));
    }
  }
  return rows;
}

bool has_closing_edges(const PieceDrawing& piece) {
  return std::ranges::any_of(piece.seams, [](const Seam& s) { return s.at == NumberAt::closing; });
}

/// Of each piece with numbers, or names of what is glued on, that have no room.
std::vector<std::string> number_rows(const std::vector<PieceDrawing>& pieces) {
  std::vector<std::string> rows;
  for (const PieceDrawing& piece : pieces) {
    for (std::string& row : std::array{number_row(piece), spot_row(piece)}) {
      if (!row.empty()) {
        rows.push_back(std::move(row));
      }
    }
  }
  return rows;
}

void add_missing(std::vector<std::string>& rows, const std::vector<std::string>& more) {
  for (const std::string& row : more) {
    if (std::ranges::find(rows, row) == rows.end()) {
      rows.push_back(row);
    }
  }
}

/// Puts a page's lists where the page has room.
class ListPlacer {
 public:
  ListPlacer(const ListedPage& page, const PageLists& others)
      : page_(page), others_(others), room_(page.pages.paper, page.pieces) {
    kinds_ = kinds_on_page(page);
    add_missing(kinds_, others.kinds);
    numbers_ = number_rows(page.pieces);
    numbers_.insert(numbers_.end(), others.numbers.begin(), others.numbers.end());
    for (const PieceId piece : ids<PieceId>(page.nets.pieces.size())) {
      if (page.pages.placements[piece].page == page.page && !page.neighbours[piece].empty()) {
        listed_.push_back(piece);
      }
    }
  }

  PageIndex place() && {
    if (!place_numbers()) {
      index_.left.numbers = std::move(numbers_);
    }
    if (!std::ranges::any_of(index_forms, [&](const IndexForm& form) { return place_index(form); })) {
      index_.left.kinds = std::move(kinds_);
      index_.left.partners = partner_rows({}, true);
    }
    return std::move(index_);
  }

 private:
  bool place_numbers() {
    return place(number_widths, [&](double width) {
      std::vector<std::string> rows;
      if (!numbers_.empty()) {
        append_wrapped(rows, number_list_heading, width);
      }
      append_all(rows, numbers_, width);
      return rows;
    });
  }

  bool place_index(const IndexForm& form) {
    return place(index_widths, [&](double width) {
      std::vector<std::string> rows;
      append_all(rows, kinds_, width);
      if (form.closing && std::ranges::any_of(page_.pieces, has_closing_edges)) {
        append_wrapped(rows, closing_words, width);
      }
      if (!listed_.empty() || !others_.partners.empty()) {
        rows.emplace_back(form.numbers ? partner_list_heading : brief_heading);
      }
      append_all(rows, partner_rows(form, false), width);
      return rows;
    });
  }

  /// "A: B 5-9, 13" for each piece, and what other pages have no room for.
  [[nodiscard]] std::vector<std::string> partner_rows(const IndexForm& form, bool each_page) const {
    std::vector<std::string> rows;
    for (const PieceId piece : listed_) {
      rows.push_back(page_.nets.pieces[piece].name + ": " +
                     partners(page_, page_.neighbours[piece], form.numbers, each_page));
    }
    rows.insert(rows.end(), others_.partners.begin(), others_.partners.end());
    return rows;
  }

  static void append_all(std::vector<std::string>& rows, const std::vector<std::string>& more, double width) {
    for (const std::string& row : more) {
      append_wrapped(rows, row, width);
    }
  }

  /// Places rows_of(width) at the first of the widths that has room; whether one has, or there is nothing to
  /// place.
  template <class RowsOf>
  bool place(std::span<const double> widths, RowsOf rows_of) {
    for (const double share : widths) {
      const std::vector<std::string> rows = rows_of(share * piece_area(page_.pages.paper).x);
      if (rows.empty()) {
        return true;
      }
      if (rows.size() > most_rows) {
        continue;
      }
      if (const auto texts = room_.place(table(rows))) {
        room_.add(*texts);
        index_.texts.insert(index_.texts.end(), texts->begin(), texts->end());
        return true;
      }
    }
    return false;
  }

  const ListedPage& page_;
  const PageLists& others_;
  PageRoom room_;
  std::vector<std::string> kinds_;
  std::vector<std::string> numbers_;
  std::vector<PieceId> listed_;  ///< pieces that are glued to others
  PageIndex index_;
};

}  // namespace

void PageLists::add(const PageLists& others, std::size_t page, bool several) {
  const auto take = [&](std::vector<std::string>& rows, const std::vector<std::string>& more) {
    for (const std::string& row : more) {
      rows.push_back(several ? fmt::format("page {}, {}", page, row) : row);
    }
  };
  add_missing(kinds, others.kinds);
  take(partners, others.partners);
  take(numbers, others.numbers);
}

PageIndex page_index(const ListedPage& page, const PageLists& others) {
  return ListPlacer(page, others).place();
}

namespace {

/// Of small letters; the last are those of lists beside pieces.
constexpr std::array<double, 3> letters_mm{2.6, 2.2, table_text_height};
constexpr double row_share = table_row_height / table_text_height;
constexpr double least_column_mm = 75.0;
constexpr double column_gap_mm = 8.0;
constexpr double heading_share = 1.15;  ///< height of headings, of the letters'
constexpr double entry_share = 1.3;     ///< of the lines that entries begin with
constexpr double indent_share = 2.0;
constexpr double after_heading_share = 0.9;  ///< of a row
constexpr double before_entry_share = 0.45;

constexpr std::string_view kind_list_heading = "which pieces are alike";

enum class Kind { heading, entry, words };

/// A line of a column.
struct ListLine {
  Kind kind = Kind::words;
  std::string text;
  bool begins = true;  ///< not the rest of a longer one
};

/// Rows of words under a heading.
struct RowList {
  std::string_view heading;
  std::vector<std::string> rows;
};

class Setter {
 public:
  Setter(const Paper& paper, double letters) : area_(piece_box(paper)), letters_(letters) {
    const double width = area_.size().x;
    columns_ = std::max(1.0, std::floor((width + column_gap_mm) / (least_column_mm + column_gap_mm)));
    width_ = (width - (columns_ - 1.0) * column_gap_mm) / columns_;
  }

  std::vector<std::vector<Text>> set(const std::vector<RowList>& lists) {
    for (const RowList& list : lists) {
      const std::vector<ListLine> heading = wrapped_as(Kind::heading, list.heading, full_width());
      const std::vector<ListLine> lines = lines_of(list.rows);
      bool begun = false;
      for (std::size_t i = 0; i < lines.size(); ++i) {
        // An entry's own line stands above another one.
        double needed = height_of(lines[i]);
        needed += lines[i].kind == Kind::entry && i + 1 < lines.size() ? height_of(lines[i + 1]) : 0.0;
        if (!begun) {
          begin_list(heading, needed);
          begun = true;
        } else if (y_ - needed < area_.low.y) {
          next_column(heading);
        }
        put(lines[i]);
      }
    }
    return std::move(pages_);
  }

 private:
  [[nodiscard]] double row() const { return row_share * letters_; }
  [[nodiscard]] double letters_of(Kind kind) const {
    return letters_ * (kind == Kind::heading ? heading_share : kind == Kind::entry ? entry_share : 1.0);
  }
  [[nodiscard]] double indent_of(const ListLine& line) const {
    return line.kind != Kind::words ? 0.0 : indent_share * letters_ * (line.begins ? 1.0 : 2.0);
  }
  [[nodiscard]] double height_of(const ListLine& line) const {
    return row_share * letters_of(line.kind) +
           (line.kind == Kind::entry && line.begins ? before_entry_share * row() : 0.0);
  }

  [[nodiscard]] std::vector<ListLine> wrapped_as(Kind kind, std::string_view text, double width) const {
    const double indent = kind == Kind::words ? indent_share * letters_ : 0.0;
    std::vector<std::string> rows;
    append_wrapped(rows, text, (width - indent) * table_text_height / letters_of(kind));
    std::vector<ListLine> lines;
    for (const std::string& row : rows) {
      lines.push_back({kind, row.substr(row.find_first_not_of(' ')), lines.empty()});
    }
    return lines;
  }

  /// "page 2, E: between 12 and 21: 13, 14; after 3: 4" is an entry with two lines below.
  [[nodiscard]] std::vector<ListLine> lines_of(const std::vector<std::string>& rows) const {
    std::vector<ListLine> lines;
    const auto add = [&](Kind kind, std::string_view text) {
      const std::vector<ListLine> own = wrapped_as(kind, text, width_);
      lines.insert(lines.end(), own.begin(), own.end());
    };
    for (const std::string& row : rows) {
      const std::size_t colon = std::min(row.find(": "), row.size());
      add(Kind::entry, row.substr(0, colon + 1));
      for (std::size_t begin = colon + 2; begin < row.size();) {
        const std::size_t end = std::min(row.find("; ", begin), row.size());
        add(Kind::words, std::string_view(row).substr(begin, end - begin));
        begin = end + 2;
      }
    }
    return lines;
  }

  [[nodiscard]] double full_width() const { return area_.size().x; }

  void begin_page() {
    pages_.emplace_back();
    y_ = area_.high.y;
    lowest_ = y_;
  }

  /// Below all that stands on the page, or on the next one. The heading stands once over all columns.
  void begin_list(const std::vector<ListLine>& heading, double needed) {
    for (const ListLine& line : heading) {
      needed += height_of(line);
    }
    needed += (1.0 + after_heading_share) * row();
    if (pages_.empty() || lowest_ - needed < area_.low.y) {
      begin_page();
    } else {
      y_ = lowest_ - row();
    }
    put_heading(heading);
  }

  void put_heading(const std::vector<ListLine>& heading) {
    column_ = 0.0;
    for (const ListLine& line : heading) {
      put(line);
    }
    y_ -= after_heading_share * row();
    columns_top_ = y_;
    at_top_ = true;
  }

  void next_column(const std::vector<ListLine>& heading) {
    column_ += 1.0;
    if (column_ < columns_) {
      y_ = columns_top_;
      at_top_ = true;
    } else {
      begin_page();
      put_heading(heading);
    }
  }

  void put(const ListLine& line) {
    y_ -= line.kind == Kind::entry && line.begins && !at_top_ ? before_entry_share * row() : 0.0;
    const double height = letters_of(line.kind);
    const double left = area_.low.x + column_ * (width_ + column_gap_mm) + indent_of(line);
    pages_.back().push_back({Layer::mark,
                             line.text,
                             {left + 0.5 * text_width(line.text, height), y_ - 0.5 * height},
                             height,
                             0.0,
                             false});
    y_ -= row_share * height;
    lowest_ = std::min(lowest_, y_);
    at_top_ = false;
  }

  Box2 area_;
  double letters_;
  double columns_ = 1.0;
  double width_ = 0.0;
  double column_ = 0.0;
  double y_ = 0.0;
  double lowest_ = 0.0;       ///< of all that stands on the page
  double columns_top_ = 0.0;  ///< of the list's columns
  bool at_top_ = true;
  std::vector<std::vector<Text>> pages_;
};

/// "2 equal: A, B" is an entry with a line; "A and B are mirror images" gets an entry for all of them.
std::vector<std::string> rows_of_kinds(const std::vector<std::string>& kinds) {
  std::vector<std::string> rows;
  std::string others;
  for (const std::string& kind : kinds) {
    if (kind.find(": ") != std::string::npos) {
      rows.push_back(kind);
    } else {
      others += (others.empty() ? "in pairs: " : "; ") + kind;
    }
  }
  if (!others.empty()) {
    rows.push_back(std::move(others));
  }
  return rows;
}

}  // namespace

std::vector<std::vector<Text>> list_pages(const PageLists& left, const Paper& paper) {
  const std::vector<RowList> lists{{number_list_heading, left.numbers},
                                   {partner_list_heading, left.partners},
                                   {kind_list_heading, rows_of_kinds(left.kinds)}};
  std::vector<std::vector<Text>> fewest = Setter(paper, letters_mm.back()).set(lists);
  for (const double letters : letters_mm) {
    std::vector<std::vector<Text>> larger = Setter(paper, letters).set(lists);
    if (larger.size() <= fewest.size()) {
      return larger;
    }
  }
  return fewest;
}

}  // namespace ridgecraft::export_
