// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/text_table.hpp"

#include <algorithm>

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

}  // namespace ridgecraft::export_
