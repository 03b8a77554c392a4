// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <charconv>

#include "verify/pages/readers.hpp"

namespace ridgecraft::verify {
namespace {

struct LayerName {
  std::string_view id;
  std::string_view title;
  PrintedLayer layer;
};
constexpr std::array<LayerName, 12> layer_names{{
    {"paint", "Colours", PrintedLayer::other},
    {"tab-fill", "Tabs", PrintedLayer::other},
    {"cut", "Cut", PrintedLayer::cut},
    {"mountain", "Mountain folds", PrintedLayer::mountain},
    {"valley", "Valley folds", PrintedLayer::valley},
    {"tab-fold", "Tab folds", PrintedLayer::tab_fold},
    {"label", "Numbers", PrintedLayer::label},
    {"piece-name", "Piece names", PrintedLayer::name},
    {"mark", "Marks", PrintedLayer::mark},
    {"back", "Back", PrintedLayer::other},
    {"tab-shadow", "Tab shadows", PrintedLayer::other},
    {"glue", "Glue here", PrintedLayer::glue},
}};

std::optional<PrintedLayer> layer_named(std::string_view name, std::string_view LayerName::*member) {
  const auto found = std::find_if(layer_names.begin(), layer_names.end(),
                                  [&](const LayerName& row) { return row.*member == name; });
  return found == layer_names.end() ? std::nullopt : std::optional(found->layer);
}

/// A dash shorter than this share of the gap behind it is a dot; dots are 0.4 of it, the shortest dashes
/// 0.67.
constexpr double dot_fraction = 0.5;

/// Takes a whole number off the end of the words.
std::optional<std::size_t> take_number(std::string_view& words) {
  const std::size_t last = words.find_last_not_of("0123456789");
  const std::string_view digits = words.substr(last == std::string_view::npos ? 0 : last + 1);
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc{} || end != digits.data() + digits.size()) {
    return std::nullopt;
  }
  words.remove_suffix(digits.size());
  return number;
}

bool take_end(std::string_view& words, std::string_view end) {
  if (!words.ends_with(end)) {
    return false;
  }
  words.remove_suffix(end.size());
  return true;
}

/// What follows `start` in a text, as far as it is made of these letters; empty where there is none.
std::string word_after(std::string_view start, std::string_view letters, std::string_view text) {
  const std::size_t at = text.find(start);
  if (at == std::string_view::npos) {
    return {};
  }
  text.remove_prefix(at + start.size());
  return std::string(text.substr(0, text.find_first_not_of(letters)));
}

}  // namespace

bool is_pdf(std::string_view bytes) {
  return bytes.starts_with("%PDF-");
}

std::optional<PrintedLayer> layer_with_id(std::string_view id) {
  return layer_named(id, &LayerName::id);
}

std::optional<PrintedLayer> layer_with_title(std::string_view title) {
  return layer_named(title, &LayerName::title);
}

Pattern pattern_of(std::span<const double> dashes) {
  if (std::none_of(dashes.begin(), dashes.end(), [](double d) { return d > 0.0; })) {
    return Pattern::solid;
  }
  if (dashes.size() == 2) {
    return dashes[0] < dot_fraction * dashes[1] ? Pattern::dotted : Pattern::dashed;
  }
  return dashes.size() == 4 && dashes[0] > dashes[2] ? Pattern::dash_dot : Pattern::strange;
}

std::string preset_in(std::string_view text) {
  return word_after("preset:", "abcdefghijklmnopqrstuvwxyz-", text);
}

double thickness_in(std::string_view settings) {
  constexpr std::string_view key = "\"thickness_mm\": ";
  const std::size_t at = settings.find(key);
  double mm = 0.0;
  if (at != std::string_view::npos) {
    const char* const begin = settings.data() + at + key.size();
    std::from_chars(begin, settings.data() + settings.size(), mm);
  }
  return mm;
}

std::string digest_in(std::string_view text) {
  return word_after("ridgecraft-model:", "0123456789abcdef", text);
}

void undo_calibration(std::string_view settings, PrintedFile& file) {
  constexpr std::string_view key = "\"calibrate\": [";
  const std::size_t at = settings.find(key);
  if (at == std::string_view::npos) {
    return;
  }
  settings.remove_prefix(at + key.size());
  const char* const end = settings.data() + settings.size();
  Vec2 measured;
  const auto first = std::from_chars(settings.data(), end, measured.x);
  const bool comma = first.ec == std::errc{} && first.ptr != end && *first.ptr == ',';
  const auto second = comma ? std::from_chars(first.ptr + 1, end, measured.y) : first;
  const auto sensible = [](double mm) { return mm > 90.0 && mm < 110.0; };
  if (!comma || second.ec != std::errc{} || !sensible(measured.x) || !sensible(measured.y)) {
    cannot_check("it says that it is calibrated, but not how");
  }
  for (PrintedPage& page : file.pages) {
    const Vec2 middle = 0.5 * page.size;
    const auto undo = [&](Vec2& p) {
      p = middle + Vec2{measured.x / 100.0 * (p.x - middle.x), measured.y / 100.0 * (p.y - middle.y)};
    };
    for (std::vector<PrintedLine>* const lines : {&page.lines, &page.leaders}) {
      for (PrintedLine& line : *lines) {
        std::for_each(line.points.begin(), line.points.end(), undo);
      }
    }
    for (PrintedText& text : page.texts) {
      undo(text.from);
      undo(text.to);
    }
  }
}

void read_page_words(std::string_view words, PrintedPage& page) {
  const auto count = take_number(words);
  if (count && take_end(words, " of ")) {
    if (const auto number = take_number(words); number && take_end(words, "page ")) {
      page.number = number;
      page.count = count;
    }
  }
}

}  // namespace ridgecraft::verify
