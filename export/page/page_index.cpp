// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/page_index.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "export/page/glue_spots.hpp"
#include "export/page/page_room.hpp"
#include "export/page/text_table.hpp"

namespace ridgecraft::paper {
namespace {

/// Widths of the table that are tried, shares of the printable width.
constexpr std::array<double, 4> widths{0.95, 0.62, 0.42, 0.28};
/// The same for a list of numbers by itself.
constexpr std::array<double, 6> list_widths{0.95, 0.62, 0.42, 0.28, 0.2, 0.16};
/// A longer list would be a page of its own.
constexpr std::size_t most_rows = 40;
constexpr std::string_view closing_words = "an edge without a number is glued to the one beside it";
constexpr std::string_view brief_heading = "where the other edges are";

enum class Partners { none, names, with_numbers };
/// What an index has.
struct Contents {
  Partners partners = Partners::with_numbers;
  bool numbers = true;  ///< those that have no room at their edges
  bool closing = true;  ///< what edges without a number are
};
/// What is tried first, and what where that has no room. A number that stands nowhere is missed more than a
/// hint at where its other edge is.
constexpr std::array<Contents, 4> in_one_place{{{Partners::with_numbers, true, true},
                                                {Partners::with_numbers, true, false},
                                                {Partners::names, true, true},
                                                {Partners::names, true, false}}};
/// The same for two lists, each at a place of its own.
constexpr std::array<Contents, 3> in_turn{
    {{Partners::none, true, false}, {Partners::with_numbers, false, false}, {Partners::names, false, false}}};

/// "B 5-9, 13; page 2: C 60-67; D 3": the page's own pieces first. `each_page`: "page 2: D 3", since each
/// stands in a line of its own.
std::string partners(const unfold::Nets& nets, const Pages& pages, PageId own,
                     std::vector<Neighbour> neighbours, bool with_numbers, bool each_page) {
  const auto page_of = [&](const Neighbour& n) { return pages.placements[n.piece].page; };
  std::stable_sort(neighbours.begin(), neighbours.end(), [&](const Neighbour& a, const Neighbour& b) {
    return std::pair(page_of(a) != own, page_of(a)) < std::pair(page_of(b) != own, page_of(b));
  });
  std::string text;
  PageId page = own;
  for (const Neighbour& neighbour : neighbours) {
    const bool other_page = page_of(neighbour) != page || (each_page && page_of(neighbour) != own);
    page = page_of(neighbour);
    text += text.empty() ? "" : other_page || with_numbers ? "; " : ", ";
    text += other_page ? "page " + std::to_string(page.value() + 1) + ": " : "";
    text += nets.pieces[neighbour.piece].name;
    text += with_numbers ? " " + number_ranges(neighbour.numbers) : "";
  }
  return text;
}

/// Which pieces of the page there are several of, on whatever page.
std::vector<std::string> kinds_on_page(const unfold::Nets& nets, const Pages& pages, PageId page,
                                       const std::vector<PieceKind>& kinds) {
  constexpr std::size_t most_names = 12;
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const bool here = std::ranges::any_of(nets.equal[i], [&](const unfold::EqualPiece& equal) {
      return pages.placements[equal.piece].page == page;
    });
    if (here) {
      rows.push_back(kind_words(nets, kinds[i], most_names));
    }
  }
  return rows;
}

bool has_closing_edges(const PieceDrawing& piece) {
  return std::ranges::any_of(piece.seams, [](const Seam& s) { return s.told == NumberAt::closing; });
}

/// Of each piece with numbers that have no room.
std::vector<std::string> number_rows(const std::vector<PieceDrawing>& pieces) {
  std::vector<std::string> rows;
  for (const PieceDrawing& piece : pieces) {
    if (std::string row = number_row(piece); !row.empty()) {
      rows.push_back(std::move(row));
    }
    if (std::string row = spot_row(piece); !row.empty()) {
      rows.push_back(std::move(row));
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

void append_list(std::vector<std::string>& rows, const RowList& list, double width) {
  if (!list.rows.empty()) {
    append_wrapped(rows, list.heading, width);
  }
  for (const std::string& row : list.rows) {
    append_wrapped(rows, row, width);
  }
}

}  // namespace

void Unplaced::add(Unplaced others, std::size_t page, bool several) {
  const auto take = [&](std::vector<std::string>& rows, const std::vector<std::string>& more) {
    for (const std::string& row : more) {
      rows.push_back(several ? fmt::format("page {}, {}", page, row) : row);
    }
  };
  add_missing(kinds, others.kinds);
  take(partners, others.partners);
  take(numbers, others.numbers);
  for (Enlarged& picture : others.pictures) {
    const auto named = [&](Enlarged& one) {
      one.words = several ? fmt::format("page {}: {}", page, one.words) : one.words;
    };
    named(picture);
    std::ranges::for_each(picture.smaller, named);
    pictures.push_back(std::move(picture));
  }
}

PageIndex page_index(const unfold::Nets& nets, const Pages& pages, PageId page,
                     const IdVector<PieceId, std::vector<Neighbour>>& neighbours,
                     const std::vector<PieceKind>& kinds, const std::vector<PieceDrawing>& pieces,
                     std::vector<Enlarged> pictures, const Unplaced& others) {
  PageRoom room(pages.paper, pieces);
  PageIndex index;
  pictures.insert(pictures.end(), others.pictures.begin(), others.pictures.end());
  const auto put_picture = [&](Enlarged picture) {
    picture = with_words(std::move(picture));
    const auto corner = room.place(picture.size);
    if (corner) {
      room.add(Box2{*corner, *corner + picture.size});
      index.shown.push_back(picture.shown);
      index.marks.add(std::move(picture.marks), *corner);
    }
    return corner.has_value();
  };
  for (Enlarged& picture : pictures) {
    if (!put_picture(picture) && std::ranges::none_of(picture.smaller, put_picture)) {
      index.left.pictures.push_back(std::move(picture));
    }
  }
  std::vector<PieceId> listed;
  for (const PieceId piece : ids<PieceId>(nets.pieces.size())) {
    if (pages.placements[piece].page == page && !neighbours[piece].empty()) {
      listed.push_back(piece);
    }
  }
  std::vector<std::string> equal = kinds_on_page(nets, pages, page, kinds);
  add_missing(equal, others.kinds);
  std::vector<std::string> numbers = number_rows(pieces);
  numbers.insert(numbers.end(), others.numbers.begin(), others.numbers.end());
  const auto rows_of = [&](const Contents& contents, double width) {
    std::vector<std::string> rows;
    if (contents.partners != Partners::none) {
      const bool full = contents.partners == Partners::with_numbers;
      for (const std::string& kind : equal) {
        append_wrapped(rows, kind, width);
      }
      if (contents.closing && std::ranges::any_of(pieces, has_closing_edges)) {
        append_wrapped(rows, closing_words, width);
      }
      if (!listed.empty() || !others.partners.empty()) {
        rows.emplace_back(full ? partner_list_heading : brief_heading);
      }
      for (const PieceId piece : listed) {
        append_wrapped(
            rows,
            nets.pieces[piece].name + ": " + partners(nets, pages, page, neighbours[piece], full, false),
            width);
      }
      for (const std::string& row : others.partners) {
        append_wrapped(rows, row, width);
      }
    }
    if (contents.numbers) {
      append_list(rows, {number_list_heading, numbers}, width);
    }
    return rows;
  };
  std::vector<std::string> every_partner;
  for (const PieceId piece : listed) {
    every_partner.push_back(nets.pieces[piece].name + ": " +
                            partners(nets, pages, page, neighbours[piece], true, true));
  }
  const auto place = [&](const Contents& contents, std::span<const double> shares) {
    std::optional<std::vector<Text>> texts;
    for (std::size_t i = 0; i < shares.size() && !texts; ++i) {
      const std::vector<std::string> rows = rows_of(contents, shares[i] * piece_area(pages.paper).x);
      if (!rows.empty() && rows.size() <= most_rows) {
        texts = room.place(table(rows));
      }
    }
    return texts;
  };
  const auto put = [&](const std::vector<Text>& texts) {
    room.add(texts);
    index.marks.texts.insert(index.marks.texts.end(), texts.begin(), texts.end());
  };
  for (const Contents& contents : in_one_place) {
    if (const auto texts = place(contents, widths)) {
      put(*texts);
      return index;
    }
  }
  every_partner.insert(every_partner.end(), others.partners.begin(), others.partners.end());
  index.left.kinds = equal;
  index.left.partners = std::move(every_partner);
  index.left.numbers = numbers;
  if (numbers.empty()) {
    return index;  // the other lists were tried already
  }
  for (const Contents& contents : in_turn) {
    const bool has_partners = contents.partners != Partners::none;
    if (has_partners ? index.left.partners.empty() && index.left.kinds.empty() : index.left.numbers.empty()) {
      continue;
    }
    if (const auto texts = place(contents, has_partners ? std::span<const double>(widths) : list_widths)) {
      put(*texts);
      (has_partners ? index.left.partners : index.left.numbers).clear();
      if (has_partners) {
        index.left.kinds.clear();
      }
    }
  }
  return index;
}

}  // namespace ridgecraft::paper
