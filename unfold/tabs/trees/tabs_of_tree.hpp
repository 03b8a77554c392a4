// SPDX-License-Identifier: GPL-3.0-or-later
// What the faces behind which tabs are glued allow, whatever the net: known before any search.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/search/forest.hpp"
#include "unfold/tabs/place/sites.hpp"
#include "unfold/tabs/shape/shapes.hpp"

namespace ridgecraft::unfold {

/// Per side of a patch, for a tab that grows from it.
struct TabTargets {
  std::vector<std::vector<Obstacle>>
      outline;                       ///< of the panel it is glued behind, near the edge; frame of tab shapes
  std::vector<ConvexShape> largest;  ///< usable and inside that panel or, where it is too narrow, across
                                     ///< slight folds; empty if there is none
  /// Folds (one side of each) behind which `largest` lies beside that panel: it needs them to be folds. None
  /// where the panel alone is wide enough.
  std::vector<std::vector<std::uint32_t>> across;
  /// 1 where the edge leads out of the patch and this side is the one that should give the tab: the smaller
  /// panel, unless only the other one has a target large enough.
  std::vector<std::uint8_t> seam;
};

/// Panels are taken as whole. Sides inside a panel and at borders of the surface have no target. O(n), but
/// for panels of very many sides.
[[nodiscard]] TabTargets find_tab_targets(const mesh::Surface& surface, const prepare::Panels& panels,
                                          const Patch& patch, const TabOptions& options);

// Numbered values that remember what they were, so that a change of many of them can be taken back.

/// A fixed number of values with a log of all that was overwritten since the last keep(). Taking back reads
/// the log and never writes to it. T must be comparable.
template <class T>
class LoggedValues {
 public:
  /// `count` default values and an empty log.
  explicit LoggedValues(std::size_t count) : now_(count) {}

  [[nodiscard]] const T& operator[](std::uint32_t i) const { return now_[i]; }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(now_.size()); }

  /// Overwrites a value; one that stays the same isn't logged.
  void set(std::uint32_t i, const T& value) {
    if (!(now_[i] == value)) {
      before_.emplace_back(i, now_[i]);
      now_[i] = value;
    }
  }

  /// From here on: what is overwritten now can't be taken back any more.
  void keep() { before_.clear(); }

  /// Makes all values what they were at the last keep(). O(values overwritten since).
  void take_back() {
    // The oldest entry of a value is the one that counts, so the newest come first.
    for (auto entry = before_.rbegin(); entry != before_.rend(); ++entry) {
      now_[entry->first] = entry->second;
    }
    before_.clear();
  }

  /// Default values for all, and nothing to take back.
  void reset() {
    now_.assign(now_.size(), T());
    before_.clear();
  }

 private:
  std::vector<T> now_;
  std::vector<std::pair<std::uint32_t, T>> before_;
};

// The tabs of a tree while the tree changes: what fits where, which are chosen, kept up to date around a
// change.

/// Usable tabs on the cuts of a net, of few shapes (shapes.hpp). Cuts to faces outside the patch
/// count where this side should give the tab. A simplification of place_tabs, which has the last word: shapes
/// are as small as usable ones can be, corners are shared where they are one vertex of the surface and lie at
/// one place, and tabs are counted, not weighed.
class TabState {
 public:
  TabState(const mesh::Surface& surface, const prepare::Panels& panels, const Patch& patch, Forest& net,
           const TabOptions& options);

  /// Chooses all tabs afresh, whatever was chosen before: they depend on the tree alone.
  void renew_all();
  /// Makes a legal move of the forest, and looks again at the tabs that this brings near other things or
  /// frees of them.
  void make(const Move& move);
  /// Takes the last move back, once: there must have been one since renew_all() or the last take_back().
  void take_back();

  /// Cuts with a usable tab.
  [[nodiscard]] std::uint32_t tabs() const { return count_.tabs; }
  /// Length of the cuts without one, mm: what a search makes as small as it can.
  [[nodiscard]] double bare_mm() const { return count_.bare_mm; }
  [[nodiscard]] bool is_cut(std::uint32_t side) const {
    return patch_.twin[side] == no_index ? targets_.seam[side] != 0
                                         : patch_.frozen[side] == 0 && net_.folds()[side] == 0;
  }
  [[nodiscard]] bool has_tab(std::uint32_t side) const { return chosen_[join_of(side)].side != no_index; }
  /// The side by which a cut is counted.
  [[nodiscard]] std::uint32_t join_of(std::uint32_t side) const {
    return patch_.twin[side] < side ? patch_.twin[side] : side;
  }
  /// The tab that grows from a side, in the frame of tab shapes; nothing if there is none.
  [[nodiscard]] const TabCandidate* tab_on(std::uint32_t side) const {
    const Choice& choice = chosen_[join_of(side)];
    return choice.side == side ? &candidates_[side][choice.shape] : nullptr;
  }

  /// Faces of a side's tree that its tabs could meet, or the tabs of; none where it can have no tab.
  [[nodiscard]] std::vector<std::uint32_t> faces_near(std::uint32_t side) const;

  /// Per side: the tabs that it may have.
  [[nodiscard]] const std::vector<std::vector<TabCandidate>>& candidates() const { return candidates_; }
  /// Per side: folds that its tabs need behind them (TabTargets::across).
  [[nodiscard]] const std::vector<std::vector<std::uint32_t>>& across() const { return targets_.across; }
  /// Per side: 1 where it leads out of the patch and should give the tab.
  [[nodiscard]] const std::vector<std::uint8_t>& seams() const { return targets_.seam; }

 private:
  struct Choice {
    std::uint32_t side = no_index;  ///< none: no tab
    std::uint32_t shape = 0;
    [[nodiscard]] bool operator==(const Choice&) const = default;
  };
  struct Count {
    std::uint32_t tabs = 0;
    double bare_mm = 0.0;
  };
  /// What the last move has to know to be taken back, beside the logs.
  struct Undo {
    Move back;    ///< takes it back; empty: there is none
    Count count;  ///< before it
  };
  using Mask = std::uint8_t;
  static_assert(most_candidates <= 8);

  [[nodiscard]] Vec2 start(std::uint32_t side) const { return net_.flat(side / 3)[side % 3]; }
  [[nodiscard]] Vec2 end(std::uint32_t side) const { return net_.flat(side / 3)[(side % 3 + 1) % 3]; }
  [[nodiscard]] Frame frame(std::uint32_t side) const;
  [[nodiscard]] Circle circle(std::uint32_t side) const;
  [[nodiscard]] bool shares(std::uint32_t vertex, Vec2 place, std::uint32_t face) const;
  [[nodiscard]] Mask free_among_faces(std::uint32_t side);
  [[nodiscard]] bool has_folds_behind(std::uint32_t side) const;
  void mark_near(const Forest::Span& span, std::uint32_t tree, bool pairs);
  void mark(std::uint32_t side);
  void mark_beside(std::uint32_t face, std::uint32_t other);
  void refresh();
  void drop_colliding();
  void fill_open();
  void choose(std::uint32_t join, const Choice& choice);
  void find_tabs_near(std::uint32_t side, std::vector<std::uint32_t>& sides);
  [[nodiscard]] bool clear(std::uint32_t a, const TabCandidate& tab_a, std::uint32_t b) const;
  [[nodiscard]] bool place(std::uint32_t join, bool may_push);
  [[nodiscard]] bool push_aside(std::uint32_t join, const Choice& choice,
                                const std::vector<std::uint32_t>& others);

  const Patch& patch_;
  Forest& net_;
  TabOptions options_;
  double reach_ = 0.0;  ///< farther from its edge no tab gets, mm
  TabTargets targets_;
  std::vector<std::uint32_t> vertex_;                  ///< of the surface, at the start of each side
  std::vector<std::vector<TabCandidate>> candidates_;  ///< per side
  std::vector<std::vector<std::uint32_t>> behind_;     ///< per join: sides whose tabs need it to be a fold
  std::vector<Circle> around_;                         ///< per side, all of them, in the side's frame
  LoggedValues<Mask> free_;                            ///< per side: candidates clear of all faces
  LoggedValues<Choice> chosen_;                        ///< per join (its smaller side)
  Count count_;                                        ///< of what is chosen
  Undo undo_;

  std::vector<std::uint32_t> marked_;  ///< sides to be looked at
  std::vector<std::uint64_t> marked_in_;
  std::uint64_t round_ = 1;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> beside_;  ///< sides whose tabs may have come together
  std::vector<std::uint32_t> open_;
};

}  // namespace ridgecraft::unfold
