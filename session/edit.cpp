// SPDX-License-Identifier: GPL-3.0-or-later
#include "session/edit.hpp"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "base/error.hpp"
#include "job/job.hpp"

namespace ridgecraft::session {
namespace {

constexpr std::string_view between_edits = "; ";

std::string words_with(std::string_view verb, const Edge& edge) {
  return fmt::format("{} {} {}", verb, edge.from.value(), edge.to.value());
}

std::string words_of(const Cut& edit) {
  return words_with("cut", edit.edge);
}
std::string words_of(const Join& edit) {
  return words_with("join", edit.edge);
}
std::string words_of(const TabFrom& edit) {
  return words_with("tab-from", edit.edge);
}
std::string words_of(const NoTab& edit) {
  return words_with("no-tab", edit.edge);
}
std::string words_of(const TabShape& edit) {
  return fmt::format("{} {} {}", words_with("tab-shape", edit.edge), edit.height_mm, edit.degrees);
}
std::string words_of(const BothTabs& edit) {
  return words_with("both-tabs", edit.edge);
}
std::string words_of(const Place& edit) {
  return fmt::format("place {} {} {} {} {}", edit.face.value(), edit.page + 1, edit.at.x, edit.at.y,
                     edit.degrees);
}
std::string words_of(const Pin& edit) {
  return fmt::format("pin {}", edit.face.value());
}
std::string words_of(const Unpin& edit) {
  return fmt::format("unpin {}", edit.face.value());
}
std::string words_of(const Retry& edit) {
  return fmt::format("retry {} {}", edit.face.value(), edit.seed);
}
std::string words_of(const Pack& edit) {
  std::string words(job::laid_out_anew);
  for (const FaceId face : edit.faces) {
    words += fmt::format(" {}", face.value());
  }
  return words;
}

std::string words_of(const Number& /*edit*/) {
  return "number";
}

/// What comes before the next separator; `text` goes on behind it.
std::string_view next_of(std::string_view& text, std::string_view separator) {
  const std::size_t end = text.find(separator);
  const std::string_view found = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + separator.size());
  return found;
}

/// The numbers of one edit, one after the other. What isn't in form is remembered, not thrown.
class Numbers {
 public:
  explicit Numbers(std::string_view words) : rest_(words) {}

  template <class Number>
  Number next() {
    Number number{};
    const std::string_view word = next_of(rest_, " ");
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, number);
    good_ = good_ && error == std::errc() && stop == end;
    return number;
  }
  double next_finite() {
    const double number = next<double>();
    good_ = good_ && std::isfinite(number);
    return number;
  }
  FaceId next_face() { return FaceId(next<std::uint32_t>()); }
  Edge next_edge() {
    const VertexId from(next<std::uint32_t>());
    return {from, VertexId(next<std::uint32_t>())};
  }
  std::uint32_t next_page() {
    const auto page = next<std::uint32_t>();
    good_ = good_ && page > 0;
    return page - 1;
  }
  [[nodiscard]] bool more() const { return !rest_.empty(); }
  [[nodiscard]] bool all_read() const { return good_ && rest_.empty(); }

 private:
  std::string_view rest_;
  bool good_ = true;
};

/// None for a verb that isn't one.
std::optional<Edit> edit_with(std::string_view verb, Numbers& numbers) {
  if (verb == "cut") {
    return Cut{numbers.next_edge()};
  }
  if (verb == "join") {
    return Join{numbers.next_edge()};
  }
  if (verb == "tab-from") {
    return TabFrom{numbers.next_edge()};
  }
  if (verb == "no-tab") {
    return NoTab{numbers.next_edge()};
  }
  if (verb == "tab-shape") {
    const Edge edge = numbers.next_edge();
    const double height = numbers.next_finite();
    return TabShape{edge, height, numbers.next_finite()};
  }
  if (verb == "both-tabs") {
    return BothTabs{numbers.next_edge()};
  }
  if (verb == "place") {
    Place place;
    place.face = numbers.next_face();
    place.page = numbers.next_page();
    place.at.x = numbers.next_finite();
    place.at.y = numbers.next_finite();
    place.degrees = numbers.next_finite();
    return place;
  }
  if (verb == "pin") {
    return Pin{numbers.next_face()};
  }
  if (verb == "unpin") {
    return Unpin{numbers.next_face()};
  }
  if (verb == "retry") {
    const FaceId face = numbers.next_face();
    return Retry{face, numbers.next<std::uint64_t>()};
  }
  if (verb == "number") {
    return Number{};
  }
  if (verb == job::laid_out_anew) {
    Pack pack;
    while (numbers.more()) {
      pack.faces.push_back(numbers.next_face());
    }
    return pack;
  }
  return std::nullopt;
}

std::optional<Edit> edit_of(std::string_view words) {
  const std::string_view verb = next_of(words, " ");
  Numbers numbers(words);
  std::optional<Edit> edit = edit_with(verb, numbers);
  return numbers.all_read() ? edit : std::nullopt;
}

}  // namespace

std::string text_of(std::span<const Edit> edits) {
  std::string text;
  for (const Edit& edit : edits) {
    text += text.empty() ? "" : between_edits;
    text += std::visit([](const auto& e) { return words_of(e); }, edit);
  }
  return text;
}

std::vector<std::vector<Edit>> steps_of(std::string_view text) {
  std::vector<std::vector<Edit>> steps;
  while (!text.empty()) {
    const std::string_view line = next_of(text, "\n");
    std::vector<Edit>& step = steps.emplace_back();
    for (std::string_view rest = line; !rest.empty();) {
      const std::optional<Edit> edit = edit_of(next_of(rest, between_edits));
      if (!edit) {
        throw Error(ErrorKind::unreadable_input, fmt::format("no step of edits: \"{}\"", line));
      }
      step.push_back(*edit);
    }
  }
  return steps;
}

}  // namespace ridgecraft::session
