// SPDX-License-Identifier: GPL-3.0-or-later
// The energy of nets against counting afresh, and the search that lowers it.
#include "unfold/energy/anneal.hpp"

#include <algorithm>
#include <numeric>

#include <catch2/catch.hpp>

#include "base/geometry.hpp"
#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/energy/net_energy.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/search/tree_search.hpp"

using namespace ridgecraft;
using test::tolerance;
using unfold::ChangingNet;
using unfold::Folds;
using unfold::NetEnergy;
using unfold::Patch;
using unfold::Room;
using unfold::Swap;
using unfold::Weights;

namespace {

/// A sphere with dents and bumps; `even`: those of one side are mirrored in the plane y = 0.
mesh::Surface lumpy(std::uint64_t seed, bool even) {
  const mesh::Surface ball = test::sphere(16, 9);
  const auto unit_of = [&](Vec3 p) {
    const auto part = [](double x) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::round(1e6 * x)));
    };
    Random random(seed + 7919 * part(p.x) + 104729 * part(even ? std::abs(p.y) : p.y) + 1299709 * part(p.z));
    return random.unit();
  };
  std::vector<Vec3> points;
  for (const Vec3 p : ball.points()) {
    points.push_back((40.0 + 20.0 * unit_of(p)) * p);
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(ball.face_count())) {
    faces.push_back(ball.vertices(f));
  }
  return mesh::Surface(std::move(points), std::move(faces));
}

/// A surface as one patch, and a clean net of it that is cut into pieces at some of its folds.
struct CutExample {
  CutExample(std::uint64_t seed, std::size_t more_pieces, bool even = false)
      : surface(lumpy(seed, even)), panels(test::no_panels(surface)) {
    patch = test::whole_patch(surface, panels);
    Random random(seed);
    unfold::TreeSearch net(patch, tolerance, seed);
    net.set_tree(unfold::start_tree(patch, unfold::StartTree::short_cuts, random));
    REQUIRE(net.run({20000, 20000}, Context()));
    tree = net.folds();
    while (links.size() < more_pieces) {
      const std::uint32_t side = random.below(static_cast<std::uint32_t>(patch.twin.size()));
      if (tree[side] != 0 && std::find(links.begin(), links.end(), side) == links.end() &&
          std::find(links.begin(), links.end(), patch.twin[side]) == links.end()) {
        links.push_back(side);
      }
    }
    linked = unfold::linked_patch(patch, links);
  }
  [[nodiscard]] ChangingNet net() const {
    return {surface, panels, linked.apart, linked.joined, tree, unfold::TabOptions(), tolerance};
  }

  mesh::Surface surface;
  prepare::Panels panels;
  Patch patch;
  Folds tree;
  std::vector<std::uint32_t> links;
  unfold::LinkedPatch linked;
};

double hull_area(const std::vector<Vec2>& hull) {
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < hull.size(); ++i) {
    twice += cross(hull[i] - hull[0], hull[i + 1] - hull[0]);
  }
  return 0.5 * twice;
}

}  // namespace

TEST_CASE("the energy is kept up to date from swap to swap, in a piece and between pieces", "[energy]") {
  for (const std::size_t more : {0U, 3U}) {
    const CutExample example(5 + more, more);
    ChangingNet net = example.net();
    const Room room{unfold::Sheet{180.0, 250.0}, 5.0, 400};
    const unfold::CutFacts facts = unfold::cut_facts(net, {});
    NetEnergy energy(net.patch(), net.tree(), facts, room, {});
    NetEnergy fresh(net.patch(), net.tree(), facts, room, {});
    Random random(3);
    int made = 0;
    int between = 0;
    for (int trial = 0; trial < 4000 && made < 150; ++trial) {
      const std::uint32_t side = random.below(static_cast<std::uint32_t>(net.patch().twin.size()));
      if (net.patch().twin[side] == unfold::nothing || net.folds()[side] != 0) {
        continue;
      }
      const std::optional<Swap> swap = unfold::draw_swap_at(side, net.patch(), net.tree(), random);
      if (!swap) {
        continue;
      }
      const double before = energy.total();
      const std::optional<double> change = energy.rate(*swap, HUGE_VAL);
      if (!change) {
        continue;
      }
      if (random.below(3) == 0) {
        energy.drop();
        REQUIRE(energy.total() == before);
        continue;
      }
      const unfold::Layout layout = unfold::lay_out(example.linked.apart, [&] {
        Folds forest = net.folds();
        for (const std::uint32_t link : example.links) {
          unfold::set_fold(example.patch, forest, link, false);
        }
        return forest;
      }());
      between += layout.piece[side / 3] != layout.piece[net.patch().twin[side] / 3] ? 1 : 0;
      net.make(*swap);
      net.keep();
      energy.keep();
      fresh.set_tree();
      REQUIRE(energy.total() == Approx(before + *change).margin(1e-4));
      REQUIRE(energy.total() == Approx(fresh.total()).margin(1e-4));
      REQUIRE(energy.all_fit() == fresh.all_fit());
      ++made;
    }
    CHECK(made == 150);
    CHECK((between > 10) == (more > 0));
  }
}

TEST_CASE("hollows are those of the convex hull, a little enlarged", "[energy]") {
  const CutExample example(8, 0);
  ChangingNet net = example.net();
  Weights hollow{};
  hollow.seam = hollow.bare = hollow.slits = hollow.mirror = hollow.open = hollow.outline = hollow.thin = 0.0;
  hollow.compact = 1.0;
  const Room anywhere;
  const NetEnergy energy(net.patch(), net.tree(), {}, anywhere, hollow);
  const double exact = hull_area(net.hull()) - unfold::area_of(example.patch);
  CHECK(100.0 * energy.total() >= exact - 0.1);
  CHECK(100.0 * energy.total() <= exact + 0.08 * hull_area(net.hull()));
}

TEST_CASE("annealing lowers the energy and keeps nets clean, as many, and the same for a seed", "[energy]") {
  for (const std::size_t more : {0U, 1U, 3U}) {
    const CutExample example(11 + more, more);
    const Room anywhere;
    const auto run = [&](ChangingNet& net) {
      unfold::anneal(net, unfold::cut_facts(net, {}), anywhere, {},
                     unfold::annealing_for(300.0, net.patch().size()), 7, Context());
    };
    ChangingNet net = example.net();
    const double before =
        NetEnergy(net.patch(), net.tree(), unfold::cut_facts(net, {}), anywhere, {}).total();
    const double held = net.held_mm();
    run(net);
    CHECK(NetEnergy(net.patch(), net.tree(), unfold::cut_facts(net, {}), anywhere, {}).total() <
          0.9 * before);
    CHECK(net.held_mm() > 0.8 * held);
    Folds forest = net.folds();
    for (const std::uint32_t link : example.links) {
      REQUIRE(forest[link] != 0);
      unfold::set_fold(example.patch, forest, link, false);
    }
    const unfold::Layout layout = unfold::lay_out(example.patch, forest);
    CHECK(layout.faces.size() == more + 1);
    CHECK(unfold::find_overlaps(layout, tolerance).empty());
    ChangingNet again = example.net();
    run(again);
    CHECK(again.folds() == net.folds());
  }
}

TEST_CASE("pieces that fit the sheet still do, and none gets too many panels", "[energy]") {
  const CutExample example(21, 3);
  ChangingNet net = example.net();
  const Room room{unfold::Sheet{200.0, 240.0}, 5.0, 120};
  NetEnergy energy(net.patch(), net.tree(), unfold::cut_facts(net, {}), room, {});
  const bool fits = energy.all_fit();
  unfold::anneal(net, unfold::cut_facts(net, {}), room, {}, unfold::annealing_for(300.0, net.patch().size()),
                 7, Context());
  energy.set_tree();
  CHECK((!fits || energy.all_fit()));
}

TEST_CASE("edges that are mirror images are cut together", "[energy]") {
  const CutExample example(31, 0, true);
  ChangingNet net = example.net();
  const Patch& patch = example.patch;
  // The mirror image of a side lies between the mirror images of its ends.
  const auto ends = [&](std::uint32_t side) {
    const CornerId c = mesh::corner(patch.face[side / 3], side % 3);
    return std::pair(example.surface.point(example.surface.vertex(c)),
                     example.surface.point(example.surface.vertex(mesh::next(c))));
  };
  std::vector<std::uint32_t> mirror(patch.twin.size(), unfold::nothing);
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    const auto [a, b] = ends(side);
    for (std::uint32_t other = 0; other < patch.twin.size(); ++other) {
      const auto [c, d] = ends(other);
      const auto image = [](Vec3 p) { return Vec3{p.x, -p.y, p.z}; };
      if (length(image(a) - d) < 1e-6 && length(image(b) - c) < 1e-6 && other != side &&
          other != patch.twin[side]) {
        mirror[side] = other;
      }
    }
  }
  // All but the diagonals have one.
  REQUIRE(3 * std::count(mirror.begin(), mirror.end(), unfold::nothing) <
          static_cast<std::ptrdiff_t>(2 * mirror.size()));
  const auto uneven = [&] {
    double sum = 0.0;
    for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
      sum += mirror[side] != unfold::nothing && net.folds()[side] != net.folds()[mirror[side]]
                 ? patch.length[side]
                 : 0.0;
    }
    return sum;
  };
  unfold::CutFacts facts = unfold::cut_facts(net, {});
  facts.mirror = mirror;
  const double before = uneven();
  const Room anywhere;
  unfold::anneal(net, facts, anywhere, {}, unfold::annealing_for(800.0, patch.size()), 7, Context());
  CHECK(uneven() < 0.4 * before);
  CHECK(net.is_clean());
}
