// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/text_scanner.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <system_error>

namespace ridgecraft::mesh {
namespace {

constexpr bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// What a decimal number that std::from_chars finds out of range stands for: infinity or zero. The sign of
/// the power of ten of its first digit decides; numbers near 1 are never out of range.
double beyond_range(std::string_view digits) {
  const bool negative = digits.starts_with('-');
  std::int64_t power = 0;
  bool seen_point = false;
  bool seen_digit = false;  // other than zero
  std::size_t i = negative ? 1 : 0;
  for (; i < digits.size() && (is_digit(digits[i]) || digits[i] == '.'); ++i) {
    if (digits[i] == '.') {
      seen_point = true;
      continue;
    }
    seen_digit = seen_digit || digits[i] != '0';
    if (!seen_point && seen_digit) {
      ++power;
    } else if (seen_point && !seen_digit) {
      --power;
    }
  }
  std::int64_t exponent = 0;
  if (i < digits.size()) {  // at the letter e
    i += i + 1 < digits.size() && digits[i + 1] == '+' ? 2U : 1U;
    const auto read = std::from_chars(digits.data() + i, digits.data() + digits.size(), exponent);
    if (read.ec == std::errc::result_out_of_range) {
      exponent = digits[i] == '-' ? std::numeric_limits<std::int64_t>::min() / 2
                                  : std::numeric_limits<std::int64_t>::max() / 2;
    }
  }
  const double size = seen_digit && power + exponent > 0 ? std::numeric_limits<double>::infinity() : 0.0;
  return negative ? -size : size;
}

constexpr char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// -1 for what is no digit of base64.
int digit64(char c) {
  if (c >= 'A' && c <= 'Z') {
    return c - 'A';
  }
  if (c >= 'a' && c <= 'z') {
    return c - 'a' + 26;
  }
  if (c >= '0' && c <= '9') {
    return c - '0' + 52;
  }
  return c == '+' || c == '-' ? 62 : c == '/' || c == '_' ? 63 : -1;
}

int digit16(char c) {
  if (c >= '0' && c <= '9') {
    return c - '0';
  }
  if (c >= 'a' && c <= 'f') {
    return c - 'a' + 10;
  }
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

}  // namespace

bool equal_ignoring_case(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) {
    return false;
  }
  if (a == b) {  // nearly always, and much faster
    return true;
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (lower(a[i]) != lower(b[i])) {
      return false;
    }
  }
  return true;
}

bool TextScanner::skip_joint() {
  const char* next = at_ + 1;
  if (next != end_ && *next == '\r') {
    ++next;
  }
  if (next != end_ && *next == '\n') {
    ++next;
  }
  if (next == at_ + 1) {
    return false;
  }
  at_ = next - 1;  // the caller steps over this one
  return true;
}

std::string_view comma_hint(std::string_view word) {
  return word.find(',') == word.npos
             ? ""
             : " (numbers need a decimal point, not a comma: export it again with English number formats)";
}

void TextScanner::skip_space(char comment_mark) {
  for (; at_ != end_; ++at_) {
    if (*at_ == comment_mark && comment_mark != '\0') {
      while (at_ != end_ && !is_line_end(*at_)) {
        ++at_;
      }
      if (at_ == end_) {
        return;
      }
    } else if (!is_blank(*at_) && !is_line_end(*at_)) {
      return;
    }
  }
}

void TextScanner::next_line() {
  const char* const start = at_;
  for (; joins_lines_ && at_ != end_ && !is_line_end(*at_); ++at_) {
    if (*at_ == '#' && (at_ == start || is_blank(at_[-1]))) {
      break;
    }
    if (*at_ == '\\') {
      skip_joint();
    }
  }
  skip_comment();
}

void TextScanner::skip_comment() {
  while (at_ != end_ && !is_line_end(*at_)) {
    ++at_;
  }
  if (at_ != end_) {
    at_ += *at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n' ? 2 : 1;
  }
}

std::string_view TextScanner::rest_of_line() {
  skip_blanks();
  const char* const first = at_;
  while (at_ != end_ && !is_line_end(*at_)) {
    ++at_;
  }
  const char* last = at_;
  while (last != first && is_blank(last[-1])) {
    --last;
  }
  return text_between(first, last);
}

std::string_view TextScanner::peek_word() const {
  const char* last = at_;
  while (last != end_ && !is_blank(*last) && !is_line_end(*last)) {
    ++last;
  }
  return text_between(at_, last);
}

std::string_view TextScanner::word() {
  skip_blanks();
  const std::string_view found = peek_word();
  at_ += found.size();
  return found;
}

bool TextScanner::number(double& value) {
  skip_blanks();
  const char* first = at_;
  if (first != end_ && *first == '+') {
    ++first;
    if (first != end_ && *first == '-') {
      return false;
    }
  }
  const auto [last, error] = std::from_chars(first, end_, value);
  if (error == std::errc::invalid_argument) {
    return false;
  }
  if (error == std::errc::result_out_of_range) {
    value = beyond_range(text_between(first, last));
  }
  const char* const start = at_;
  at_ = last;
  if (!at_word_end()) {
    at_ = start;
    return false;
  }
  return true;
}

bool TextScanner::integer(std::int64_t& value) {
  skip_blanks();
  const char* const start = at_;
  const bool negative = at_ != end_ && *at_ == '-';
  if (negative || (at_ != end_ && *at_ == '+')) {
    ++at_;
  }
  if (at_ == end_ || !is_digit(*at_)) {
    at_ = start;
    return false;
  }
  constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();
  std::int64_t size = 0;
  for (; at_ != end_ && is_digit(*at_); ++at_) {
    size = size > (largest - 9) / 10 ? largest : 10 * size + (*at_ - '0');
  }
  value = negative ? -size : size;
  return true;
}

std::optional<std::string> from_base64(std::string_view text) {
  while (text.ends_with('=')) {
    text.remove_suffix(1);
  }
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  unsigned count = 0;
  for (const char c : text) {
    const int digit = digit64(c);
    if (digit < 0) {
      return std::nullopt;
    }
    bits = bits << 6U | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes.push_back(static_cast<char>(bits >> count & 0xffU));
    }
  }
  // One digit alone is less than a byte.
  return count == 6 ? std::nullopt : std::optional(std::move(bytes));
}

std::string from_percent(std::string_view text) {
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int high = text[i] == '%' && i + 2 < text.size() ? digit16(text[i + 1]) : -1;
    const int low = high >= 0 ? digit16(text[i + 2]) : -1;
    if (low >= 0) {
      bytes.push_back(static_cast<char>(16 * high + low));
      i += 2;
    } else {
      bytes.push_back(text[i]);
    }
  }
  return bytes;
}

}  // namespace ridgecraft::mesh
