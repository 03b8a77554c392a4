// SPDX-License-Identifier: GPL-3.0-or-later
// What a run writes down before it exchanges files, and what the next one reads of it.
#include "cli/files/set/set_journal.hpp"

#include <catch2/catch.hpp>

using namespace ridgecraft::cli;

namespace {

SetJournal example() {
  SetJournal journal;
  journal.siblings = {{"../b c", new_run_id(unknown_kernel)}};
  journal.replacements = {{0, "house.pdf", std::nullopt, {1834, 1699876543210123456}},
                          {3, "a name\nwith 100 % of Füchse", FileState{0, -5}, {1, 0}}};
  journal.removals = {{"house-2.svg", {12, 13}}};
  return journal;
}

}  // namespace

TEST_CASE("a journal is read as it was written", "[set_journal]") {
  SetJournal journal = example();
  CHECK(parse_journal(listing(journal)) == journal);
  for (const Decision decision : {Decision::forward, Decision::back}) {
    journal.decision = decision;
    CHECK(parse_journal(listing(journal) + decision_line(decision)) == journal);
  }
  CHECK(parse_journal(listing(journal) + decision_line(Decision::forward) + decision_line(Decision::back)) ==
        journal);
}

TEST_CASE("a journal that was cut off anywhere has decided nothing", "[set_journal]") {
  const std::string text = listing(example()) + decision_line(Decision::forward);
  for (std::size_t length = 0; length < text.size(); ++length) {
    CAPTURE(length);
    const auto journal = parse_journal(text.substr(0, length));
    REQUIRE(journal);
    CHECK(journal->decision == Decision::none);
  }
}

TEST_CASE("what isn't a journal, or leads out of its folder, is none", "[set_journal]") {
  const auto with_line = [](const std::string& line) {
    return parse_journal("ridgecraft journal 1\n" + line + "\nend\nforward\n");
  };
  CHECK(with_line("replace 0 - 1 2 a.pdf"));
  for (const char* line : {"replace 0 - 1 2 ../a.pdf",
                           "replace 0 - 1 2 b/a.pdf",
                           "replace 0 - 1 2 ..",
                           "replace 0 - 1 2 %2E%2E",
                           "replace 0 - 1 2 a%2Fb",
                           "replace 0 - 1 2 a%00b",
                           "replace 0 - 1 2 ",
                           "replace 0 - 1 2",
                           "replace",
                           "replace 0 - 1 2 a b",
                           "replace -1 - 1 2 a",
                           "replace 0 1 2 3 a",
                           "replace 0 - 1x 2 a",
                           "replace 0 - 1 2 a%4",
                           "replace 0 - 1 2 a%zz",
                           "remove - a",
                           "remove 1 2 ../a",
                           "sibling ../b 1234",
                           "rename 1 2",
                           ""}) {
    CAPTURE(line);
    CHECK_FALSE(with_line(line));
  }
  CHECK_FALSE(parse_journal("ridgecraft journal 2\nend\nforward\n"));
  CHECK_FALSE(parse_journal("my diary\n"));
}
