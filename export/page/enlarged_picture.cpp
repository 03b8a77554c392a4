// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/enlarged_picture.hpp"

#include <algorithm>

#include "export/page/text_table.hpp"

namespace ridgecraft::paper {
namespace {

constexpr double words_gap_mm = 0.4;   ///< between the frame and what stands above it
constexpr double letter_gap_mm = 1.1;  ///< between the ring and the words beside it

}  // namespace

Enlarged with_words(Enlarged picture) {
  const std::string& letter = picture.shown.letter;
  const double radius = letter.empty() ? 0.0 : ring_radius(letter);
  const double left = letter.empty() ? 0.0 : 2.0 * radius + letter_gap_mm;
  std::vector<std::string> rows;
  append_wrapped(rows, picture.words, picture.size.x - left);
  // The first row stands at half the ring's height.
  const double drop = std::max(0.0, radius - 0.5 * table_text_height);
  const double words = drop + static_cast<double>(rows.size()) * table_row_height;
  picture.size.y += words_gap_mm + std::max(words, 2.0 * radius + words_gap_mm);
  if (!letter.empty()) {
    picture.marks.add(ringed(letter, {}), {radius, picture.size.y - radius});
  }
  picture.marks.add({table(rows), {}, {}}, {left, picture.size.y - drop});
  return picture;
}

}  // namespace ridgecraft::paper
