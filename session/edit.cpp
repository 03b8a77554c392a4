// SPDX-License-Identifier: GPL-3.0-or-later
#include "session/edit.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <system_error>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/error.hpp"

namespace ridgecraft::session {
namespace {

constexpr std::string_view between_edits = "; ";
/// In the order of the variant's alternatives.
constexpr std::array<std::string_view, std::variant_size_v<Edit>> verbs{"cut", "join", "tab-from", "no-tab"};

template <std::size_t... I>
Edit edit_with(std::size_t verb, const Edge& edge, std::index_sequence<I...> /*all*/) {
  Edit edit;
  ((verb == I ? static_cast<void>(edit.emplace<I>(std::variant_alternative_t<I, Edit>{edge})) : void()), ...);
  return edit;
}

std::string words_of(const Edit& edit) {
  const Edge edge = std::visit([](const auto& e) { return e.edge; }, edit);
  return fmt::format("{} {} {}", verbs.at(edit.index()), edge.from.value(), edge.to.value());
}

/// What comes before the next separator; `text` goes on behind it.
std::string_view next_of(std::string_view& text, std::string_view separator) {
  const std::size_t end = text.find(separator);
  const std::string_view found = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + separator.size());
  return found;
}

std::optional<VertexId> vertex_of(std::string_view word) {
  std::uint32_t number = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, number);
  return error == std::errc() && stop == end ? std::optional(VertexId(number)) : std::nullopt;
}

std::optional<Edit> edit_of(std::string_view words) {
  const auto verb = std::find(verbs.begin(), verbs.end(), next_of(words, " "));
  const auto from = vertex_of(next_of(words, " "));
  const auto to = vertex_of(words);
  if (!from || !to || verb == verbs.end()) {
    return std::nullopt;
  }
  return edit_with(static_cast<std::size_t>(verb - verbs.begin()), {*from, *to},
                   std::make_index_sequence<verbs.size()>());
}

}  // namespace

std::string text_of(std::span<const Edit> edits) {
  std::string text;
  for (const Edit& edit : edits) {
    text += text.empty() ? "" : between_edits;
    text += words_of(edit);
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
