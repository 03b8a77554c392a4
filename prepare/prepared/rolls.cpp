// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/prepared/rolls.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <tuple>
#include <utility>

#include "base/elementary.hpp"
#include "base/vector.hpp"

namespace ridgecraft::prepare {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
/// Flatter is no fold: the contract's limit.
constexpr double least_bend = 1e-4 * degree;
/// Two rulings of one flat region lie so at most to each other: those of a low cone of few sides do.
constexpr double most_taper = 35.0 * degree;
/// From region to region that changes by as much at most, or they are no piece of a cylinder or a cone:
/// strips of triangles that point up and down turn to and fro.
constexpr double most_twist = 5.0 * degree;
/// Of two rulings of one region the shorter has at least this share of the other; the rest is another shape.
constexpr double least_share = 0.5;
/// Fewer rulings make a polygon rather than something round.
constexpr std::size_t fewest_rulings = 3;
/// Regions with more neighbours are plates, which end bands at most.
constexpr std::size_t most_neighbours = 64;
/// A region that is so many times as wide as the one beside it is flat, with something round at its side.
constexpr double flat_width = 3.0;
/// As far as simplification may move a surface, of its largest extent.
constexpr double most_moved = 0.02;
/// A band with two ends has creases or borders along so much of its rims, or it is a piece of something that
/// is round both ways.
constexpr double creased_share = 0.5;
/// A fold that is saved is worth as much seam, mm (effort.hpp): 0.2 minutes, at 0.037 minutes a mm.
constexpr double seam_for_fold_mm = 5.5;
/// Nets keep what goes all the way round as a strip in any case; that a strip with two ends stays whole costs
/// as much seam on average: a minute, in nets of 15 models.
constexpr double strip_mm = 27.0;

/// A side of a region over which a band may go on.
struct Side {
  CornerId corner;
  Vec3 middle;
  Vec3 along;  ///< unit vector, counterclockwise around the region
  double length = 0.0;
};

/// What a region hands on from one side to another.
struct Passage {
  std::array<CornerId, 2> sides{};  ///< the second is none where a band can only end here
  double width = 0.0;               ///< between them half way
  double taper = 0.0;               ///< radians, of the second against the first, as seen from outside
};

class RollFinder {
 public:
  RollFinder(const mesh::Surface& surface, const Panels& panels, const RollRules& rules, double mm)
      : surface_(surface), panels_(panels), rules_(rules), mm_(mm) {}

  Rolls find() {
    find_passages();
    IdVector<PanelId, std::uint8_t> seen(panels_.count(), 0);
    // Ends first: what is left then goes round.
    for (const bool from_ends : {true, false}) {
      for (const PanelId p : ids<PanelId>(panels_.count())) {
        if (seen[p] != 0 || (from_ends && !ends_at(p))) {
          continue;
        }
        Chain chain = chain_from(p);
        for (const PanelId q : chain.panels) {
          seen[q] = 1;
        }
        add_rolls(std::move(chain));
      }
    }
    return std::move(result_);
  }

 private:
  /// Regions in a row: over_[i] leads from region i to the next one, of a ring's last one to the first.
  struct Chain {
    std::vector<PanelId> panels;
    std::vector<CornerId> out;  ///< a side of the region before
    bool closed = false;
  };

  [[nodiscard]] PanelId panel(CornerId c) const { return panels_.panel[mesh::face_of(c)]; }
  [[nodiscard]] double bend(CornerId c) const { return surface_.fold_angle(surface_.edge(c)); }

  // From region to region.

  [[nodiscard]] bool may_bend(EdgeId e) const {
    const double angle = std::abs(surface_.fold_angle(e));
    return angle >= least_bend && angle < most_roll_bend;
  }

  /// The sides of each region where it meets another one along one edge alone.
  [[nodiscard]] IdVector<PanelId, std::vector<Side>> find_sides() const {
    std::vector<std::tuple<PanelId, PanelId, EdgeId>> between;
    for (const EdgeId e : ids<EdgeId>(surface_.edge_count())) {
      const auto [c, d] = surface_.sides(e);
      if (d.valid() && panel(c) != panel(d)) {
        between.emplace_back(std::min(panel(c), panel(d)), std::max(panel(c), panel(d)), e);
      }
    }
    std::sort(between.begin(), between.end());
    IdVector<PanelId, std::vector<Side>> sides(panels_.count());
    const auto same = [](const auto& a, const auto& b) {
      return std::get<0>(a) == std::get<0>(b) && std::get<1>(a) == std::get<1>(b);
    };
    for (std::size_t i = 0; i < between.size(); ++i) {
      const bool alone = (i == 0 || !same(between[i - 1], between[i])) &&
                         (i + 1 == between.size() || !same(between[i], between[i + 1]));
      const EdgeId e = std::get<2>(between[i]);
      if (alone && may_bend(e)) {
        for (const CornerId c : surface_.sides(e)) {
          const Vec3 from = surface_.point(surface_.vertex(c));
          const Vec3 to = surface_.point(surface_.vertex(mesh::next(c)));
          sides[panel(c)].push_back({c, 0.5 * (from + to), normalized(to - from), surface_.length(e)});
        }
      }
    }
    return sides;
  }

  void find_passages() {
    const IdVector<PanelId, std::vector<Side>> sides = find_sides();
    for (const PanelId p : ids<PanelId>(panels_.count())) {
      passages_.push_back(best_passage(sides[p]));
    }
    // A band goes on where both regions want it to.
    IdVector<PanelId, Passage> agreed = passages_;
    for (Passage& passage : agreed) {
      for (CornerId& side : passage.sides) {
        if (side.valid()) {
          const CornerId twin = surface_.twin(side);
          const Passage& other = passages_[panel(twin)];
          side = other.sides[0] == twin || other.sides[1] == twin ? side : CornerId();
        }
      }
    }
    passages_ = std::move(agreed);
  }

  [[nodiscard]] Passage best_passage(const std::vector<Side>& sides) const {
    Passage best;
    double best_slenderness = 0.0;
    if (sides.size() <= most_neighbours) {
      for (std::size_t i = 0; i < sides.size(); ++i) {
        for (std::size_t j = i + 1; j < sides.size(); ++j) {
          const auto [passage, slenderness] = across(sides[i], sides[j]);
          if (slenderness > best_slenderness) {
            best_slenderness = slenderness;
            best = passage;
          }
        }
      }
    }
    if (best_slenderness == 0.0 && !sides.empty()) {
      const Side& longest = *std::max_element(
          sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.length < b.length; });
      double area = 0.0;
      for (const FaceId f : panels_.faces[panel(longest.corner)]) {
        area += surface_.area(f);
      }
      best = {{longest.corner, CornerId()}, area / longest.length, 0.0};
    }
    return best;
  }

  /// How a region leads from one side to another, and how slender it is: 0 where it doesn't.
  [[nodiscard]] std::pair<Passage, double> across(const Side& a, const Side& b) const {
    const Vec3 normal = surface_.normal(mesh::face_of(a.corner));
    const double cosine = -dot(a.along, b.along);
    const double taper = elementary::atan2(dot(normal, cross(a.along, -b.along)), cosine);
    if (!(std::abs(taper) < most_taper) ||
        std::min(a.length, b.length) < least_share * std::max(a.length, b.length)) {
      return {};
    }
    const Vec3 along = normalized(a.along - b.along);
    const Vec3 way = b.middle - a.middle;
    const double shift = dot(way, along);
    const double width = length(way - shift * along);
    const double mean = 0.5 * (a.length + b.length);
    if (!(width > 0.0) || std::abs(shift) > least_share * mean) {
      return {};
    }
    return {{{a.corner, b.corner}, width, taper}, mean / width};
  }

  // Along a band.

  [[nodiscard]] bool ends_at(PanelId p) const {
    return !passages_[p].sides[0].valid() || !passages_[p].sides[1].valid();
  }

  [[nodiscard]] CornerId other_side(CornerId in) const {
    const std::array<CornerId, 2>& sides = passages_[panel(in)].sides;
    return sides[0] == in ? sides[1] : sides[0];
  }

  /// From an end of a chain to the other one; once round where it has none.
  [[nodiscard]] Chain chain_from(PanelId start) const {
    Chain chain;
    const std::array<CornerId, 2>& sides = passages_[start].sides;
    CornerId out = sides[1].valid() ? sides[1] : sides[0];
    chain.panels.push_back(start);
    while (out.valid()) {
      chain.out.push_back(out);
      const CornerId in = surface_.twin(out);
      if (panel(in) == start) {
        chain.closed = true;
        break;
      }
      chain.panels.push_back(panel(in));
      out = other_side(in);
    }
    return chain;
  }

  /// As seen by whoever goes over the side.
  [[nodiscard]] double taper_towards(CornerId out) const {
    const Passage& passage = passages_[panel(out)];
    return passage.sides[1] == out ? passage.taper : -passage.taper;
  }

  [[nodiscard]] double width(PanelId p) const { return mm_ * passages_[p].width; }

  [[nodiscard]] double radius_mm(CornerId side) const {
    const double one = width(panel(side));
    const double two = width(panel(surface_.twin(side)));
    const double narrow = std::min(one, two);
    return 0.5 * (narrow + std::min(flat_width * narrow, std::max(one, two))) / std::abs(bend(side));
  }

  /// Whether paper can be bent there as it is bent around.
  [[nodiscard]] bool bends_well(CornerId side) {
    const double radius = radius_mm(side);
    const double moved = radius * (1.0 - elementary::cos(0.5 * std::abs(bend(side))));
    if (moved > most_moved * mm_ * surface_.bounds().largest_extent()) {
      return false;
    }
    if (radius < rules_.least_radius_mm) {
      result_.too_tight += radius >= least_paper_radius_mm ? 1 : 0;
      return false;
    }
    const CornerId twin = surface_.twin(side);
    const bool both_go_on = other_side(side).valid() && other_side(twin).valid();
    return !both_go_on || std::abs(taper_towards(side) + taper_towards(twin)) < most_twist;
  }

  /// Whether the rulings on either side of a region bend it one way.
  [[nodiscard]] bool one_way(CornerId before, CornerId after) const {
    return bend(before) * bend(after) > 0.0;
  }

  void add_rolls(Chain chain) {
    const std::size_t n = chain.out.size();
    if (n == 0) {
      return;
    }
    std::vector<bool> kept(n);
    for (std::size_t i = 0; i < n; ++i) {
      kept[i] = bends_well(chain.out[i]);
    }
    // Where it turns the other way the weaker ruling becomes a fold.
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = i + 1 == n ? 0 : i + 1;
      if ((j != 0 || chain.closed) && kept[i] && kept[j] && !one_way(chain.out[i], chain.out[j])) {
        const bool first = std::abs(bend(chain.out[i])) < std::abs(bend(chain.out[j]));
        kept[first ? i : j] = false;
      }
    }
    if (chain.closed) {
      const auto gap = static_cast<std::ptrdiff_t>(std::find(kept.begin(), kept.end(), false) - kept.begin());
      if (gap == static_cast<std::ptrdiff_t>(n)) {
        add_roll(chain.panels, chain.out, true);
        return;
      }
      // It begins behind a ruling that isn't kept, and is none any more.
      const auto first = (gap + 1) % static_cast<std::ptrdiff_t>(n);
      std::rotate(kept.begin(), kept.begin() + first, kept.end());
      std::rotate(chain.out.begin(), chain.out.begin() + first, chain.out.end());
      std::rotate(chain.panels.begin(), chain.panels.begin() + first, chain.panels.end());
    }
    for (std::size_t i = 0; i < n; ++i) {
      std::size_t end = i;
      while (end < n && kept[end]) {
        ++end;
      }
      const auto at = [](auto& all, std::size_t k) { return all.begin() + static_cast<std::ptrdiff_t>(k); };
      if (end > i) {
        add_roll({at(chain.panels, i), at(chain.panels, end + 1)}, {at(chain.out, i), at(chain.out, end)},
                 false);
      }
      i = end;
    }
  }

  /// Whether the rims of a band with two ends are creases, or borders, over creased_share of their length.
  [[nodiscard]] bool has_creased_rims(const std::vector<PanelId>& panels,
                                      const std::vector<CornerId>& out) const {
    double creased = 0.0;
    double all = 0.0;
    for (std::size_t i = 1; i < out.size(); ++i) {
      for (const FaceId f : panels_.faces[panels[i]]) {
        for (const unsigned k : {0U, 1U, 2U}) {
          const CornerId side = mesh::corner(f, k);
          const EdgeId e = surface_.edge(side);
          const bool border = surface_.is_border(e);
          if (side == out[i] || side == surface_.twin(out[i - 1]) ||
              (!border && panel(surface_.twin(side)) == panels[i])) {
            continue;
          }
          all += surface_.length(e);
          creased += border || std::abs(surface_.fold_angle(e)) >= most_roll_bend ? surface_.length(e) : 0.0;
        }
      }
    }
    return creased >= creased_share * all;
  }

  void add_roll(std::vector<PanelId> panels, const std::vector<CornerId>& out, bool closed) {
    if (out.size() < fewest_rulings || !(closed || has_creased_rims(panels, out))) {
      return;
    }
    Roll roll;
    roll.panels = std::move(panels);
    roll.closed = closed;
    double rulings_mm = 0.0;
    for (const CornerId side : out) {
      roll.rulings.push_back(surface_.edge(side));
      rulings_mm += mm_ * surface_.length(roll.rulings.back());
    }
    std::array<double, 2> rims_mm{};
    double rim_edges = 0.0;
    for (std::size_t i = closed ? 0 : 1; i < out.size(); ++i) {
      const CornerId in = surface_.twin(out[i == 0 ? out.size() - 1 : i - 1]);
      // Both as the region's outline runs: from each end to the other one's beginning.
      rims_mm[0] += distance(mesh::next(in), out[i]);
      rims_mm[1] += distance(mesh::next(out[i]), in);
      rim_edges += 1.0;
    }
    const double rim_mm = 0.5 * (rims_mm[0] + rims_mm[1]) / rim_edges;
    const auto count = static_cast<double>(out.size());
    const double more_seam_mm =
        count * std::max(0.0, rim_mm - rulings_mm / count) + (closed ? 0.0 : strip_mm);
    if (rules_.which == Rolled::automatic && more_seam_mm > count * seam_for_fold_mm) {
      return;
    }
    std::vector<double> radii;
    for (const CornerId side : out) {
      radii.push_back(radius_mm(side));
    }
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    const auto [less, more] = std::minmax(rims_mm[0], rims_mm[1]);
    roll.radii_mm = {*middle * 2.0 * less / (less + more), *middle * 2.0 * more / (less + more)};
    if (result_.of_edge.empty()) {
      result_.of_edge.resize(surface_.edge_count());
    }
    const RollId id(result_.rolls.size());
    for (const EdgeId e : roll.rulings) {
      result_.of_edge[e] = id;
    }
    result_.rolls.push_back(std::move(roll));
  }

  [[nodiscard]] double distance(CornerId from, CornerId to) const {
    return mm_ * length(surface_.point(surface_.vertex(to)) - surface_.point(surface_.vertex(from)));
  }

  const mesh::Surface& surface_;
  const Panels& panels_;
  const RollRules& rules_;
  const double mm_;
  IdVector<PanelId, Passage> passages_;
  Rolls result_;
};

}  // namespace

Rolls find_rolls(const mesh::Surface& surface, const Panels& panels, const RollRules& rules, double mm) {
  return rules.which == Rolled::never ? Rolls() : RollFinder(surface, panels, rules, mm).find();
}

}  // namespace ridgecraft::prepare
