// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/page_index.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "export/page/glue_spots.hpp"
#include "export/page/page_room.hpp"
#include "export/page/text_table.hpp"

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

}  // namespace ridgecraft::export_
