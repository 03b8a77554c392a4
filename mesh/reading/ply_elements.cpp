// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/ply_elements.hpp"

#include <cctype>
#include <optional>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "base/text.hpp"
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

struct KnownProperty {
  std::string_view name;
  bool is_list;
  PlyRole role;
};

constexpr KnownProperty vertex_properties[] = {
    {"x", false, PlyRole::x},
    {"y", false, PlyRole::y},
    {"z", false, PlyRole::z},
    {"s", false, PlyRole::u},
    {"t", false, PlyRole::v},
    {"u", false, PlyRole::u},
    {"v", false, PlyRole::v},
    {"texture_u", false, PlyRole::u},
    {"texture_v", false, PlyRole::v},
    {"texture_s", false, PlyRole::u},
    {"texture_t", false, PlyRole::v},
    {"red", false, PlyRole::red},
    {"green", false, PlyRole::green},
    {"blue", false, PlyRole::blue},
    {"diffuse_red", false, PlyRole::red},
    {"diffuse_green", false, PlyRole::green},
    {"diffuse_blue", false, PlyRole::blue},
};
constexpr KnownProperty face_properties[] = {
    {"vertex_indices", true, PlyRole::indices},
    {"vertex_index", true, PlyRole::indices},
    {"texcoord", true, PlyRole::texture_list},
    {"texnumber", false, PlyRole::texture_number},
    {"red", false, PlyRole::red},
    {"green", false, PlyRole::green},
    {"blue", false, PlyRole::blue},
    {"diffuse_red", false, PlyRole::red},
    {"diffuse_green", false, PlyRole::green},
    {"diffuse_blue", false, PlyRole::blue},
};
constexpr KnownProperty edge_properties[] = {
    {"vertex1", false, PlyRole::first_end},
    {"vertex2", false, PlyRole::second_end},
};

std::span<const KnownProperty> known_of(PlyKind kind) {
  switch (kind) {
    case PlyKind::vertex:
      return vertex_properties;
    case PlyKind::face:
      return face_properties;
    case PlyKind::edge:
      return edge_properties;
  }
  return {};
}

}  // namespace

PlyHeader read_ply_header(const Source& source) {
  return HeaderReader(source).read();
}

PlyRoles ply_roles(const PlyElement& element, PlyKind kind) {
  const std::span<const KnownProperty> known = known_of(kind);
  PlyRoles roles;
  for (const PlyProperty& property : element.properties) {
    const auto found = std::find_if(known.begin(), known.end(), [&](const KnownProperty& k) {
      return k.name == property.name && k.is_list == property.is_list;
    });
    PlyRole role = found == known.end() ? PlyRole::skipped : found->role;
    if (kind == PlyKind::edge && !is_integer(property.type)) {
      role = PlyRole::skipped;
    }
    roles.push_back(has(roles, role) ? PlyRole::skipped : role);
  }
  return roles;
}

double PlyValues::number(PlyType type) {
  if (encoding_ == PlyEncoding::ascii) {
    double value = 0.0;
    text_.skip_space('\0');
    if (!text_.number(value)) {
      refuse_word();
    }
    return value;
  }
  switch (type) {
    case PlyType::float32:
      return double{std::bit_cast<float>(static_cast<std::uint32_t>(take(type)))};
    case PlyType::float64:
      return std::bit_cast<double>(take(type));
    default:
      return static_cast<double>(take_integer(type));
  }
}

std::int64_t PlyValues::integer(PlyType type) {
  if (encoding_ != PlyEncoding::ascii) {
    return take_integer(type);
  }
  std::int64_t value = 0;
  text_.skip_space('\0');
  if (!text_.integer(value) || !text_.at_word_end()) {
    refuse_word();
  }
  return value;
}

std::int64_t PlyValues::list_length(const PlyProperty& property) {
  const std::int64_t length = integer(property.length_type);
  // In text a value has at least a digit and a blank, of which the last may be missing.
  const auto room =
      static_cast<std::int64_t>(encoding_ == PlyEncoding::ascii ? (text_.rest().size() + 1) / 2
                                                                : rest().size() / size_of(property.type));
  if (length < 0) {
    refuse(ErrorKind::unreadable_input, fmt::format("a list has {} entries", length));
  }
  if (length > room) {
    refuse(ErrorKind::unreadable_input,
           fmt::format(
               "a list has {} entries, more than the {} bytes that follow can hold; the file may be cut off",
               length, rest().size()));
  }
  return length;
}

void PlyValues::skip(PlyType type) {
  if (encoding_ != PlyEncoding::ascii) {
    (void)take(type);
    return;
  }
  text_.skip_space('\0');
  if (text_.word().empty()) {
    refuse_end();
  }
}

void PlyValues::skip(const PlyProperty& property) {
  if (!property.is_list) {
    skip(property.type);
    return;
  }
  const std::int64_t length = list_length(property);
  if (encoding_ != PlyEncoding::ascii) {
    at_ += length * static_cast<std::int64_t>(size_of(property.type));
    return;
  }
  for (std::int64_t i = 0; i < length; ++i) {
    skip(property.type);
  }
}

bool PlyValues::too_few_for(const PlyElement& element) const {
  std::size_t row = 0;
  for (const PlyProperty& property : element.properties) {
    row += encoding_ == PlyEncoding::ascii ? 2
                                           : size_of(property.is_list ? property.length_type : property.type);
  }
  const std::size_t room = rest().size() + (encoding_ == PlyEncoding::ascii ? 1 : 0);
  return row > 0 && static_cast<std::uint64_t>(element.count) > room / row;
}

std::uint64_t PlyValues::take(PlyType type) {
  const std::size_t size = size_of(type);
  if (static_cast<std::size_t>(end_ - at_) < size) {
    refuse_end();
  }
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t shift = encoding_ == PlyEncoding::little_endian ? i : size - 1 - i;
    value |= std::uint64_t{static_cast<unsigned char>(at_[i])} << (8 * shift);
  }
  at_ += size;
  return value;
}

std::int64_t PlyValues::take_integer(PlyType type) {
  const std::uint64_t value = take(type);
  switch (type) {
    case PlyType::int8:
      return static_cast<std::int8_t>(value);
    case PlyType::int16:
      return static_cast<std::int16_t>(value);
    case PlyType::int32:
      return static_cast<std::int32_t>(value);
    default:
      return static_cast<std::int64_t>(value);
  }
}

void PlyValues::refuse(ErrorKind kind, std::string_view reason) const {
  const std::string of = fmt::format("{} {} of {}", shortened(element_->name), number_ + 1, element_->count);
  if (encoding_ == PlyEncoding::ascii) {
    source_.refuse_line(kind, text_.place(), fmt::format("{}: {}", of, reason));
  }
  source_.refuse_byte(kind, at_, fmt::format("{}: {}", of, reason));
}

void PlyValues::refuse_end() const {
  refuse(ErrorKind::unreadable_input, "the file ends here, it is cut off");
}

void PlyValues::refuse_word() const {
  const std::string_view word = text_.peek_word();
  if (word.empty()) {
    refuse_end();
  }
  refuse(ErrorKind::unreadable_input, fmt::format("{} is no number that belongs here", in_quotes(word)));
}

}  // namespace ridgecraft::mesh
