// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/set/set_journal.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace ridgecraft::cli {
namespace {

constexpr std::string_view first_line = "ridgecraft journal 1";
constexpr std::string_view last_line = "end";
constexpr std::string_view forward_line = "forward";
constexpr std::string_view back_line = "back";

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
         c == '-' || c == '/';
}

std::string encoded(const std::string& name) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string text;
  for (const char c : name) {
    if (is_plain(c)) {
      text += c;
    } else {
      const auto byte = static_cast<unsigned char>(c);
      text += {'%', digits[byte >> 4U], digits[byte & 15U]};
    }
  }
  return text;
}

std::string state_text(const std::optional<FileState>& state) {
  return state ? std::to_string(state->bytes) + " " + std::to_string(state->changed_ns) : "-";
}

/// Takes a line apart, word by word; a word that isn't as it should be spoils the whole line.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}

  std::string_view next() {
    const std::size_t end = std::min(rest_.find(' '), rest_.size());
    const std::string_view word = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    good_ = good_ && !word.empty();
    return word;
  }
  template <class Number>
  Number number() {
    const std::string_view word = next();
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    good_ = good_ && error == std::errc() && end == word.data() + word.size();
    return value;
  }
  FileState state() {
    const auto bytes = number<std::int64_t>();
    return {bytes, number<std::int64_t>()};
  }
  std::optional<FileState> state_or_none() {
    if (rest_.starts_with("- ")) {
      next();
      return std::nullopt;
    }
    return state();
  }
  std::string path() {
    const std::string_view word = next();
    std::string name;
    for (std::size_t i = 0; i < word.size(); ++i) {
      if (word[i] != '%') {
        name += word[i];
        continue;
      }
      unsigned byte = 0;
      const std::string_view digits = word.substr(i + 1, 2);
      const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
      good_ = good_ && digits.size() == 2 && error == std::errc() && end == digits.data() + 2 && byte != 0;
      name += static_cast<char>(byte);
      i += 2;
    }
    return name;
  }
  /// A name in the folder itself.
  std::string name() {
    std::string name = path();
    good_ = good_ && name != "." && name != ".." && name.find('/') == std::string::npos;
    return name;
  }
  RunId id() {
    RunId id(next());
    good_ = good_ && run_of(journal_name(id)) == id;
    return id;
  }
  /// True when all words were good and none is left.
  [[nodiscard]] bool good() const { return good_ && rest_.empty(); }

 private:
  std::string_view rest_;
  bool good_ = true;
};

/// False for a line that is none of a listing's.
bool read_line(std::string_view line, SetJournal& journal) {
  Words words(line);
  const std::string_view kind = words.next();
  if (kind == "sibling") {
    Sibling sibling;
    sibling.path = words.path();
    sibling.id = words.id();
    journal.siblings.push_back(sibling);
  } else if (kind == "replace") {
    Replacement replacement;
    replacement.number = words.number<unsigned>();
    replacement.before = words.state_or_none();
    replacement.after = words.state();
    replacement.target = words.name();
    journal.replacements.push_back(replacement);
  } else if (kind == "remove") {
    Removal removal;
    removal.before = words.state();
    removal.target = words.name();
    journal.removals.push_back(removal);
  } else {
    return false;
  }
  return words.good();
}

std::vector<std::string_view> whole_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  return lines;
}

}  // namespace

std::string listing(const SetJournal& journal) {
  std::string text = std::string(first_line) + "\n";
  for (const Sibling& sibling : journal.siblings) {
    text += "sibling " + encoded(sibling.path) + " " + sibling.id + "\n";
  }
  for (const Replacement& r : journal.replacements) {
    text += "replace " + std::to_string(r.number) + " " + state_text(r.before) + " " + state_text(r.after) +
            " " + encoded(r.target) + "\n";
  }
  for (const Removal& r : journal.removals) {
    text += "remove " + state_text(r.before) + " " + encoded(r.target) + "\n";
  }
  return text + std::string(last_line) + "\n";
}

std::string decision_line(Decision decision) {
  return std::string(decision == Decision::back ? back_line : forward_line) + "\n";
}

std::optional<SetJournal> parse_journal(std::string_view text) {
  SetJournal journal;
  const std::vector<std::string_view> lines = whole_lines(text);
  if (lines.empty()) {
    return journal;
  }
  if (lines[0] != first_line) {
    return std::nullopt;
  }
  std::size_t i = 1;
  while (i < lines.size() && lines[i] != last_line) {
    if (!read_line(lines[i], journal)) {
      return std::nullopt;
    }
    ++i;
  }
  if (i == lines.size()) {
    return SetJournal{};
  }
  if (i + 1 < lines.size()) {
    // On a full disk a decision may have been written in part, and then nothing was done.
    const std::string_view last = lines.back();
    journal.decision = last == forward_line ? Decision::forward
                       : last == back_line  ? Decision::back
                                            : Decision::none;
  }
  return journal;
}

}  // namespace ridgecraft::cli
