// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/list_pages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "export/page/number_list.hpp"
#include "export/page/text_table.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::export_ {
namespace {

/// Of small letters; the last are those of lists beside pieces.
constexpr std::array<double, 3> letters_mm{2.6, 2.2, table_text_height};
constexpr double row_share = table_row_height / table_text_height;
constexpr double least_column_mm = 75.0;
constexpr double column_gap_mm = 8.0;
constexpr double heading_share = 1.15;  ///< height of headings, of the letters'
constexpr double entry_share = 1.3;     ///< of the lines that entries begin with
constexpr double indent_share = 2.0;
constexpr double after_heading_share = 0.9;  ///< of a row
constexpr double before_entry_share = 0.45;

constexpr std::string_view kind_list_heading = "which pieces are alike";

enum class Kind { heading, entry, words };

/// A line of a column.
struct ListLine {
  Kind kind = Kind::words;
  std::string text;
  bool begins = true;  ///< not the rest of a longer one
};

/// Rows of words under a heading.
struct RowList {
  std::string_view heading;
  std::vector<std::string> rows;
};

class Setter {
 public:
  Setter(const Paper& paper, double letters) : area_(piece_box(paper)), letters_(letters) {
    const double width = area_.size().x;
    columns_ = std::max(1.0, std::floor((width + column_gap_mm) / (least_column_mm + column_gap_mm)));
    width_ = (width - (columns_ - 1.0) * column_gap_mm) / columns_;
  }

  std::vector<std::vector<Text>> set(const std::vector<RowList>& lists) {
    for (const RowList& list : lists) {
      const std::vector<ListLine> heading = wrapped_as(Kind::heading, list.heading, full_width());
      const std::vector<ListLine> lines = lines_of(list.rows);
      bool begun = false;
      for (std::size_t i = 0; i < lines.size(); ++i) {
        // An entry's own line stands above another one.
        double needed = height_of(lines[i]);
        needed += lines[i].kind == Kind::entry && i + 1 < lines.size() ? height_of(lines[i + 1]) : 0.0;
        if (!begun) {
          begin_list(heading, needed);
          begun = true;
        } else if (y_ - needed < area_.low.y) {
          next_column(heading);
        }
        put(lines[i]);
      }
    }
    return std::move(pages_);
  }

 private:
  [[nodiscard]] double row() const { return row_share * letters_; }
  [[nodiscard]] double letters_of(Kind kind) const {
    return letters_ * (kind == Kind::heading ? heading_share : kind == Kind::entry ? entry_share : 1.0);
  }
  [[nodiscard]] double indent_of(const ListLine& line) const {
    return line.kind != Kind::words ? 0.0 : indent_share * letters_ * (line.begins ? 1.0 : 2.0);
  }
  [[nodiscard]] double height_of(const ListLine& line) const {
    return row_share * letters_of(line.kind) +
           (line.kind == Kind::entry && line.begins ? before_entry_share * row() : 0.0);
  }

  [[nodiscard]] std::vector<ListLine> wrapped_as(Kind kind, std::string_view text, double width) const {
    const double indent = kind == Kind::words ? indent_share * letters_ : 0.0;
    std::vector<std::string> rows;
    append_wrapped(rows, text, (width - indent) * table_text_height / letters_of(kind));
    std::vector<ListLine> lines;
    for (const std::string& row : rows) {
      lines.push_back({kind, row.substr(row.find_first_not_of(' ')), lines.empty()});
    }
    return lines;
  }

  /// "page 2, E: between 12 and 21: 13, 14; after 3: 4" is an entry with two lines below.
  [[nodiscard]] std::vector<ListLine> lines_of(const std::vector<std::string>& rows) const {
    std::vector<ListLine> lines;
    const auto add = [&](Kind kind, std::string_view text) {
      const std::vector<ListLine> own = wrapped_as(kind, text, width_);
      lines.insert(lines.end(), own.begin(), own.end());
    };
    for (const std::string& row : rows) {
      const std::size_t colon = std::min(row.find(": "), row.size());
      add(Kind::entry, row.substr(0, colon + 1));
      for (std::size_t begin = colon + 2; begin < row.size();) {
        const std::size_t end = std::min(row.find("; ", begin), row.size());
        add(Kind::words, std::string_view(row).substr(begin, end - begin));
        begin = end + 2;
      }
    }
    return lines;
  }

  [[nodiscard]] double full_width() const { return area_.size().x; }

  void begin_page() {
    pages_.emplace_back();
    y_ = area_.high.y;
    lowest_ = y_;
  }

  /// Below all that stands on the page, or on the next one. The heading stands once over all columns.
  void begin_list(const std::vector<ListLine>& heading, double needed) {
    for (const ListLine& line : heading) {
      needed += height_of(line);
    }
    needed += (1.0 + after_heading_share) * row();
    if (pages_.empty() || lowest_ - needed < area_.low.y) {
      begin_page();
    } else {
      y_ = lowest_ - row();
    }
    put_heading(heading);
  }

  void put_heading(const std::vector<ListLine>& heading) {
    column_ = 0.0;
    for (const ListLine& line : heading) {
      put(line);
    }
    y_ -= after_heading_share * row();
    columns_top_ = y_;
    at_top_ = true;
  }

  void next_column(const std::vector<ListLine>& heading) {
    column_ += 1.0;
    if (column_ < columns_) {
      y_ = columns_top_;
      at_top_ = true;
    } else {
      begin_page();
      put_heading(heading);
    }
  }

  void put(const ListLine& line) {
    y_ -= line.kind == Kind::entry && line.begins && !at_top_ ? before_entry_share * row() : 0.0;
    const double height = letters_of(line.kind);
    const double left = area_.low.x + column_ * (width_ + column_gap_mm) + indent_of(line);
    pages_.back().push_back({Layer::mark,
                             line.text,
                             {left + 0.5 * text_width(line.text, height), y_ - 0.5 * height},
                             height,
                             0.0,
                             false});
    y_ -= row_share * height;
    lowest_ = std::min(lowest_, y_);
    at_top_ = false;
  }

  Box2 area_;
  double letters_;
  double columns_ = 1.0;
  double width_ = 0.0;
  double column_ = 0.0;
  double y_ = 0.0;
  double lowest_ = 0.0;       ///< of all that stands on the page
  double columns_top_ = 0.0;  ///< of the list's columns
  bool at_top_ = true;
  std::vector<std::vector<Text>> pages_;
};

/// "2 equal: A, B" is an entry with a line; "A and B are mirror images" gets an entry for all of them.
std::vector<std::string> rows_of_kinds(const std::vector<std::string>& kinds) {
  std::vector<std::string> rows;
  std::string others;
  for (const std::string& kind : kinds) {
    if (kind.find(": ") != std::string::npos) {
      rows.push_back(kind);
    } else {
      others += (others.empty() ? "in pairs: " : "; ") + kind;
    }
  }
  if (!others.empty()) {
    rows.push_back(std::move(others));
  }
  return rows;
}

}  // namespace

std::vector<std::vector<Text>> list_pages(const PageLists& left, const Paper& paper) {
  const std::vector<RowList> lists{{number_list_heading, left.numbers},
                                   {partner_list_heading, left.partners},
                                   {kind_list_heading, rows_of_kinds(left.kinds)}};
  std::vector<std::vector<Text>> fewest = Setter(paper, letters_mm.back()).set(lists);
  for (const double letters : letters_mm) {
    std::vector<std::vector<Text>> larger = Setter(paper, letters).set(lists);
    if (larger.size() <= fewest.size()) {
      return larger;
    }
  }
  return fewest;
}

}  // namespace ridgecraft::export_
