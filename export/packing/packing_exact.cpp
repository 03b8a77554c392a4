// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/packing/packing_exact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "base/polygon.hpp"

namespace ridgecraft::paper {
namespace {

/// Shallower overlaps are rounding, mm.
constexpr double touching_mm = 1e-7;
/// Corners of two polygons that are one, mm; and how far a corner may bend inwards in a convex polygon, as
/// the sine of the angle.
constexpr double same_corner_mm = 1e-6;
constexpr double bend_tolerance = 1e-9;
/// Places looked at for each move: anywhere, and near the present one; how many are improved first, and how
/// many to the end.
constexpr int samples_anywhere = 24;
constexpr int samples_near = 8;
constexpr std::size_t improved_places = 3;
/// Steps of the improvement, as shares of the shape's smaller side.
constexpr double descent_begins = 0.25;
constexpr double descent_pauses = 0.02;
constexpr double descent_ends = 0.001;
/// Growth of a pair's weight in each round: from the least to the most for the deepest, and decay.
constexpr double least_growth = 1.2;
constexpr double most_growth = 2.0;
constexpr double decay = 0.95;
constexpr double most_pair_weight = 1e12;
/// Sides kept of differences, after which they are made anew: 24 bytes each.
constexpr std::size_t most_sides = 20'000'000;

/// What is convex and covers both, where they share a side and nothing is added; nothing otherwise.
std::optional<std::vector<Vec2>> united(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  const auto same = [](Vec2 p, Vec2 q) { return length(p - q) < same_corner_mm; };
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      if (!same(a[i], b[(k + 1) % b.size()]) || !same(a[(i + 1) % a.size()], b[k])) {
        continue;
      }
      std::vector<Vec2> points;
      for (std::size_t n = 1; n <= a.size(); ++n) {
        points.push_back(a[(i + n) % a.size()]);
      }
      for (std::size_t n = 2; n < b.size(); ++n) {
        points.push_back(b[(k + n) % b.size()]);
      }
      for (std::size_t n = 0; n < points.size(); ++n) {
        const Vec2 one = points[(n + 1) % points.size()] - points[n];
        const Vec2 two = points[(n + 2) % points.size()] - points[(n + 1) % points.size()];
        if (cross(one, two) < -bend_tolerance * length(one) * length(two)) {
          return std::nullopt;
        }
      }
      return points;
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::vector<Vec2>> merged_convex(std::vector<std::vector<Vec2>> polygons) {
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (doubled_area(polygons[i]) < 0.0) {
      std::reverse(polygons[i].begin(), polygons[i].end());
    }
  }
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    for (std::size_t k = i + 1; k < polygons.size();) {
      if (auto both = united(polygons[i], polygons[k])) {
        polygons[i] = std::move(*both);
        polygons.erase(polygons.begin() + static_cast<std::ptrdiff_t>(k));
        k = i + 1;
      } else {
        ++k;
      }
    }
  }
  return polygons;
}

ExactSeparation::ExactSeparation(const PackingTask& task, const std::vector<std::vector<Turn>>& turns,
                                 Random& random, const Context& context)
    : count_(task.shapes.size()),
      gap_(task.gap),
      random_(random),
      context_(context),
      area_(task.area),
      weight_(count_ * count_, 1.0),
      taken_(count_) {
  const auto equal_turns = [](const std::vector<Turn>& a, const std::vector<Turn>& b) {
    return std::ranges::equal(
        a, b, [](const Turn& s, const Turn& t) { return s.cosine == t.cosine && s.sine == t.sine; });
  };
  for (std::uint32_t i = 0; i < count_; ++i) {
    std::uint32_t kind = 0;
    while (kind < i &&
           (task.shapes[kind].convex != task.shapes[i].convex || !equal_turns(turns[kind], turns[i]))) {
      ++kind;
    }
    kind_.push_back(kind);
    scale_.push_back(std::sqrt(task.shapes[i].area));
    if (kind < i) {
      turned_.push_back(turned_[kind]);
      continue;
    }
    const std::vector<std::vector<Vec2>> convex = merged_convex(task.shapes[i].convex);
    std::vector<Turned>& of_shape = turned_.emplace_back();
    for (const Turn& turn : turns[i]) {
      Box2 box;
      Turned turned;
      for (const std::vector<Vec2>& polygon : convex) {
        std::vector<Vec2>& points = turned.convex.emplace_back();
        for (const Vec2 p : polygon) {
          points.push_back(turn(p));
          box.add(points.back());
        }
      }
      turned.low = box.low;
      turned.size = box.size();
      for (std::vector<Vec2>& polygon : turned.convex) {
        for (Vec2& p : polygon) {
          p = p - box.low;
        }
      }
      of_shape.push_back(std::move(turned));
    }
  }
}

void ExactSeparation::forget() {
  std::ranges::fill(weight_, 1.0);
}

const ExactSeparation::Differences& ExactSeparation::differences(std::uint32_t a, std::uint32_t turn_a,
                                                                 std::uint32_t b, std::uint32_t turn_b) {
  const std::uint64_t key = ((std::uint64_t{kind_[a]} * 256 + turn_a) << 32U) + kind_[b] * 256 + turn_b;
  if (const auto found = differences_.find(key); found != differences_.end()) {
    return found->second;
  }
  if (sides_kept_ > most_sides) {
    differences_.clear();
    sides_kept_ = 0;
  }
  Differences made;
  for (const std::vector<Vec2>& one : turned_[a][turn_a].convex) {
    Box2 box_one;
    for (const Vec2 p : one) {
      box_one.add(p);
    }
    for (const std::vector<Vec2>& two : turned_[b][turn_b].convex) {
      Box2 box_two;
      for (const Vec2 p : two) {
        box_two.add(p);
      }
      Difference difference;
      difference.box.low = box_one.low - box_two.high - Vec2{gap_, gap_};
      difference.box.high = box_one.high - box_two.low + Vec2{gap_, gap_};
      difference.first = static_cast<std::uint32_t>(made.sides.size());
      const auto add = [&](Vec2 normal) {
        double far = -INFINITY;
        for (const Vec2 p : one) {
          far = std::max(far, dot(normal, p));
        }
        double near = INFINITY;
        for (const Vec2 p : two) {
          near = std::min(near, dot(normal, p));
        }
        made.sides.push_back({normal, far - near + gap_});
      };
      for (const auto& [polygon, sign] : {std::pair(&one, -1.0), std::pair(&two, 1.0)}) {
        for (std::size_t i = 0; i < polygon->size(); ++i) {
          const Vec2 side = (*polygon)[(i + 1) % polygon->size()] - (*polygon)[i];
          if (const double size = length(side); size > same_corner_mm) {
            add(sign / size * perpendicular(side));
          }
        }
      }
      difference.end = static_cast<std::uint32_t>(made.sides.size());
      made.of_pairs.push_back(difference);
    }
  }
  sides_kept_ += made.sides.size();
  return differences_.emplace(key, std::move(made)).first->second;
}

/// Of all pairs of polygons together; more than `limit` where it is more.
double ExactSeparation::depth(const Differences& of, Vec2 place, double limit) {
  double sum = 0.0;
  work_ += of.of_pairs.size() / 4 + 1;
  for (const Difference& difference : of.of_pairs) {
    if (place.x <= difference.box.low.x || place.x >= difference.box.high.x ||
        place.y <= difference.box.low.y || place.y >= difference.box.high.y) {
      continue;
    }
    double least = INFINITY;
    for (std::uint32_t i = difference.first; i < difference.end; ++i) {
      ++work_;
      const Side& side = of.sides[i];
      least = std::min(least, side.reach - dot(side.normal, place));
      if (least <= touching_mm) {
        break;
      }
    }
    if (least > touching_mm) {
      sum += least;
      if (sum > limit) {
        return sum;
      }
    }
  }
  return sum;
}

double ExactSeparation::overlap(std::uint32_t a, const ExactPlace& at, std::uint32_t b,
                                const ExactPlace& other, double limit) {
  ++work_;
  if (at.page != other.page || apart(taken_by(a, at).box, taken_by(b, other).box)) {
    return 0.0;
  }
  return depth(differences(a, at.turn, b, other.turn), other.at - at.at, limit);
}

double ExactSeparation::cost(std::uint32_t shape, const ExactPlace& place,
                             const std::vector<ExactPlace>& places, double limit) {
  double sum = 0.0;
  const Taken here = taken_by(shape, place);
  for (std::uint32_t other = 0; other < count_ && sum < limit; ++other) {
    const Taken& there = taken_[other];
    if (other == shape || there.page != here.page) {
      continue;
    }
    ++work_;
    if (apart(here.box, there.box)) {
      continue;
    }
    const double weight = weight_[shape * count_ + other] * std::sqrt(scale_[shape] * scale_[other]);
    sum += weight * depth(differences(shape, place.turn, other, places[other].turn),
                          places[other].at - place.at, (limit - sum) / weight);
  }
  return sum;
}

ExactPlace ExactSeparation::inside(std::uint32_t shape, ExactPlace place) const {
  const Vec2 room = area_ - turned_[shape][place.turn].size;
  place.at = {std::clamp(place.at.x, 0.0, std::max(0.0, room.x)),
              std::clamp(place.at.y, 0.0, std::max(0.0, room.y))};
  return place;
}

ExactPlace ExactSeparation::random_place(std::uint32_t shape, std::uint32_t pages) {
  ExactPlace place;
  place.page = random_.below(pages);
  place.turn = random_.below(static_cast<std::uint32_t>(turned_[shape].size()));
  const Vec2 room = area_ - turned_[shape][place.turn].size;
  place.at = {random_.unit() * room.x, random_.unit() * room.y};
  return inside(shape, place);
}

/// Along the axes and between them, with steps that grow where they help and shrink where they don't.
void ExactSeparation::descend(std::uint32_t shape, const std::vector<ExactPlace>& places, double first,
                              double last, Candidate& candidate) {
  constexpr std::array<Vec2, 4> directions{{{1, 0}, {0, 1}, {0.7, 0.7}, {0.7, -0.7}}};
  double step = first;
  while (step >= last && candidate.cost > 0.0) {
    const Vec2 direction = step * directions[random_.below(4)];
    bool better = false;
    for (const double sign : {1.0, -1.0}) {
      ExactPlace next = candidate.place;
      next.at += sign * direction;
      next = inside(shape, next);
      const double there = cost(shape, next, places, candidate.cost);
      if (there < candidate.cost) {
        candidate = {next, there};
        better = true;
        break;
      }
    }
    step *= better ? 1.1 : 0.6;
  }
}

bool ExactSeparation::relocate(std::uint32_t shape, std::vector<ExactPlace>& places, std::uint32_t pages) {
  const auto smaller_side = [&](std::uint32_t turn) {
    const Vec2 size = turned_[shape][turn].size;
    return std::min(size.x, size.y);
  };
  const double here = cost(shape, places[shape], places, INFINITY);
  if (here == 0.0) {
    return false;
  }
  std::vector<Candidate> found{{places[shape], here}};
  const auto offer = [&](const ExactPlace& place) {
    const double limit =
        found.size() > improved_places ? found.back().cost : std::numeric_limits<double>::infinity();
    const double there = cost(shape, place, places, limit);
    if (there < limit) {
      const auto at = std::upper_bound(found.begin(), found.end(), there,
                                       [](double value, const Candidate& c) { return value < c.cost; });
      found.insert(at, {place, there});
      if (found.size() > improved_places + 1) {
        found.pop_back();
      }
    }
  };
  for (int i = 0; i < samples_near; ++i) {
    ExactPlace near = places[shape];
    if (random_.below(2) == 0) {
      near.turn = random_.below(static_cast<std::uint32_t>(turned_[shape].size()));
    }
    const Vec2 size = turned_[shape][near.turn].size;
    near.at += {(random_.unit() - 0.5) * size.x, (random_.unit() - 0.5) * size.y};
    offer(inside(shape, near));
  }
  for (int i = 0; i < samples_anywhere; ++i) {
    offer(random_place(shape, pages));
  }
  for (Candidate& candidate : found) {
    const double side = smaller_side(candidate.place.turn);
    descend(shape, places, descent_begins * side, descent_pauses * side, candidate);
  }
  Candidate best = *std::min_element(found.begin(), found.end(),
                                     [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  const double side = smaller_side(best.place.turn);
  descend(shape, places, descent_pauses * side, descent_ends * side, best);
  if (best.cost < here) {
    places[shape] = best.place;
    taken_[shape] = taken_by(shape, best.place);
    return true;
  }
  return false;
}

void ExactSeparation::raise_weights(const std::vector<ExactPlace>& places) {
  std::vector<double> depths(count_ * count_);
  double deepest = 0.0;
  left_ = 0.0;
  for (std::uint32_t a = 0; a < count_; ++a) {
    for (std::uint32_t b = 0; b < a; ++b) {
      const double here = overlap(a, places[a], b, places[b], INFINITY);
      depths[a * count_ + b] = here;
      deepest = std::max(deepest, here);
      left_ += here;
    }
  }
  for (std::uint32_t a = 0; a < count_; ++a) {
    for (std::uint32_t b = 0; b < a; ++b) {
      const double here = depths[a * count_ + b];
      double& weight = weight_[a * count_ + b];
      weight = here > 0.0 ? std::min(most_pair_weight,
                                     weight * (least_growth + (most_growth - least_growth) * here / deepest))
                          : std::max(1.0, weight * decay);
      weight_[b * count_ + a] = weight;
    }
  }
}

bool ExactSeparation::run(std::vector<ExactPlace>& places, std::uint32_t pages, Vec2 area,
                          std::uint64_t most_work) {
  area_ = area;
  for (std::uint32_t i = 0; i < count_; ++i) {
    places[i] = inside(i, places[i]);
    taken_[i] = taken_by(i, places[i]);
  }
  const std::uint64_t begin = work_;
  std::vector<std::uint32_t> order(count_);
  std::iota(order.begin(), order.end(), 0U);
  while (true) {
    raise_weights(places);
    if (left_ == 0.0) {
      return true;
    }
    for (std::size_t i = count_; i > 1; --i) {
      std::swap(order[i - 1], order[random_.below(static_cast<std::uint32_t>(i))]);
    }
    for (const std::uint32_t shape : order) {
      relocate(shape, places, pages);
      context_.check();
      if (work_ - begin > most_work || context_.out_of_time()) {
        raise_weights(places);
        return left_ == 0.0;
      }
    }
  }
}

}  // namespace ridgecraft::paper
