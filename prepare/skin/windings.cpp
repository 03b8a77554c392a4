// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/skin/windings.hpp"

#include <algorithm>
#include <iterator>
#include <map>

#include "base/boxes.hpp"
#include "base/random.hpp"
#include "base/rays.hpp"
#include "prepare/skin/contacts.hpp"

namespace ridgecraft::prepare {
namespace {

class Rays {
  /// From a facet, and what it has met.
  struct Ray {
    const Corners& facet;
    Exact::Point_3 from;
    Exact::Point_3 to;
    std::map<std::uint32_t, std::int32_t> ahead;    ///< around the side that the ray leaves to
    std::map<std::uint32_t, std::int32_t> through;  ///< what the front has less than the back
  };

 public:
  Rays(const PlacedSoup& soup, ExactPoints& points, Arrangement& arranged)
      : soup_(soup),
        points_(points),
        arranged_(arranged),
        solids_(solids_of(soup)),
        tree_(
            solids_.size(), [&](std::uint32_t i) { return box(solids_[i]); },
            [&](std::uint32_t i) {
              const Corners& c = soup.corners[solids_[i]];
              const std::vector<Vec3>& p = soup.soup.points;
              return (p[c[0]] + p[c[1]] + p[c[2]]) / 3.0;
            }) {
    for (const std::uint32_t t : soup.whole) {
      const Box3 of_triangle = box(t);
      box_.add(of_triangle.low);
      box_.add(of_triangle.high);
    }
  }

  /// Counts what a ray from the patch meets. False where it comes through a side or a corner of something:
  /// then another direction tells.
  bool shoot(Patch& patch, std::uint32_t f) {
    const Corners& c = arranged_.facets[f].corners;
    const Exact::Point_3 from = CGAL::centroid(points_[c[0]], points_[c[1]], points_[c[2]]);
    const double far = 4.0 * box_.diagonal();
    const auto draw = [&] { return (random_.below(2) == 0 ? -1.0 : 1.0) * (0.2 + random_.unit()); };
    const Vec3 way{far * draw(), far * draw(), far * draw()};
    Ray ray{c, from, from + Exact::Vector_3(way.x, way.y, way.z), {}, {}};
    const auto facing = CGAL::orientation(points_[c[0]], points_[c[1]], points_[c[2]], ray.to);
    if (facing == CGAL::COPLANAR) {
      return false;
    }
    const bool to_front = facing == CGAL::POSITIVE;
    bool sure = true;
    const Vec3 start{CGAL::to_double(from.x()), CGAL::to_double(from.y()), CGAL::to_double(from.z())};
    const double margin = 1e-9 * box_.diagonal();
    tree_.search([&](std::uint32_t node) { return comes_near(start, way, grown(tree_.box(node), margin)); },
                 [&](std::uint32_t place) {
                   if (sure) {
                     const std::uint32_t t = solids_[tree_.order()[place]];
                     sure = count(t, ray);
                   }
                 });
    if (!sure) {
      return false;
    }
    std::map<std::uint32_t, std::int32_t> behind = ray.ahead;
    for (const auto& [body, number] : ray.through) {
      behind[body] += to_front ? number : -number;
    }
    const auto listed = [](const std::map<std::uint32_t, std::int32_t>& windings) {
      std::vector<Winding> list;
      std::copy_if(windings.begin(), windings.end(), std::back_inserter(list),
                   [](const Winding& w) { return w.second != 0; });
      return list;
    };
    patch.front = listed(to_front ? ray.ahead : behind);
    patch.back = listed(to_front ? behind : ray.ahead);
    return true;
  }

  /// Counts one triangle.
  bool count(std::uint32_t t, Ray& ray) {
    const Exact::Point_3& a = points_[soup_.corners[t][0]];
    const Exact::Point_3& b = points_[soup_.corners[t][1]];
    const Exact::Point_3& c = points_[soup_.corners[t][2]];
    const auto side = CGAL::orientation(a, b, c, ray.from);
    const auto other = CGAL::orientation(a, b, c, ray.to);
    const auto first = CGAL::orientation(ray.from, ray.to, a, b);
    const auto second = CGAL::orientation(ray.from, ray.to, b, c);
    const auto third = CGAL::orientation(ray.from, ray.to, c, a);
    const bool left = first != CGAL::NEGATIVE && second != CGAL::NEGATIVE && third != CGAL::NEGATIVE;
    const bool right = first != CGAL::POSITIVE && second != CGAL::POSITIVE && third != CGAL::POSITIVE;
    if (side == other || (!left && !right)) {
      return side != CGAL::COPLANAR || side != other;  // a ray within the plane tells nothing
    }
    if (first == CGAL::COPLANAR || second == CGAL::COPLANAR || third == CGAL::COPLANAR ||
        other == CGAL::COPLANAR) {
      return false;
    }
    const std::uint32_t body = soup_.soup.body[t];
    if (side == CGAL::COPLANAR) {
      // The facet lies on it.
      ray.through[body] += alike(ray.facet, a, b, c) ? 1 : -1;
    } else {
      ray.ahead[body] += side == CGAL::NEGATIVE ? 1 : -1;
    }
    return true;
  }

  /// Do a facet and a triangle in its plane face the same way?
  bool alike(const Corners& facet, const Exact::Point_3& a, const Exact::Point_3& b,
             const Exact::Point_3& c) {
    const auto normal = CGAL::cross_product(b - a, c - a);
    const Exact::Point_3& p = points_[facet[0]];
    const auto own = CGAL::cross_product(points_[facet[1]] - p, points_[facet[2]] - p);
    return CGAL::sign(normal * own) == CGAL::POSITIVE;
  }

  static std::vector<std::uint32_t> solids_of(const PlacedSoup& soup) {
    std::vector<std::uint32_t> solids;
    std::copy_if(soup.whole.begin(), soup.whole.end(), std::back_inserter(solids),
                 [&](std::uint32_t t) { return soup.is_solid(t); });
    return solids;
  }
  [[nodiscard]] Box3 box(std::uint32_t t) const { return box_of(soup_.soup.points, soup_.corners[t]); }

  const PlacedSoup& soup_;
  ExactPoints& points_;
  Arrangement& arranged_;
  std::vector<std::uint32_t> solids_;  ///< triangles
  BoxTree<Box3> tree_;                 ///< of the solids' triangles
  Box3 box_;                           ///< of all triangles
  Random random_{1};
};

}  // namespace

void find_windings(const PlacedSoup& soup, ExactPoints& points, const std::vector<std::uint32_t>& largest,
                   Arrangement& arranged, const Context& context) {
  Rays rays(soup, points, arranged);
  for (std::size_t p = 0; p < arranged.patches.size(); ++p) {
    if (p % 64 == 0) {
      context.check();
    }
    // A direction that nothing comes in the way of is found at once; the bound is for what can't be.
    constexpr int most_tries = 100;
    for (int i = 0; i < most_tries && !rays.shoot(arranged.patches[p], largest[p]); ++i) {
    }
  }
}

}  // namespace ridgecraft::prepare
