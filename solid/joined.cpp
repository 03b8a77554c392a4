// SPDX-License-Identifier: GPL-3.0-or-later
// Fewer convex bodies in place of many.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "base/rays.hpp"
#include "solid/cover.hpp"
#include "solid/hulls.hpp"
#include "solid/rays.hpp"

namespace ridgecraft::solid {
namespace {

/// Rays over the longest side of all bodies that tell how much two of them share.
constexpr double rays_over_all = 64.0;
/// So many bodies are all compared with each other; of more each with those that are nearest.
constexpr std::size_t few_bodies = 24;
constexpr std::size_t nearest_bodies = 12;
/// A body's volume with another is that of its farthest points in so many directions.
constexpr std::size_t directions = 64;

std::array<Vec3, directions> all_around() {
  std::array<Vec3, directions> result;
  for (std::size_t i = 0; i < directions; ++i) {
    result[i] = even_direction(static_cast<int>(i), static_cast<int>(directions));
  }
  return result;
}

double distance(const Box3& a, const Box3& b) {
  const auto gap = [](double low_a, double high_a, double low_b, double high_b) {
    return std::fmax(0.0, std::fmax(low_a - high_b, low_b - high_a));
  };
  return length(Vec3{gap(a.low.x, a.high.x, b.low.x, b.high.x), gap(a.low.y, a.high.y, b.low.y, b.high.y),
                     gap(a.low.z, a.high.z, b.low.z, b.high.z)});
}

class Joiner {
 public:
  Joiner(const JoinRules& rules, const Context& context)
      : rules_(rules), context_(context), directions_(all_around()) {}

  std::vector<Body> run(std::vector<Body> bodies) {
    Box3 all;
    for (const Body& body : bodies) {
      for (const Vec3 p : body.points) {
        all.add(p);
      }
    }
    step_ = all.largest_extent() / rays_over_all;
    flat_ = 1e-6 * step_;
    rays_ = std::make_unique<Rays>(all, 2, step_);
    Stretches held;
    for (const Body& body : bodies) {
      const Stretches one = rays_->inside(body);
      held.insert(held.end(), one.begin(), one.end());
    }
    held_ = united(std::move(held));
    for (Body& body : bodies) {
      add(std::move(body));
    }
    alive_ = members_.size();
    offer_all();
    while (step()) {
    }
    std::vector<Body> left;
    for (Member& member : members_) {
      if (member.alive) {
        left.push_back(std::move(member.body));
      }
    }
    return left;
  }

 private:
  struct Member {
    Body body;
    Box3 box;
    std::vector<Vec3> farthest;  ///< points in all directions
    double volume = 0.0;         ///< of their hull
    Stretches air;               ///< of what no body held at first
    bool alive = true;
  };
  using Pair = std::tuple<double, std::uint32_t, std::uint32_t>;  ///< added volume, then both

  [[nodiscard]] bool too_many() const { return rules_.most > 0 && alive_ > rules_.most; }

  std::uint32_t add(Body body) {
    context_.check();
    Member member;
    for (const Vec3 p : body.points) {
      member.box.add(p);
    }
    member.farthest = farthest_of(body.points);
    member.volume = mass_properties(convex_hull(member.farthest, flat_, context_)).volume;
    member.air = difference(rays_->inside(body), held_);
    member.body = std::move(body);
    members_.push_back(std::move(member));
    return static_cast<std::uint32_t>(members_.size() - 1);
  }

  [[nodiscard]] std::vector<Vec3> farthest_of(const std::vector<Vec3>& points) const {
    if (points.size() <= directions) {
      return points;
    }
    std::set<std::size_t> chosen;
    for (const Vec3 d : directions_) {
      std::size_t best = 0;
      for (std::size_t i = 1; i < points.size(); ++i) {
        best = dot(d, points[i]) > dot(d, points[best]) ? i : best;
      }
      chosen.insert(best);
    }
    std::vector<Vec3> result;
    for (const std::size_t i : chosen) {
      result.push_back(points[i]);
    }
    return result;
  }

  /// How much air the hull of two holds that neither does.
  [[nodiscard]] double added_volume(const Member& a, const Member& b) const {
    std::vector<Vec3> points = a.farthest;
    points.insert(points.end(), b.farthest.begin(), b.farthest.end());
    const Body hull = convex_hull(points, flat_, context_);
    Stretches both = a.air;
    both.insert(both.end(), b.air.begin(), b.air.end());
    return step_ * step_ * (total(difference(rays_->inside(hull), held_)) - total(united(std::move(both))));
  }

  void offer(std::uint32_t i, std::uint32_t j) {
    const auto [a, b] = std::minmax(i, j);
    if (offered_.insert({a, b}).second) {
      context_.check();
      queue_.insert({added_volume(members_[a], members_[b]), a, b});
    }
  }

  /// Pairs of a body with the others, or the nearest of many.
  void offer_with(std::uint32_t i) {
    std::vector<std::pair<double, std::uint32_t>> others;
    for (std::uint32_t j = 0; j < members_.size(); ++j) {
      if (j != i && members_[j].alive) {
        others.emplace_back(distance(members_[i].box, members_[j].box), j);
      }
    }
    const std::size_t count =
        others.size() < few_bodies ? others.size() : std::min(nearest_bodies, others.size());
    std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(count), others.end());
    for (std::size_t k = 0; k < count; ++k) {
      offer(i, others[k].second);
    }
  }

  void offer_all() {
    for (std::uint32_t i = 0; i < members_.size(); ++i) {
      if (members_[i].alive) {
        offer_with(i);
      }
    }
  }

  /// Joins the next pair; false when that is all.
  bool step() {
    while (!queue_.empty()) {
      const auto [added, a, b] = *queue_.begin();
      if (members_[a].alive && members_[b].alive) {
        const double volume = members_[a].volume + members_[b].volume + added;
        queue_.erase(queue_.begin());
        // Pairs behind it may be larger, and it may be free for them.
        if (!too_many() && !(added <= rules_.free_share * volume)) {
          continue;
        }
        join(a, b);
        return true;
      }
      queue_.erase(queue_.begin());
    }
    return false;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    std::vector<Vec3> points = members_[a].body.points;
    points.insert(points.end(), members_[b].body.points.begin(), members_[b].body.points.end());
    const std::uint32_t united = add(convex_hull(points, flat_, context_));
    // It takes the place of the first.
    std::swap(members_[a], members_[united]);
    members_[b].alive = members_[united].alive = false;
    --alive_;
    std::erase_if(offered_, [&](const auto& pair) {
      return pair.first == a || pair.second == a || pair.first == b || pair.second == b;
    });
    std::erase_if(queue_, [&](const Pair& pair) {
      return std::get<1>(pair) == a || std::get<2>(pair) == a || std::get<1>(pair) == b ||
             std::get<2>(pair) == b;
    });
    if (alive_ == few_bodies) {
      offer_all();
    } else {
      offer_with(a);
    }
  }

  JoinRules rules_;
  const Context& context_;
  std::array<Vec3, directions> directions_;
  std::unique_ptr<Rays> rays_;
  double step_ = 0.0;
  double flat_ = 0.0;
  Stretches held_;
  std::vector<Member> members_;
  std::size_t alive_ = 0;
  std::set<std::pair<std::uint32_t, std::uint32_t>> offered_;
  std::set<Pair> queue_;
};

}  // namespace

std::vector<Body> joined(std::vector<Body> bodies, const JoinRules& rules, const Context& context) {
  return bodies.size() < 2 ? std::move(bodies) : Joiner(rules, context).run(std::move(bodies));
}

}  // namespace ridgecraft::solid
