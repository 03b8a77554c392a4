// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/number_list.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

namespace ridgecraft::export_ {
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

}  // namespace ridgecraft::export_
