// SPDX-License-Identifier: GPL-3.0-or-later
// Colours on pages: where they are, where they aren't, and that lines can be seen on them.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "export/paint/cells.hpp"
#include "export/paint/dot_picture.hpp"
#include "export/style/line_style.hpp"
#include "mesh/look/look.hpp"
#include "sample_pages.hpp"
#include "support/shapes.hpp"
#include "unfold/net/outline.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
using export_::Drawing;
using export_::Layer;

namespace {

const export_::Mark sample_mark{"ridgecraft 0", "Sample", "0123456789abcdef"};

/// Each face in one of these colours, in turn by its panel.
std::shared_ptr<const mesh::Look> look_of(const SamplePages& sample, const std::vector<mesh::Rgb>& colours) {
  const mesh::Surface& surface = sample.model.model.surface;
  std::vector<mesh::LookFace> faces;
  std::vector<mesh::Paint> paints;
  for (const mesh::Rgb& colour : colours) {
    paints.push_back({colour, nullptr, nullptr});
  }
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    mesh::LookFace face;
    for (unsigned k = 0; k < 3; ++k) {
      face.corners[k] = surface.point(surface.vertex(mesh::corner(f, k)));
    }
    face.normal = surface.normal(f);
    face.paint = sample.model.panels.panel[f].value() % static_cast<std::uint32_t>(colours.size());
    faces.push_back(face);
  }
  return std::make_shared<const mesh::Look>(mesh::LookParts{std::move(faces), std::move(paints)});
}

std::vector<Drawing> painted(const SamplePages& sample, export_::Ink ink = export_::Ink::colour,
                             unsigned threads = 1) {
  export_::Style style;
  style.ink = ink;
  Context context;
  context.threads = threads;
  return export_::draw({sample.model, sample.nets, sample.pages}, style, nullptr, context);
}

bool inside(const std::vector<Vec2>& convex, Vec2 p) {
  for (std::size_t i = 0; i < convex.size(); ++i) {
    if (cross(convex[(i + 1) % convex.size()] - convex[i], p - convex[i]) < 0.0) {
      return false;
    }
  }
  return true;
}

/// The colour at a place of the page, as a viewer paints it.
std::optional<export_::Color> colour_at(const Drawing& page, Vec2 p) {
  std::optional<export_::Color> found;
  for (const auto member : {&export_::Group::ground, &export_::Group::fills}) {
    for (const export_::Group& group : page.groups) {
      for (const export_::Fill& fill : group.*member) {
        for (const auto& polygon : fill.polygons) {
          found = inside(polygon, p) ? fill.color : found;
        }
      }
    }
  }
  return found;
}

export_::Color color_of(const mesh::Rgb& colour) {
  return {colour[0], colour[1], colour[2]};
}

/// Each face bears a part of one picture.
void give_picture(SamplePages& sample) {
  std::vector<std::uint8_t> pixels;
  for (std::uint32_t y = 0; y < 64; ++y) {
    for (std::uint32_t x = 0; x < 64; ++x) {
      pixels.insert(pixels.end(), {static_cast<std::uint8_t>(4 * x), static_cast<std::uint8_t>(4 * y), 90});
    }
  }
  const auto flat = look_of(sample, {{200, 30, 30}});
  std::vector<mesh::LookFace> faces = flat->faces();
  for (mesh::LookFace& face : faces) {
    face.places = {Vec2{0.1, 0.1}, {0.9, 0.1}, {0.5, 0.9}};
  }
  sample.model.look = std::make_shared<const mesh::Look>(mesh::LookParts{
      faces, {{{255, 255, 255}, std::make_shared<const mesh::Picture>(64, 64, pixels), nullptr}}});
}

/// Of all pages, in order.
std::vector<std::shared_ptr<const std::string>> pictures_of(const std::vector<Drawing>& pages) {
  std::vector<std::shared_ptr<const std::string>> all;
  for (const Drawing& page : pages) {
    for (const export_::Group& group : page.groups) {
      for (const export_::Image& image : group.images) {
        all.push_back(image.jpeg);
      }
    }
  }
  return all;
}

}  // namespace

TEST_CASE("Faces bear their own colour, and tabs that of the face that covers them") {
  const std::vector<mesh::Rgb> colours{{200, 30, 30}, {30, 160, 50}, {20, 30, 120}, {250, 220, 90}};
  const mesh::Surface ball = sphere(7, 5);
  SamplePages sample = sample_pages(ball, 40.0, 5.0, all_edges(ball));
  sample.model.look = look_of(sample, colours);
  const std::vector<Drawing> pages = painted(sample);
  const mesh::Surface& surface = sample.model.model.surface;
  const auto colour_of = [&](FaceId f) {
    return color_of(colours[sample.model.panels.panel[f].value() % colours.size()]);
  };
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const export_::Placement& place = sample.pages.placements[sample.nets.piece[f]];
    const auto& [a, b, c] = sample.nets.flat[f];
    for (const Vec2 p : {(a + b + c) / 3.0, 0.96 * a + 0.02 * b + 0.02 * c, 0.02 * a + 0.49 * b + 0.49 * c}) {
      CHECK(colour_at(pages[place.page.value()], place(p)) == colour_of(f));
    }
  }
  for (const unfold::Tab& tab : sample.nets.tabs) {
    const FaceId own = mesh::face_of(tab.side);
    const FaceId other = mesh::face_of(surface.twin(tab.side));
    const export_::Placement& place = sample.pages.placements[sample.nets.piece[own]];
    const Vec2 along = tab.polygon[1] - tab.polygon[0];
    const Vec2 out = perpendicular(along) / length(along);
    const Vec2 middle = 0.5 * (tab.polygon[0] + tab.polygon[1]);
    CHECK(colour_at(pages[place.page.value()], place(middle + 0.5 * out)) == colour_of(other));
    CHECK_FALSE(colour_at(pages[place.page.value()], place(middle + (export_::bleed_mm + 0.5) * out)));
  }
  CHECK_FALSE(std::any_of(pages.begin(), pages.end(), [](const Drawing& page) {
    return std::any_of(page.groups.begin(), page.groups.end(),
                       [](const export_::Group& group) { return !group.images.empty(); });
  }));
}

TEST_CASE("Something near one place of an edge takes its colours beyond the cut only there") {
  const SamplePages sample = sample_pages(cube(), 50.0, 0.0, all_edges(cube()), "Sample", {}, 0.2);
  const mesh::Surface& surface = sample.model.model.surface;
  const PieceId piece(0);
  const export_::Placement& place = sample.pages.placements[piece];
  std::vector<Vec2> outline;
  const auto cuts = unfold::cut_lines(surface, sample.nets, piece);
  REQUIRE(cuts.loops.size() == 1);
  for (const Vec2 p : cuts.loops[0]) {
    outline.push_back(place(p));
  }
  REQUIRE(outline.size() == 4);
  const Vec2 a = outline[0];
  const Vec2 along = (outline[1] - a) / length(outline[1] - a);
  const Vec2 out = -perpendicular(along);
  const Vec2 tip = a + 25.0 * along + 0.08 * out;
  std::vector<export_::PieceDrawing> page(2);
  page[0].group.lines.push_back({Layer::cut, outline, true});
  page[1].group.lines.push_back(
      {Layer::cut, {tip, tip + 20.0 * out + 5.0 * along, tip + 20.0 * out - 5.0 * along}, true});
  const auto contents = export_::piece_contents(surface, sample.nets);
  const auto cells = export_::cells_of({sample.model, sample.nets, piece, contents[piece], place}, page, 0);
  const auto is_coloured = [&](double at, double beyond) {
    return std::ranges::any_of(cells, [&](const export_::Cell& cell) {
      return cell.kind == export_::CellKind::bleed && inside(cell.polygon, a + at * along + beyond * out);
    });
  };
  for (const double at : {0.5, 5.0, 12.3, 20.0, 30.0, 37.7, 45.0, 49.5}) {
    CHECK(is_coloured(at, 0.05));
    CHECK(is_coloured(at, 1.9));
  }
  for (const double at : {22.0, 23.0, 27.0, 28.0}) {
    CAPTURE(at);
    const double room = std::abs(at - 25.0);
    CHECK(is_coloured(at, 0.25 * (room - 0.9)));
    CHECK_FALSE(is_coloured(at, 0.5 * room + 0.1));
  }
  CHECK_FALSE(is_coloured(25.0, 0.06));
}

TEST_CASE("A short line that meets an edge's end takes its colours beyond the cut only as far as it goes") {
  const SamplePages sample = sample_pages(cube(), 50.0, 0.0, all_edges(cube()), "Sample", {}, 0.2);
  const mesh::Surface& surface = sample.model.model.surface;
  const PieceId piece(0);
  const export_::Placement& place = sample.pages.placements[piece];
  std::vector<Vec2> outline;
  const auto cuts = unfold::cut_lines(surface, sample.nets, piece);
  REQUIRE(cuts.loops.size() == 1);
  for (const Vec2 p : cuts.loops[0]) {
    outline.push_back(place(p));
  }
  const auto contents = export_::piece_contents(surface, sample.nets);
  const double size = length(outline[1] - outline[0]);
  for (const bool at_end : {false, true}) {
    CAPTURE(at_end);
    // Distances are measured from the corner that the line meets.
    const Vec2 corner = outline[at_end ? 1 : 0];
    const Vec2 along = (outline[at_end ? 0 : 1] - corner) / size;
    const Vec2 out = at_end ? perpendicular(along) : -perpendicular(along);
    std::vector<export_::PieceDrawing> page(1);
    page[0].group.lines.push_back({Layer::cut, outline, true});
    page[0].group.lines.push_back({Layer::cut, {corner, corner + 10.0 * along + 0.5 * out}, false});
    const auto cells = export_::cells_of({sample.model, sample.nets, piece, contents[piece], place}, page, 0);
    const auto is_coloured = [&](double at, double beyond) {
      return std::ranges::any_of(cells, [&](const export_::Cell& cell) {
        return cell.kind == export_::CellKind::bleed &&
               inside(cell.polygon, corner + at * along + beyond * out);
      });
    };
    // The two share the gap beside it, and it is in nobody's way farther on.
    for (const double at : {5.0, 8.0}) {
      CAPTURE(at);
      CHECK(is_coloured(at, 0.02 * at));
      CHECK_FALSE(is_coloured(at, 0.03 * at));
    }
    CHECK(is_coloured(13.0, 0.5));
    for (const double at : {16.0, 20.0, 35.0, 48.0}) {
      CAPTURE(at);
      CHECK(is_coloured(at, 1.9));
    }
  }
}

TEST_CASE("Where a tab is shorter than its edge, colours reach beyond the rest of it") {
  SamplePages sample = sample_pages(cube(), 50.0, 6.0);
  REQUIRE_FALSE(sample.nets.tabs.empty());
  unfold::Tab& tab = sample.nets.tabs[TabId(0)];
  const Vec2 base = tab.polygon[1] - tab.polygon[0];
  const Vec2 corner = tab.polygon[0];
  tab.polygon[0] = corner + 0.3 * base;
  tab.polygon[1] = corner + 0.8 * base;
  const FaceId face = mesh::face_of(tab.side);
  const PieceId piece = sample.nets.piece[face];
  const export_::Placement& place = sample.pages.placements[piece];
  const auto contents = export_::piece_contents(sample.model.model.surface, sample.nets);
  const auto cells = export_::cells_of({sample.model, sample.nets, piece, contents[piece], place},
                                       std::vector<export_::PieceDrawing>(1), 0);
  const Vec2 out = perpendicular(base) / length(base);  // a tab runs against the clock, from its base
  for (const auto& [share, kind] : {std::pair{0.05, export_::CellKind::bleed},
                                    {0.25, export_::CellKind::bleed},
                                    {0.55, export_::CellKind::tab},
                                    {0.9, export_::CellKind::bleed}}) {
    CAPTURE(share);
    const Vec2 p = place(corner + share * base + 0.3 * out);
    CHECK(std::ranges::any_of(cells, [&, wanted = kind](const export_::Cell& cell) {
      return cell.kind == wanted && (wanted == export_::CellKind::tab || cell.face == face) &&
             inside(cell.polygon, p);
    }));
  }
}

TEST_CASE("Colours reach beyond cut edges, but not to other pieces") {
  SamplePages sample = sample_pages(cube(), 50.0, 0.0, all_edges(cube()), "Sample", {}, 0.2);
  sample.model.look = look_of(sample, {{200, 30, 30}, {30, 160, 50}, {20, 30, 120}});
  const std::vector<Drawing> pages = painted(sample);
  const mesh::Surface& surface = sample.model.model.surface;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const export_::Placement& place = sample.pages.placements[sample.nets.piece[f]];
    for (unsigned k = 0; k < 3; ++k) {
      if (sample.nets.use[surface.edge(mesh::corner(f, k))] == unfold::EdgeUse::fold) {
        continue;
      }
      const Vec2 a = place(sample.nets.flat[f][k]);
      const Vec2 b = place(sample.nets.flat[f][(k + 1) % 3]);
      const Vec2 out = -perpendicular(b - a) / length(b - a);
      for (const double share : {0.02, 0.5, 0.98}) {
        // Half of the gap between pieces is the least.
        const Vec2 p = a + share * (b - a) + 0.8 * out;
        CHECK(colour_at(pages[place.page.value()], p) ==
              colour_at(
                  pages[place.page.value()],
                  place((sample.nets.flat[f][0] + sample.nets.flat[f][1] + sample.nets.flat[f][2]) / 3.0)));
      }
    }
  }
  // No rim lies on another piece.
  for (const Drawing& page : pages) {
    for (const export_::Group& group : page.groups) {
      for (const export_::Group& other : page.groups) {
        for (const export_::Fill& ground : group.ground) {
          for (const auto& rim : ground.polygons) {
            for (const export_::Fill& fill : other.fills) {
              for (const auto& face : fill.polygons) {
                const Vec2 middle = 0.25 * (rim[0] + rim[1] + rim[2] + rim[3 % rim.size()]);
                CHECK_FALSE(inside(face, middle));
              }
            }
          }
        }
      }
    }
  }
}

TEST_CASE(
    "Lines and letters on dark faces are light, on both they have a halo, on light ones they are dark") {
  SamplePages sample = sample_pages(cube(), 50.0, 5.0);
  const auto tones = [&](const std::vector<mesh::Rgb>& colours) {
    sample.model.look = look_of(sample, colours);
    std::array<std::size_t, 3> counts{};  // dark, light, halos
    for (const Drawing& page : painted(sample)) {
      for (const export_::Group& group : page.groups) {
        for (const export_::Line& line : group.lines) {
          if (line.layer == Layer::paint) {
            ++counts[2];
          } else if (line.layer == Layer::mountain) {
            ++counts[line.tone == export_::Tone::light ? 1 : 0];
          }
        }
      }
    }
    return counts;
  };
  const auto light = tones({{250, 240, 200}});
  CHECK(light[0] > 0);
  CHECK(light[1] == 0);
  CHECK(light[2] == 0);
  const auto dark = tones({{30, 10, 60}});
  CHECK(dark[0] == 0);
  CHECK(dark[1] == light[0]);
  const auto both = tones({{30, 10, 60}, {250, 240, 200}});
  CHECK(both[0] > 0);
  CHECK(both[2] > 0);
}

TEST_CASE("Numbers have a halo wherever neither black nor light strokes stand out from their ground") {
  SamplePages sample = sample_pages(cube(), 50.0, 5.0);
  const auto halos = [&](mesh::Rgb colour) {
    sample.model.look = look_of(sample, {colour});
    std::size_t found = 0;
    std::size_t inside = 0;
    for (const Drawing& page : painted(sample)) {
      for (const export_::Group& group : page.groups) {
        for (const export_::Text& text : group.texts) {
          found += text.layer == Layer::paint ? 1U : 0U;
          inside += text.layer == Layer::piece_name ? 1U : 0U;
        }
      }
    }
    REQUIRE(inside > 0);
    return found;
  };
  // Black on it 5.3 : 1, light grey 3.4 : 1.
  CHECK(halos({64, 133, 189}) > 0);
  // Numbers that reach over an edge have one on every dark ground; on these colours no others do.
  CHECK(halos({250, 240, 200}) == 0);
  CHECK(halos({64, 133, 189}) > halos({30, 10, 60}));
}

TEST_CASE("Pages in lines alone are those of a model without colours, and threads change nothing") {
  SamplePages sample = sample_pages(sphere(7, 5), 40.0, 5.0);
  const std::vector<Drawing> plain = painted(sample);
  sample.model.look = look_of(sample, {{200, 30, 30}, {30, 160, 50}});
  const std::vector<Drawing> coloured = painted(sample);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    CHECK(export_::write_svg(plain[i], sample_mark) ==
          export_::write_svg(painted(sample, export_::Ink::lines)[i], sample_mark));
    CHECK(export_::write_svg(plain[i], sample_mark) != export_::write_svg(coloured[i], sample_mark));
    CHECK(export_::write_svg(coloured[i], sample_mark) ==
          export_::write_svg(painted(sample, export_::Ink::colour, 4)[i], sample_mark));
    CHECK(export_::write_dxf(plain[i], sample_mark) == export_::write_dxf(coloured[i], sample_mark));
    for (const export_::Preset& preset : export_::presets()) {
      if (!preset.simulates) {
        CHECK(export_::write_machine_svg(plain[i], sample_mark, preset) ==
              export_::write_machine_svg(coloured[i], sample_mark, preset));
      }
    }
  }
  CHECK(export_::write_pdf(coloured, sample_mark) ==
        export_::write_pdf(painted(sample, export_::Ink::colour, 4), sample_mark));
}

TEST_CASE("Pictures have the dots that are asked for, and lie under their faces") {
  SamplePages sample = sample_pages(cube(), 50.0, 5.0);
  give_picture(sample);
  for (const double dots : {72.0, 300.0}) {
    export_::Style style;
    style.dots_per_inch = dots;
    std::size_t images = 0;
    for (const Drawing& page : export_::draw({sample.model, sample.nets, sample.pages}, style)) {
      for (const export_::Group& group : page.groups) {
        for (const export_::Image& image : group.images) {
          ++images;
          CHECK(image.width / (image.place.high.x - image.place.low.x) == Approx(dots / 25.4));
          CHECK(image.height / (image.place.high.y - image.place.low.y) == Approx(dots / 25.4));
          const auto unpacked = mesh::unpack_picture(*image.jpeg);
          REQUIRE(unpacked);
          CHECK(unpacked->width() == image.width);
          CHECK(unpacked->height() == image.height);
          for (const auto& polygon : image.clip) {
            for (const Vec2 p : polygon) {
              CHECK((p.x >= image.place.low.x && p.x <= image.place.high.x && p.y >= image.place.low.y &&
                     p.y <= image.place.high.y));
            }
          }
        }
      }
    }
    CHECK(images == sample.nets.pieces.size());
  }
}

TEST_CASE("Dots that nobody sees have a neighbour's colour, and take no room") {
  // A ring of dots in two colours, in a box that is no multiple of JPEG's squares.
  const auto ring = [](double dots_per_mm, bool painted_all) {
    export_::DotRaster raster({{0.0, 0.0}, {43.0, 37.0}}, dots_per_mm);
    for (int y = 0; y < raster.height(); ++y) {
      for (int x = 0; x < raster.width(); ++x) {
        const double away = length(raster.middle(x, y) - Vec2{21.0, 18.0});
        if (painted_all || (away > 12.0 && away < 16.0)) {
          raster.paint(x, y, raster.middle(x, y).x < 21.0 ? mesh::Rgb{210, 30, 30} : mesh::Rgb{30, 30, 210});
        }
      }
    }
    raster.fill_up();
    return raster.image();
  };
  const export_::Image image = ring(4.0, false);
  const auto unpacked = mesh::unpack_picture(*image.jpeg);
  REQUIRE(unpacked);
  std::size_t others = 0;
  for (std::size_t i = 0; i < unpacked->pixels().size(); i += 3) {
    const int red = unpacked->pixels()[i];
    const int blue = unpacked->pixels()[i + 2];
    others += std::abs(std::abs(red - blue) - 180) > 60 ? 1U : 0U;
  }
  CHECK(others < unpacked->pixels().size() / 3 / 100);  // along the border of the two
  CHECK(image.jpeg->size() < 2 * ring(4.0, true).jpeg->size());
  export_::DotRaster nothing({{0.0, 0.0}, {5.0, 5.0}}, 4.0);
  nothing.fill_up();
  const auto white = mesh::unpack_picture(*nothing.image().jpeg);
  REQUIRE(white);
  CHECK(std::ranges::all_of(white->pixels(), [](std::uint8_t byte) { return byte == 255; }));
}

TEST_CASE("Pictures are painted again only where something of them changes, and pages are the same") {
  const mesh::Surface ball = sphere(7, 5);
  SamplePages sample = sample_pages(ball, 40.0, 5.0, all_edges(ball));
  give_picture(sample);
  export_::DrawReport report;
  const auto first = pictures_of(export_::draw({sample.model, sample.nets, sample.pages}, {}, &report));
  REQUIRE(first.size() > 1);
  CHECK(pictures_of(export_::draw({sample.model, sample.nets, sample.pages}, {}, &report)) == first);

  // One piece goes to a page of its own, where nothing is near it, so all others keep theirs or lose a
  // neighbour.
  sample.pages.placements[PieceId(sample.nets.pieces.size() - 1)].page = PageId(sample.pages.count++);
  const std::vector<Drawing> moved = export_::draw({sample.model, sample.nets, sample.pages}, {}, &report);
  const std::vector<Drawing> fresh = painted(sample);
  REQUIRE(moved.size() == fresh.size());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    CHECK(export_::write_svg(moved[i], mark) == export_::write_svg(fresh[i], mark));
  }
  const auto after = pictures_of(moved);
  CHECK(std::any_of(after.begin(), after.end(), [&](const auto& picture) {
    return std::find(first.begin(), first.end(), picture) != first.end();
  }));

  // Another style has other pictures.
  export_::Style pale;
  pale.ink = export_::Ink::pale;
  for (const auto& picture :
       pictures_of(export_::draw({sample.model, sample.nets, sample.pages}, pale, &report))) {
    CHECK(std::find(after.begin(), after.end(), picture) == after.end());
  }
}
