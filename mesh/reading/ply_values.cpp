// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/ply_values.hpp"

#include <fmt/format.h>

#include "base/printable.hpp"

namespace ridgecraft::mesh {

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
