// SPDX-License-Identifier: GPL-3.0-or-later
// What all folders stand on: text, lengths, disjoint sets.
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/disjoint_sets.hpp"
#include "base/random.hpp"
#include "base/text.hpp"

using namespace ridgecraft;

TEST_CASE("every code point survives UTF-8, and no surrogate does", "[base]") {
  for (char32_t code = 0; code <= 0x10FFFF; code += code < 0x3000 ? 1 : 97) {
    std::string text;
    append_utf8(text, code);
    const auto [read, length] = first_character(text + "x");
    const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
    if (read != (surrogate ? replacement_character : code) || length != (surrogate ? 1 : text.size())) {
      FAIL("U+" << std::hex << static_cast<std::uint32_t>(code));
    }
    // Cut off anywhere, it is nothing.
    for (std::size_t n = 1; n < text.size(); ++n) {
      CHECK(first_character(text.substr(0, n)).length == 1);
      CHECK(first_character(text.substr(n)).code == replacement_character);
    }
  }
}

TEST_CASE("overlong and impossible bytes are replaced one by one", "[base]") {
  for (const char* text : {"\xc0\x80", "\xe0\x80\x80", "\xf0\x80\x80\x80", "\xf4\x90\x80\x80", "\xf8\x88\x80",
                           "\xff", "\x80", "\xe2\x28\xa1"}) {
    CHECK(first_character(text).code == replacement_character);
    CHECK(first_character(text).length == 1);
  }
  CHECK(is_control(U'\x1b'));
  CHECK(is_control(0x85));
  CHECK(is_control(0x2028));
  CHECK_FALSE(is_control(U'~'));
  CHECK_FALSE(is_control(0xA0));
}

TEST_CASE("a length is a number and a unit, and what follows is left", "[base]") {
  const auto taken = [](std::string_view text) {
    const auto length = take_length(text);
    return std::pair(length ? length->number * length->mm_per_unit.value_or(1.0) : std::nan(""),
                     std::string(text));
  };
  CHECK(taken(" 8.5 in x 11") == std::pair(8.5 * 25.4, std::string("x 11")));
  CHECK(taken("2m") == std::pair(2000.0, std::string()));
  CHECK(taken("2mm") == std::pair(2.0, std::string()));
  CHECK(taken("3 inches") == std::pair(3 * 25.4, std::string()));
  CHECK(taken("-4x") == std::pair(-4.0, std::string("x")));
  CHECK(std::isnan(taken("x4").first));
  CHECK(std::isnan(taken("1e999").first));
  CHECK(unit_mm("ft") == 304.8);
  CHECK_FALSE(unit_mm("").has_value());
  CHECK_FALSE(unit_mm("mmm").has_value());
}

TEST_CASE("tasks that share a seed have sequences of their own, which stay what they are", "[base]") {
  // Nets that people have already come from these.
  CHECK(Random::stream(1, 0).next() == Random(1ULL ^ 0x9e3779b97f4a7c15ULL).next());
  CHECK(Random::stream(7, 2).next() == Random(7ULL ^ (3ULL * 0x9e3779b97f4a7c15ULL)).next());
  std::set<std::uint64_t> first;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    first.insert(Random::stream(1, i).next());
    first.insert(Random::stream(~std::uint64_t{1}, i).next());
  }
  CHECK(first.size() == 2000);
}

TEST_CASE("disjoint sets agree with labels, whatever the order of joining", "[base]") {
  Random random(7);
  for (int round = 0; round < 50; ++round) {
    constexpr std::uint32_t n = 60;
    DisjointSets sets(n);
    std::vector<std::uint32_t> label(n);
    std::iota(label.begin(), label.end(), 0U);
    for (int k = 0; k < 70; ++k) {
      const std::uint32_t a = random.below(n);
      const std::uint32_t b = random.below(n);
      const std::uint32_t low = std::min(label[a], label[b]);
      const std::uint32_t high = std::max(label[a], label[b]);
      CHECK(sets.join(a, b) == (low != high));
      for (std::uint32_t& l : label) {
        l = l == high ? low : l;
      }
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      CHECK(sets.find(i) == label[i]);
    }
  }
}

TEST_CASE("words are listed as people do", "[sentence]") {
  CHECK(listed({}, "and").empty());
  CHECK(listed({"a"}, "and") == "a");
  CHECK(listed({"a", "b"}, "or") == "a or b");
  CHECK(listed({"a", "b", "c"}, "and") == "a, b and c");
  CHECK(counted(1, "page") == "1 page");
  CHECK(counted(0, "page") == "0 pages");
}
