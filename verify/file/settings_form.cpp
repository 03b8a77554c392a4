// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/file/settings_form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <variant>

#include <fmt/format.h>

#include "base/option_table.hpp"
#include "verify/file/schema.hpp"
#include "verify/file/tolerance.hpp"

namespace ridgecraft::verify {
namespace {

/// Which jobs have the setting: those with pages, those without, both; or whoever asked for it.
enum class Needed { always, with_pages, without_pages, never };

struct Known {
  Needed needed;
  bool (*fits)(const Setting& value, const Option* row);
  const Option* row = nullptr;  ///< of the option that it is the setting of, where it is that of one
};

constexpr double any = std::numeric_limits<double>::infinity();

bool is_number(const Setting& value, double low, double high) {
  const double* const number = std::get_if<double>(&value);
  return number != nullptr && *number >= low && *number <= high;
}

bool is_yes_or_no(const Setting& value, const Option* /*row*/) {
  return std::holds_alternative<bool>(value);
}

bool is_text(const Setting& value, const Option* /*row*/) {
  const std::string* const text = std::get_if<std::string>(&value);
  return text != nullptr && !text->empty();
}

bool is_hash_text(const Setting& value, const Option* /*row*/) {
  const std::string* const hash = std::get_if<std::string>(&value);
  return hash != nullptr && is_hash(*hash);
}

bool is_length(const Setting& value, const Option* /*row*/) {
  return is_number(value, 0.0, max_coordinate_mm);
}

bool is_scale(const Setting& value, const Option* /*row*/) {
  return is_number(value, std::numeric_limits<double>::min(), any);
}

bool is_sheet(const Setting& value, const Option* /*row*/) {
  const auto* const size = std::get_if<std::vector<double>>(&value);
  return size != nullptr && size->size() == 2 && (*size)[0] > 0.0 && (*size)[1] > 0.0;
}

template <const char* word>
bool is_word(const Setting& value, const Option* /*row*/) {
  const std::string* const text = std::get_if<std::string>(&value);
  return text != nullptr && *text == word;
}

bool is_choice(const Setting& value, const Option* row) {
  const std::string* const word = std::get_if<std::string>(&value);
  return word != nullptr && std::any_of(row->choices.begin(), row->choices.end(),
                                        [&](const OptionChoice& choice) { return choice.word == *word; });
}

/// A value of the option, as a setting holds it.
bool is_of_option(const Setting& value, const Option* row) {
  constexpr double angle_tolerance_deg = 1e-6;  // ten digits of what is kept in radians
  switch (row->kind) {
    case OptionKind::flag:
      return is_yes_or_no(value, row);
    case OptionKind::choice:
      return is_choice(value, row);
    case OptionKind::file:
      return is_hash_text(value, row);
    case OptionKind::length:
    case OptionKind::number:
      return is_number(value, row->low, row->high);
    case OptionKind::angle:
      return is_number(value, row->low - angle_tolerance_deg, row->high + angle_tolerance_deg);
    case OptionKind::whole: {
      const double* const number = std::get_if<double>(&value);
      return is_choice(value, row) ||
             (is_number(value, row->low, row->high) && std::floor(*number) == *number);
    }
    case OptionKind::text:
    case OptionKind::list:
      return is_text(value, row);
  }
  return false;
}

/// The setting of a list of weights begins so, and goes on with the term's name, which is the program's
/// affair.
constexpr std::string_view weight_prefix = "weigh_";

bool is_weight(const Setting& value, const Option* row) {
  return is_number(value, row->low, row->high);
}

constexpr char united[] = "united";
constexpr char apart[] = "apart";

/// Those of options, and those that no option gives.
const std::map<std::string_view, Known>& known_settings() {
  static const std::map<std::string_view, Known> all = [] {
    std::map<std::string_view, Known> known{
        {"bodies", {Needed::never, is_word<united>}},    {"standing", {Needed::never, is_word<apart>}},
        {"tabs", {Needed::always, is_yes_or_no}},        {"tab_heights", {Needed::never, is_text}},
        {"tab_angles", {Needed::never, is_text}},        {"judged_at_mm", {Needed::never, is_length}},
        {"mm_per_unit", {Needed::never, is_scale}},      {"edits", {Needed::never, is_text}},
        {"paper_mm", {Needed::with_pages, is_sheet}},    {"gap_mm", {Needed::with_pages, is_length}},
        {"whole", {Needed::without_pages, is_yes_or_no}}};
    for (const Option& row : option_table()) {
      if (row.setting == weight_prefix) {
        known[row.setting] = {Needed::with_pages, is_weight, &row};
      } else if (!row.setting.empty()) {
        known[row.setting] = {row.noted == Noted::always       ? Needed::always
                              : row.noted == Noted::with_pages ? Needed::with_pages
                                                               : Needed::never,
                              is_of_option, &row};
      }
    }
    return known;
  }();
  return all;
}

/// Nets may have got other tabs and pages since they were searched: before the name of what was another then.
constexpr std::string_view searched_prefix = "searched_";

/// None for an unknown setting.
const Known* find_known(std::string_view name) {
  const bool weight = name.starts_with(weight_prefix) && name.size() > weight_prefix.size() &&
                      std::all_of(name.begin() + weight_prefix.size(), name.end(),
                                  [](char c) { return c >= 'a' && c <= 'z'; });
  const auto found = known_settings().find(weight ? weight_prefix : name);
  return found == known_settings().end() || (name == weight_prefix) ? nullptr : &found->second;
}

bool has(const Settings& settings, std::string_view name) {
  return settings.find(name) != nullptr;
}

bool is_needed(const Known& known, bool with_pages) {
  return known.needed == Needed::always ||
         known.needed == (with_pages ? Needed::with_pages : Needed::without_pages);
}

bool is_allowed(const Known& known, bool with_pages) {
  return known.needed == Needed::never || is_needed(known, with_pages);
}

/// Settings that exclude or need each other.
void check_together(const Settings& settings, std::vector<std::string>& faults) {
  if (has(settings, "size_mm") == has(settings, "mm_per_unit")) {
    faults.emplace_back("the settings have to tell the size or the scale, and only one of them");
  }
  if (is_true(settings, "all_tabs") && !is_true(settings, "tabs")) {
    faults.emplace_back("the settings ask for all tabs and for none");
  }
  // Nets made before hold the faces that they were simplified to.
  const bool named_edges = has(settings, "cuts") || has(settings, "keep");
  const Setting* const faces = settings.find("faces");
  if (named_edges && faces != nullptr && *faces != Setting(std::string("keep"))) {
    faults.emplace_back("the settings name edges of the model, but don't keep its faces");
  }
}

}  // namespace

bool is_true(const Settings& settings, std::string_view name) {
  const Setting* const value = settings.find(name);
  const bool* const answer = value == nullptr ? nullptr : std::get_if<bool>(value);
  return answer != nullptr && *answer;
}

const Setting* searched_with(const Settings& settings, std::string_view name) {
  return settings.find(std::string(searched_prefix) + std::string(name));
}

bool is_hash(std::string_view text) {
  constexpr std::size_t fewest = 8;
  constexpr std::size_t most = 64;
  return text.size() >= fewest && text.size() <= most &&
         text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

std::vector<std::string> faults_of_settings(const Settings& settings) {
  std::vector<std::string> faults;
  const bool with_pages = !has(settings, "whole");
  for (const auto& [name, value] : settings.all) {
    const bool earlier = name.starts_with(searched_prefix);
    const Known* const known =
        find_known(std::string_view(name).substr(earlier ? searched_prefix.size() : 0));
    if (known == nullptr) {
      faults.push_back(fmt::format("the settings have {}, which nobody knows", quote(name)));
      continue;
    }
    if (!known->fits(value, known->row)) {
      faults.push_back(fmt::format("the setting \"{}\" has a value that no option takes", name));
    }
    if (!earlier && !is_allowed(*known, with_pages)) {
      faults.push_back(fmt::format("the settings can't have \"{}\"", name));
    }
  }
  for (const auto& [name, known] : known_settings()) {
    if (name != weight_prefix && is_needed(known, with_pages) && !has(settings, name)) {
      faults.push_back(fmt::format("the settings lack \"{}\"", name));
    }
  }
  check_together(settings, faults);
  return faults;
}

}  // namespace ridgecraft::verify
