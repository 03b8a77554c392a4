// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/words.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "base/utf8.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::paper {
namespace {

Text words_at(std::string_view words, Vec2 left, double height, Weight weight) {
  Text text;
  text.layer = weight == Weight::bold ? Layer::piece_name : Layer::mark;
  text.text = words;
  text.centre = left + Vec2{0.5 * text_width(words, height), 0.5 * height};
  text.height = height;
  return text;
}

}  // namespace

Text words_from(std::string_view words, Vec2 at, double height, Weight weight) {
  return words_at(words, at, height, weight);
}

Text words_to(std::string_view words, Vec2 at, double height, Weight weight) {
  return words_at(words, at - Vec2{text_width(words, height), 0.0}, height, weight);
}

std::vector<std::string> wrapped(std::string_view words, double width, double height) {
  std::vector<std::string> rows;
  std::string row;
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(' ', begin), words.size());
    const std::string word(words.substr(begin, end - begin));
    begin = end + 1;
    const std::string longer = row.empty() ? word : row + " " + word;
    if (!row.empty() && text_width(longer, height) > width) {
      rows.push_back(row);
      row = word;
    } else {
      row = longer;
    }
  }
  if (!row.empty()) {
    rows.push_back(row);
  }
  return rows;
}

std::string shortened(std::string_view words, double width, double height) {
  if (text_width(words, height) <= width) {
    return std::string(words);
  }
  const std::vector<char32_t> codes = code_points(words);
  const auto first_codes = [&](std::size_t count) {
    std::string first;
    for (const char32_t code : std::span(codes).subspan(0, count)) {
      append_utf8(first, code);
    }
    return first + "…";
  };
  // By halves: the words may be a list of ten thousand names.
  std::size_t fitting = 0;
  for (std::size_t too_many = codes.size(); fitting + 1 < too_many;) {
    const std::size_t middle = std::midpoint(fitting, too_many);
    (text_width(first_codes(middle), height) <= width ? fitting : too_many) = middle;
  }
  return first_codes(fitting);
}

}  // namespace ridgecraft::paper
