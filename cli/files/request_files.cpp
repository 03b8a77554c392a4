// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/request_files.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/encodings.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/model/soup.hpp"
#include "mesh/reading/files.hpp"

namespace ridgecraft::cli {
namespace {

/// The words of a line, between spaces, tabs and commas; what follows a # says nothing.
std::vector<std::string_view> words_of_line(std::string_view line) {
  constexpr std::string_view space = " \t\r,";
  std::vector<std::string_view> words;
  line = line.substr(0, line.find('#'));
  for (std::size_t begin = line.find_first_not_of(space); begin != std::string_view::npos;
       begin = line.find_first_not_of(space)) {
    line.remove_prefix(begin);
    words.push_back(line.substr(0, line.find_first_of(space)));
    line.remove_prefix(words.back().size());
  }
  return words;
}

/// Calls visit(words, number) for each line that has words; lines are counted from 1.
template <class Visit>
void for_each_line(std::string_view text, Visit visit) {
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (const std::vector<std::string_view> words = words_of_line(text.substr(0, end)); !words.empty()) {
      visit(words, number);
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

[[noreturn]] void refuse_line(const std::string& file, std::size_t line, std::string_view reason) {
  throw Error(ErrorKind::unreadable_input, fmt::format("{}, line {}: {}", file, line, reason), file);
}

std::uint32_t number_of(std::string_view word, const std::string& file, std::size_t line) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) {
    refuse_line(file, line, fmt::format("'{}' is no number of a point", word));
  }
  return value;
}

/// Pairs of points, one pair a line.
job::EdgeList pairs_in(const EdgeFile& edges, const mesh::Model& model) {
  const std::uint32_t first = mesh::first_point_number(model.format);
  job::EdgeList list{{}, digest(edges.bytes)};
  for_each_line(edges.bytes, [&](const std::vector<std::string_view>& words, std::size_t line) {
    std::vector<std::uint32_t> pair;
    for (const std::string_view word : words) {
      pair.push_back(number_of(word, edges.name, line));
    }
    if (pair.size() != 2) {
      refuse_line(edges.name, line, "two numbers of points are needed");
    }
    for (const std::uint32_t number : pair) {
      if (number < first || number - first >= model.file_points.size()) {
        refuse_line(edges.name, line,
                    fmt::format("the model has no point {} (its points are {} to {})", number, first,
                                model.file_points.size() - 1 + first));
      }
    }
    list.edges.push_back({pair[0] - first, pair[1] - first});
  });
  return list;
}

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

EdgeFiles read_edge_files(const EdgeArguments& edges) {
  const auto read = [](const std::string& name) -> std::optional<EdgeFile> {
    if (name.empty()) {
      return std::nullopt;
    }
    // Read before the aggregate begins: g++ 12 destroys its members twice where one of them throws.
    std::string bytes = mesh::read_file(name);
    return EdgeFile{name, std::move(bytes)};
  };
  return {read(edges.cuts), read(edges.keep), read(edges.from)};
}

std::vector<InputFile> input_files(const EdgeArguments& edges) {
  return {{"--from", edges.from}, {"--cuts", edges.cuts}, {"--keep", edges.keep}};
}

job::EdgeRequests requests_of(const EdgeFiles& files, const mesh::Model& model) {
  job::EdgeRequests requests;
  if (files.cuts) {
    requests.cut = pairs_in(*files.cuts, model);
  }
  if (files.keep) {
    requests.keep = pairs_in(*files.keep, model);
  }
  if (files.from) {
    requests.from = job::OldNets{files.from->name, files.from->bytes};
  }
  return requests;
}

std::vector<unfold::EdgeTab> read_tab_file(const std::string& name, std::string_view bytes) {
  std::vector<unfold::EdgeTab> tabs;
  for_each_line(bytes, [&](const std::vector<std::string_view>& words, std::size_t line) {
    tabs.push_back(TabLine(words, fmt::format("{}, line {}", name, line)).read());
  });
  return tabs;
}

}  // namespace ridgecraft::cli
