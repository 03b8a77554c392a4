// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/nearest_place.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>
#include <vector>

#include "base/boxes.hpp"
#include "base/elementary.hpp"
#include "export/packing/clearance.hpp"
#include "export/packing/packing_shape.hpp"
#include "export/piece_shapes.hpp"
#include "export/sheet/paper.hpp"

namespace ridgecraft::export_ {
namespace {

constexpr double nearby_step_mm = 1.0;  ///< between places that are tried

/// A convex polygon of a piece on its page.
struct PlacedBit {
  std::vector<Vec2> corners;
  Box2 box;
};

std::vector<PlacedBit> placed_bits(const PackingShape& shape, const Placement& at) {
  std::vector<PlacedBit> bits;
  for (std::vector<Vec2>& corners : placed(shape, at)) {
    const Box2 box = box_of(corners);
    bits.push_back({std::move(corners), box});
  }
  return bits;
}

/// What has to be added to a range for it to lie within another one.
double way_into(double low, double high, double least, double most) {
  return low < least ? least - low : high > most ? most - high : 0.0;
}

class NearbySearch {
 public:
  NearbySearch(const unfold::Nets& nets, const Pages& pages, PieceId piece, const Placement& held,
               double reach_mm)
      : sheet_(piece_box(pages.paper)), least_mm_(pages.paper.gap - gap_rounding_mm), reach_mm_(reach_mm) {
    const PackingTask task = packing_task(nets, pages.paper);
    own_ = placed_bits(task.shapes[piece.value()], held);
    for (const PlacedBit& bit : own_) {
      box_.add(bit.box.low);
      box_.add(bit.box.high);
    }
    for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
      if (p != piece && pages.placements[p].page == held.page) {
        add_others(placed_bits(task.shapes[p.value()], pages.placements[p]));
      }
    }
  }

  /// By how much the piece has to move.
  [[nodiscard]] std::optional<Vec2> run() const {
    const Vec2 size = box_.size();
    const Vec2 room = sheet_.size();
    if (size.x > room.x || size.y > room.y) {
      return std::nullopt;
    }
    const Vec2 first = onto_sheet({});
    const int rings = static_cast<int>(reach_mm_ / nearby_step_mm);
    std::vector<Vec2> shifts;
    for (int ring = 0; ring <= rings; ++ring) {
      const int places = std::max(1, static_cast<int>(std::ceil(2.0 * std::numbers::pi * ring)));
      for (int i = 0; i < places; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / places;
        const Vec2 by = ring * nearby_step_mm * Vec2{elementary::cos(angle), elementary::sin(angle)};
        const Vec2 shift = onto_sheet(first + by);
        if (length(shift) <= reach_mm_) {
          shifts.push_back(shift);
        }
      }
    }
    // Rings are round the place on the sheet; nearest is what is nearest to where the piece is held.
    std::ranges::stable_sort(shifts, {}, [](Vec2 shift) { return dot(shift, shift); });
    const auto found = std::ranges::find_if(shifts, [&](Vec2 shift) { return has_room(shift); });
    return found != shifts.end() ? std::optional(*found) : std::nullopt;
  }

 private:
  void add_others(std::vector<PlacedBit> bits) {
    for (PlacedBit& bit : bits) {
      if (meet(grown(bit.box, reach_mm_ + least_mm_), box_)) {
        others_.push_back(std::move(bit));
      }
    }
  }

  [[nodiscard]] Vec2 onto_sheet(Vec2 shift) const {
    return shift + Vec2{way_into(box_.low.x + shift.x, box_.high.x + shift.x, sheet_.low.x, sheet_.high.x),
                        way_into(box_.low.y + shift.y, box_.high.y + shift.y, sheet_.low.y, sheet_.high.y)};
  }

  [[nodiscard]] bool has_room(Vec2 shift) const {
    return std::ranges::all_of(own_, [&](const PlacedBit& bit) {
      const Box2 around = grown({bit.box.low + shift, bit.box.high + shift}, least_mm_);
      std::vector<Vec2> corners;
      return std::ranges::none_of(others_, [&](const PlacedBit& other) {
        if (!meet(around, other.box)) {
          return false;
        }
        if (corners.empty()) {
          std::ranges::transform(bit.corners, std::back_inserter(corners), [&](Vec2 p) { return p + shift; });
        }
        return convex_distance(corners, other.corners) < least_mm_;
      });
    });
  }

  Box2 sheet_;
  double least_mm_;  ///< between pieces
  double reach_mm_;
  std::vector<PlacedBit> own_;
  Box2 box_;  ///< around these
  std::vector<PlacedBit> others_;
};

}  // namespace

std::optional<Placement> nearest_place(const unfold::Nets& nets, const Pages& pages, PieceId piece,
                                       const Placement& held, double reach_mm) {
  const std::optional<Vec2> shift = NearbySearch(nets, pages, piece, held, reach_mm).run();
  if (!shift) {
    return std::nullopt;
  }
  Placement found = held;
  found.shift += *shift;
  return found;
}

}  // namespace ridgecraft::export_
