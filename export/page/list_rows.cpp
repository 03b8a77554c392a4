// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/list_rows.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "export/style/stroke_font.hpp"

namespace ridgecraft::export_ {
namespace {

constexpr std::string_view indent = "   ";

}  // namespace

void append_wrapped(std::vector<std::string>& rows, std::string_view text, double width) {
  std::string row;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word(text.substr(begin, end - begin));
    begin = end + 1;
    const std::string longer = row.empty() ? word : row + " " + word;
    if (!row.empty() && text_width(longer, table_text_height) > width) {
      rows.push_back(row);
      row = std::string(indent) + word;
    } else {
      row = longer;
    }
  }
  rows.push_back(row);
}

std::vector<Text> table(const std::vector<std::string>& rows) {
  std::vector<Text> texts;
  double y = -0.5 * table_text_height;
  for (const std::string& row : rows) {
    const std::size_t from = row.find_first_not_of(' ');
    const double left = from == 0 ? 0.0 : text_width(indent, table_text_height);
    const std::string words = row.substr(from);
    texts.push_back({Layer::mark,
                     words,
                     {left + 0.5 * text_width(words, table_text_height), y},
                     table_text_height,
                     0.0,
                     false});
    y -= table_row_height;
  }
  return texts;
}

namespace {

/// Narrower or lower paper holds no list, mm.
constexpr double least_width = 40.0;
constexpr double least_height = 20.0;

/// Numbers that stand at their edges, as they follow each other on one outline.
using Shown = std::vector<std::uint32_t>;

Shown shown_on(const PieceDrawing& piece, const std::vector<std::size_t>& rim) {
  Shown numbers;
  for (const std::size_t seam : rim) {
    if (piece.seams[seam].at == NumberAt::edge) {
      numbers.push_back(piece.seams[seam].number);
    }
  }
  return numbers;
}

/// How often these numbers follow each other on the piece's outlines.
std::size_t count_of(const Shown& wanted, const PieceDrawing& piece) {
  std::size_t count = 0;
  for (const std::vector<std::size_t>& rim : piece.rims) {
    const Shown shown = shown_on(piece, rim);
    for (std::size_t begin = 0; begin < shown.size(); ++begin) {
      std::size_t same = 0;
      while (same < wanted.size() && shown[(begin + same) % shown.size()] == wanted[same]) {
        ++same;
      }
      count += same == wanted.size() ? 1U : 0U;
    }
  }
  return count;
}

/// As many of the last numbers before a run as there have to be for one place to be meant. `around`: those on
/// the run's outline, from the first behind the run to the last before it.
Shown numbers_before(const PieceDrawing& piece, const Shown& around) {
  for (std::size_t size = 1; size < around.size(); ++size) {
    const Shown last(around.end() - static_cast<std::ptrdiff_t>(size), around.end());
    Shown place = last;
    place.push_back(around.front());
    if (count_of(place, piece) == 1) {
      return last;
    }
  }
  return around;
}

/// "13, 14"
std::string numbers_of(const PieceDrawing& piece, const std::vector<std::size_t>& run) {
  std::string text;
  for (const std::size_t seam : run) {
    text += (text.empty() ? "" : ", ") + std::to_string(piece.seams[seam].number);
  }
  return text;
}

/// "after 12 come 13, 14, then 21"
std::string words_of_run(const PieceDrawing& piece, const std::vector<std::size_t>& run,
                         const Shown& around) {
  return fmt::format("after {} {} {}, then {}", fmt::join(numbers_before(piece, around), ", "),
                     run.size() == 1 ? "comes" : "come", numbers_of(piece, run), around.front());
}

/// The words for one outline; none where all its numbers were placed.
std::vector<std::string> words_of_rim(const PieceDrawing& piece, const std::vector<std::size_t>& rim) {
  const auto is_lost = [&](std::size_t seam) { return piece.seams[seam].at != NumberAt::edge; };
  const auto is_listed = [&](std::size_t seam) { return piece.seams[seam].at == NumberAt::list; };
  const auto lost = static_cast<std::size_t>(std::count_if(rim.begin(), rim.end(), is_lost));
  if (std::ranges::none_of(rim, is_listed)) {
    return {};
  }
  const auto size = [&](std::size_t seam) {
    return length(piece.seams[seam].edge.b - piece.seams[seam].edge.a);
  };
  const bool none_placed = lost == rim.size();
  // Begins with the longest edge, or with one whose number stands on paper: no run goes over the end.
  const auto first = none_placed ? std::max_element(rim.begin(), rim.end(),
                                                    [&](auto a, auto b) { return size(a) < size(b); })
                                 : std::find_if_not(rim.begin(), rim.end(), is_lost);
  std::vector<std::size_t> around(first, rim.end());
  around.insert(around.end(), rim.begin(), first);
  if (none_placed) {
    return {"all round, from the longest edge: " + numbers_of(piece, around)};
  }
  std::vector<std::string> words;
  // Those that come before the first one clockwise are the last ones.
  Shown shown = shown_on(piece, around);
  std::ranges::rotate(shown, shown.begin() + 1);
  for (std::size_t i = 0; i < around.size();) {
    std::vector<std::size_t> run;
    for (++i; i < around.size() && is_lost(around[i]); ++i) {
      run.push_back(around[i]);
    }
    if (std::ranges::any_of(run, is_listed)) {
      words.push_back(words_of_run(piece, run, shown));
    }
    std::ranges::rotate(shown, shown.begin() + 1);
  }
  return words;
}

}  // namespace

std::string number_row(const PieceDrawing& piece) {
  std::string row;
  for (const std::vector<std::size_t>& rim : piece.rims) {
    for (const std::string& words : words_of_rim(piece, rim)) {
      row += (row.empty() ? piece.name + ": " : "; ") + words;
    }
  }
  return row;
}

bool has_room_for_lists(const Paper& paper) {
  const Vec2 area = piece_area(paper);
  return area.x >= least_width && area.y >= least_height;
}

namespace {

constexpr double index_clearance = 2.5;  ///< from lines and texts of the page, mm
constexpr double place_step = 5.0;       ///< between places that are tried, mm

/// Calls try_at(corner) for the lower left corners that a box of this size may have, the lowest ones first,
/// until it returns true.
template <class Try>
void at_places(const Box2& area, Vec2 size, Try try_at) {
  for (double y = area.low.y; y + size.y <= area.high.y; y += place_step) {
    for (double x = area.low.x; x + size.x <= area.high.x; x += place_step) {
      if (try_at(Vec2{x, y})) {
        return;
      }
    }
  }
}

}  // namespace

PageRoom::PageRoom(const Paper& paper, const std::vector<PieceDrawing>& pieces)
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
    add(piece.group.texts);
  }
}

void PageRoom::add(const std::vector<Text>& texts) {
  for (const Text& text : texts) {
    obstacles_.add(text);
  }
}

std::optional<std::vector<Text>> PageRoom::place(const std::vector<Text>& texts) const {
  Box2 box;
  std::vector<TurnedBox> from_centre;  // what each text covers around its own centre
  for (const Text& text : texts) {
    const Box2 own = box_of(text).bounds();
    box.add(own.low);
    box.add(own.high);
    Text at_origin = text;
    at_origin.centre = {};
    from_centre.push_back(box_of(at_origin));
  }
  std::optional<std::vector<Text>> found;
  at_places(area_, box.size(), [&](Vec2 corner) {
    const Vec2 shift = corner - box.low;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      if (!free(from_centre[i], texts[i].height, texts[i].centre + shift)) {
        return false;
      }
    }
    found = texts;
    for (Text& text : *found) {
      text.centre += shift;
    }
    return true;
  });
  return found;
}

bool PageRoom::free(TurnedBox text, double height, Vec2 centre) const {
  text.centre += centre;
  // The foot lies below the area: it needs no more than the distance to a line.
  return obstacles_.is_free(text, height, std::min(index_clearance, 0.5 * table_row_height),
                            index_clearance) &&
         !on_a_piece(centre);
}

bool PageRoom::on_a_piece(Vec2 p) const {
  return std::ranges::any_of(pieces_, [&](const PieceDrawing& piece) {
    return std::ranges::any_of(piece.faces, [&](const std::array<Vec2, 3>& f) {
      return cross(f[1] - f[0], p - f[0]) >= 0.0 && cross(f[2] - f[1], p - f[1]) >= 0.0 &&
             cross(f[0] - f[2], p - f[2]) >= 0.0;
    });
  });
}

}  // namespace ridgecraft::export_
