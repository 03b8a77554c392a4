// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/tab_file.hpp"

#include <charconv>
#include <numbers>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/length_text.hpp"
#include "cli/files/text_lines.hpp"

namespace ridgecraft::cli {
namespace {

class TabLine {
 public:
  TabLine(const std::vector<std::string_view>& words, std::string where)
      : where_(std::move(where)), words_(words) {}

  [[nodiscard]] unfold::EdgeTab read() const {
    unfold::EdgeTab tab;
    tab.where = where_;
    tab.number = number(words_.front());
    if (words_.size() == 1) {
      refuse("after the number of an edge comes none, both, height=, angle= or the name of a piece");
    }
    for (std::size_t i = 1; i < words_.size(); ++i) {
      take(words_[i], tab);
    }
    if (!tab.wanted && words_.size() > 2) {
      refuse("an edge with no tab can't have more asked of it");
    }
    return tab;
  }

 private:
  [[noreturn]] void refuse(const std::string& reason) const {
    throw Error(ErrorKind::unreadable_input, where_ + ": " + reason);
  }

  [[nodiscard]] std::uint32_t number(std::string_view word) const {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || value == 0) {
      refuse(fmt::format("'{}' is no number of an edge", word));
    }
    return value;
  }

  void take(std::string_view word, unfold::EdgeTab& tab) const {
    constexpr std::string_view height = "height=";
    constexpr std::string_view angle = "angle=";
    if (word == "none") {
      tab.wanted = false;
    } else if (word == "both") {
      tab.both = true;
    } else if (word.starts_with(height)) {
      tab.height_mm = height_of(word.substr(height.size()));
    } else if (word.starts_with(angle)) {
      tab.angle = angle_of(word.substr(angle.size()));
    } else if (word.find('=') != std::string_view::npos || !tab.piece.empty()) {
      refuse(fmt::format(
          "'{}' isn't understood; there may be none, both, height=, angle= and the name of one piece", word));
    } else {
      tab.piece = std::string(word);
    }
  }

  [[nodiscard]] double height_of(std::string_view text) const {
    std::string_view rest = text;
    const auto length = take_length(rest);
    const double mm = length && rest.empty() ? length->number * length->mm_per_unit.value_or(1.0) : 0.0;
    if (!(mm >= unfold::lowest_asked_mm && mm <= unfold::highest_asked_mm)) {
      refuse(fmt::format("height={} isn't from 1.5mm to 50mm", text));
    }
    return mm;
  }

  [[nodiscard]] double angle_of(std::string_view text) const {
    double degrees = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), degrees);
    if (error != std::errc() || end != text.data() + text.size() || !(degrees >= 15.0 && degrees <= 90.0)) {
      refuse(fmt::format("angle={} isn't a number of degrees from 15 to 90", text));
    }
    return degrees * std::numbers::pi / 180.0;
  }

  std::string where_;
  const std::vector<std::string_view>& words_;
};

}  // namespace

std::vector<unfold::EdgeTab> read_tab_file(const std::string& name, std::string_view bytes) {
  std::vector<unfold::EdgeTab> tabs;
  for_each_line(bytes, [&](const std::vector<std::string_view>& words, std::size_t line) {
    tabs.push_back(TabLine(words, fmt::format("{}, line {}", name, line)).read());
  });
  return tabs;
}

}  // namespace ridgecraft::cli
