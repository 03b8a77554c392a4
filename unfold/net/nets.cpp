// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/net/nets.hpp"

#include <algorithm>
#include <array>

namespace ridgecraft::unfold {

namespace {

struct ReasonNames {
  std::string_view contract;
  std::string_view message;
};

/// In the order of PieceReason.
constexpr std::array reason_names{
    ReasonNames{"part", "piece_part"},           ReasonNames{"page", "piece_page"},
    ReasonNames{"overlap", "piece_overlap"},     ReasonNames{"overlap", "piece_no_net"},
    ReasonNames{"tabs", "piece_tabs"},           ReasonNames{"faces", "piece_faces"},
    ReasonNames{"time", "piece_time"},           ReasonNames{"request", "piece_request"},
    ReasonNames{"component", "piece_component"}, ReasonNames{"request", "piece_folding"},
    ReasonNames{"faces", "piece_shape"}};
static_assert(reason_names.size() == static_cast<std::size_t>(PieceReason::shape) + 1);

}  // namespace

std::string_view name(PieceReason reason) {
  return reason_names[static_cast<std::size_t>(reason)].contract;
}

std::string_view message_code(PieceReason reason) {
  return reason_names[static_cast<std::size_t>(reason)].message;
}

std::string_view name(NoTab reason) {
  static constexpr std::array<std::string_view, 8> names{
      "",           "edge_too_short", "no_room", "target_too_small", "too_little_paper", "beyond_sheet",
      "not_wanted", "time_up"};
  static_assert(names.size() == static_cast<std::size_t>(NoTab::time_up) + 1);
  return names[static_cast<std::size_t>(reason)];
}

std::string piece_name(std::size_t number) {
  std::string name;
  for (std::size_t rest = number + 1; rest > 0; rest = (rest - 1) / 26) {
    name.insert(name.begin(), static_cast<char>('A' + (rest - 1) % 26));
  }
  return name;
}

}  // namespace ridgecraft::unfold
