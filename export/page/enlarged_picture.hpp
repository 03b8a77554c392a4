// SPDX-License-Identifier: GPL-3.0-or-later
// A picture that shows a part of a piece once more, larger, and the words above it.
#pragma once

#include <string>
#include <vector>

#include "export/page/page_marks.hpp"
#include "export/page/place_marks.hpp"

namespace ridgecraft::paper {

/// A picture in a frame. Its lower left corner is the origin; all of it is page furniture, which nobody cuts.
struct Enlarged {
  Vec2 size;
  std::string words;  ///< what it is: "part of D, 3 times as large"
  PageMarks marks;
  PicturePlace shown;             ///< its page, piece and letter are for whoever has them
  bool whole = false;             ///< all of the piece is seen
  std::vector<Enlarged> smaller;  ///< the same with less around it, if it may be smaller
};

/// The picture with its letter and words above it; its size is that of all.
[[nodiscard]] Enlarged with_words(Enlarged picture);
/// What stands above a picture is no higher: six rows of words, of narrow ones.
inline constexpr double most_words_mm = 20.0;

}  // namespace ridgecraft::paper
