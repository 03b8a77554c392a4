// SPDX-License-Identifier: GPL-3.0-or-later
// What the cuts of a net cost, told by the angles of its outline alone, without laying anything flat.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "unfold/net/options.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/tabs/shape/shapes.hpp"

namespace ridgecraft::unfold {

/// What comes to lie on what when a patch is mirrored or turned.
struct SideImages {
  /// Per side: a side of the edge that is its image in the patch; `no_index` where there is none, or where it
  /// is its own.
  std::vector<std::uint32_t> side;
  double weight = 1.0;  ///< as a share of Weights::mirror
};

/// What is known of a patch's sides before any of them is cut.
struct CutFacts {
  /// Per side, or empty where tabs aren't wanted: the tabs that might grow there.
  std::span<const std::vector<TabCandidate>> candidates;
  /// Per side, with candidates: folds that its tabs need behind them.
  std::span<const std::vector<std::uint32_t>> across;
  /// Per side, with candidates: 1 where it leads out of the patch and should give the tab.
  std::span<const std::uint8_t> seam;
  double clearance_mm = 0.0;  ///< of tabs
  /// With each motion there is the one back.
  std::span<const SideImages> images = {};
};

/// What an edge costs as a seam, mm: its length, more of it in the open and less in creases and hollows, less
/// where labels meet (Weights::seam, open, borders).
[[nodiscard]] double seam_price(const Patch& patch, std::uint32_t side, const Weights& weights);

/// The cuts of a net with what each costs, in mm, kept up to date while cuts and folds are swapped:
/// - its length to be glued, more of it in the open and less in creases and hollows (Weights::seam, open);
/// - less of it where colours or names of the model meet, for a fold there costs what is saved
/// (Weights::borders);
/// - its length once more where no usable tab has room (bare), and a little where only one of its sides has.
///   A tab has room when it keeps clear of the two sides of the outline that meet its edge, taken as endless;
///   what lies farther off isn't seen. A hundred times as quick as TabState;
/// - its length where it is a slit: its sides meet in the outline and open by less than 20 degrees (slits);
/// - its length where its image is no cut (mirror).
class CutCosts {
 public:
  /// The patch and the facts must outlive this.
  CutCosts(const Patch& patch, const CutFacts& facts, const Weights& weights);

  /// Takes a tree or a forest. O(n).
  void set_tree(const Folds& folds);
  /// Of all cuts, mm.
  [[nodiscard]] double total() const { return total_; }
  /// The same without what is due to room for tabs.
  [[nodiscard]] double total_without_bare() const { return total_ - bare_; }
  /// Has neither side of this cut room for a tab?
  [[nodiscard]] bool lacks_tab(std::uint32_t side) const { return cost_[join_of(side)].lacks; }
  [[nodiscard]] bool is_cut(std::uint32_t side) const { return cut_[side] != 0; }
  /// Whether an image of an edge is a cut where it isn't, or the other way round.
  [[nodiscard]] bool is_asymmetric(std::uint32_t side) const {
    return std::any_of(images_.begin(), images_.end(), [&](const SideImages& images) {
      return images.side[side] != no_index && cut_[side] != cut_[images.side[side]];
    });
  }
  /// What making `cut` a fold and `fold` a cut adds to total(); either may be nothing. Must be followed by
  /// keep() or drop(). O(1) for vertices of ordinary valence.
  [[nodiscard]] double change(std::uint32_t cut, std::uint32_t fold);
  /// How much of the last change() is due to room for tabs.
  [[nodiscard]] double change_of_bare() const { return bare_sum_; }
  /// What it costs, mm, that an edge is a cut and none of its images is, or the other way round.
  [[nodiscard]] double asymmetry_price(std::uint32_t side) const;
  [[nodiscard]] std::span<const SideImages> images() const { return images_; }
  void keep();
  void drop();
  /// Images count so many times as much from now on. O(n).
  void weigh_images(double times);

 private:
  struct Angles {
    std::array<float, most_candidates> left{};
    std::array<float, most_candidates> right{};
    std::uint32_t count = 0;
  };
  struct Cost {
    double mm = 0.0;    ///< all of it
    double bare = 0.0;  ///< what of it is due to room for tabs
    bool lacks = false;
  };
  /// The angles outside the paper at both ends of a side of the outline, and whether the edge's other side is
  /// the next one there.
  struct Ends {
    float left = 0.0F;
    float right = 0.0F;
    bool slit_left = false;
    bool slit_right = false;
  };

  [[nodiscard]] std::uint32_t join_of(std::uint32_t side) const {
    return patch_.twin[side] < side ? patch_.twin[side] : side;
  }
  void set_cut(std::uint32_t side, std::uint8_t cut);
  [[nodiscard]] Ends ends_of(std::uint32_t side) const;
  [[nodiscard]] bool has_room(std::uint32_t side, const Ends& ends) const;
  [[nodiscard]] Cost cost_of(std::uint32_t join) const;
  [[nodiscard]] double price_of_pair(std::uint32_t side, const SideImages& images) const;
  [[nodiscard]] double asymmetry(std::uint32_t side) const;
  [[nodiscard]] double asymmetry_of_changed() const;
  void note(std::uint32_t side);
  void note_neighbours(std::uint32_t side);
  void note_behind(std::uint32_t join);

  const Patch& patch_;
  const Weights weights_;
  const bool with_tabs_;
  double images_times_ = 1.0;
  std::span<const SideImages> images_;
  std::span<const std::vector<std::uint32_t>> across_;
  std::vector<std::vector<std::uint32_t>> behind_;  ///< per join: others whose tabs need it to be a fold
  std::vector<std::uint8_t> cut_;                   ///< per side: on the outline
  std::vector<std::uint8_t> seam_;
  std::vector<float> corner_angle_;  ///< per side: of its face at its start
  std::vector<double> price_;        ///< per side: as a seam, mm
  std::vector<Angles> needed_;       ///< per side: angles outside the paper that each candidate needs
  std::vector<Cost> cost_;           ///< per join (its smaller side)
  double total_ = 0.0;
  double bare_ = 0.0;

  // The swap that was rated last.
  std::uint32_t changed_cut_ = no_index;
  std::uint32_t changed_fold_ = no_index;
  std::vector<std::uint32_t>
      changed_;  ///< two edges, their neighbours on the outline, tabs that lie behind them
  std::vector<Cost> new_cost_;
  double sum_ = 0.0;
  double bare_sum_ = 0.0;
};

}  // namespace ridgecraft::unfold
