// SPDX-License-Identifier: GPL-3.0-or-later
// Where pieces lie after a step: where they lay, where somebody has laid them, or wherever there is room.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <variant>

#include "base/context.hpp"
#include "base/id.hpp"
#include "export/layout_around.hpp"
#include "export/sheet/pages.hpp"
#include "job/job.hpp"
#include "session/edit.hpp"
#include "session/state.hpp"

namespace ridgecraft::session {

/// Collects what is to become of each piece, then lays them out. Both states have pages; those of `after` are
/// still those of before. What it refers to must outlive it.
class Places {
 public:
  /// Each piece of the nets stays where the larger share of its faces lay, as long as they lie in its net as
  /// they lay.
  Places(const job::Paper& made, const State& before, const State& after);

  /// The piece is laid there by this edit of the step.
  void lay(std::size_t edit, const Place& place);
  /// The piece may go anywhere.
  void release(FaceId face) { kept_[after_.nets->piece[face]].reset(); }
  /// All pieces may go anywhere, but for those that are pinned.
  void release_all();

  /// Refused where a piece can't lie where it was laid, or a pinned one where it lay.
  [[nodiscard]] std::variant<paper::Pages, Refusal> pages(const Context& context) const;

 private:
  [[nodiscard]] Refusal refusal_of(const paper::NoPlace& none) const;

  const job::Paper& made_;
  const State& after_;
  IdVector<PieceId, std::optional<paper::KeptPlace>> kept_;
  std::map<PieceId, std::size_t> laid_;  ///< by which edit
};

/// Where the piece of a place has room nearby, turned as asked, without moving another: the nearest such
/// place, none within `reach_mm`. The state has pages, the face, and the page or the one before it.
[[nodiscard]] std::optional<Place> place_near(const State& state, const Place& asked, double reach_mm);

}  // namespace ridgecraft::session
