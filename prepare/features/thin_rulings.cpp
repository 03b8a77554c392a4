// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/features/thin_rulings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "base/vector.hpp"
#include "mesh/model/surface.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/features/choose_rulings.hpp"
#include "prepare/panels/regions.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/panels/ruled_strips.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/prepared/prepared.hpp"
#include "prepare/prepared/rolls.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {
namespace {

/// Strips across strips: once those that run one way are thinned, those across them may be.
constexpr int most_thinnings = 4;
/// Larger models are collapsed first.
constexpr std::size_t too_many_to_thin = 100000;

/// One round: strips that have nothing to do with each other, those with the narrowest faces first.
class Round {
 public:
  Round(const mesh::Model& model, const RulingRules& rules, const RollRules& rolled)
      : surface_(model.surface),
        loose_(mesh::take_apart(model)),
        panels_(find_panels(surface_)),
        regions_(surface_, panels_, loose_) {
    const std::vector<bool> rolls = rolled_regions(rolled);
    const std::vector<Box3> box = mesh::component_bounds(surface_);
    for (RuledStrip& strip : ruled_strips(surface_, regions_, loose_)) {
      const FaceId face(regions_.faces(strip.regions.front().front()).front());
      RulingRules own = rules;
      own.largest_mm = std::min(rules.largest_mm, move_allowed(box[surface_.component(face).value()]));
      own.rolled = std::all_of(strip.regions.begin(), strip.regions.end(), [&](const auto& across) {
        return std::all_of(across.begin(), across.end(), [&](std::uint32_t region) { return rolls[region]; });
      });
      ChosenRulings chosen = choose_rulings(surface_, strip, own);
      if (!chosen.gone.empty()) {
        wishes_.push_back({std::move(strip), std::move(chosen), {}, {}});
        look_up(wishes_.back());
      }
    }
    std::stable_sort(wishes_.begin(), wishes_.end(),
                     [](const Wish& a, const Wish& b) { return a.chosen.narrowest < b.chosen.narrowest; });
  }

  /// How many lines went. Strips beside which a region can't become what it should are left out, and all
  /// others are tried again.
  std::size_t run(mesh::Model& model) {
    while (!wishes_.empty()) {
      RegionChanges changes(loose_, regions_);
      std::vector<bool> used(regions_.count(), false);
      std::vector<std::size_t> taken;
      std::size_t lines = 0;
      for (std::size_t w = 0; w < wishes_.size(); ++w) {
        if (take(wishes_[w], changes, used)) {
          taken.push_back(w);
          lines += wishes_[w].chosen.gone.size();
        }
      }
      MergedRegions result = merged_regions(surface_, loose_, regions_, changes);
      if (result.failed.empty() && mesh::is_surface(result.faces)) {
        mesh::put_together(model, std::move(result.faces));
        return lines;
      }
      if (!leave_out(taken, result.failed)) {
        return 0;
      }
    }
    return 0;
  }

 private:
  struct Wish {
    RuledStrip strip;
    ChosenRulings chosen;
    std::vector<std::uint32_t> points;   ///< that go
    std::vector<std::uint32_t> touched;  ///< regions that lose a corner
  };

  /// Of each region, whether a band that is rolled goes through it.
  [[nodiscard]] std::vector<bool> rolled_regions(const RollRules& rules) const {
    std::vector<bool> rolled(regions_.count(), false);
    for (const Roll& roll : find_rolls(surface_, panels_, rules).rolls) {
      for (const PanelId panel : roll.panels) {
        for (const FaceId f : panels_.faces[panel]) {
          rolled[regions_.region(f.value())] = true;
        }
      }
    }
    return rolled;
  }

  static bool is_tip(const RuledStrip& strip, std::uint32_t point) {
    const auto& first = strip.lines[0].points;
    const auto& second = strip.lines[1].points;
    return !strip.loops && ((first.front() == point && second.front() == point) ||
                            (first.back() == point && second.back() == point));
  }

  void look_up(Wish& wish) const {
    for (const std::size_t l : wish.chosen.gone) {
      for (const std::uint32_t p : wish.strip.lines[l].points) {
        if (!is_tip(wish.strip, p)) {
          wish.points.push_back(p);
          for (const CornerId c : surface_.corners_at(VertexId(p))) {
            wish.touched.push_back(regions_.region(mesh::face_of(c).value()));
          }
        }
      }
    }
    std::sort(wish.touched.begin(), wish.touched.end());
    wish.touched.erase(std::unique(wish.touched.begin(), wish.touched.end()), wish.touched.end());
  }

  /// Marks what goes, unless it has to do with the regions of a strip that came before.
  static bool take(const Wish& wish, RegionChanges& changes, std::vector<bool>& used) {
    const auto is_used = [&](std::uint32_t region) { return used[region]; };
    const auto& between = wish.strip.regions;
    if (std::any_of(wish.touched.begin(), wish.touched.end(), is_used) ||
        std::any_of(between.begin(), between.end(), [&](const auto& regions) {
          return std::any_of(regions.begin(), regions.end(), is_used);
        })) {
      return false;
    }
    for (const auto& regions : between) {
      for (const std::uint32_t region : regions) {
        used[region] = true;
      }
    }
    for (const std::uint32_t p : wish.points) {
      changes.gone[p] = true;
    }
    for (const std::size_t l : wish.chosen.gone) {
      const auto& before = between[(l + between.size() - 1) % between.size()];
      for (std::size_t t = 0; t < before.size(); ++t) {
        changes.sets.join(before[t], between[l][t]);
      }
    }
    return true;
  }

  /// Whether there were any such wishes.
  bool leave_out(const std::vector<std::size_t>& taken, const std::vector<std::uint32_t>& failed) {
    std::vector<bool> bad(regions_.count(), false);
    for (const std::uint32_t region : failed) {
      bad[region] = true;
    }
    bool any = false;
    for (std::size_t k = taken.size(); k-- > 0;) {
      const auto& touched = wishes_[taken[k]].touched;
      if (std::any_of(touched.begin(), touched.end(), [&](std::uint32_t region) { return bad[region]; })) {
        wishes_.erase(wishes_.begin() + static_cast<std::ptrdiff_t>(taken[k]));
        any = true;
      }
    }
    return any;
  }

  const mesh::Surface& surface_;
  mesh::LooseFaces loose_;
  Panels panels_;
  PanelRegions regions_;
  std::vector<Wish> wishes_;
};

}  // namespace

std::size_t thin_rulings(mesh::Model& model, const SimplifyOptions& options, double largest_mm,
                         const Context& context) {
  if (model.surface.face_count() > too_many_to_thin) {
    return 0;
  }
  const RulingRules rules{options.short_edge_mm, largest_mm,
                          PanelTolerance{}.distance * model.surface.bounds().diagonal()};
  std::size_t all = 0;
  for (int round = 0; round < most_thinnings; ++round) {
    context.check();
    const std::size_t lines = Round(model, rules, options.rolls).run(model);
    if (lines == 0) {
      break;
    }
    all += lines;
    remesh_panels(model, context);
  }
  return all;
}

}  // namespace ridgecraft::prepare
