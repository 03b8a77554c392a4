// SPDX-License-Identifier: GPL-3.0-or-later
// Every cut is in one chain with one number, however seams fork and run into themselves.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/net/chains.hpp"
#include "unfold/net/keep_numbers.hpp"
#include "unfold/net/nets.hpp"

using namespace ridgecraft;
using unfold::Chain;
using unfold::EdgeUse;

namespace {

unfold::Nets nets_with(const mesh::Surface& surface, EdgeUse use) {
  unfold::Nets nets;
  nets.use = IdVector<EdgeId, EdgeUse>(surface.edge_count(), use);
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    nets.use[e] = surface.is_border(e) ? EdgeUse::border : use;
  }
  nets.piece = IdVector<FaceId, PieceId>(surface.face_count(), PieceId(0));
  return nets;
}

std::array<VertexId, 2> ends(const mesh::Surface& surface, EdgeId e) {
  const CornerId side = surface.sides(e)[0];
  return {surface.vertex(side), surface.vertex(mesh::next(side))};
}

/// The cuts of some nets as chains, found another way: cuts that meet where no other edge is cut and no
/// border runs are one.
std::size_t chains_by_merging(const mesh::Surface& surface, const unfold::Nets& nets) {
  std::map<VertexId, std::vector<EdgeId>> at;
  std::set<VertexId> at_border;
  std::vector<std::uint32_t> set(surface.edge_count());
  std::iota(set.begin(), set.end(), 0U);
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    for (const VertexId v : ends(surface, e)) {
      if (surface.is_border(e)) {
        at_border.insert(v);
      } else if (nets.use[e] == EdgeUse::cut) {
        at[v].push_back(e);
      }
    }
  }
  const auto find = [&](std::uint32_t i) {
    while (set[i] != i) {
      i = set[i];
    }
    return i;
  };
  std::size_t rings = 0;
  for (const auto& [v, edges] : at) {
    if (edges.size() == 2 && !at_border.contains(v)) {
      const std::uint32_t a = find(edges[0].value());
      const std::uint32_t b = find(edges[1].value());
      rings += a == b ? 1 : 0;
      set[a] = b;
    }
  }
  std::set<std::uint32_t> chains;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    if (nets.use[e] == EdgeUse::cut) {
      chains.insert(find(e.value()));
    }
  }
  return chains.size() + rings;
}

/// The same surface with points and faces in another order, and the same edges cut.
std::pair<mesh::Surface, unfold::Nets> shuffled(const mesh::Surface& surface, const unfold::Nets& nets,
                                                std::uint64_t seed) {
  Random random(seed);
  const auto shuffle = [&](std::size_t count) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t i = count; i > 1; --i) {
      std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
    }
    return order;
  };
  const std::vector<std::uint32_t> points = shuffle(surface.vertex_count());
  std::vector<Vec3> moved(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    moved[points[v]] = surface.point(VertexId(v));
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const std::uint32_t f : shuffle(surface.face_count())) {
    std::array<VertexId, 3> face = surface.vertices(FaceId(f));
    for (VertexId& v : face) {
      v = VertexId(points[v.value()]);
    }
    std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(random.below(3)), face.end());
    faces.push_back(face);
  }
  mesh::Surface other(moved, faces);
  std::set<std::array<VertexId, 2>> cut;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    if (nets.use[e] == EdgeUse::cut) {
      const auto [a, b] = ends(surface, e);
      const VertexId c(points[a.value()]);
      const VertexId d(points[b.value()]);
      cut.insert({std::min(c, d), std::max(c, d)});
    }
  }
  unfold::Nets same = nets_with(other, EdgeUse::fold);
  for (const EdgeId e : ids<EdgeId>(other.edge_count())) {
    const auto [a, b] = ends(other, e);
    if (cut.contains({std::min(a, b), std::max(a, b)})) {
      same.use[e] = EdgeUse::cut;
    }
  }
  return {std::move(other), std::move(same)};
}

std::vector<std::uint32_t> numbers(const unfold::Nets& nets) {
  std::vector<std::uint32_t> all;
  for (const unfold::Join& join : nets.joins) {
    all.push_back(join.number);
  }
  return all;
}

}  // namespace

TEST_CASE("every cut is in one chain, whichever edges are cuts and whatever pieces they part", "[unfold]") {
  const mesh::Surface surface = test::sphere(9, 7);
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    Random random(seed);
    const std::uint32_t pieces = 1 + static_cast<std::uint32_t>(random.below(4));
    const std::uint32_t one_in = 2 + static_cast<std::uint32_t>(random.below(8));
    unfold::Nets nets = nets_with(surface, EdgeUse::fold);
    for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
      nets.use[e] = random.below(one_in) == 0 ? EdgeUse::cut : EdgeUse::fold;
    }
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      nets.piece[f] = PieceId(static_cast<std::uint32_t>(random.below(pieces)));
    }
    unfold::number_joins(surface, nets);
    const std::vector<Chain> chains = unfold::chains_of(surface, nets);
    std::vector<JoinId> joins;
    std::vector<std::size_t> joins_of(surface.edge_count(), 0);
    for (std::size_t i = 0; i < chains.size(); ++i) {
      CHECK(chains[i].number == i + 1);
      joins.insert(joins.end(), chains[i].joins.begin(), chains[i].joins.end());
      for (const CornerId side : chains[i].sides) {
        ++joins_of[surface.edge(side).value()];
      }
    }
    CHECK(joins.size() == nets.joins.size());
    CHECK(std::ranges::is_sorted(joins));
    std::size_t wrong = 0;
    for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
      wrong += joins_of[e.value()] != (nets.use[e] == EdgeUse::cut ? 1U : 0U) ? 1U : 0U;
    }
    CHECK(wrong == 0);
    CHECK(chains.size() == chains_by_merging(surface, nets));
    auto [other, same] = shuffled(surface, nets, seed);
    unfold::number_joins(other, same);
    CHECK(unfold::chains_of(other, same).size() == chains.size());
  }
}

TEST_CASE("a ring is two chains, a row of cuts one", "[unfold]") {
  const mesh::Surface surface = test::sphere(8, 6);
  unfold::Nets nets = nets_with(surface, EdgeUse::fold);
  std::vector<EdgeId> ring;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [a, b] = ends(surface, e);
    if (std::abs(surface.point(a).z) < 1e-9 && std::abs(surface.point(b).z) < 1e-9) {
      nets.use[e] = EdgeUse::cut;
      ring.push_back(e);
    }
  }
  REQUIRE(ring.size() == 8);
  unfold::number_joins(surface, nets);
  const std::vector<Chain> two = unfold::chains_of(surface, nets);
  REQUIRE(two.size() == 2);
  CHECK(two[0].joins.size() == 4);
  CHECK(two[1].joins.size() == 4);
  nets.use[ring[3]] = EdgeUse::fold;
  unfold::number_joins(surface, nets);
  CHECK(unfold::chains_of(surface, nets).size() == 1);
}

TEST_CASE("a number stays with its edges, and with one row of them", "[unfold]") {
  const mesh::Surface surface = test::sphere(8, 6);
  unfold::Nets nets = nets_with(surface, EdgeUse::fold);
  std::vector<EdgeId> meridian;  // from pole to pole
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [a, b] = ends(surface, e);
    const auto on_it = [&](VertexId v) {
      return std::abs(surface.point(v).y) < 1e-9 && surface.point(v).x > -1e-9;
    };
    if (on_it(a) && on_it(b)) {
      nets.use[e] = EdgeUse::cut;
      meridian.push_back(e);
    }
  }
  REQUIRE(meridian.size() == 6);
  unfold::number_joins(surface, nets);
  const IdVector<JoinId, unfold::Join> before = nets.joins;
  CHECK(numbers(nets) == std::vector<std::uint32_t>{1, 1, 1, 1, 1, 1});

  // An edge in its middle becomes a fold: the longer part keeps the number.
  unfold::Nets parted = nets;
  parted.use[before[JoinId(2)].edge] = EdgeUse::fold;
  unfold::number_joins(surface, parted);
  unfold::keep_numbers(surface, before, parted);
  CHECK(numbers(parted) == std::vector<std::uint32_t>{1, 1, 1, 2, 2});

  // A cut that ends at it leaves it one row on the other side.
  unfold::Nets forked = nets;
  const auto [a, b] = ends(surface, before[JoinId(1)].edge);
  const auto [c, d] = ends(surface, before[JoinId(2)].edge);
  const VertexId middle = a == c || a == d ? a : b;
  for (const CornerId corner : surface.corners_at(middle)) {
    if (forked.use[surface.edge(corner)] == EdgeUse::fold) {
      forked.use[surface.edge(corner)] = EdgeUse::cut;
      break;
    }
  }
  unfold::number_joins(surface, forked);
  CHECK(unfold::chains_of(surface, forked).size() == 3);
  unfold::keep_numbers(surface, before, forked);
  CHECK(numbers(forked) == std::vector<std::uint32_t>{1, 1, 1, 1, 1, 1, 2});
  CHECK(unfold::chains_of(surface, forked).size() == 3);
}
