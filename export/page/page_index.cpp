// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/page_index.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "export/page/glue_spots.hpp"
#include "export/page/obstacles.hpp"
#include "export/page/text_table.hpp"

namespace ridgecraft::paper {
namespace {

constexpr double index_clearance = 2.5;  ///< from lines and texts of the page, mm
constexpr double step = 5.0;             ///< between places that are tried, mm
/// Widths of the table that are tried, shares of the printable width.
constexpr std::array<double, 4> widths{0.95, 0.62, 0.42, 0.28};
/// The same for a list of numbers by itself.
constexpr std::array<double, 6> list_widths{0.95, 0.62, 0.42, 0.28, 0.2, 0.16};
/// A longer list would be a page of its own.
constexpr std::size_t most_rows = 40;
constexpr std::string_view brief_heading = "where the other edges are";

enum class Partners { none, names, with_numbers };
/// What an index has.
struct Contents {
  Partners partners = Partners::with_numbers;
  bool numbers = true;  ///< those that have no room at their edges
};
/// What is tried first, and what where that has no room. A number that stands nowhere is missed more than a
/// hint at where its other edge is.
constexpr std::array<Contents, 2> in_one_place{{{Partners::with_numbers, true}, {Partners::names, true}}};
/// The same for two lists, each at a place of its own.
constexpr std::array<Contents, 3> in_turn{
    {{Partners::none, true}, {Partners::with_numbers, false}, {Partners::names, false}}};

/// "B 5-9, 13; page 2: C 60-67, D 3": the page's own pieces first.
std::string partners(const unfold::Nets& nets, const Pages& pages, PageId own,
                     std::vector<Neighbour> neighbours, bool with_numbers) {
  const auto page_of = [&](const Neighbour& n) { return pages.placements[n.piece].page; };
  std::stable_sort(neighbours.begin(), neighbours.end(), [&](const Neighbour& a, const Neighbour& b) {
    return std::pair(page_of(a) != own, page_of(a)) < std::pair(page_of(b) != own, page_of(b));
  });
  std::string text;
  PageId page = own;
  for (const Neighbour& neighbour : neighbours) {
    const bool other_page = page_of(neighbour) != page;
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

void append_list(std::vector<std::string>& rows, const RowList& list, double width) {
  if (!list.rows.empty()) {
    append_wrapped(rows, list.heading, width);
  }
  for (const std::string& row : list.rows) {
    append_wrapped(rows, row, width);
  }
}

/// All that is drawn on the page, and where its pieces are.
class PageRoom {
 public:
  PageRoom(const Paper& paper, const std::vector<PieceDrawing>& pieces)
      : area_(piece_box(paper)), obstacles_(paper.size), pieces_(pieces) {
    for (const PieceDrawing& piece : pieces) {
      for (const Line& line : piece.group.lines) {
        for (std::size_t i = 1; i < line.points.size(); ++i) {
          obstacles_.add({line.points[i - 1], line.points[i]}, Obstacles::Kind::cut);
        }
        if (line.closed) {
          obstacles_.add({line.points.back(), line.points.front()}, Obstacles::Kind::cut);
        }
      }
      for (const Text& text : piece.group.texts) {
        obstacles_.add(text);
      }
    }
  }

  void add(const std::vector<Text>& texts) {
    for (const Text& text : texts) {
      obstacles_.add(text);
    }
  }

  /// The texts at the lowest place that has room, the leftmost of those.
  [[nodiscard]] std::optional<std::vector<Text>> place(const std::vector<Text>& texts) const {
    Box2 box;
    for (const Text& text : texts) {
      const Box2 own = box_of(text).bounds();
      box.add(own.low);
      box.add(own.high);
    }
    for (double y = area_.low.y; y + box.size().y <= area_.high.y; y += step) {
      for (double x = area_.low.x; x + box.size().x <= area_.high.x; x += step) {
        std::vector<Text> here = texts;
        for (Text& text : here) {
          text.centre += Vec2{x, y} - box.low;
        }
        if (std::ranges::all_of(here, [&](const Text& text) { return free(text); })) {
          return here;
        }
      }
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool free(const Text& text) const {
    // The foot lies below the area: it needs no more than the distance to a line.
    return obstacles_.is_free(text, std::min(index_clearance, 0.5 * table_row_height), index_clearance) &&
           !on_a_piece(text.centre);
  }
  [[nodiscard]] bool on_a_piece(Vec2 p) const {
    return std::ranges::any_of(pieces_, [&](const PieceDrawing& piece) {
      return std::ranges::any_of(piece.faces, [&](const std::array<Vec2, 3>& f) {
        return cross(f[1] - f[0], p - f[0]) >= 0.0 && cross(f[2] - f[1], p - f[1]) >= 0.0 &&
               cross(f[0] - f[2], p - f[2]) >= 0.0;
      });
    });
  }

  Box2 area_;
  Obstacles obstacles_;
  const std::vector<PieceDrawing>& pieces_;
};

}  // namespace

PageIndex page_index(const unfold::Nets& nets, const Pages& pages, PageId page,
                     const IdVector<PieceId, std::vector<Neighbour>>& neighbours,
                     const std::vector<PieceKind>& kinds, const std::vector<PieceDrawing>& pieces) {
  std::vector<PieceId> listed;
  for (const PieceId piece : ids<PieceId>(nets.pieces.size())) {
    if (pages.placements[piece].page == page && !neighbours[piece].empty()) {
      listed.push_back(piece);
    }
  }
  const std::vector<std::string> equal = kinds_on_page(nets, pages, page, kinds);
  const std::vector<std::string> numbers = number_rows(pieces);
  const auto rows_of = [&](const Contents& contents, double width) {
    std::vector<std::string> rows;
    if (contents.partners != Partners::none) {
      const bool full = contents.partners == Partners::with_numbers;
      for (const std::string& kind : equal) {
        append_wrapped(rows, kind, width);
      }
      if (!listed.empty()) {
        rows.emplace_back(full ? partner_list_heading : brief_heading);
      }
      for (const PieceId piece : listed) {
        append_wrapped(rows,
                       nets.pieces[piece].name + ": " + partners(nets, pages, page, neighbours[piece], full),
                       width);
      }
    }
    if (contents.numbers) {
      append_list(rows, {number_list_heading, numbers}, width);
    }
    return rows;
  };
  std::vector<std::string> every_partner = equal;
  for (const PieceId piece : listed) {
    every_partner.push_back(nets.pieces[piece].name + ": " +
                            partners(nets, pages, page, neighbours[piece], true));
  }
  PageRoom room(pages.paper, pieces);
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
  for (const Contents& contents : in_one_place) {
    if (auto texts = place(contents, widths)) {
      return {std::move(*texts), {}, {}};
    }
  }
  PageIndex index{{}, std::move(every_partner), numbers};
  if (numbers.empty()) {
    return index;  // the other lists were tried already
  }
  for (const Contents& contents : in_turn) {
    const bool has_partners = contents.partners != Partners::none;
    if ((has_partners ? index.partners : index.numbers).empty()) {
      continue;
    }
    if (const auto texts = place(contents, has_partners ? std::span<const double>(widths) : list_widths)) {
      room.add(*texts);
      index.texts.insert(index.texts.end(), texts->begin(), texts->end());
      (has_partners ? index.partners : index.numbers).clear();
    }
  }
  return index;
}

std::optional<std::vector<Text>> list_beside(const Paper& paper, const std::vector<PieceDrawing>& pieces,
                                             const std::vector<Text>& others, const RowList& list) {
  PageRoom room(paper, pieces);
  room.add(others);
  for (const double share : list_widths) {
    std::vector<std::string> lines;
    append_list(lines, list, share * piece_area(paper).x);
    if (lines.size() > most_rows) {
      continue;
    }
    if (auto texts = room.place(table(lines))) {
      return texts;
    }
  }
  return std::nullopt;
}

}  // namespace ridgecraft::paper
