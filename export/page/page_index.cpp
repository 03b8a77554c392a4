// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/page_index.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "export/page/obstacles.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::paper {
namespace {

constexpr double index_text_height = 1.9;  ///< mm
constexpr double row_height = 3.1;         ///< baseline to baseline, mm
constexpr double index_clearance = 2.5;    ///< from lines and texts of the page, mm
constexpr double step = 5.0;               ///< between places that are tried, mm
/// Widths of the table that are tried, shares of the printable width.
constexpr std::array<double, 4> widths{0.95, 0.62, 0.42, 0.28};
/// A longer list would be a page of its own.
constexpr std::size_t most_rows = 40;
constexpr std::string_view full_heading = "where the other edges are: piece and numbers";
constexpr std::string_view brief_heading = "where the other edges are";
constexpr std::string_view indent = "   ";

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

/// Words in rows that are no wider than `width`, those after the first one indented.
void append_wrapped(std::vector<std::string>& rows, const std::string& text, double width) {
  std::string row;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    begin = end + 1;
    const std::string longer = row.empty() ? word : row + " " + word;
    if (!row.empty() && text_width(longer, index_text_height) > width) {
      rows.push_back(row);
      row = std::string(indent) + word;
    } else {
      row = longer;
    }
  }
  rows.push_back(row);
}

/// The rows with their upper left corner at the origin.
std::vector<Text> table(const std::vector<std::string>& rows) {
  std::vector<Text> texts;
  double y = -0.5 * index_text_height;
  for (const std::string& row : rows) {
    const std::size_t from = row.find_first_not_of(' ');
    const double left = from == 0 ? 0.0 : text_width(indent, index_text_height);
    const std::string words = row.substr(from);
    texts.push_back({Layer::mark,
                     words,
                     {left + 0.5 * text_width(words, index_text_height), y},
                     index_text_height,
                     0.0,
                     false});
    y -= row_height;
  }
  return texts;
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
    return obstacles_.is_free(text, std::min(index_clearance, 0.5 * row_height), index_clearance) &&
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

std::vector<Text> page_index(const unfold::Nets& nets, const Pages& pages, PageId page,
                             const IdVector<PieceId, std::vector<Neighbour>>& neighbours,
                             const std::vector<PieceKind>& kinds,
                             const std::vector<PieceDrawing>& pieces) {
  std::vector<PieceId> listed;
  for (const PieceId piece : ids<PieceId>(nets.pieces.size())) {
    if (pages.placements[piece].page == page && !neighbours[piece].empty()) {
      listed.push_back(piece);
    }
  }
  const std::vector<std::string> equal = kinds_on_page(nets, pages, page, kinds);
  if (listed.empty() && equal.empty()) {
    return {};
  }
  const PageRoom room(pages.paper, pieces);
  for (const bool with_numbers : {true, false}) {
    for (const double share : widths) {
      const double width = share * piece_area(pages.paper).x;
      std::vector<std::string> rows;
      for (const std::string& kind : equal) {
        append_wrapped(rows, kind, width);
      }
      if (!listed.empty()) {
        rows.emplace_back(with_numbers ? full_heading : brief_heading);
      }
      for (const PieceId piece : listed) {
        const std::string& name = nets.pieces[piece].name;
        append_wrapped(rows, name + ": " + partners(nets, pages, page, neighbours[piece], with_numbers),
                       width);
      }
      if (rows.size() <= most_rows) {
        if (auto texts = room.place(table(rows))) {
          return *texts;
        }
      }
    }
  }
  return {};
}

}  // namespace ridgecraft::paper
