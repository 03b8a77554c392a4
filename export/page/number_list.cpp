// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/number_list.hpp"

#include <algorithm>
#include <cstddef>

#include "export/page/text_table.hpp"

namespace ridgecraft::paper {
namespace {

/// Narrower or lower paper holds no list, mm.
constexpr double least_width = 40.0;
constexpr double least_height = 20.0;

/// "after 12: 13, 14"
std::string words_of_run(const PieceDrawing& piece, const std::vector<std::size_t>& run,
                         const std::string& where) {
  std::string text = where;
  for (std::size_t i = 0; i < run.size(); ++i) {
    text += (i == 0 ? " " : ", ") + std::to_string(piece.seams[run[i]].number);
  }
  return text;
}

/// The words for one outline; none where all its numbers were placed.
std::vector<std::string> words_of_rim(const PieceDrawing& piece, const std::vector<std::size_t>& rim) {
  const auto is_lost = [&](std::size_t seam) { return !piece.seams[seam].numbered; };
  const auto lost = static_cast<std::size_t>(std::count_if(rim.begin(), rim.end(), is_lost));
  if (lost == 0) {
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
    return {words_of_run(piece, around, "all round from the longest edge:")};
  }
  std::vector<std::string> words;
  for (std::size_t i = 0; i < around.size();) {
    std::vector<std::size_t> run;
    const std::string before = std::to_string(piece.seams[around[i]].number);
    for (++i; i < around.size() && is_lost(around[i]); ++i) {
      run.push_back(around[i]);
    }
    if (!run.empty()) {
      words.push_back(words_of_run(piece, run, "after " + before + ":"));
    }
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

std::vector<std::vector<Text>> number_pages(const std::vector<std::string>& rows, const Paper& paper) {
  const Box2 area = piece_box(paper);
  const auto most = static_cast<std::size_t>((area.high.y - area.low.y) / table_row_height);
  std::vector<std::string> heading;
  append_wrapped(heading, number_list_heading, area.high.x - area.low.x);
  std::vector<std::string> lines;
  for (const std::string& row : rows) {
    append_wrapped(lines, row, area.high.x - area.low.x);
  }
  std::vector<std::vector<Text>> pages;
  const std::size_t per_page = most - heading.size();
  for (std::size_t begin = 0; begin < lines.size(); begin += per_page) {
    std::vector<std::string> page = heading;
    page.insert(page.end(), lines.begin() + static_cast<std::ptrdiff_t>(begin),
                lines.begin() + static_cast<std::ptrdiff_t>(std::min(begin + per_page, lines.size())));
    pages.push_back(table(page));
    for (Text& text : pages.back()) {
      text.centre += Vec2{area.low.x, area.high.y};
    }
  }
  return pages;
}

}  // namespace ridgecraft::paper
