// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/formats/utf8.hpp"

namespace ridgecraft::paper {
namespace {

bool forbidden(char32_t code) {
  return is_control(code) || (code & 0xFFFEU) == 0xFFFEU;
}

}  // namespace

std::vector<char32_t> code_points(std::string_view utf8) {
  std::vector<char32_t> codes;
  codes.reserve(utf8.size());
  while (!utf8.empty()) {
    const auto [code, length] = first_character(utf8);
    codes.push_back(forbidden(code) ? U' ' : code);
    utf8.remove_prefix(length);
  }
  return codes;
}

std::string printable_utf8(std::string_view utf8) {
  std::string out;
  out.reserve(utf8.size());
  for (const char32_t code : code_points(utf8)) {
    append_utf8(out, code);
  }
  return out;
}

}  // namespace ridgecraft::paper
