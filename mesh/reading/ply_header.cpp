// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/ply_header.hpp"

#include <cctype>
#include <optional>

#include <fmt/format.h>

#include "base/printable.hpp"
#include "mesh/reading/text_scanner.hpp"

namespace ridgecraft::mesh {
namespace {

std::optional<PlyType> type_of(std::string_view word) {
  // The first column is Turk's, the second that of later programs.
  static constexpr std::string_view names[][2] = {
      {"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"},   {"ushort", "uint16"},
      {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"}};
  for (std::size_t i = 0; i < std::size(names); ++i) {
    if (word == names[i][0] || word == names[i][1]) {
      return static_cast<PlyType>(i);
    }
  }
  return std::nullopt;
}

class HeaderReader {
 public:
  explicit HeaderReader(const Source& source) : source_(source), text_(source.bytes) {}

  PlyHeader read();

 private:
  bool read_line();
  void read_format();
  void read_element();
  void read_property();
  void read_comment();
  /// Before the elements some programs say who wrote the file, without the word comment.
  [[nodiscard]] bool is_remark(std::string_view keyword) const {
    return header_.elements.empty() && std::isalpha(static_cast<unsigned char>(keyword.front())) != 0;
  }
  PlyType read_type();
  void skip_line_end();
  [[noreturn]] void refuse(const char* place, std::string_view reason) {
    source_.refuse_line(ErrorKind::unreadable_input, place, reason);
  }

  const Source& source_;
  TextScanner text_;
  PlyHeader header_;
  bool has_format_ = false;
  bool ends_in_cr_ = false;  ///< lines of the header end in CR alone, so a LF after it belongs to the body
};

PlyHeader HeaderReader::read() {
  (void)text_.rest_of_line();
  ends_in_cr_ = text_.rest().starts_with('\r') && !text_.rest().starts_with("\r\n");
  do {
    skip_line_end();
    if (text_.done()) {
      source_.refuse(ErrorKind::unreadable_input, "is cut off: its header has no end_header");
    }
  } while (read_line());
  skip_line_end();
  if (!has_format_) {
    source_.refuse(ErrorKind::unreadable_input, "is no PLY file: its header has no format line");
  }
  header_.body = text_.rest();
  return std::move(header_);
}

void HeaderReader::skip_line_end() {
  (void)text_.rest_of_line();
  if (!ends_in_cr_) {
    text_.next_line();
  } else if (!text_.done()) {
    text_.advance();
  }
}

/// False at end_header.
bool HeaderReader::read_line() {
  const std::string_view keyword = text_.word();
  if (keyword == "end_header") {
    return false;
  }
  if (keyword == "format") {
    read_format();
  } else if (keyword == "element") {
    read_element();
  } else if (keyword == "property") {
    read_property();
  } else if (keyword == "comment") {
    read_comment();
  } else if (!keyword.empty() && keyword != "obj_info" && !is_remark(keyword)) {
    refuse(keyword.data(),
           fmt::format("{} doesn't belong in the header; end_header may be missing", in_quotes(keyword)));
  }
  return true;
}

void HeaderReader::read_format() {
  const std::string_view word = text_.word();
  if (word == "ascii") {
    header_.encoding = PlyEncoding::ascii;
  } else if (word == "binary_little_endian") {
    header_.encoding = PlyEncoding::little_endian;
  } else if (word == "binary_big_endian") {
    header_.encoding = PlyEncoding::big_endian;
  } else {
    refuse(word.data(), fmt::format("the PLY format {} isn't known", in_quotes(word)));
  }
  has_format_ = true;
}

void HeaderReader::read_element() {
  PlyElement element;
  element.name = text_.word();
  const char* const place = text_.place();
  if (!text_.integer(element.count) || !text_.at_word_end() || element.count < 0) {
    refuse(place, fmt::format("the number of elements {} is expected", in_quotes(element.name)));
  }
  header_.elements.push_back(std::move(element));
}

PlyType HeaderReader::read_type() {
  const std::string_view word = text_.word();
  const auto type = type_of(word);
  if (!type) {
    refuse(word.data(), fmt::format("the type {} isn't known", in_quotes(word)));
  }
  return *type;
}

void HeaderReader::read_property() {
  if (header_.elements.empty()) {
    refuse(text_.place(), "a property comes before the first element");
  }
  PlyProperty property;
  text_.skip_blanks();
  if (text_.peek_word() == "list") {
    (void)text_.word();
    property.is_list = true;
    property.length_type = read_type();
    if (!is_integer(property.length_type)) {
      refuse(text_.place(), "the length of a list must be an integer");
    }
  }
  property.type = read_type();
  property.name = text_.word();
  if (property.name.empty()) {
    refuse(text_.place(), "a property has no name");
  }
  header_.elements.back().properties.push_back(property);
}

void HeaderReader::read_comment() {
  if (equal_ignoring_case(text_.word(), "TextureFile")) {
    if (const std::string_view name = text_.rest_of_line(); !name.empty()) {
      header_.pictures.push_back(name);
    }
  }
}

}  // namespace

PlyHeader read_ply_header(const Source& source) {
  return HeaderReader(source).read();
}

}  // namespace ridgecraft::mesh
