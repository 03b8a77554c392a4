// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/random.hpp"
#include "segment/joining/join_parts.hpp"
#include "segment/joining/partition.hpp"
#include "segment/surface/scaled_surface.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

using segment::Border;
using segment::Pair;

/// Borders of items in a row and across, summed up anew from the items of each set.
std::map<Pair, double> summed(const std::map<Pair, double>& between_items,
                              const std::vector<std::uint32_t>& set_of) {
  std::map<Pair, double> sums;
  for (const auto& [pair, length] : between_items) {
    const std::uint32_t p = set_of[pair.first];
    const std::uint32_t q = set_of[pair.second];
    if (p != q) {
      sums[std::minmax(p, q)] += length;
    }
  }
  return sums;
}

}  // namespace

TEST_CASE("Pairs have their turn by rank, then by number, whatever ranks they had before") {
  Random random(4);
  for (int round = 0; round < 20; ++round) {
    segment::PairQueue<double> queue;
    std::map<Pair, double> waiting;
    for (int step = 0; step < 300; ++step) {
      const Pair pair{random.below(8), 8 + random.below(8)};
      const double rank = random.below(5);
      switch (random.below(4)) {
        case 0:
          queue.drop(pair);
          waiting.erase(pair);
          break;
        case 1:
          if (!waiting.empty()) {
            const auto least =
                std::min_element(waiting.begin(), waiting.end(),
                                 [](const auto& a, const auto& b) { return a.second < b.second; });
            CHECK(queue.take() == least->first);
            waiting.erase(least);
          }
          break;
        default:
          queue.put(pair, rank);
          waiting[pair] = rank;
      }
      CHECK(queue.empty() == waiting.empty());
    }
  }
}

TEST_CASE("Borders of sets that grow together are those of all that is in them") {
  constexpr std::uint32_t items = 40;
  Random random(5);
  std::map<Pair, double> between_items;
  segment::BorderGraph<Border> borders(items);
  for (int i = 0; i < 120; ++i) {
    const std::uint32_t p = random.below(items);
    const std::uint32_t q = random.below(items);
    if (p != q) {
      const double length = 1.0 + random.below(10);  // whole numbers: sums are exact in any order
      between_items[std::minmax(p, q)] += length;
      borders.between(p, q).add({length, 0.5 * length});
    }
  }
  std::vector<std::uint32_t> set_of(items);
  std::iota(set_of.begin(), set_of.end(), 0U);
  while (!borders.all().empty()) {
    const Pair pair = borders.all().begin()->first;
    std::uint32_t into = pair.first;
    std::vector<std::uint32_t> taken_in{pair.second};
    if (random.below(2) == 0) {
      // Both into a new set.
      into = borders.add_set();
      taken_in.push_back(pair.first);
    }
    for (const std::uint32_t from : taken_in) {
      std::size_t gone = 0;
      const std::size_t before = borders.beside(from).size();
      borders.take_in(into, from, [&](const Pair& ended) {
        CHECK((ended.first == from || ended.second == from));
        ++gone;
      });
      CHECK(gone == before);
      CHECK(borders.beside(from).empty());
      std::replace(set_of.begin(), set_of.end(), from, into);
    }
    const std::map<Pair, double> expected = summed(between_items, set_of);
    REQUIRE(borders.all().size() == expected.size());
    for (const auto& [between, border] : borders.all()) {
      CHECK(border.length == expected.at(between));
      CHECK(border.mean() == 0.5);
    }
  }
}

namespace {

using segment::RaySpan;

/// A cloud of points for each group, as hulls that hold their union's.
struct Clouds {
  explicit Clouds(std::size_t groups) : ids(groups) {
    Random random(6);
    for (auto& group : ids) {
      const Vec3 middle{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5};
      for (int i = 0; i < 20; ++i) {
        const Vec3 p{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5};
        group.push_back(static_cast<std::uint32_t>(points.size()));
        points.push_back(segment::snap_to_grid(middle + 0.5 * p));
      }
    }
  }
  [[nodiscard]] std::vector<RaySpan> rays(std::size_t group) const {
    segment::HullBuilder builder(points);
    segment::Hull hull;
    builder.build(ids[group], hull);
    return segment::cast_rays(hull, points);
  }

  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> ids;
};

/// Length of the union of some groups' stretches, ray by ray.
double span_length(const std::vector<std::vector<RaySpan>>& groups) {
  std::map<std::uint32_t, std::vector<RaySpan>> by_ray;
  for (const auto& group : groups) {
    for (const RaySpan& span : group) {
      by_ray[span.ray].push_back(span);
    }
  }
  double sum = 0.0;
  for (auto& [ray, spans] : by_ray) {
    sum += segment::union_length(spans);
  }
  return sum;
}

}  // namespace

TEST_CASE("Hulls that are joined one by one cover what all of them cover") {
  Clouds clouds(6);
  std::vector<std::vector<RaySpan>> rays;
  segment::HullUnion hulls;
  hulls.start(true);
  for (std::uint32_t g = 0; g < clouds.ids.size(); ++g) {
    rays.push_back(clouds.rays(g));
    hulls.add(g, rays.back());
  }
  CHECK(hulls.length() == Approx(span_length(rays)).epsilon(1e-12));
  for (std::uint32_t h = 1; h < clouds.ids.size(); ++h) {
    auto& into = clouds.ids[0];
    into.insert(into.end(), clouds.ids[h].begin(), clouds.ids[h].end());
    const std::vector<RaySpan> united = clouds.rays(0);
    const double before = hulls.length();
    const double added = hulls.added_length(0, h, united);
    CHECK(added >= 0.0);
    hulls.unite(0, h, united);
    rays[0] = united;
    rays[h].clear();
    CHECK(hulls.length() == Approx(before + added).epsilon(1e-12));
    CHECK(hulls.length() == Approx(span_length(rays)).epsilon(1e-12));
  }
}

TEST_CASE("Without rays a union of hulls is nothing") {
  segment::HullUnion hulls;
  hulls.start(false);
  hulls.add(0, {});
  hulls.unite(0, 1, {});
  CHECK(hulls.length() == 0.0);
  CHECK(hulls.added_length(0, 1, {}) == 0.0);
}

namespace {

using segment::Facets;

/// A post with a groove, far within the tolerance, above its lowest third.
mesh::Surface post() {
  return test::revolve({{0, 0}, {0.5, 0}, {0.5, 1}, {0.45, 1.05}, {0.5, 1.1}, {0.5, 2}, {0.5, 3}, {0, 3}},
                       24);
}

/// The post in three parts from below, the lowest one bordered by the groove.
struct ThreeParts {
  ThreeParts() {
    const auto height = [&](std::uint32_t f) {
      const auto& [a, b, c] = scaled.corners[f];
      return (scaled.points[a].z + scaled.points[b].z + scaled.points[c].z) / 3.0;
    };
    // From the middle of the post at 1.5 the groove is 0.45 down, the next border 0.5 up.
    const double unit = 1.0 / scaled.unit;
    parts.resize(3);
    for (std::uint32_t f = 0; f < scaled.facet_count(); ++f) {
      const double z = height(f);
      parts[z < -0.45 * unit ? 0 : z < 0.5 * unit ? 1 : 2].facets.push_back(f);
    }
    for (segment::MeasuredPart& part : parts) {
      part.depth = 1;
      segment::Measurement measurement;
      measurer.measure(part.facets, {}, {}, measurement);
      part.hull = measurement.hull;
      part.concavity = measurement.concavity;
    }
  }

  Context context;
  segment::ScaledSurface scaled = segment::scale_surface(post(), {});
  segment::EdgeWeights weights = segment::weigh_edges(scaled);
  segment::VertexGraph graph = segment::build_vertex_graph(scaled, 0.025);
  segment::Measurer measurer{scaled, graph, {0.1}, context};
  segment::ValleyCache valleys;
  segment::JoiningTools tools{&measurer, &weights, nullptr, &valleys};
  std::vector<segment::MeasuredPart> parts;
};

}  // namespace

TEST_CASE("Parts that joined one that joined another leave nothing behind") {
  // The two upper ones come first, since the border between them is convex; then the lowest takes them in.
  ThreeParts post;
  REQUIRE(std::all_of(post.parts.begin(), post.parts.end(),
                      [](const auto& part) { return !part.facets.empty() && part.concavity <= 0.1; }));
  const std::vector<segment::PartTask> joined = segment::join_parts(post.parts, post.tools);
  REQUIRE(joined.size() == 1);
  CHECK(joined[0].facets.size() == post.scaled.facet_count());
  CHECK(joined[0].reason == segment::PartReason::merged);

  const segment::Rejoined rejoined = segment::rejoin_divided(post.parts, post.tools);
  CHECK(rejoined.kept.empty());
  REQUIRE(rejoined.changed.size() == 1);
  CHECK(rejoined.changed[0].facets.size() == post.scaled.facet_count());
}

TEST_CASE("Only parts that were divided join others after the last measurement") {
  ThreeParts post;
  for (segment::MeasuredPart& part : post.parts) {
    part.depth = 0;
  }
  const segment::Rejoined rejoined = segment::rejoin_divided(post.parts, post.tools);
  CHECK(rejoined.changed.empty());
  CHECK(rejoined.kept.size() == 3);
  for (const segment::PartTask& task : segment::leave_parts(post.parts)) {
    CHECK(task.hull.has_value());
    CHECK(task.depth == 0);
  }
}

}  // namespace ridgecraft
