// SPDX-License-Identifier: GPL-3.0-or-later
// Edits of one step, one after the other, up to the state that they leave; and where pieces lie after it.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <variant>
#include <vector>

#include "base/context.hpp"
#include "base/id.hpp"
#include "export/layout_around.hpp"
#include "export/sheet/pages.hpp"
#include "job/job.hpp"
#include "job/page_layout.hpp"
#include "session/edit.hpp"
#include "unfold/edits.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"

namespace ridgecraft::session {

// Where pieces lie after a step: where they lay, where somebody has laid them, or wherever there is room.

/// Collects what is to become of each piece, then lays them out. Both states have pages; those of `after` are
/// still those of before. What it refers to must outlive it.
class Places {
 public:
  /// Each piece of the nets stays where the larger share of its faces lay, as long as they lie in its net as
  /// they lay.
  Places(const job::Result& made, const State& before, const State& after);

  /// The piece is laid there by this edit of the step.
  void lay(std::size_t edit, const Place& place);
  /// The piece may go anywhere.
  void release(FaceId face) { kept_[after_.nets->piece[face]].reset(); }
  /// All pieces may go anywhere, but for those that are pinned.
  void release_all();

  /// Refused where a piece can't lie where it was laid, or a pinned one where it lay.
  [[nodiscard]] std::variant<export_::Pages, Refusal> pages(const Context& context) const;

 private:
  [[nodiscard]] Refusal refusal_of(const export_::NoPlace& none) const;

  const job::Result& made_;
  const State& after_;
  IdVector<PieceId, std::optional<export_::KeptPlace>> kept_;
  std::map<PieceId, std::size_t> laid_;  ///< by which edit
};

/// Where the piece of a place has room nearby, turned as asked, without moving another: the nearest such
/// place, none within `reach_mm`. The state has pages, the face, and the page or the one before it.
[[nodiscard]] std::optional<Place> place_near(const State& state, const Place& asked, double reach_mm);

// Edits of one step, one after the other, up to the state that they leave.

/// A step in the making. What it refers to must outlive it.
class Draft {
 public:
  /// `made`: the job, before any edit. The context's deadline is ignored, so that equal edits always give
  /// equal bytes.
  Draft(const job::Result& made, const State& before, const Context& context);

  /// Does all edits but for tabs and places, or says why not. Takes the time of unfold/edits.hpp and
  /// unfold/edits.hpp for each.
  [[nodiscard]] std::optional<Refusal> change(std::span<const Edit> edits);

  /// Whether the nets are those from before, tabs included, so that finish() only lays out.
  [[nodiscard]] bool nets_stay() const { return !nets_ && !new_tabs_; }

  /// Then gives the nets their tabs, and each piece a place: its own, or one next to those that stay.
  [[nodiscard]] std::variant<State, Refusal> finish() const;

 private:
  using Change = std::optional<Refusal>;
  [[nodiscard]] unfold::UnfoldProblem problem() const {
    return {surface_, made_.prepared.panels, made_.part, options_};
  }
  [[nodiscard]] const unfold::Nets& nets() const { return nets_ ? *nets_ : *before_.nets; }
  [[nodiscard]] bool is_pinned(PieceId piece) const;
  [[nodiscard]] Refusal pinned_refusal(PieceId piece) const;
  [[nodiscard]] Change check_face(FaceId face) const;
  [[nodiscard]] Change change(const Cut& cut);
  [[nodiscard]] Change change(const Join& join);
  [[nodiscard]] Change change(const TabFrom& tab);
  [[nodiscard]] Change change(const NoTab& tab);
  [[nodiscard]] Change change(const TabShape& shape);
  [[nodiscard]] Change change(const BothTabs& both);
  [[nodiscard]] Change change(const Place& place);
  [[nodiscard]] Change change(const Pin& pin);
  [[nodiscard]] Change change(const Unpin& unpin);
  [[nodiscard]] Change change(const Retry& retry);
  [[nodiscard]] Change change(const Pack& pack);
  [[nodiscard]] Change change(const Number& edit);
  [[nodiscard]] Change ask_for_tab(const Edge& named, unfold::TabAt tab);
  [[nodiscard]] Change pinned_beside(EdgeId edge) const;
  [[nodiscard]] Change take(unfold::ChangedNets changed);
  [[nodiscard]] std::vector<FaceId> faces_at(EdgeId edge) const;
  [[nodiscard]] unfold::Nets with_tabs(std::vector<unfold::TabAt> as_before,
                                       const std::vector<unfold::TabAt>& asked) const;
  [[nodiscard]] Change missing_tab(const unfold::Nets& finished) const;
  [[nodiscard]] std::variant<State, Refusal> placed(State state) const;

  /// A piece that somebody laid, by which edit.
  struct Laid {
    std::size_t edit = 0;
    Place place;
  };
  /// A tab that somebody asked for, by which edit.
  struct TabEdit {
    std::size_t edit = 0;
    unfold::TabAt tab;
  };

  const job::Result& made_;
  const mesh::Surface& surface_;
  const State& before_;
  Context context_;
  unfold::Options options_;
  job::PageLabels labels_;
  std::optional<unfold::Nets> nets_;  ///< once they have changed
  bool new_tabs_ = false;
  bool numbered_ = false;  ///< names and numbers are those of the program again
  std::set<FaceId> pinned_;
  std::vector<TabEdit> tabs_;
  std::vector<Laid> laid_;
  std::vector<FaceId> packed_;
  bool all_packed_ = false;
  std::size_t edit_ = 0;  ///< which is being done
};

}  // namespace ridgecraft::session
