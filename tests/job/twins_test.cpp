// SPDX-License-Identifier: GPL-3.0-or-later
// Equal bodies get equal nets, wherever they lie and however their faces are numbered.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "job/job.hpp"
#include "mesh/mesh.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"
#include "unfold/net/equal_pieces.hpp"

using namespace ridgecraft;

namespace {

using Turned = std::array<Vec3, 3>;

/// Any turn, from a random quaternion.
Turned any_turn(Random& random) {
  const auto number = [&] { return 2.0 * random.unit() - 1.0; };
  double w = number();
  double x = number();
  double y = number();
  double z = number();
  const double size = std::sqrt(w * w + x * x + y * y + z * z);
  w /= size, x /= size, y /= size, z /= size;
  return {Vec3{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
          Vec3{2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
          Vec3{2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
}

Vec3 turned(const Turned& rows, Vec3 p) {
  return {dot(rows[0], p), dot(rows[1], p), dot(rows[2], p)};
}

/// Bodies as an OBJ file, with six decimals as most programs write them.
class ObjText {
 public:
  explicit ObjText(std::uint64_t seed) : random_(seed) {}

  /// Adds a body with its points and faces in any order.
  void add(const std::string& name, const mesh::Surface& body, const Turned& rows, Vec3 shift,
           bool mirrored) {
    text_ += "o " + name + "\n";
    std::vector<std::uint32_t> order;
    for (std::uint32_t v = 0; v < body.vertex_count(); ++v) {
      order.push_back(v);
    }
    shuffle(order);
    std::vector<std::size_t> number(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      Vec3 p = body.point(VertexId(order[i]));
      p.x = mirrored ? -p.x : p.x;
      p = turned(rows, p) + shift;
      number[order[i]] = points_ + i + 1;
      char line[120];
      std::snprintf(line, sizeof line, "v %.6f %.6f %.6f\n", p.x, p.y, p.z);
      text_ += line;
    }
    points_ += order.size();
    std::vector<std::uint32_t> faces;
    for (std::uint32_t f = 0; f < body.face_count(); ++f) {
      faces.push_back(f);
    }
    shuffle(faces);
    for (const std::uint32_t f : faces) {
      auto [a, b, c] = body.vertices(FaceId(f));
      if (mirrored) {
        std::swap(b, c);
      }
      text_ += "f " + std::to_string(number[a.value()]) + " " + std::to_string(number[b.value()]) + " " +
               std::to_string(number[c.value()]) + "\n";
    }
  }

  [[nodiscard]] mesh::Model model() const {
    return mesh::read(mesh::ModelFile{text_, "twins.obj", "twins", {}}, {}, {});
  }
  Random& random() { return random_; }

 private:
  void shuffle(std::vector<std::uint32_t>& items) {
    for (std::size_t i = items.size(); i > 1; --i) {
      std::swap(items[i - 1], items[random_.below(static_cast<std::uint32_t>(i))]);
    }
  }

  Random random_;
  std::string text_;
  std::size_t points_ = 0;
};

/// A wheel with flat caps of many corners, without any symmetry.
mesh::Surface wheel() {
  return test::mapped(test::revolve({{0, 0}, {9, 0}, {10, 1}, {10, 4}, {8, 5}, {0, 5}}, 12), [](Vec3 p) {
    return Vec3{p.x + 0.05 * p.y, p.y * (1.0 + 0.004 * p.x), p.z * (1.0 + 0.02 * p.x)};
  });
}

mesh::Surface oar() {
  return test::mapped(test::revolve({{0, 0}, {1, 0}, {1.5, 5}, {1.2, 30}, {0.8, 34}, {0, 34}}, 6),
                      [](Vec3 p) {
                        const double blade = p.z > 20 ? 1.0 : 0.0;
                        return Vec3{p.x * (1.0 + 1.5 * blade) + 0.02 * p.z, p.y * (1.0 - 0.5 * blade), p.z};
                      });
}

mesh::Surface hull() {
  return test::mapped(test::cube(), [](Vec3 p) { return Vec3{20 * p.x - 10, 140 * p.y - 70, 12 * p.z}; });
}

std::vector<std::size_t> kinds_of(const job::Result& made) {
  std::vector<std::size_t> counts;
  for (const auto& kind : made.nets.equal) {
    counts.push_back(kind.size());
  }
  return counts;
}

/// Pieces of each component, and those among them that are of a kind with a piece of every other component
/// with as many faces.
bool all_twins_are_equal(const job::Result& made, std::size_t bodies) {
  const mesh::Surface& surface = made.prepared.model.surface;
  std::vector<std::set<ComponentId>> components;
  for (const auto& kind : made.nets.equal) {
    std::set<ComponentId>& own = components.emplace_back();
    for (const unfold::EqualPiece& equal : kind) {
      own.insert(surface.component(made.nets.pieces[equal.piece].faces.front()));
    }
  }
  for (const std::vector<prepare::TwinBody>& kind : made.prepared.twins) {
    if (kind.size() != bodies) {
      return false;
    }
    std::set<ComponentId> all;
    for (const prepare::TwinBody& body : kind) {
      all.insert(surface.component(body.faces.front()));
    }
    std::set<PieceId> pieces;
    for (const FaceId f : kind[0].faces) {
      pieces.insert(made.nets.piece[f]);
    }
    for (const PieceId piece : pieces) {
      const auto found = std::find_if(made.nets.equal.begin(), made.nets.equal.end(), [&](const auto& equal) {
        return std::any_of(equal.begin(), equal.end(),
                           [&](const unfold::EqualPiece& one) { return one.piece == piece; });
      });
      if (found == made.nets.equal.end() ||
          components[static_cast<std::size_t>(found - made.nets.equal.begin())] != all) {
        return false;
      }
    }
  }
  return true;
}

job::Options keeping_faces() {
  job::Options options;
  options.simplify.mode = prepare::Simplification::keep;
  return options;
}

}  // namespace

TEST_CASE("fourteen oars at random have one net", "[job][twins]") {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    for (const bool keep : {false, true}) {
      CAPTURE(seed, keep);
      ObjText boat(seed);
      boat.add("hull", hull(), {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, {}, false);
      for (int i = 0; i < 14; ++i) {
        const Turned turn = any_turn(boat.random());
        boat.add("oar." + std::to_string(i), oar(), turn, {i % 2 == 0 ? -60.0 : 60.0, 9.0 * i - 60, 10},
                 false);
      }
      job::Options options = keep ? keeping_faces() : job::Options();
      options.bodies = prepare::Bodies::keep;  // oars that run into each other would become one body
      const job::Result made = job::run(boat.model(), options, {});
      REQUIRE(made.prepared.twins.size() == 1);
      CHECK(all_twins_are_equal(made, 14));
      CHECK(made.figures.overlaps == 0);
      REQUIRE_FALSE(made.drawn.kinds.empty());
      CHECK(made.drawn.kinds.front().name == "oar");
      CHECK(made.drawn.kinds.front().mirrored.empty());
    }
  }
}

TEST_CASE("two wheels and their mirror images have one net", "[job][twins]") {
  for (const std::uint64_t seed : {1U, 2U}) {
    for (const bool keep : {false, true}) {
      CAPTURE(seed, keep);
      ObjText cart(seed);
      cart.add("body",
               test::mapped(test::cube(),
                            [](Vec3 p) {
                              return Vec3{60 * p.x, 100 * p.y, 22 * p.z};
                            }),
               {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, {}, false);
      for (int i = 0; i < 4; ++i) {
        const Turned turn = any_turn(cart.random());
        cart.add("wheel" + std::to_string(i), wheel(), turn, {i % 2 == 0 ? -40.0 : 100.0, 80.0 * (i / 2), 0},
                 i >= 2);
      }
      const job::Result made = job::run(cart.model(), keep ? keeping_faces() : job::Options(), {});
      REQUIRE(made.prepared.twins.size() == 1);
      CHECK(all_twins_are_equal(made, 4));
      REQUIRE_FALSE(kinds_of(made).empty());
      CHECK(made.drawn.kinds.front().count() % 4 == 0);
      CHECK(made.drawn.kinds.front().name == "wheel");
      // Pieces of one kind are laid on each other by their motions.
      for (const auto& kind : made.nets.equal) {
        const unfold::Piece& first = made.nets.pieces[kind[0].piece];
        for (const unfold::EqualPiece& equal : kind) {
          CHECK(made.nets.pieces[equal.piece].faces.size() == first.faces.size());
          CHECK(made.nets.pieces[equal.piece].folding.way == first.folding.way);
        }
      }
    }
  }
}

TEST_CASE("twins keep equal tabs when tabs are given anew", "[job][twins]") {
  ObjText boat(5);
  for (int i = 0; i < 3; ++i) {
    const Turned turn = any_turn(boat.random());
    boat.add("oar", oar(), turn, {40.0 * i, 0, 0}, i == 1);
  }
  const job::Result made = job::run(boat.model(), keeping_faces(), {});
  CHECK(all_twins_are_equal(made, 3));
  unfold::TabOptions lower;
  lower.height_mm = 3.0;
  const job::Result again = job::with_tabs(made, lower, {});
  CHECK(all_twins_are_equal(again, 3));
  CHECK(again.fold != made.fold);
  CHECK(job::with_tabs(again, made.options.tabs, {}).nets.tabs.size() == made.nets.tabs.size());
}

TEST_CASE("the four legs of a table have one net", "[job][twins]") {
  // Legs of one body: cubes below a board, tapered.
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < 7; ++x) {
    for (int y = 0; y < 7; ++y) {
      cells.push_back({x, y, 0});
    }
  }
  for (const auto& [x, y] : {std::array{0, 0}, {0, 6}, {6, 0}, {6, 6}}) {
    for (int z = 1; z <= 5; ++z) {
      cells.push_back({x, y, -z});
    }
  }
  ObjText table(11);
  const mesh::Surface body = test::mapped(test::voxels(cells), [](Vec3 p) {
    // Towards a line near its outer corner, more in one direction: no leg has a symmetry of its own.
    const auto towards = [&](double at, double taper) {
      const double line = at < 3.5 ? 0.3 : 6.7;
      return p.z < 0.0 ? line + (1.0 + taper * p.z) * (at - line) : at;
    };
    return Vec3{towards(p.x, 0.06), towards(p.y, 0.1), p.z < 0.0 ? 1.5 * p.z : p.z};
  });
  table.add("table", body, any_turn(table.random()), {}, false);
  const job::Result made = job::run(table.model(), keeping_faces(), {});
  const auto most_equal = [&](const unfold::Nets& nets) {
    std::size_t most = 0;
    for (const auto& kind : unfold::find_equal_pieces(made.prepared.model.surface, nets)) {
      most = std::max(most, kind.size());
    }
    return most;
  };
  unfold::Nets bare = made.nets;
  bare.tabs = {};
  CHECK(most_equal(bare) == 4);
  CHECK(most_equal(made.nets) == 4);
}

TEST_CASE("bodies that are nearly equal keep their own nets", "[job][twins]") {
  ObjText boat(7);
  for (int i = 0; i < 2; ++i) {
    const Turned turn = any_turn(boat.random());
    const mesh::Surface longer = test::mapped(oar(), [&](Vec3 p) {
      return Vec3{p.x, p.y, p.z * (1.0 + 0.03 * i)};
    });
    boat.add("oar", longer, turn, {40.0 * i, 0, 0}, false);
  }
  const job::Result made = job::run(boat.model(), keeping_faces(), {});
  CHECK(made.prepared.twins.empty());
  CHECK(made.nets.equal.empty());
}

TEST_CASE("a file that calls pieces equal that aren't is found", "[job][twins]") {
  ObjText boat(9);
  boat.add("hull", hull(), {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, {}, false);
  for (int i = 0; i < 3; ++i) {
    const Turned turn = any_turn(boat.random());
    boat.add("oar", oar(), turn, {40.0 * i, 90, 0}, false);
  }
  job::Options options;
  options.bodies = prepare::Bodies::keep;
  const job::Result made = job::run(boat.model(), options, {});
  const std::size_t begin = made.fold.find('[', made.fold.find("\"ridgecraft:equal_pieces\""));
  REQUIRE(begin != std::string::npos);
  std::size_t end = begin;
  for (int depth = 0; end < made.fold.size(); ++end) {
    depth += made.fold[end] == '[' ? 1 : made.fold[end] == ']' ? -1 : 0;
    if (depth == 0) {
      break;
    }
  }
  const auto said = [&](const std::string& kinds) {
    return verify::verify(made.fold.substr(0, begin) + kinds + made.fold.substr(end + 1), {}, {});
  };
  const auto entry = [&](PieceId piece, bool mirrored) {
    return "{\"piece\":" + std::to_string(piece.value()) + ",\"mirrored\":" + (mirrored ? "true}" : "false}");
  };
  const auto& kind = made.nets.equal.front();
  PieceId other;  // of no kind
  for (const PieceId p : ids<PieceId>(made.nets.pieces.size())) {
    const bool equal = std::any_of(made.nets.equal.begin(), made.nets.equal.end(), [&](const auto& some) {
      return std::any_of(some.begin(), some.end(), [&](const auto& one) { return one.piece == p; });
    });
    other = equal ? other : p;
  }
  REQUIRE(other.valid());
  REQUIRE(other < kind[0].piece);
  const std::string first = entry(kind[0].piece, false);
  CHECK(said("[[" + first + "," + entry(kind[1].piece, false) + "]]").sound());
  CHECK(said("[]").sound());
  for (const std::string& wrong :
       {"[[" + entry(other, false) + "," + entry(kind[0].piece, false) + "]]",
        "[[" + first + "," + entry(kind[1].piece, true) + "]]", "[[" + first + "," + first + "]]"}) {
    const verify::Report report = said(wrong);
    REQUIRE(report.faults.size() == 1);
    CHECK(report.faults[0].promise == verify::Promise::statements);
  }
  for (const std::string& wrong : {"[[" + first + "]]", "[[" + entry(PieceId(99), false) + "," + first + "]]",
                                   std::string("[7]"), std::string("7")}) {
    const verify::Report report = said(wrong);
    REQUIRE_FALSE(report.faults.empty());
    CHECK(report.faults[0].promise == verify::Promise::form);
  }
}

TEST_CASE("a file that calls tabs of equal pieces equal that aren't is found", "[job][twins]") {
  const job::Result made =
      job::run(mesh::read(std::string(RIDGECRAFT_SOURCE_DIR) + "/samples/star.obj", {}, {}), {}, {});
  const std::string told = ",\"other_tabs\":true";
  const std::size_t at = made.fold.find(told);
  REQUIRE(at != std::string::npos);
  CHECK(verify::verify(made.fold, {}, {}).sound());
  const auto with = [&](const std::string& other) {
    return verify::verify(made.fold.substr(0, at) + other + made.fold.substr(at + told.size()), {}, {});
  };
  for (const std::string& wrong : {std::string(), std::string(",\"other_tabs\":false")}) {
    const verify::Report report = with(wrong);
    REQUIRE(report.faults.size() == 1);
    CHECK(report.faults[0].promise == verify::Promise::statements);
  }
  const verify::Report no_form = with(",\"other_tabs\":7");
  REQUIRE_FALSE(no_form.faults.empty());
  CHECK(no_form.faults[0].promise == verify::Promise::form);
}
