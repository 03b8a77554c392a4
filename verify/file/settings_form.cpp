// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/file/settings_form.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <variant>

#include <fmt/format.h>

#include "verify/file/schema.hpp"
#include "verify/file/tolerance.hpp"

namespace ridgecraft::verify {
namespace {

enum class Kind {
  yes_no,
  number,
  whole_number,
  sheet,
  hash,
  faces,
  bodies,
  standing,
  skins,
  piece_mode,
  tab_sides,
  axis,
  page_by,
  words
};

/// Which jobs have the setting: those with pages, those without, both; or whoever asked for it.
enum class Needed { always, with_pages, without_pages, never };

struct Known {
  std::string_view name;
  Kind kind;
  Needed needed;
  double low = 0.0, high = 0.0;  ///< of numbers, both included
};

constexpr double any = std::numeric_limits<double>::infinity();
/// The range of an option's values is that of the option.
constexpr std::array<Known, 38> known_settings{{
    {"seed", Kind::whole_number, Needed::always, 0.0, any},
    {"faces", Kind::faces, Needed::always},
    {"bodies", Kind::bodies, Needed::never},
    {"standing", Kind::standing, Needed::never},
    {"skins", Kind::skins, Needed::never},
    {"concavity", Kind::number, Needed::always, 0.001, 2.0},
    {"tabs", Kind::yes_no, Needed::always},
    {"tab_height_mm", Kind::number, Needed::always, 1.5, 50.0},
    {"tab_angle_deg", Kind::number, Needed::always, 15.0 - 1e-6, 90.0 + 1e-6},
    {"tab_sides", Kind::tab_sides, Needed::never},
    {"border_tabs", Kind::yes_no, Needed::never},
    {"tab_heights", Kind::words, Needed::never},
    {"tab_angles", Kind::words, Needed::never},
    {"tab_file", Kind::hash, Needed::never},
    {"all_tabs", Kind::yes_no, Needed::never},
    {"fold_linear", Kind::yes_no, Needed::never},
    {"size_mm", Kind::number, Needed::never, 1.0, 100'000.0},
    {"judged_at_mm", Kind::number, Needed::never, 1.0, 100'000.0},
    {"mm_per_unit", Kind::number, Needed::never, std::numeric_limits<double>::min(), any},
    {"up", Kind::axis, Needed::never},
    {"only", Kind::words, Needed::never},
    {"without", Kind::words, Needed::never},
    {"cuts", Kind::hash, Needed::never},
    {"keep", Kind::hash, Needed::never},
    {"from", Kind::hash, Needed::never},
    {"edits", Kind::words, Needed::never},
    {"paper_mm", Kind::sheet, Needed::with_pages},
    {"margin_mm", Kind::number, Needed::with_pages, 0.0, max_coordinate_mm},
    {"gap_mm", Kind::number, Needed::with_pages, 0.0, max_coordinate_mm},
    {"pieces", Kind::piece_mode, Needed::with_pages},
    {"max_faces", Kind::whole_number, Needed::with_pages, 0.0, any},
    {"pack", Kind::words, Needed::never},
    {"grain", Kind::words, Needed::never},
    {"page_by", Kind::page_by, Needed::never},
    {"hide_folds_deg", Kind::number, Needed::with_pages, 0.0, 180.0},
    {"thickness_mm", Kind::number, Needed::never, 0.0, 20.0},
    {"hinge", Kind::words, Needed::never},
    {"whole", Kind::yes_no, Needed::without_pages},
}};

/// The weight of any term of what a piece costs: its name is the program's affair, not the format's.
constexpr std::string_view weight_prefix = "weigh_";
constexpr Known weight{weight_prefix, Kind::number, Needed::with_pages, 0.0, 1e6};

bool is_weight(std::string_view name) {
  return name.starts_with(weight_prefix) && name.size() > weight_prefix.size() &&
         std::all_of(name.begin() + weight_prefix.size(), name.end(),
                     [](char c) { return c >= 'a' && c <= 'z'; });
}

/// Nets may have got other tabs and pages since they were searched: before the name of what was another then.
constexpr std::string_view searched_prefix = "searched_";

/// None for a setting that nobody knows.
const Known* find_known(std::string_view name) {
  if (is_weight(name)) {
    return &weight;
  }
  const auto* const known = std::find_if(known_settings.begin(), known_settings.end(),
                                         [&](const Known& k) { return k.name == name; });
  return known == known_settings.end() ? nullptr : known;
}

bool is_whole(double value) {
  return std::floor(value) == value;
}

bool number_fits(const Setting& value, double low, double high, bool whole) {
  const double* const number = std::get_if<double>(&value);
  return number != nullptr && *number >= low && *number <= high && (!whole || is_whole(*number));
}

bool word_is_one_of(const Setting& value, std::initializer_list<std::string_view> words) {
  const std::string* const word = std::get_if<std::string>(&value);
  return word != nullptr && std::find(words.begin(), words.end(), *word) != words.end();
}

bool fits(const Setting& value, const Known& known) {
  switch (known.kind) {
    case Kind::yes_no:
      return std::holds_alternative<bool>(value);
    case Kind::number:
      return number_fits(value, known.low, known.high, false);
    case Kind::whole_number:
      return number_fits(value, known.low, known.high, true);
    case Kind::sheet: {
      const auto* const size = std::get_if<std::vector<double>>(&value);
      return size != nullptr && size->size() == 2 && (*size)[0] > 0.0 && (*size)[1] > 0.0;
    }
    case Kind::hash: {
      const std::string* const hash = std::get_if<std::string>(&value);
      return hash != nullptr && is_hash(*hash);
    }
    case Kind::faces:
      return word_is_one_of(value, {"auto", "keep"}) || number_fits(value, 4.0, any, true);
    case Kind::bodies:
      return word_is_one_of(value, {"united"});
    case Kind::standing:
      return word_is_one_of(value, {"apart"});
    case Kind::skins:
      return word_is_one_of(value, {"both", "middle"});
    case Kind::piece_mode:
      return word_is_one_of(value, {"few", "parts", "small"});
    case Kind::tab_sides:
      return word_is_one_of(value, {"one-side", "alternate", "both", "slots"});
    case Kind::axis:
      return word_is_one_of(value, {"x", "y", "z"});
    case Kind::page_by:
      return word_is_one_of(value, {"material", "object"});
    case Kind::words: {
      const std::string* const words = std::get_if<std::string>(&value);
      return words != nullptr && !words->empty();
    }
  }
  return false;
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
  if (named_edges && faces != nullptr && !word_is_one_of(*faces, {"keep"})) {
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
    if (!fits(value, *known)) {
      faults.push_back(fmt::format("the setting \"{}\" has a value that no option takes", name));
    }
    if (!earlier && !is_allowed(*known, with_pages)) {
      faults.push_back(fmt::format("the settings can't have \"{}\"", name));
    }
  }
  for (const Known& known : known_settings) {
    if (is_needed(known, with_pages) && !has(settings, known.name)) {
      faults.push_back(fmt::format("the settings lack \"{}\"", known.name));
    }
  }
  check_together(settings, faults);
  return faults;
}

}  // namespace ridgecraft::verify
