// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/layout_around.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "base/boxes.hpp"
#include "base/elementary.hpp"
#include "export/layout.hpp"
#include "export/packing/packing.hpp"
#include "export/packing/packing_page.hpp"
#include "export/packing/packing_shape.hpp"
#include "export/sheet/paper.hpp"

namespace ridgecraft::export_ {
namespace {

/// Cells in which room is looked for, mm.
constexpr double cell_mm = 1.0;
/// How many turns of a piece are tried.
constexpr std::size_t most_turns = 16;

class AroundLayout {
 public:
  AroundLayout(const unfold::Nets& nets, const Paper& paper,
               const IdVector<PieceId, std::optional<KeptPlace>>& kept, const LayoutRules& rules)
      : kept_(kept),
        sort_(rules.sort),
        task_(packing_task(nets, paper, rules.fold_directions)),
        box_(piece_box(paper)),
        grid_(task_.area, cell_mm),
        places_(nets.pieces.size()) {
    check_fit(nets, task_, paper);
    pages_.paper = paper;
  }

  std::variant<Pages, NoPlace> lay_out(const Context& context) {
    if (const std::optional<NoPlace> none = keep()) {
      return *none;
    }
    std::vector<PieceId> homeless;
    for (const PieceId p : in_order()) {
      context.check();
      if (!places_[p] && !find_room(p)) {
        homeless.push_back(p);
      }
    }
    add_pages(homeless, context);
    return finished();
  }

 private:
  [[nodiscard]] const PackingShape& shape(PieceId p) const { return task_.shapes[p.value()]; }
  [[nodiscard]] std::uint32_t sort_of(PieceId p) const { return sort_.empty() ? 0 : sort_[p]; }
  [[nodiscard]] int hold_of(PieceId p) const { return kept_[p] ? static_cast<int>(kept_[p]->hold) : -1; }

  /// What is held most firmly first, then large ones.
  [[nodiscard]] std::vector<PieceId> in_order() const {
    std::vector<PieceId> order;
    for (const PieceId p : ids<PieceId>(task_.shapes.size())) {
      order.push_back(p);
    }
    std::stable_sort(order.begin(), order.end(), [&](PieceId a, PieceId b) {
      return hold_of(a) != hold_of(b) ? hold_of(a) > hold_of(b) : shape(a).area > shape(b).area;
    });
    return order;
  }

  [[nodiscard]] bool on_sheet(PieceId p, const Rigid& at) const {
    const auto& hull = shape(p).hull;
    return std::all_of(hull.begin(), hull.end(), [&](Vec2 corner) {
      const Vec2 q = at(corner);
      return q.x >= box_.low.x - fit_tolerance_mm && q.x <= box_.high.x + fit_tolerance_mm &&
             q.y >= box_.low.y - fit_tolerance_mm && q.y <= box_.high.y + fit_tolerance_mm;
    });
  }

  /// Pieces that would come too near to each other where they are kept, of each one the others.
  [[nodiscard]] std::vector<std::vector<PieceId>> neighbours() const {
    std::map<PageId, std::vector<OwnedPolygon>> on_page;
    for (const PieceId p : ids<PieceId>(kept_.size())) {
      if (kept_[p]) {
        for (auto& polygon : placed(shape(p), kept_[p]->at)) {
          on_page[kept_[p]->at.page].push_back({p.value(), std::move(polygon)});
        }
      }
    }
    std::vector<std::vector<PieceId>> near(kept_.size());
    for (const auto& [page, polygons] : on_page) {
      for (const auto& [a, b] : too_near(polygons, task_.gap - gap_rounding_mm)) {
        near[a].push_back(PieceId(b));
        near[b].push_back(PieceId(a));
      }
    }
    return near;
  }

  /// Why a piece can't lie on its page as the pieces lie that have their places; none where it can.
  [[nodiscard]] std::optional<NoPlace> why_not(PieceId p, const std::vector<PieceId>& near) const {
    const Placement& at = kept_[p]->at;
    if (!on_sheet(p, at)) {
      return NoPlace{p, {}, NoPlace::Why::beyond_sheet};
    }
    for (const PieceId other : near) {
      if (places_[other]) {
        return NoPlace{p, other, NoPlace::Why::too_near};
      }
    }
    if (const auto first = first_on_.find(at.page);
        first != first_on_.end() && sort_of(first->second) != sort_of(p)) {
      return NoPlace{p, first->second, NoPlace::Why::other_sort};
    }
    return std::nullopt;
  }

  /// Keeps what can be kept. What was laid doesn't push away what lies, but what has changed.
  std::optional<NoPlace> keep() {
    const std::vector<std::vector<PieceId>> near = neighbours();
    const std::vector<PieceId> order = in_order();
    for (const Hold hold : {Hold::lying, Hold::laid, Hold::changed}) {
      for (const PieceId p : order) {
        if (!kept_[p] || kept_[p]->hold != hold) {
          continue;
        }
        if (const std::optional<NoPlace> none = why_not(p, near[p.value()]); !none) {
          put(p, kept_[p]->at);
        } else if (hold == Hold::laid) {
          return none;
        }
      }
    }
    return std::nullopt;
  }

  void put(PieceId p, const Placement& at) {
    places_[p] = at;
    first_on_.try_emplace(at.page, p);
  }

  /// A page as the search for room sees it, made when it is first looked at.
  PackingPage& bitmap(PageId page) {
    const auto found = bitmaps_.find(page);
    if (found != bitmaps_.end()) {
      return found->second;
    }
    PackingPage& made = bitmaps_.try_emplace(page, grid_).first->second;
    for (const PieceId p : ids<PieceId>(places_.size())) {
      if (places_[p] && places_[p]->page == page) {
        take(p, *places_[p], made);
      }
    }
    return made;
  }

  /// Pieces lie between the cells of the grid: so much more is kept free around them.
  void take(PieceId p, const Placement& at, PackingPage& page) const {
    Vec2 low{INFINITY, INFINITY};
    for (const Vec2 corner : shape(p).hull) {
      const Vec2 q = at.turn(corner);
      low = {std::min(low.x, q.x), std::min(low.y, q.y)};
    }
    const Vec2 place = (1.0 / grid_.cell) * (low + at.shift - box_.low);
    const Vec2 cell{std::max(0.0, std::floor(place.x)), std::max(0.0, std::floor(place.y))};
    const Raster raster =
        rasterize(shape(p), {at.cosine, at.sine}, grid_.cell, task_.gap + grid_.cell * length(place - cell));
    page.take(raster, {static_cast<std::int32_t>(cell.x), static_cast<std::int32_t>(cell.y)});
  }

  /// Pages where the piece may look for room, that on which it lay first.
  [[nodiscard]] std::vector<PageId> pages_for(PieceId p) const {
    std::vector<PageId> pages;
    for (const auto& [page, first] : first_on_) {
      if (sort_of(first) == sort_of(p)) {
        pages.push_back(page);
      }
    }
    if (kept_[p]) {
      std::stable_partition(pages.begin(), pages.end(),
                            [&](PageId page) { return page == kept_[p]->at.page; });
    }
    return pages;
  }

  bool find_room(PieceId p) {
    std::vector<Raster> rasters;
    for (const Turn& turn : turns_to_try(shape(p), task_.area, most_turns)) {
      rasters.push_back(rasterize(shape(p), turn, grid_.cell, task_.gap));
    }
    for (const PageId number : pages_for(p)) {
      PackingPage& page = bitmap(number);
      std::uint64_t work = 0;
      double limit = task_.area.y + fit_tolerance_mm;
      const Raster* best = nullptr;
      Spot at;
      for (const Raster& raster : rasters) {
        if (const std::optional<Spot> spot = page.find(raster, limit, true, work)) {
          best = &raster;
          at = *spot;
          limit = at.row * grid_.cell + raster.size.y - grid_.cell;
        }
      }
      if (best != nullptr) {
        const Vec2 corner{at.column * grid_.cell, at.row * grid_.cell};
        Placement place;
        place.page = number;
        place.cosine = best->turn.cosine;
        place.sine = best->turn.sine;
        place.shift = box_.low + corner - best->low;
        page.take(*best, at);
        put(p, place);
        return true;
      }
    }
    return false;
  }

  /// New pages behind all others, for each sort its own.
  void add_pages(const std::vector<PieceId>& homeless, const Context& context) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> of_sort;
    for (const PieceId p : homeless) {
      of_sort[sort_of(p)].push_back(p.value());
    }
    std::uint32_t next = first_on_.empty() ? 0 : first_on_.rbegin()->first.value() + 1;
    for (const auto& [sort, shapes] : of_sort) {
      const std::vector<Packed> packed = pack(part_of(task_, shapes), context);
      const std::uint32_t first = next;
      for (std::size_t i = 0; i < shapes.size(); ++i) {
        Placement place;
        place.page = PageId(first + packed[i].page);
        place.cosine = packed[i].turn.cosine;
        place.sine = packed[i].turn.sine;
        place.shift = packed[i].shift + box_.low;
        put(PieceId(shapes[i]), place);
        next = std::max(next, place.page.value() + 1);
      }
    }
  }

  /// With pages numbered from 0 on, without gaps.
  [[nodiscard]] Pages finished() {
    std::map<PageId, PageId> number;
    for (const auto& [page, first] : first_on_) {
      number.try_emplace(page, PageId(number.size()));
    }
    pages_.count = number.size();
    pages_.placements = IdVector<PieceId, Placement>(places_.size());
    for (const PieceId p : ids<PieceId>(places_.size())) {
      pages_.placements[p] = places_[p].value();
      pages_.placements[p].page = number.at(places_[p]->page);
    }
    return std::move(pages_);
  }

  const IdVector<PieceId, std::optional<KeptPlace>>& kept_;
  const IdVector<PieceId, std::uint32_t>& sort_;
  PackingTask task_;
  Box2 box_;
  PackingGrid grid_;
  IdVector<PieceId, std::optional<Placement>> places_;
  std::map<PageId, PieceId> first_on_;  ///< some piece on each page
  std::map<PageId, PackingPage> bitmaps_;
  Pages pages_;
};

}  // namespace

std::variant<Pages, NoPlace> layout_around(const unfold::Nets& nets, const Paper& paper,
                                           const IdVector<PieceId, std::optional<KeptPlace>>& kept,
                                           const Context& context, const LayoutRules& rules) {
  check_paper(paper);
  return AroundLayout(nets, paper, kept, rules).lay_out(context);
}

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
