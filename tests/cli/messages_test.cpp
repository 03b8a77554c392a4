// SPDX-License-Identifier: GPL-3.0-or-later
// The table of messages: both languages, the same gaps, and every code that the sources use.
#include <algorithm>
#include <array>
#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include <catch2/catch.hpp>

#include "base/message.hpp"
#include "mesh/model/soup.hpp"
#include "support/temporary_folder.hpp"
#include "unfold/net/nets.hpp"

using namespace ridgecraft;
namespace fs = std::filesystem;

namespace {

std::set<std::string> gaps_of(std::string_view text) {
  std::set<std::string> gaps;
  for (std::size_t at = text.find('{'); at != std::string_view::npos; at = text.find('{', at + 1)) {
    gaps.emplace(text.substr(at + 1, text.find_first_of(",|}", at) - at - 1));
  }
  return gaps;
}

/// All literals of the product's sources but those of the table.
std::string sources() {
  std::string text;
  for (const char* folder :
       {"base", "mesh", "prepare", "segment", "unfold", "export", "job", "session", "cli", "solid", "wasm"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(RIDGECRAFT_SOURCE_DIR) / folder)) {
      if (entry.path().extension() == ".cpp" && entry.path().filename() != "message_table.cpp") {
        text += ridgecraft::test::read_bytes(entry.path());
      }
    }
  }
  return text;
}

}  // namespace

TEST_CASE("each message has two languages with the same gaps, and fills them", "[messages]") {
  std::set<std::string_view> codes;
  for (const MessageRow& row : message_table()) {
    CAPTURE(row.code);
    CHECK(codes.insert(row.code).second);
    CHECK_FALSE(row.english.empty());
    CHECK_FALSE(row.german.empty());
    CHECK_FALSE(row.english.ends_with('.'));
    const std::set<std::string> gaps = gaps_of(row.english);
    CHECK(gaps == gaps_of(row.german));
    Message message(row.code);
    for (const std::string& gap : gaps) {
      message.values.emplace_back(gap, "1");
    }
    CHECK(english(message).find_first_of("{}|") == std::string::npos);
  }
}

TEST_CASE("each code that the sources name is in the table, and each of the table is named", "[messages]") {
  const std::string code = sources();
  std::set<std::string> known;
  const auto is_composed = [](std::string_view row) {
    return std::ranges::any_of(std::array<std::string_view, 4>{"no_tab_", "repair_", "cuts_", "keeps_"},
                               [&](std::string_view begin) { return row.starts_with(begin); });
  };
  for (const MessageRow& row : message_table()) {
    known.emplace(row.code);
    CAPTURE(row.code);
    CHECK((is_composed(row.code) || code.find('"' + std::string(row.code) + '"') != std::string::npos));
  }
  // The first words of a message, which may be chosen between.
  const std::regex use(R"re(Message\(([^{;]*?)(?:, \{|\)|;))re");
  const std::regex literal(R"re("([a-z_0-9]+)")re");
  std::size_t uses = 0;
  for (std::sregex_iterator at(code.begin(), code.end(), use), end; at != end; ++at) {
    const std::string first = (*at)[1];
    if (first.find('+') != std::string::npos) {
      continue;  // composed of a kind's name
    }
    for (std::sregex_iterator word(first.begin(), first.end(), literal); word != end; ++word) {
      ++uses;
      CAPTURE(first);
      CHECK(known.contains((*word)[1]));
    }
  }
  CHECK(uses > 50);
}

TEST_CASE("kinds that are named by what they are have messages", "[messages]") {
  for (int i = 0; i <= static_cast<int>(mesh::RepairKind::narrow_faces); ++i) {
    CHECK_FALSE(english(mesh::message({static_cast<mesh::RepairKind>(i), 2, ""})).empty());
  }
  for (int i = 1; i <= static_cast<int>(unfold::NoTab::time_up); ++i) {
    CHECK_FALSE(english(Message("no_tab_" + std::string(name(static_cast<unfold::NoTab>(i))))).empty());
  }
}

TEST_CASE("gaps are filled by numbers, options and items", "[messages]") {
  CHECK(english(Message("split_for_tabs", {{"n", 1}})) == "1 piece was split off for tabs");
  CHECK(english(Message("repair_points_joined", {{"n", 24}})) == "24 points at equal places were joined");
  CHECK(english(Message("option_word", {{"option", "--grain"},
                                        {"words", plain_items({"any", "long", "short"})},
                                        {"text", "up"}})) == "--grain takes any, long or short, not 'up'");
  CHECK(english(
            Message("options_exclude", {option_value("a", "tabs", "none"), option_value("b", "bed", "")})) ==
        "--tabs none and --bed exclude each other");
}
