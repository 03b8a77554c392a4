// SPDX-License-Identifier: GPL-3.0-or-later
// What is written in a format is read back as it was, bit for bit; what is damaged is refused or sound.
#include <bit>
#include <cmath>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/random.hpp"
#include "mesh/write.hpp"
#include "reading.hpp"
#include "soup_writer.hpp"
#include "support/shapes.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
using mesh::Soup;

namespace {

/// Any finite double: all signs, exponents and mantissas.
double any_double(Random& random) {
  double value = 0.0;
  do {
    value = std::bit_cast<double>(random.next());
  } while (!std::isfinite(value));
  return value;
}

Soup random_soup(Random& random, bool triangles_of_floats) {
  Soup soup;
  const std::uint32_t points = 1 + random.below(40);
  for (std::uint32_t i = 0; i < points; ++i) {
    const auto coordinate = [&] {
      return triangles_of_floats ? double{static_cast<float>(random.unit() * 200 - 100)} : any_double(random);
    };
    const double x = coordinate();
    const double y = coordinate();
    soup.points.push_back({x, y, coordinate()});
  }
  const std::uint32_t polygons = 1 + random.below(40);
  for (std::uint32_t i = 0; i < polygons; ++i) {
    const std::uint32_t corners = triangles_of_floats ? 3 : random.below(random.below(10) == 0 ? 400 : 7);
    for (std::uint32_t k = 0; k < corners; ++k) {
      soup.corner_point.push_back(random.below(points));
    }
    soup.first_corner.push_back(static_cast<std::uint32_t>(soup.corner_point.size()));
  }
  return soup;
}

bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](Vec3 p, Vec3 q) {
    return p == q && std::signbit(p.x) == std::signbit(q.x) && std::signbit(p.y) == std::signbit(q.y) &&
           std::signbit(p.z) == std::signbit(q.z);
  });
}

constexpr SoupFormat indexed[] = {SoupFormat::obj, SoupFormat::off, SoupFormat::ply_ascii,
                                  SoupFormat::ply_little_endian, SoupFormat::ply_big_endian};
constexpr SoupFormat loose[] = {SoupFormat::stl_ascii, SoupFormat::stl_binary};

}  // namespace

TEST_CASE("Indexed formats give back every bit of random soups") {
  Random random(7);
  for (int round = 0; round < 200; ++round) {
    const Soup soup = random_soup(random, false);
    for (const SoupFormat format : indexed) {
      const Soup back = parsed(written(soup, format), "");
      REQUIRE(same_bits(back.points, soup.points));
      REQUIRE(back.first_corner == soup.first_corner);
      REQUIRE(back.corner_point == soup.corner_point);
    }
  }
}

TEST_CASE("STL gives back the corners of random triangles") {
  Random random(8);
  for (int round = 0; round < 200; ++round) {
    const Soup soup = random_soup(random, true);
    for (const SoupFormat format : loose) {
      const Soup back = parsed(written(soup, format), "");
      REQUIRE(back.polygon_count() == soup.polygon_count());
      for (std::size_t i = 0; i < soup.corner_point.size(); ++i) {
        REQUIRE(back.points[back.corner_point[i]] == soup.points[soup.corner_point[i]]);
      }
    }
  }
}

TEST_CASE("Damaged files are refused with a proper sentence or read as a sound soup") {
  Random random(9);
  for (int round = 0; round < 3000; ++round) {
    const bool triangles = random.below(2) == 0;
    const Soup soup = random_soup(random, triangles);
    std::string bytes = written(soup, triangles ? loose[random.below(2)] : indexed[random.below(5)]);
    for (std::uint32_t i = 0; i <= random.below(4); ++i) {
      const std::size_t at = random.below(static_cast<std::uint32_t>(bytes.size()));
      if (random.below(4) == 0) {
        bytes.resize(at + 1);
      } else {
        bytes[at] = static_cast<char>(random.below(2) == 0
                                          ? random.below(256)
                                          : static_cast<unsigned char>(" \n-/.9e#\\"[random.below(9)]));
      }
    }
    try {
      const Soup back = parsed(bytes, "");
      REQUIRE(back.first_corner.back() == back.corner_point.size());
      for (const std::uint32_t p : back.corner_point) {
        REQUIRE(p < back.points.size());
      }
      for (const Vec3 p : back.points) {
        REQUIRE((std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)));
      }
    } catch (const Error& error) {
      REQUIRE((error.kind() == ErrorKind::unreadable_input || error.kind() == ErrorKind::unusable_mesh));
      REQUIRE(std::string_view(error.what()).starts_with("model."));
      REQUIRE(std::string_view(error.what()).find('\n') == std::string_view::npos);
    }
  }
}

TEST_CASE("Surfaces are written with every bit and with their colours") {
  Random random(10);
  for (const mesh::Surface& surface : {cube(), sphere(7, 5), tetrahedron()}) {
    mesh::FaceColours colours;
    for (std::size_t f = 0; f < surface.face_count(); ++f) {
      const auto shade = static_cast<std::uint8_t>(random.below(3) * 100);
      colours.push_back({shade, 255, static_cast<std::uint8_t>(random.below(256))});
    }
    for (const std::string& bytes :
         {mesh::write_ply(surface, colours, mesh::PlyKind::ascii),
          mesh::write_ply(surface, colours, mesh::PlyKind::binary), mesh::write_off(surface, colours),
          mesh::write_ply(surface, {}, mesh::PlyKind::ascii),
          mesh::write_ply(surface, {}, mesh::PlyKind::binary), mesh::write_off(surface, {}),
          mesh::write_obj(surface)}) {
      const Soup soup = parsed(bytes, "");
      CHECK(soup.remarks.entries().empty());
      REQUIRE(same_bits(soup.points, {surface.points().begin(), surface.points().end()}));
      REQUIRE(soup.polygon_count() == surface.face_count());
      for (const FaceId f : ids<FaceId>(surface.face_count())) {
        for (unsigned k = 0; k < 3; ++k) {
          REQUIRE(soup.polygon(f.value())[k] == surface.vertex(mesh::corner(f, k)).value());
        }
        if (!soup.materials.empty() && soup.materials[0].colour) {
          const mesh::Colour& colour = *soup.materials[soup.polygon_material[f.value()]].colour;
          for (std::size_t k = 0; k < 3; ++k) {
            REQUIRE(std::lround(colour[k] * 255.0) == colours[f][k]);
          }
        }
      }
    }
  }
}
