// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/asked_options.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/option_values.hpp"

namespace ridgecraft::job {
namespace {

/// Old words come last in a row, so these have the indices of its choices.
std::vector<std::string> words_of(const Option& row) {
  std::vector<std::string> words;
  for (const OptionChoice& choice : row.choices) {
    if (choice.means.empty()) {
      words.emplace_back(choice.word);
    }
  }
  return words;
}

}  // namespace

double number_of(const Option& row, const std::string& called, const std::string& text) {
  if (row.kind == OptionKind::length) {
    return length_or_refuse(called, text, row.low, row.high);
  }
  const double number = number_or_refuse(called, text, row.low, row.high);
  return row.kind == OptionKind::angle ? number * (std::numbers::pi / 180.0) : number;
}

const AskedOptions::Typed& AskedOptions::as_typed(std::string_view name) const {
  static const Typed nothing;
  const auto found = typed_.find(name);
  return found == typed_.end() ? nothing : found->second;
}

bool AskedOptions::given(std::string_view name) const {
  const Typed& typed = as_typed(name);
  return typed.flag || typed.off || !typed.text.empty() || !typed.texts.empty();
}

bool AskedOptions::flag(std::string_view name) const {
  return as_typed(name).flag;
}

std::string AskedOptions::text(std::string_view name) const {
  const Typed& typed = as_typed(name);
  return typed.text.empty() ? std::string(option_row(name).usual) : typed.text;
}

const std::vector<std::string>& AskedOptions::texts(std::string_view name) const {
  return as_typed(name).texts;
}

double AskedOptions::number(std::string_view name) const {
  return number_of(option_row(name), called(name), text(name));
}

std::uint64_t AskedOptions::whole(std::string_view name) const {
  const Option& row = option_row(name);
  const std::uint64_t most =
      std::isinf(row.high) ? std::numeric_limits<std::uint64_t>::max() : static_cast<std::uint64_t>(row.high);
  return whole_number_or_refuse(called(name), text(name), static_cast<std::uint64_t>(row.low), most);
}

std::size_t AskedOptions::choice(std::string_view name) const {
  const Option& row = option_row(name);
  std::string word = text(name);
  for (const OptionChoice& choice : row.choices) {
    if (choice.word == word && !choice.means.empty()) {
      word = choice.means;
    }
  }
  return word_or_refuse(called(name), word, words_of(row));
}

std::string AskedOptions::called(std::string_view name) const {
  return naming_ == Naming::command_line ? "--" + std::string(name) : std::string(option_row(name).keyword);
}

/// "all-tabs": it is given; "numbers=back": it is this.
bool AskedOptions::holds(std::string_view condition) const {
  const std::size_t equals = condition.find('=');
  const std::string_view name = condition.substr(0, equals);
  const Typed& typed = as_typed(name);
  return equals == std::string_view::npos ? given(name) && !typed.off
                                          : typed.text == condition.substr(equals + 1);
}

/// "--numbers back" or "numbers='back'"
std::string AskedOptions::told(std::string_view condition) const {
  const std::size_t equals = condition.find('=');
  std::string name = called(condition.substr(0, equals));
  if (equals == std::string_view::npos) {
    return name;
  }
  const std::string word(condition.substr(equals + 1));
  return naming_ == Naming::command_line ? name + " " + word : name + "='" + word + "'";
}

void AskedOptions::check_rules() const {
  for (const OptionRule& rule : option_rules()) {
    if (holds(rule.option) && holds(rule.other) != rule.needs) {
      refuse(told(rule.option) +
             (rule.needs ? " goes with " + told(rule.other)
                         : " and " + told(rule.other) + " exclude each other") +
             (rule.why.empty() ? "" : ": " + std::string(rule.why)));
    }
  }
}

}  // namespace ridgecraft::job
