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

TEST_CASE("pieces are equal whatever their tabs are, and where those differ it is said", "[equal]") {
  const mesh::Surface two = twice(odd(), false);
  const unfold::Nets nets = with_moved_copy(two, false, {});
  REQUIRE_FALSE(nets.tabs.empty());
  const auto with_other_tabs = [&](const unfold::Nets& some) {
    std::size_t count = 0;
    for (const auto& kind : unfold::find_equal_pieces(two, some)) {
      REQUIRE(kind.size() == 2);
      count += kind[1].other_tabs ? 1U : 0U;
    }
    return count;
  };
  CHECK(with_other_tabs(nets) == 0);
  unfold::Nets nudged = nets;
  nudged.tabs[TabId(0)].polygon[2] += Vec2{0.005, 0.005};
  CHECK(with_other_tabs(nudged) == 0);
  unfold::Nets shorter = nets;
  shorter.tabs[TabId(0)].polygon[2] += Vec2{0.1, 0.1};
  CHECK(with_other_tabs(shorter) == 1);
}

TEST_CASE("pieces whose outlines differ aren't equal", "[equal]") {
  const mesh::Surface two = twice(odd(), false);
  unfold::Nets nets = with_moved_copy(two, false, {});
  const std::size_t kinds = unfold::find_equal_pieces(two, nets).size();
  nets.flat[FaceId(0)][0] += Vec2{0.1, 0.1};
  CHECK(unfold::find_equal_pieces(two, nets).size() == kinds - 1);
}

TEST_CASE("mirror images that are glued to each other are equal but for tabs", "[equal]") {
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
  // The search needn't end symmetric, but often does.
  std::size_t symmetric = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Context context;
    context.seed = seed;
    const unfold::Nets nets = unfold::unfold(head, test::no_panels(head), part, options, context);
    CHECK(test::faults_of(head, nets, options).empty());
    REQUIRE(nets.pieces.size() == 3);
    if (!nets.equal.empty()) {
      REQUIRE(nets.equal[0].size() == 2);
      CHECK(nets.equal[0][1].mirrored);
      CHECK(nets.equal[0][1].other_tabs);
      ++symmetric;
    }
  }
  CHECK(symmetric >= 3);
}
