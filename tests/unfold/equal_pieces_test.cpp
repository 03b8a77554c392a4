// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that are equal on paper are found, whatever their place, turn and numbers; others aren't.
#include "unfold/net/equal_pieces.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"
#include "support/symmetric_shapes.hpp"
#include "unfold/nets_checks.hpp"

using namespace ridgecraft;

namespace {

/// The same surface twice, far from each other, the second time mirrored if asked.
mesh::Surface twice(const mesh::Surface& one, bool mirrored) {
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> faces;
  for (const bool second : {false, true}) {
    const bool turns = second && mirrored;
    const auto first = static_cast<std::uint32_t>(points.size());
    for (const Vec3 p : one.points()) {
      points.push_back(second ? Vec3{1000.0 + (turns ? -p.x : p.x), p.y, p.z} : p);
    }
    for (const FaceId f : ids<FaceId>(one.face_count())) {
      const auto [a, b, c] = one.vertices(f);
      const auto moved = [&](VertexId v) { return VertexId(first + v.value()); };
      faces.push_back({moved(a), moved(turns ? c : b), moved(turns ? b : c)});
    }
  }
  return {points, faces};
}

mesh::Surface odd() {
  return test::mapped(test::sphere(8, 6), [](Vec3 p) {
    return 30.0 *
           Vec3{p.x * (1.0 + 0.3 * p.z + 0.2 * p.y), 1.7 * p.y + 0.3 * p.x * p.z, p.z + 0.2 * p.y * p.y};
  });
}

/// Nets of one body, and of a copy of it, mirrored if it is, whose nets are moved.
unfold::Nets with_moved_copy(const mesh::Surface& two, bool mirrored, Rigid motion) {
  unfold::Options options;
  options.sheet.reset();
  prepare::TwinBodies twins(1);
  const auto half = static_cast<std::uint32_t>(two.face_count() / 2);
  for (const std::uint32_t first : {0U, half}) {
    prepare::TwinBody& body = twins[0].emplace_back();
    body.mirrored = mirrored && first == half;
    for (std::uint32_t f = first; f < first + half; ++f) {
      body.faces.emplace_back(f);
    }
  }
  options.twins = twins;
  IdVector<FaceId, PartId> part(two.face_count());
  for (const FaceId f : ids<FaceId>(two.face_count())) {
    part[f] = PartId(f.value() < half ? 0 : 1);
  }
  unfold::Nets nets = unfold::unfold(two, test::no_panels(two), part, options, {});
  for (const FaceId f : ids<FaceId>(two.face_count())) {
    if (f.value() >= half) {
      for (Vec2& p : nets.flat[f]) {
        p = motion(p);
      }
    }
  }
  for (unfold::Tab& tab : nets.tabs) {
    if (mesh::face_of(tab.side).value() >= half) {
      for (Vec2& p : tab.polygon) {
        p = motion(p);
      }
    }
  }
  return nets;
}

}  // namespace

TEST_CASE("a copy gets the nets of its original, and both are known as equal", "[equal]") {
  const mesh::Surface two = twice(odd(), false);
  const unfold::Nets nets = with_moved_copy(two, false, {});
  CHECK(test::faults_of(two, nets, {}).empty());
  REQUIRE(nets.pieces.size() % 2 == 0);
  REQUIRE(nets.equal.size() == nets.pieces.size() / 2);
  for (const auto& kind : nets.equal) {
    CHECK(kind.size() == 2);
    CHECK_FALSE(kind[1].mirrored);
  }
}

TEST_CASE("pieces are equal after any motion, and turned over", "[equal]") {
  Random random(3);
  for (const bool mirrored : {false, true}) {
    const mesh::Surface two = twice(odd(), mirrored);
    for (int i = 0; i < 5; ++i) {
      const double angle = 6.28 * random.unit();
      const Rigid motion{std::cos(angle), std::sin(angle), {100.0 * random.unit(), -70.0 * random.unit()}};
      const unfold::Nets nets = with_moved_copy(two, mirrored, motion);
      const auto kinds = unfold::find_equal_pieces(two, nets);
      REQUIRE(kinds.size() == nets.pieces.size() / 2);
      for (const auto& kind : kinds) {
        REQUIRE(kind.size() == 2);
        CHECK(kind[1].mirrored == mirrored);
        // The motion takes each corner of the first to a corner of the other.
        const auto& first = nets.pieces[kind[0].piece].faces;
        for (const FaceId f : first) {
          const auto& image = nets.flat[FaceId(f.value() + two.face_count() / 2)];
          for (std::size_t k = 0; k < 3; ++k) {
            Vec2 p = nets.flat[f][k];
            p = kind[1].motion(mirrored ? Vec2{-p.x, p.y} : p);
            CHECK(length(p - image[mirrored ? (3 - k) % 3 : k]) < 1e-6);
          }
        }
      }
    }
  }
}

TEST_CASE("a tab or a fold more makes pieces unequal", "[equal]") {
  const mesh::Surface two = twice(odd(), false);
  unfold::Nets nets = with_moved_copy(two, false, {});
  REQUIRE_FALSE(nets.tabs.empty());
  const std::size_t kinds = unfold::find_equal_pieces(two, nets).size();
  unfold::Nets shorter = nets;
  shorter.tabs[TabId(0)].polygon[2] += Vec2{0.1, 0.1};
  CHECK(unfold::find_equal_pieces(two, shorter).size() == kinds - 1);
  unfold::Nets nudged = nets;
  nudged.tabs[TabId(0)].polygon[2] += Vec2{0.005, 0.005};
  CHECK(unfold::find_equal_pieces(two, nudged).size() == kinds);
}

TEST_CASE("mirror images that are glued to each other are equal but for tabs between them", "[equal]") {
  // A head in three parts: its left, its right, and a neck that both are glued to.
  const mesh::Surface head = test::mapped(test::one_plane(8), [](Vec3 p) { return 30.0 * p; });
  IdVector<FaceId, PartId> part(head.face_count());
  for (const FaceId f : ids<FaceId>(head.face_count())) {
    Vec3 middle;
    for (const VertexId v : head.vertices(f)) {
      middle = middle + head.point(v) / 3.0;
    }
    part[f] = PartId(middle.z < -12.0 ? 2 : middle.x < 0.0 ? 0 : 1);
  }
  unfold::Options options;
  options.sheet.reset();
  options.pieces.mode = unfold::PieceMode::parts;
  const unfold::Nets nets = unfold::unfold(head, test::no_panels(head), part, options, {});
  CHECK(test::faults_of(head, nets, options).empty());
  REQUIRE(nets.pieces.size() == 3);
  REQUIRE(nets.equal.size() == 1);
  const std::vector<unfold::EqualPiece>& sides = nets.equal[0];
  REQUIRE(sides.size() == 2);
  CHECK(sides[1].mirrored);
  CHECK(sides[1].other_tabs);

  const auto lies_between = [&](const unfold::Tab& tab) {
    const auto is_side = [&](CornerId corner) {
      const PieceId piece = nets.piece[mesh::face_of(corner)];
      return piece == sides[0].piece || piece == sides[1].piece;
    };
    return is_side(tab.side) && is_side(head.twin(tab.side)) &&
           nets.piece[mesh::face_of(tab.side)] != nets.piece[mesh::face_of(head.twin(tab.side))];
  };
  std::size_t between = 0;
  for (const TabId t : ids<TabId>(nets.tabs.size())) {
    unfold::Nets changed = nets;
    changed.tabs[t].polygon[2] += Vec2{0.1, 0.1};
    const bool is_own = lies_between(nets.tabs[t]);
    between += is_own ? 1U : 0U;
    // The neck has no equal.
    const bool of_neck = nets.piece[mesh::face_of(nets.tabs[t].side)] != sides[0].piece &&
                         nets.piece[mesh::face_of(nets.tabs[t].side)] != sides[1].piece;
    CHECK(unfold::find_equal_pieces(head, changed).size() == (is_own || of_neck ? 1 : 0));
  }
  CHECK(between > 4);
  CHECK(between < nets.tabs.size());
}

TEST_CASE("kinds are divided until only tabs between their own pieces differ", "[equal]") {
  // Each face of an octahedron is a piece of its own; what differs are tabs alone.
  const mesh::Surface body = test::mapped(test::sphere(4, 2), [](Vec3 p) { return 40.0 * p; });
  IdVector<FaceId, PartId> part(body.face_count());
  for (const FaceId f : ids<FaceId>(body.face_count())) {
    part[f] = PartId(f.value());
  }
  unfold::Options options;
  options.sheet.reset();
  options.pieces.mode = unfold::PieceMode::parts;
  unfold::Nets nets = unfold::unfold(body, test::no_panels(body), part, options, {});
  REQUIRE(nets.pieces.size() == 8);
  REQUIRE(nets.equal.size() == 1);
  CHECK(nets.equal[0].size() == 8);
  // One face is another shape: tabs towards its three neighbours lead out of the kind of the others.
  const PieceId odd = nets.piece[FaceId(0)];
  for (const FaceId f : nets.pieces[odd].faces) {
    nets.flat[f][0] += Vec2{1.0, 1.0};
  }
  const auto kinds = unfold::find_equal_pieces(body, nets);
  for (const auto& kind : kinds) {
    for (const unfold::EqualPiece& equal : kind) {
      CHECK(equal.piece != odd);
      // Compared by hand: as many tabs towards pieces outside the kind as the first has.
      const auto outward = [&](PieceId piece) {
        std::size_t count = 0;
        for (const unfold::Tab& tab : nets.tabs) {
          const PieceId target = nets.piece[mesh::face_of(body.twin(tab.side))];
          const bool leaves = std::none_of(kind.begin(), kind.end(),
                                           [&](const auto& other) { return other.piece == target; });
          count += nets.piece[mesh::face_of(tab.side)] == piece && leaves ? 1U : 0U;
        }
        return count;
      };
      CHECK(outward(equal.piece) == outward(kind[0].piece));
    }
  }
}

TEST_CASE("one piece of a ring that gets other tabs leaves the others equal", "[equal]") {
  // Seven equal pieces in a ring between two caps, wider below.
  const mesh::Surface body = test::mapped(test::sphere(7, 3), [](Vec3 p) {
    return 40.0 * Vec3{p.x * (1.0 - 0.3 * p.z), p.y * (1.0 - 0.3 * p.z), p.z};
  });
  IdVector<FaceId, PartId> part(body.face_count());
  for (const FaceId f : ids<FaceId>(body.face_count())) {
    Vec3 middle;
    double top = -1.0;
    double bottom = 1.0;
    for (const VertexId v : body.vertices(f)) {
      const Vec3 p = body.point(v) / 40.0;
      middle = middle + p / 3.0;
      top = std::max(top, p.z);
      bottom = std::min(bottom, p.z);
    }
    const double around = std::atan2(middle.y, middle.x) / 6.2831853 * 7.0 + 14.0;
    part[f] = PartId(top > 0.99 ? 7 : bottom < -0.99 ? 8 : static_cast<std::uint32_t>(around) % 7);
  }
  unfold::Options options;
  options.sheet.reset();
  options.pieces.merge = false;
  const unfold::Nets nets = unfold::unfold(body, test::no_panels(body), part, options, {});
  const auto largest = [&](const unfold::Nets& some) {
    std::vector<unfold::EqualPiece> most;
    for (const auto& kind : unfold::find_equal_pieces(body, some)) {
      most = kind.size() > most.size() ? kind : most;
    }
    return most;
  };
  const auto kind = largest(nets);
  REQUIRE(kind.size() >= 4);  // so two of them are glued to each other
  const auto is_of_kind = [&](PieceId piece) {
    return std::any_of(kind.begin(), kind.end(), [&](const auto& equal) { return equal.piece == piece; });
  };
  std::size_t outward = 0;
  std::size_t between = 0;
  for (const TabId t : ids<TabId>(nets.tabs.size())) {
    const CornerId side = nets.tabs[t].side;
    if (!is_of_kind(nets.piece[mesh::face_of(side)])) {
      continue;
    }
    unfold::Nets changed = nets;
    changed.tabs[t].polygon[2] += Vec2{0.1, 0.1};
    const bool leaves = !is_of_kind(nets.piece[mesh::face_of(body.twin(side))]);
    ++(leaves ? outward : between);
    // Where only some of them have a neighbour of their kind on that side, the one that changes is another
    // kind.
    const std::size_t left = largest(changed).size();
    CHECK((left == kind.size() - 1 || (!leaves && left == kind.size())));
  }
  CHECK(between > 0);
}
