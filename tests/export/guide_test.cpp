// SPDX-License-Identifier: GPL-3.0-or-later
// The guide: complete, legible, the same on every machine, and its figures those of the formula.
#include "export/guide/guide.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "export/export.hpp"
#include "export/guide/cover.hpp"
#include "export/guide/effort.hpp"
#include "export/guide/picture.hpp"
#include "export/guide/words.hpp"
#include "export/page/obstacles.hpp"
#include "export/style/stroke_font.hpp"
#include "export/view/camera.hpp"
#include "export/view/scene.hpp"
#include "sample_pages.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

using mesh::Surface;

Surface bracket() {
  return test::voxels({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 1}});
}

struct Drawn {
  test::SamplePages sample;
  export_::Assembly assembly;
  export_::Guide guide;
};
Drawn draw(const Surface& surface, double scale, bool every_panel_a_piece = true, unsigned threads = 1) {
  Drawn drawn;
  drawn.sample = every_panel_a_piece ? test::sample_pages(surface, scale, 5.0, test::all_edges(surface))
                                     : test::sample_pages(surface, scale, 5.0);
  drawn.sample.model.panels = prepare::find_panels(drawn.sample.model.model.surface);
  drawn.assembly = export_::assembly_order(drawn.sample.model.model.surface, drawn.sample.nets);
  Context context;
  context.threads = threads;
  drawn.guide = export_::draw_guide({drawn.sample.model,
                                     drawn.sample.nets,
                                     drawn.sample.pages,
                                     drawn.assembly,
                                     drawn.sample.pages.count,
                                     {},
                                     export_::stance_of(drawn.sample.model.model)},
                                    {}, context);
  return drawn;
}

std::vector<std::string> words_on(const export_::Drawing& page) {
  std::vector<std::string> words;
  for (const export_::Group& group : page.groups) {
    for (const export_::Text& text : group.texts) {
      words.push_back(text.text);
    }
  }
  return words;
}

bool has(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

TEST_CASE("the guide names every piece where it is seen, and has every step", "[guide]") {
  const Drawn drawn = draw(bracket(), 30.0);
  const export_::Guide& guide = drawn.guide;
  CHECK(guide.steps == drawn.assembly.steps.size());
  REQUIRE(guide.pages.size() > 2);
  const auto overview = words_on(guide.pages[1]);
  for (const unfold::Piece& piece : drawn.sample.nets.pieces) {
    CHECK(has(overview, piece.name));
  }
  for (std::size_t s = 0; s < guide.steps; ++s) {
    const std::string title = export_::step_title(drawn.sample.nets, drawn.assembly.steps[s]);
    CHECK(std::any_of(guide.pages.begin() + 2, guide.pages.end(), [&](const export_::Drawing& page) {
      const auto words = words_on(page);
      return has(words, std::to_string(s + 1)) && has(words, title);
    }));
  }
}

TEST_CASE("sides that look alike are drawn once", "[guide]") {
  const auto pictures = [](const Drawn& drawn, const std::string& words) {
    const auto overview = words_on(drawn.guide.pages[1]);
    return std::ranges::count_if(
        overview, [&](const std::string& text) { return text.find(words) != std::string::npos; });
  };
  const Drawn tower = draw(test::revolve({{0.0, 0.0}, {1.0, 0.0}, {1.0, 3.0}, {0.0, 3.0}}, 8), 30.0, false);
  CHECK(pictures(tower, "as on the first page, and from all other sides") == 1);
  CHECK(pictures(tower, "turn on") == 0);
  const Drawn other = draw(bracket(), 30.0);
  CHECK(pictures(other, "from all other sides") == 0);
  CHECK(pictures(other, "turn on") >= 3);
}

TEST_CASE("a step names all that it glues to, also what lies behind what is seen", "[guide]") {
  // Each wall of a cube is a piece, so that the floor and the far walls are seen from no side that is shown.
  const Drawn drawn = draw(test::cube(), 60.0);
  REQUIRE(drawn.guide.steps == 6);
  REQUIRE(drawn.guide.pages.size() == 3);
  std::size_t wanted = 0;
  for (const export_::AssemblyStep& step : drawn.assembly.steps) {
    wanted += export_::glued_before(drawn.sample.model.model.surface, drawn.sample.nets, step).size();
  }
  std::size_t named = 0;
  bool any_behind = false;
  for (const std::string& word : words_on(drawn.guide.pages[2])) {
    const bool in_brackets = word.starts_with('(') && word.ends_with(')');
    const std::string name = in_brackets ? word.substr(1, word.size() - 2) : word;
    named += std::ranges::any_of(drawn.sample.nets.pieces,
                                 [&](const unfold::Piece& piece) { return piece.name == name; })
                 ? 1U
                 : 0U;
    any_behind = any_behind || word.find("behind what is seen here") != std::string::npos;
  }
  // Besides, each step has the name of its own piece as its title and beside the picture.
  CHECK(named == wanted + 2 * 6);
  CHECK(any_behind);
}

TEST_CASE("no page of the guide has one row of steps alone where the others have room for it", "[guide]") {
  // 1 to 36 pieces; six steps a page, or eight.
  const auto pages_of = [](std::size_t steps) {
    const std::size_t pages = (steps + 5) / 6;
    return steps % 6 == 1 || steps % 6 == 2 ? std::min(pages, (steps + 7) / 8) : pages;
  };
  for (const std::size_t cubes : {1U, 2U, 3U, 5U}) {
    std::vector<std::array<int, 3>> places;
    for (std::size_t i = 0; i < cubes; ++i) {
      places.push_back({static_cast<int>(i), 0, 0});
    }
    const Drawn drawn = draw(test::voxels(places), 30.0);
    CAPTURE(drawn.guide.steps);
    CHECK(drawn.guide.pages.size() == 2 + std::max<std::size_t>(1, pages_of(drawn.guide.steps)));
    // Each of them is filled: its lowest words stand at the foot.
    for (std::size_t page = 2; page < drawn.guide.pages.size() && drawn.guide.steps > 2; ++page) {
      double lowest = 1e9;
      for (const export_::Group& group : drawn.guide.pages[page].groups) {
        for (const export_::Text& text : group.texts) {
          lowest = group.id == "steps" ? std::min(lowest, text.centre.y) : lowest;
        }
      }
      CHECK(lowest < 40.0);
    }
  }
}

TEST_CASE("the picture of a step takes the room below its net where rows are high", "[guide]") {
  // Four steps on a page of two rows and two columns, and pictures that are about as broad as they are high.
  const Drawn drawn = draw(test::tetrahedron(), 60.0);
  REQUIRE(drawn.guide.steps == 4);
  REQUIRE(drawn.guide.pages.size() == 3);
  const export_::Drawing& page = drawn.guide.pages.back();
  double broadest = 0.0;
  for (const export_::Group& group : page.groups) {
    for (const export_::Area& area : group.areas) {
      Box2 box;
      for (const Vec2 p : area.outline) {
        box.add(p);
      }
      broadest = std::max(broadest, box.size().x);
    }
  }
  // Beside the net and the names on both sides there would be a quarter of the page.
  CHECK(broadest > 0.28 * page.size.x);
}

TEST_CASE("the cover shows the model in its own colours, unless lines are all that is printed", "[guide]") {
  Drawn drawn = draw(bracket(), 30.0);
  const Surface& surface = drawn.sample.model.model.surface;
  // Faces to the right of a plane that cuts through some of them are red, the others green: a picture of two
  // pixels beside each other.
  mesh::LookParts parts;
  mesh::Paint paint;
  paint.picture = std::make_shared<const mesh::Picture>(mesh::Picture(2, 1, {220, 20, 20, 20, 160, 20}));
  parts.paints.push_back(paint);
  const Box3 bounds = surface.bounds();
  for (const FaceId face : ids<FaceId>(surface.face_count())) {
    mesh::LookFace& look = parts.faces.emplace_back();
    look.normal = surface.normal(face);
    for (std::size_t k = 0; k < 3; ++k) {
      look.corners[k] = surface.point(surface.vertices(face)[k]);
      const double share = (look.corners[k].x - bounds.low.x) / bounds.size().x;
      look.places[k] = {0.05 + 0.9 * share, 0.5};
    }
  }
  drawn.sample.model.look = std::make_shared<const mesh::Look>(parts);
  const auto hues_on_cover = [&](export_::Ink ink) {
    export_::Style style;
    style.ink = ink;
    const export_::Guide guide = export_::draw_guide({drawn.sample.model,
                                                      drawn.sample.nets,
                                                      drawn.sample.pages,
                                                      drawn.assembly,
                                                      drawn.sample.pages.count,
                                                      {},
                                                      {}},
                                                     style, {});
    std::set<char> found;
    const auto add = [&](int red, int green) {
      found.insert(red > 2 * green ? 'r' : green > 2 * red ? 'g' : '-');
    };
    const export_::Group& cover = guide.pages[0].groups[0];
    for (const export_::Area& area : cover.areas) {
      add(area.color->red, area.color->green);
    }
    for (const export_::Image& image : cover.images) {
      const mesh::Picture picture = *mesh::unpack_picture(*image.jpeg);
      for (const std::vector<Vec2>& polygon : image.clip) {
        const Vec2 middle = (polygon[0] + polygon[1] + polygon[2]) / 3.0;  // inside, as it is convex
        const Vec2 size = image.place.size();
        const mesh::Rgb colour =
            picture.at({(middle.x - image.place.low.x) / size.x, (middle.y - image.place.low.y) / size.y}, 0);
        add(colour[0], colour[1]);
      }
    }
    return found;
  };
  CHECK(hues_on_cover(export_::Ink::colour).contains('r'));
  CHECK(hues_on_cover(export_::Ink::colour).contains('g'));
  CHECK_FALSE(hues_on_cover(export_::Ink::lines).contains('r'));
}

TEST_CASE("texts of the guide lie on their sheet and on no other text", "[guide]") {
  for (const double scale : {12.0, 30.0}) {
    for (const Surface& surface : {bracket(), test::cube(), test::sphere(8, 5)}) {
      const Drawn drawn = draw(surface, scale);
      for (const export_::Drawing& page : drawn.guide.pages) {
        std::vector<export_::Text> texts;
        for (const export_::Group& group : page.groups) {
          texts.insert(texts.end(), group.texts.begin(), group.texts.end());
          for (const export_::Area& area : group.areas) {
            for (const Vec2 p : area.outline) {
              CHECK((p.x >= 0.0 && p.y >= 0.0 && p.x <= page.size.x && p.y <= page.size.y));
            }
          }
        }
        for (std::size_t i = 0; i < texts.size(); ++i) {
          CAPTURE(page.page, texts[i].text);
          const Box2 box = export_::box_of(texts[i]).bounds();
          CHECK((box.low.x >= 5.0 && box.low.y >= 5.0));
          CHECK((box.high.x <= page.size.x - 5.0 && box.high.y <= page.size.y - 5.0));
          for (std::size_t j = 0; j < i; ++j) {
            CAPTURE(texts[j].text);
            CHECK_FALSE(export_::overlap(export_::box_of(texts[i]), export_::box_of(texts[j])));
          }
        }
      }
    }
  }
}

TEST_CASE("no word of a guide needs a font of the machine", "[guide]") {
  for (const double scale : {12.0, 30.0, 300.0}) {
    for (const export_::Drawing& page : draw(bracket(), scale).guide.pages) {
      for (const std::string& words : words_on(page)) {
        CAPTURE(words);
        CHECK(export_::stroke_font_covers(words));
      }
    }
  }
}

TEST_CASE("a guide is tagged: headings, paragraphs, and pictures with words", "[guide]") {
  const Drawn drawn = draw(bracket(), 30.0);
  const std::string bytes = export_::write_guide_pdf(drawn.guide.pages, {"ridgecraft 0.1.0", "bracket", "0"});
  const auto count = [&](const std::string& words) {
    std::size_t found = 0;
    for (std::size_t at = bytes.find(words); at != std::string::npos; at = bytes.find(words, at + 1)) {
      ++found;
    }
    return found;
  };
  CHECK(count("/Marked true") == 1);
  CHECK(count("/StructTreeRoot") >= 1);
  CHECK(count("/S /H1") == 1);
  CHECK(count("/S /H2") >= drawn.guide.steps);
  CHECK(count("/S /P") > drawn.guide.steps);
  CHECK(count("/S /Figure") > drawn.guide.steps);
  CHECK(count("/S /Figure") == count("/Alt "));
  CHECK(count("/StructParents ") == drawn.guide.pages.size());
}

TEST_CASE("a guide is the same on one thread and on three", "[guide]") {
  const auto bytes = [](unsigned threads) {
    return export_::write_guide_pdf(draw(bracket(), 30.0, true, threads).guide.pages,
                                    {"ridgecraft 0.1.0", "x", "0"});
  };
  CHECK(bytes(1) == bytes(3));
}

TEST_CASE("a model of one piece has a guide of one step", "[guide]") {
  const Drawn drawn = draw(test::cube(), 40.0, false);
  CHECK(drawn.guide.steps == 1);
  CHECK(drawn.guide.pages.size() == 3);
}

TEST_CASE("time and difficulty are those of the formula", "[guide]") {
  const Surface cube = test::cube();
  const auto sample = test::sample_pages(cube, 30.0, 5.0, test::all_edges(cube));
  const export_::Effort effort = export_::effort_of(sample.model, sample.nets, 0.05);
  // Six squares that are glued along twelve edges of 30 mm, and not folded.
  CHECK(effort.joins == 12);
  CHECK(effort.folds == 0);
  CHECK(effort.seam_mm == Approx(360.0));
  CHECK(effort.median_join_mm == Approx(30.0));
  CHECK(effort.minutes == Approx(2.0 * 360.0 / 100.0 + 360.0 / 60.0 + 0.4 * 12.0 + 6.0));
  CHECK(effort.difficulty == 1);
  // A third of the edges have no tab.
  unfold::Nets bare = sample.nets;
  for (const JoinId join : ids<JoinId>(4)) {
    REQUIRE(bare.joins[join].tab.valid());
    bare.joins[join].tab = {};
  }
  CHECK(export_::effort_of(sample.model, bare, 0.05).difficulty == 3);
  const auto tiny = test::sample_pages(cube, 2.5, 1.0);
  const export_::Effort fine = export_::effort_of(tiny.model, tiny.nets, 0.05);
  CHECK(fine.difficulty == 3);  // few edges, but all of them short
  const auto small = test::sample_pages(cube, 6.5, 1.0);
  CHECK(export_::effort_of(small.model, small.nets, 0.05).difficulty == 1);
}

TEST_CASE("durations and weights of paper in words", "[guide]") {
  CHECK(export_::duration_words(2.0) == "about 10 minutes");
  CHECK(export_::duration_words(44.0) == "about 40 minutes");
  CHECK(export_::duration_words(61.0) == "about 1 hour");
  CHECK(export_::duration_words(200.0) == "about 3.5 hours");
  CHECK(export_::duration_words(730.0) == "about 12 hours");
  CHECK(export_::paper_weight(100.0, 12.0) == "120 to 160 g/m\u00b2");
  CHECK(export_::paper_weight(100.0, 5.0) == "100 to 120 g/m\u00b2");
  CHECK(export_::paper_weight(800.0, 12.0) == "250 to 300 g/m\u00b2");
}

TEST_CASE("pieces that are glued to each other have different hues", "[guide]") {
  const Drawn drawn = draw(bracket(), 30.0);
  const Surface& surface = drawn.sample.model.model.surface;
  const auto hues = export_::piece_hues(surface, drawn.sample.nets);
  for (const unfold::Join& join : drawn.sample.nets.joins) {
    const auto [c, d] = surface.sides(join.edge);
    const PieceId a = drawn.sample.nets.piece[mesh::face_of(c)];
    const PieceId b = drawn.sample.nets.piece[mesh::face_of(d)];
    CHECK((a == b || hues[a] != hues[b]));
  }
}

TEST_CASE("a model stands as its file says, or on its feet", "[guide]") {
  mesh::Model model;
  model.surface = test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {0, 0, 2}});
  CHECK(export_::stance_of(model).up == Vec3{0.0, 0.0, 1.0});
  model.frame.up = mesh::Axis::x;
  CHECK(export_::stance_of(model).up == Vec3{1.0, 0.0, 0.0});
  mesh::Model ball;
  ball.surface = test::sphere(12, 9);
  ball.format = mesh::FileFormat::stl_ascii;
  CHECK(export_::stance_of(ball).up == Vec3{0.0, 0.0, 1.0});
  // A lid that would stand on a small flat place at its back, too.
  mesh::Model lid;
  lid.format = mesh::FileFormat::obj;
  lid.surface = test::mapped(test::sphere(32, 32), [](Vec3 p) {
    return Vec3{1.7 * p.x, p.y, 1.5 * std::max(p.z, -0.95)};
  });
  CHECK(export_::stance_of(lid).up == Vec3{0.0, 1.0, 0.0});
  lid.format = mesh::FileFormat::stl_ascii;
  CHECK(export_::stance_of(lid).up == Vec3{0.0, 0.0, 1.0});
  // A plant on a pointed foot, taller than it is deep: nothing but the origin tells that it doesn't lie.
  const auto plant = [](double foot) {
    mesh::Model model_of_plant;
    model_of_plant.format = mesh::FileFormat::obj;
    model_of_plant.surface = test::mapped(test::sphere(16, 12), [&](Vec3 p) {
      return Vec3{p.x, 3.0 * p.z + foot, 0.9 * p.y};
    });
    return export_::stance_of(model_of_plant).up;
  };
  // A head whose left and right sides are mirror images across z, in a format in which z is usual.
  mesh::Model head;
  head.format = mesh::FileFormat::stl_ascii;
  const auto headlike = [](Vec3 p) {
    return Vec3{p.x + 0.4 * p.y * p.y + 5.0, 1.1 * p.y + 0.3 * p.x * p.x * p.y + 0.2 * p.x, 0.95 * p.z};
  };
  head.surface = test::mapped(test::sphere(24, 13), headlike);
  CHECK(export_::stance_of(head).up == Vec3{0.0, 1.0, 0.0});
  // A plate of the same outline lies.
  head.surface = test::mapped(test::sphere(24, 13), [&](Vec3 p) {
    const Vec3 q = headlike(p);
    return Vec3{q.x, q.y, 0.3 * q.z};
  });
  CHECK(export_::stance_of(head).up == Vec3{0.0, 0.0, 1.0});
  // Where its sides aren't alike nothing tells.
  head.surface = test::mapped(test::sphere(24, 13), [&](Vec3 p) {
    return headlike({p.x, p.y, p.z + 0.1 * p.z * p.z});
  });
  CHECK(export_::stance_of(head).up == Vec3{0.0, 0.0, 1.0});
  CHECK(plant(3.0) == Vec3{0.0, 1.0, 0.0});
  CHECK(plant(0.0) == Vec3{0.0, 0.0, 1.0});
}

TEST_CASE("the first page shows the side on which most is painted", "[guide]") {
  // A ball of one colour, but for two on its back, or with as much on either side.
  const auto shown_front = [](bool front_painted, bool in_colour) {
    auto sample = test::sample_pages(test::sphere(24, 16), 30.0, 5.0);
    const Surface& surface = sample.model.model.surface;
    mesh::LookParts parts;
    parts.paints = {{{200, 200, 200}, nullptr, nullptr}, {{20, 20, 20}, nullptr, nullptr}};
    const export_::Stance stance{{0.0, 0.0, 1.0}, {0.0, -1.0, 0.0}};
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      const auto [a, b, c] = surface.vertices(f);
      mesh::LookFace& look = parts.faces.emplace_back();
      look.corners = {surface.point(a), surface.point(b), surface.point(c)};
      look.normal = surface.normal(f);
      const double toward = dot(look.normal, stance.front);
      const bool painted = toward < -0.5 || (front_painted && toward > 0.5);
      look.paint = painted && f.value() % 2 == 0 ? 1 : 0;
    }
    sample.model.look = std::make_shared<const mesh::Look>(parts);
    export_::GuideModel guide;
    guide.model = &sample.model;
    guide.nets = &sample.nets;
    guide.stance = stance;
    guide.in_colour = in_colour;
    guide.scene = export_::scene_of(sample.model, sample.nets, 0.0);
    return dot(export_::turned_to_cover(guide).front, stance.front);
  };
  CHECK(shown_front(false, true) == Approx(-1.0));
  CHECK(shown_front(true, true) == Approx(1.0));
  CHECK(shown_front(false, false) == Approx(1.0));
}

TEST_CASE("mirror images of a step are known as a pair", "[guide]") {
  unfold::Nets nets;
  for (const char* name : {"A", "B", "C", "D", "E"}) {
    unfold::Piece piece;
    piece.name = name;
    nets.pieces.push_back(piece);
  }
  nets.equal = {{{PieceId(1), false}, {PieceId(3), true}}, {{PieceId(0), false}, {PieceId(2), false}}};
  export_::AssemblyStep step;
  step.pieces = {PieceId(0), PieceId(3)};
  const auto pairs = export_::mirror_pairs(nets, step);
  REQUIRE(pairs.size() == 1);
  CHECK(pairs[0].piece == PieceId(3));
  CHECK(pairs[0].image == PieceId(1));
  step.pieces = {PieceId(1), PieceId(3)};
  REQUIRE(export_::mirror_pairs(nets, step).size() == 1);
  CHECK(export_::mirror_pairs(nets, step)[0].piece == PieceId(1));
  // Of three nobody says which is meant.
  nets.equal[0].push_back({PieceId(4), true});
  CHECK(export_::mirror_pairs(nets, step).empty());
}

TEST_CASE("a line to a small face ends where its piece has most room", "[guide]") {
  const export_::Anchor face{true, {1.0, 2.0}, 0.5};
  const export_::Anchor piece{true, {3.0, 4.0}, 2.0};
  CHECK(export_::anchor_to_point_at(face, piece, 0.4).at == face.at);
  CHECK(export_::anchor_to_point_at(face, piece, 0.6).at == piece.at);
}

TEST_CASE("lines to names of one column don't cross, and words don't meet", "[guide]") {
  Random random(3);
  for (int round = 0; round < 200; ++round) {
    std::vector<export_::Callout> callouts;
    for (std::uint32_t n = 1 + random.below(40); n > 0; --n) {
      callouts.push_back(
          {"P" + std::to_string(n), {20.0 + 60.0 * random.unit(), 5.0 + 50.0 * random.unit()}});
    }
    export_::Group group;
    const std::size_t placed =
        export_::add_callouts(callouts, {{{0.0, 0.0}, {100.0, 60.0}}, 15.0, 85.0, 2.0}, group);
    CHECK(placed == std::min<std::size_t>(callouts.size(), 38));
    REQUIRE(group.lines.size() == placed);
    REQUIRE(group.texts.size() == placed);
    for (std::size_t i = 0; i < placed; ++i) {
      CHECK((group.texts[i].centre.y >= 0.9 && group.texts[i].centre.y <= 59.1));
      for (std::size_t j = 0; j < i; ++j) {
        CHECK_FALSE(export_::overlap(export_::box_of(group.texts[i]), export_::box_of(group.texts[j])));
        const auto& p = group.lines[i].points;
        const auto& q = group.lines[j].points;
        const auto side = [](Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - a); };
        const bool one_column = (p[0].x < 50.0) == (q[0].x < 50.0);
        CHECK_FALSE((one_column && side(p[0], p[1], q[0]) * side(p[0], p[1], q[1]) < -1e-9 &&
                     side(q[0], q[1], p[0]) * side(q[0], q[1], p[1]) < -1e-9));
      }
    }
  }
}

}  // namespace
}  // namespace ridgecraft
