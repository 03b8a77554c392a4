// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/pages/content_token.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "verify/file/tolerance.hpp"
#include "verify/pages/print_form.hpp"

namespace ridgecraft::verify {
namespace {

constexpr std::string_view blanks{"\0\t\n\f\r ", 6};
constexpr std::string_view ends{"\0\t\n\f\r ()<>[]{}/%", 16};

void skip(std::string_view& bytes, std::size_t count) {
  bytes.remove_prefix(std::min(count, bytes.size()));
}

/// Blanks and comments, which go to the end of the line.
void skip_blanks(std::string_view& bytes) {
  while (true) {
    skip(bytes, std::min(bytes.find_first_not_of(blanks), bytes.size()));
    if (!bytes.starts_with('%')) {
      return;
    }
    skip(bytes, std::min(bytes.find_first_of("\r\n"), bytes.size()));
  }
}

/// "(a (b) \) c)": brackets in pairs need no backslash.
void skip_text(std::string_view& bytes) {
  int depth = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (bytes[i] == '\\') {
      ++i;
    } else if (bytes[i] == '(') {
      ++depth;
    } else if (bytes[i] == ')' && --depth == 0) {
      skip(bytes, i + 1);
      return;
    }
  }
  cannot_check("a text in its content has no end");
}

/// "<< /MCID 0 >>", with texts and dictionaries inside.
void skip_dictionary(std::string_view& bytes) {
  int depth = 0;
  do {
    skip_blanks(bytes);
    if (bytes.empty()) {
      cannot_check("a dictionary in its content has no end");
    } else if (bytes.starts_with("<<")) {
      ++depth;
      skip(bytes, 2);
    } else if (bytes.starts_with(">>")) {
      --depth;
      skip(bytes, 2);
    } else if (bytes.starts_with('(')) {
      skip_text(bytes);
    } else {
      skip(bytes, 1);
    }
  } while (depth > 0);
}

void skip_hexadecimal(std::string_view& bytes) {
  const std::size_t end = bytes.find('>');
  if (end == std::string_view::npos) {
    cannot_check("a text in its content has no end");
  }
  skip(bytes, end + 1);
}

ContentToken number_or_word(std::string_view text) {
  std::string_view digits = text;
  if (digits.starts_with('+')) {
    digits.remove_prefix(1);
  }
  ContentToken token{ContentToken::Kind::word, 0.0, text};
  const bool like_number =
      !digits.empty() && digits.find_first_not_of("0123456789.-") == std::string_view::npos;
  if (like_number) {
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), token.number, std::chars_format::fixed);
    if (error != std::errc{} || end != digits.data() + digits.size() ||
        !(std::abs(token.number) <= max_coordinate_mm)) {
      cannot_check("its content has a number that is none: {}", text.substr(0, 40));
    }
    token.kind = ContentToken::Kind::number;
  }
  return token;
}

}  // namespace

ContentToken take_token(std::string_view& bytes) {
  using Kind = ContentToken::Kind;
  skip_blanks(bytes);
  if (bytes.empty()) {
    return {};
  }
  const char first = bytes.front();
  if (first == '(') {
    skip_text(bytes);
    return {Kind::other, 0.0, {}};
  }
  if (first == '<') {
    bytes.starts_with("<<") ? skip_dictionary(bytes) : skip_hexadecimal(bytes);
    return {Kind::other, 0.0, {}};
  }
  if (first == '[' || first == ']') {
    skip(bytes, 1);
    return {first == '[' ? Kind::open_list : Kind::close_list, 0.0, {}};
  }
  const bool is_name = first == '/';
  skip(bytes, is_name ? 1 : 0);
  const std::string_view text = bytes.substr(0, bytes.find_first_of(ends));
  skip(bytes, text.size());
  if (is_name) {
    return {Kind::name, 0.0, text};
  }
  if (text.empty()) {
    cannot_check("its content has a {} where none may be", first);
  }
  return number_or_word(text);
}

}  // namespace ridgecraft::verify
