// SPDX-License-Identifier: GPL-3.0-or-later
// Folding pieces up: the motion ends in the model, and orders hold every fold once.
#include "unfold/folding/fold_order.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/folding/face_meeting.hpp"
#include "unfold/folding/fold_motion.hpp"
#include "unfold/folding/folding_meetings.hpp"
#include "unfold/folding/free_folding.hpp"
#include "unfold/folding/opening.hpp"
#include "unfold/net/tolerance.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/check.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/search/net_search.hpp"
#include "unfold/unfold.hpp"

using namespace ridgecraft;
using unfold::FoldMotion;
using unfold::FoldWay;
using unfold::Nets;

namespace {

Nets nets_of(const mesh::Surface& surface) {
  return unfold::unfold(surface, test::flat_panels(surface), test::one_part(surface), {}, {});
}

/// A sheet that is bent along parallel lines: its profile, pulled along z.
mesh::Surface bent_sheet(const std::vector<Vec2>& profile, double width) {
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> faces;
  for (const Vec2 p : profile) {
    points.push_back({p.x, p.y, 0.0});
    points.push_back({p.x, p.y, width});
  }
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const auto at = [&](std::size_t k) { return VertexId(2 * i + k); };
    faces.push_back({at(0), at(2), at(3)});
    faces.push_back({at(0), at(3), at(1)});
  }
  return {std::move(points), std::move(faces)};
}

/// Looks at each motion.
constexpr int samples = unfold::samples_of_motion;

/// Whether the profile with each joint turned by its share of what it is turned by crosses itself, its
/// stretches shortened at both ends.
bool crosses(const std::vector<Vec2>& profile, const std::vector<double>& share, double shortened) {
  std::vector<std::array<Vec2, 2>> stretches;
  Vec2 at{};
  double heading = 0.0;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const Vec2 along = profile[i + 1] - profile[i];
    if (i > 0) {
      const Vec2 before = profile[i] - profile[i - 1];
      heading += share[i] * std::atan2(cross(before, along), dot(before, along));
    }
    const Vec2 way{std::cos(heading), std::sin(heading)};
    const Vec2 end = at + length(along) * way;
    stretches.push_back({at + shortened * way, end - shortened * way});
    at = end;
  }
  const auto side = [](Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - a); };
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    for (std::size_t j = i + 2; j < stretches.size(); ++j) {
      const auto& [a, b] = stretches[i];
      const auto& [c, d] = stretches[j];
      // Stretches on one line are on no side of each other but for rounding.
      constexpr double rounding = -1e-9;
      if (side(a, b, c) * side(a, b, d) < rounding && side(c, d, a) * side(c, d, b) < rounding) {
        return true;
      }
    }
  }
  return false;
}

/// Stretches of 10 to 70 mm at sharp and blunt angles; where it would cross itself it stops.
std::vector<Vec2> random_profile(Random& random) {
  std::vector<Vec2> profile{{0.0, 0.0}};
  double heading = 0.0;
  for (int i = 0; i < 14; ++i) {
    const double reach = 10.0 + 60.0 * random.unit();
    profile.push_back(profile.back() + reach * Vec2{std::cos(heading), std::sin(heading)});
    if (i > 1 && crosses(profile, std::vector<double>(profile.size(), 1.0), -1.0)) {
      profile.pop_back();
      break;
    }
    heading += (random.below(3) == 0 ? -1.0 : 1.0) * (0.5 + 2.0 * random.unit());
  }
  return profile;
}

/// Two hooks that hold each other, bent a little; straight where that would make them cross.
std::vector<Vec2> random_hooks(Random& random) {
  std::vector<Vec2> profile{{30, 20}, {30, 30}, {10, 30}, {10, 10}, {0, 10},
                            {0, 40},  {60, 40}, {60, 24}, {20, 24}, {20, 10}};
  for (Vec2& p : profile) {
    p += Vec2{12.0 * random.unit() - 6.0, 12.0 * random.unit() - 6.0};
  }
  const std::size_t length = 6 + random.below(5);
  profile.resize(std::min(length, profile.size()));
  return crosses(profile, std::vector<double>(profile.size(), 1.0), -1.0)
             ? std::vector<Vec2>{{0.0, 0.0}, {20.0, 0.0}, {20.0, 20.0}}
             : profile;
}

/// Seven stretches that wind inwards, outwards or to and fro.
std::vector<Vec2> random_spiral(Random& random) {
  for (;;) {
    std::vector<Vec2> profile{{0.0, 0.0}};
    double heading = 0.0;
    const double to_and_fro = random.unit();
    for (int i = 0; i < 7; ++i) {
      const double reach = 8.0 + 40.0 * random.unit();
      profile.push_back(profile.back() + reach * Vec2{std::cos(heading), std::sin(heading)});
      heading += (random.unit() < to_and_fro ? -1.0 : 1.0) * (0.9 + 1.8 * random.unit());
    }
    if (!crosses(profile, std::vector<double>(profile.size(), 1.0), -1.0)) {
      return profile;
    }
  }
}

bool crosses_together(const std::vector<Vec2>& profile, double shortened) {
  for (int sample = 1; sample < samples; ++sample) {
    const double share = static_cast<double>(sample) / samples;
    if (crosses(profile, std::vector<double>(profile.size(), share), shortened)) {
      return true;
    }
  }
  return false;
}

bool crosses_in_order(const std::vector<Vec2>& profile, const std::vector<std::size_t>& joints,
                      double shortened) {
  std::vector<double> share(profile.size(), 0.0);
  for (const std::size_t joint : joints) {
    for (int sample = 1; sample <= samples; ++sample) {
      share[joint] = static_cast<double>(sample) / samples;
      if (crosses(profile, share, shortened)) {
        return true;
      }
    }
  }
  return false;
}

/// Whether some order of the joints folds the profile up: all are tried.
bool any_order_works(const std::vector<Vec2>& profile, double shortened) {
  std::vector<std::size_t> joints(profile.size() - 2);
  std::iota(joints.begin(), joints.end(), std::size_t{1});
  do {
    if (!crosses_in_order(profile, joints, shortened)) {
      return true;
    }
  } while (std::next_permutation(joints.begin(), joints.end()));
  return false;
}

/// The joints of a bent sheet in the order in which its creases are folded.
std::vector<std::size_t> joints_of(const mesh::Surface& sheet, const unfold::FoldOrder& folding) {
  std::vector<std::size_t> joints;
  for (const auto& step : folding.steps) {
    joints.push_back(sheet.vertex(step.front()).value() / 2);
  }
  return joints;
}

/// A net found with no thought of folding, from a start of long strips; without folds where there is none.
std::pair<unfold::Patch, unfold::Folds> depth_first_net(const mesh::Surface& surface, std::uint64_t seed) {
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faces.push_back(f);
  }
  unfold::Patch patch = unfold::make_patch(surface, test::flat_panels(surface), faces);
  unfold::NetSearch search;
  search.start = unfold::StartTree::depth_first;
  search.tolerance = unfold::net_tolerance(patch.extent);
  search.iterations = 2000;
  unfold::NetFound net = unfold::find_net(patch, search, seed, {});
  return {std::move(patch), net.overlaps == 0 ? std::move(net.folds) : unfold::Folds{}};
}

/// Pairs of faces that meet in a pose, all of them compared, but for those of one plate or beside one crease.
std::set<std::pair<std::uint32_t, std::uint32_t>> pairs_in(const FoldMotion& motion,
                                                           const std::vector<double>& share) {
  FoldMotion::Pose pose;
  motion.pose(share, pose);
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t f = 0; f < motion.face_count(); ++f) {
    for (std::uint32_t g = f + 1; g < motion.face_count(); ++g) {
      const std::uint32_t p = motion.plate(f);
      const std::uint32_t q = motion.plate(g);
      unfold::Corners one = pose.corners[f];
      unfold::Corners other = pose.corners[g];
      if (p != q && !motion.hinged(p, q) && unfold::without_seam(one, one) &&
          unfold::without_seam(other, other) && unfold::meet(one, other)) {
        pairs.emplace(f, g);
      }
    }
  }
  return pairs;
}

/// Pairs that meet on the way when all creases are folded together, and not at its end.
unfold::FacePairs pairs_that_meet(const FoldMotion& motion) {
  const std::size_t creases = motion.creases().size();
  const auto always = pairs_in(motion, std::vector<double>(creases, 1.0));
  std::set<std::pair<std::uint32_t, std::uint32_t>> found;
  for (int sample = 1; sample < samples; ++sample) {
    found.merge(pairs_in(motion, std::vector<double>(creases, static_cast<double>(sample) / samples)));
  }
  unfold::FacePairs pairs;
  std::set_difference(found.begin(), found.end(), always.begin(), always.end(), std::back_inserter(pairs));
  return pairs;
}

/// Pairs that meet on the way when one crease is folded after the other.
std::size_t meetings_in_order(const FoldMotion& motion, const std::vector<std::uint32_t>& order) {
  std::vector<double> share(motion.creases().size(), 1.0);
  const auto always = pairs_in(motion, share);
  std::fill(share.begin(), share.end(), 0.0);
  std::size_t count = 0;
  for (const std::uint32_t crease : order) {
    for (int sample = 1; sample <= samples; ++sample) {
      share[crease] = static_cast<double>(sample) / samples;
      for (const auto& pair : pairs_in(motion, share)) {
        count += always.contains(pair) ? 0U : 1U;
      }
    }
  }
  return count;
}

/// Greatest difference of a distance between two corners in the folded piece and in the model.
double refold_error(const mesh::Surface& surface, const Nets& nets, PieceId piece) {
  const FoldMotion motion(unfold::flat_piece(surface, nets, piece));
  FoldMotion::Pose pose;
  motion.pose(std::vector<double>(motion.creases().size(), 1.0), pose);
  const auto& corners = pose.corners;
  std::vector<Vec3> folded;
  std::vector<Vec3> model;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto vertices = surface.vertices(nets.pieces[piece].faces[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      folded.push_back(corners[i][k]);
      model.push_back(surface.point(vertices[k]));
    }
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < folded.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      worst = std::max(worst, std::abs(length(folded[i] - folded[j]) - length(model[i] - model[j])));
    }
    // Mirrored pieces keep their distances, so orientation is looked at, too.
    if (i >= 5) {
      const auto volume = [&](const std::vector<Vec3>& p) {
        return dot(cross(p[1] - p[0], p[2] - p[0]), p[i] - p[0]);
      };
      worst = std::max(worst, std::abs(volume(folded) - volume(model)));
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("folded by all of their angles, pieces are the model", "[unfold]") {
  std::vector<mesh::Surface> surfaces{test::cube(), test::tetrahedron(), test::sphere(8, 5),
                                      test::voxels({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, 2)};
  for (const mesh::Surface& surface : surfaces) {
    const Nets nets = nets_of(surface);
    for (const PieceId piece : ids<PieceId>(nets.pieces.size())) {
      CHECK(refold_error(surface, nets, piece) < 1e-9);
    }
  }
}

TEST_CASE("one crease after the other ends where all at a time do", "[unfold]") {
  const mesh::Surface surface = test::sphere(9, 6);
  const Nets nets = nets_of(surface);
  const FoldMotion motion(unfold::flat_piece(surface, nets, PieceId(0)));
  const auto creases = static_cast<std::uint32_t>(motion.creases().size());
  Random random(3);
  FoldMotion::Pose stepwise;
  motion.pose(std::vector<double>(creases, 0.0), stepwise);
  for (int step = 0; step < 200; ++step) {
    const std::uint32_t crease = random.below(creases);
    const FoldMotion::Pose before = stepwise;
    motion.fold(crease, random.unit(), stepwise);
    FoldMotion::Pose afresh;
    motion.pose(stepwise.share, afresh);
    const std::vector<std::uint32_t> beyond = motion.faces_beyond(crease);
    for (std::uint32_t f = 0; f < afresh.corners.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        CHECK(length(stepwise.corners[f][k] - afresh.corners[f][k]) < 1e-12);
      }
      const bool stays = std::find(beyond.begin(), beyond.end(), f) == beyond.end();
      CHECK((!stays || before.corners[f] == stepwise.corners[f]));
    }
  }
}

TEST_CASE("a tree that gets in its own way is exchanged for one that doesn't", "[unfold]") {
  // Long strips wound round a ball and round a knot of cubes: many of them run through themselves.
  const std::vector<mesh::Surface> surfaces{
      test::scaled(test::sphere(14, 9), 40.0),
      test::scaled(test::voxels({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}, 2), 30.0)};
  int stuck = 0;
  int freed = 0;
  for (const mesh::Surface& surface : surfaces) {
    std::vector<FaceId> faces;
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      faces.push_back(f);
    }
    const unfold::Patch patch = unfold::make_patch(surface, test::flat_panels(surface), faces);
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      unfold::NetSearch search;
      search.start = unfold::StartTree::depth_first;
      search.tolerance = unfold::net_tolerance(patch.extent);
      search.iterations = 2000;
      const unfold::NetFound net = unfold::find_net(patch, search, seed, {});
      if (net.overlaps > 0 || unfold::folds_together(patch, net.folds, {})) {
        continue;
      }
      ++stuck;
      // Trees with shorter cuts cost less.
      const auto freed_for = [&](double worth) {
        unfold::ChangingNet changing(patch, net.folds, search.tolerance);
        const auto cost = [&](unfold::ChangingNet& of) -> std::optional<double> {
          double sum = 0.0;
          for (std::size_t side = 0; side < patch.length.size(); ++side) {
            sum += of.folds()[side] == 0 ? patch.length[side] : 0.0;
          }
          return sum;
        };
        const double given = *cost(changing);
        const bool changed = unfold::fold_freely(changing, cost, worth, seed, {});
        CHECK(changed == (changing.folds() != net.folds));
        CHECK((!changed || *cost(changing) <= given + worth));
        return changing.folds();
      };
      const unfold::Folds other = freed_for(1e9);
      CHECK(unfold::lay_out(patch, other).faces.size() == 1);
      CHECK(unfold::find_overlaps(unfold::lay_out(patch, other), search.tolerance).empty());
      for (std::size_t side = 0; side < other.size(); ++side) {
        CHECK((patch.frozen[side] == 0 || other[side] == net.folds[side]));
      }
      CHECK((other == net.folds || unfold::folds_together(patch, other, {})));
      freed += other != net.folds ? 1 : 0;
      CHECK(freed_for(1e9) == other);
      CHECK(freed_for(-1e9) == net.folds);
    }
  }
  CHECK(stuck > 0);
  CHECK(freed == stuck);
}

TEST_CASE("an order of folding has each folded edge once", "[unfold]") {
  std::vector<mesh::Surface> surfaces{test::cube(), test::sphere(12, 8),
                                      test::voxels({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, 3)};
  for (const std::string& file : test::shared_models()) {
    if (file.find("bunny_128") != std::string::npos || file.find("star80") != std::string::npos) {
      surfaces.push_back(test::read_off(file));
    }
  }
  for (const mesh::Surface& surface : surfaces) {
    const Nets nets = nets_of(surface);
    std::map<EdgeId, int> times;
    for (const unfold::Piece& piece : nets.pieces) {
      for (const auto& step : piece.folding.steps) {
        CHECK(!step.empty());
        for (const CornerId side : step) {
          ++times[surface.edge(side)];
          CHECK(nets.piece[mesh::face_of(side)] == PieceId(&piece - &nets.pieces[PieceId(0)]));
        }
      }
      CHECK((piece.folding.way != FoldWay::together || piece.folding.steps.size() <= 1));
    }
    for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
      const bool folded = nets.use[e] == unfold::EdgeUse::fold && std::abs(surface.fold_angle(e)) > 1e-5;
      CHECK(times[e] == (folded ? 1 : 0));
    }
  }
}

TEST_CASE("a cube folds up with all creases at a time", "[unfold]") {
  const mesh::Surface cube = test::scaled(test::cube(), 50.0);
  const Nets nets = nets_of(cube);
  CHECK(nets.pieces[PieceId(0)].folding.way == FoldWay::together);
}

TEST_CASE("strips fold as their profiles say", "[unfold]") {
  // The profile's joints turn in the plane: whether it crosses itself there is another question than the
  // program's, with the same answer.
  Random random(7);
  std::map<FoldWay, int> seen;
  for (int round = 0; round < 300; ++round) {
    const std::vector<Vec2> profile = round % 2 == 0 ? random_profile(random) : random_hooks(random);
    const mesh::Surface sheet = bent_sheet(profile, 30.0);
    const Nets nets = nets_of(sheet);
    REQUIRE(nets.pieces.size() == 1);
    const unfold::FoldOrder& folding = nets.pieces[PieceId(0)].folding;
    ++seen[folding.way];
    CHECK((folding.way == FoldWay::together) == !crosses_together(profile, 0.3));
    if (folding.way != FoldWay::together && folding.way != FoldWay::with_care) {
      CHECK(!crosses_in_order(profile, joints_of(sheet, folding), 0.3));
    }
    CHECK(folding.in_the_way.has_value() == (folding.way == FoldWay::with_care));
  }
  CHECK(seen[FoldWay::together] > 0);
  CHECK(seen[FoldWay::leaves_first] + seen[FoldWay::middle_first] + seen[FoldWay::in_order] > 0);
}

TEST_CASE("an order is told wherever there is one, and only there", "[unfold]") {
  // Of few joints all orders can be tried.
  Random random(11);
  std::map<FoldWay, int> seen;
  for (int round = 0; round < 4000; ++round) {
    std::vector<Vec2> profile = random_spiral(random);
    if (!crosses_together(profile, 0.3)) {
      continue;
    }
    const mesh::Surface sheet = bent_sheet(profile, 30.0);
    const Nets nets = nets_of(sheet);
    REQUIRE(nets.pieces.size() == 1);
    const unfold::FoldOrder& folding = nets.pieces[PieceId(0)].folding;
    ++seen[folding.way];
    INFO(round);
    // Triangles give way a little farther than the stretches of the profile.
    if (folding.way == FoldWay::with_care) {
      CHECK(!any_order_works(profile, 0.0));
    } else {
      CHECK(!crosses_in_order(profile, joints_of(sheet, folding), 1.5));
    }
  }
  CHECK(seen[FoldWay::in_order] > 0);
}

TEST_CASE("hems that hold each other need care, and two of their faces are named", "[unfold]") {
  // A square tube closed by a seam as cans have it: each edge is bent back into the other.
  const std::vector<Vec2> seam{{40, 103}, {70, 103},    {70, 100},   {0, 100},    {0, 0},
                               {100, 0},  {100, 104.5}, {38, 104.5}, {38, 101.5}, {67, 101.5}};
  for (std::size_t joint = 1; joint + 1 < seam.size(); ++joint) {
    int crossing = 0;
    for (int sample = 0; sample < samples; ++sample) {
      std::vector<double> share(seam.size(), 1.0);
      share[joint] = static_cast<double>(sample) / samples;
      crossing += crosses(seam, share, 1.0) ? 1 : 0;
    }
    CHECK(crossing > 0);
  }
  const Nets nets = nets_of(bent_sheet(seam, 30.0));
  REQUIRE(nets.pieces.size() == 1);
  const unfold::FoldOrder& folding = nets.pieces[PieceId(0)].folding;
  CHECK(folding.way == FoldWay::with_care);
  REQUIRE(folding.in_the_way.has_value());
  CHECK((*folding.in_the_way)[0] != (*folding.in_the_way)[1]);
}

TEST_CASE("what opens backwards folds forwards", "[unfold]") {
  // Nets that were searched without a thought of folding.
  int opened = 0;
  for (const mesh::Surface& surface :
       {test::scaled(test::sphere(8, 5), 40.0), test::scaled(test::cube(), 50.0),
        test::scaled(test::voxels({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}, 1), 30.0)}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const auto [patch, folds] = depth_first_net(surface, seed);
      if (folds.empty()) {
        continue;
      }
      const FoldMotion motion(unfold::flat_piece(patch, folds));
      const Context context;
      unfold::FoldTrial trial(motion, context);
      const unfold::Opening opening = unfold::open_piece(motion, trial, context);
      if (opening.opened.size() < motion.creases().size()) {
        CHECK(opening.in_the_way.has_value());
        continue;
      }
      ++opened;
      std::set<std::uint32_t> each(opening.opened.begin(), opening.opened.end());
      CHECK(each.size() == motion.creases().size());
      std::vector<std::uint32_t> order(opening.opened.rbegin(), opening.opened.rend());
      CHECK(trial.order_works(order));
      CHECK(meetings_in_order(motion, order) == 0);
      const unfold::Opening again = unfold::open_piece(motion, trial, context);
      CHECK(again.opened == opening.opened);
    }
  }
  CHECK(opened > 6);
}

TEST_CASE("meetings are counted as if each tree were folded afresh", "[unfold]") {
  std::size_t most = 0;
  for (const mesh::Surface& surface :
       {test::scaled(test::sphere(8, 6), 40.0),
        test::scaled(test::voxels({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}, 1), 30.0)}) {
    const auto [patch, folds] = depth_first_net(surface, 3);
    REQUIRE_FALSE(folds.empty());
    unfold::RootedNet net(patch);
    net.set_tree(folds);
    unfold::FoldingMeetings meetings(patch);
    meetings.count(net);
    Random random(5);
    unfold::Branch branch(patch);
    for (int step = 0; step < 80; ++step) {
      auto pairs = meetings.pairs();
      std::sort(pairs.begin(), pairs.end());
      CHECK(pairs == pairs_that_meet(FoldMotion(unfold::flat_piece(patch, net.folds()))));
      most = std::max(most, pairs.size());
      const std::uint32_t f = random.below(patch.size());
      const auto swap = unfold::draw_swap_between(f, (f + 1) % patch.size(), net, branch, random);
      if (!swap) {
        continue;
      }
      const std::size_t after = meetings.after(net, *swap, 100000);
      for (const std::size_t limit : {std::size_t{1}, after, after + 1}) {
        CHECK(meetings.after(net, *swap, limit) == std::min(limit, after));
      }
      if (random.below(3) > 0) {
        meetings.keep(net);
        net.swap(swap->below, swap->side);
        CHECK(meetings.total() == after);
      }
    }
  }
  CHECK(most > 0);
}
