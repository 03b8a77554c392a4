// SPDX-License-Identifier: GPL-3.0-or-later
// What is written in a format is read back as it was, bit for bit; what is damaged is refused or sound.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/random.hpp"
#include "fuzz/fuzz_reader.hpp"
#include "mesh/file_writers.hpp"
#include "mesh/mesh.hpp"
#include "mesh/reading/pdo/read_pdo.hpp"
#include "mesh/seeds.hpp"
#include "reading.hpp"
#include "support/shapes.hpp"
#include "support/temporary_folder.hpp"

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

// Files of glTF, 3MF and PDO with bytes changed, cut out, doubled and swapped: read as a sound soup and
// repaired, or refused with a proper sentence. RIDGECRAFT_MUTATIONS=100000 does so many of each kind; ulimit
// -v tells how much memory they may take.

namespace fs = std::filesystem;

namespace {

std::uint32_t wanted_mutations() {
  const char* const asked = std::getenv("RIDGECRAFT_MUTATIONS");
  return asked != nullptr ? static_cast<std::uint32_t>(std::atoi(asked)) : 600U;
}

std::uint32_t below(Random& random, std::size_t count) {
  return random.below(static_cast<std::uint32_t>(std::max<std::size_t>(count, 1)));
}

/// Numbers that are dear to those who look for mistakes.
const std::vector<std::string> numbers{
    "0",     "-1",   "1",          "4294967295", "4294967296", "18446744073709551615",
    "1e308", "-0.5", "2147483648", "65535",      "null",       "[]",
    "{}",    "\"\"", "true",       "1e-320"};

/// Puts one of them in the place of a number in a text.
void change_number(std::string& bytes, Random& random) {
  const std::size_t from = bytes.find_first_of("0123456789", below(random, bytes.size()));
  if (from == bytes.npos) {
    return;
  }
  const std::size_t to = std::min(bytes.find_first_not_of("0123456789.-+eE", from), bytes.size());
  bytes.replace(from, to - from, numbers[below(random, numbers.size())]);
}

void mutate(std::string& bytes, Random& random) {
  const std::size_t at = below(random, bytes.size());
  const std::size_t length = std::min<std::size_t>(bytes.size() - at, 1 + below(random, 40));
  switch (random.below(8)) {
    case 0:
      bytes[at] = static_cast<char>(random.below(256));
      break;
    case 1:
      bytes[at] = static_cast<char>(bytes[at] ^ static_cast<char>(1U << random.below(8)));
      break;
    case 2:
      bytes.erase(at, length);
      break;
    case 3:
      bytes.insert(at, std::string(bytes, below(random, bytes.size()), length));
      break;
    case 4:
      if (random.below(4) == 0) {
        bytes.resize(at);
      } else {
        bytes.replace(at, length, length, static_cast<char>(random.below(2) == 0 ? 0 : 255));
      }
      break;
    default:
      change_number(bytes, random);
  }
  if (bytes.empty()) {
    bytes = " ";
  }
}

std::string mutated(std::string bytes, Random& random) {
  for (std::uint32_t i = 0; i <= random.below(4); ++i) {
    mutate(bytes, random);
  }
  return bytes;
}

struct Tally {
  std::size_t read = 0;
  std::size_t refused = 0;
};

/// Reads and repairs; the promises of both are checked.
void try_file(const std::string& bytes, const std::string& name, Tally& tally) {
  const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  (void)fuzz_reader(data, bytes.size(), name);
  try {
    const mesh::Model model = mesh::read(mesh::ModelFile{bytes, name, "model", {}}, {}, {});
    REQUIRE(model.surface.face_count() > 0);
    ++tally.read;
  } catch (const Error&) {
    ++tally.refused;
  }
  if (mesh::may_have_seams(bytes)) {
    try {
      (void)mesh::read_seams(bytes, name, {});
    } catch (const Error&) {
    }
  }
}

/// The collection's files below a size that leaves time for many, where they are at hand.
std::vector<std::string> collected(const fs::path& folder, const std::set<std::string>& suffixes) {
  constexpr std::uintmax_t largest = 50'000;
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && suffixes.contains(entry.path().extension().string()) &&
        entry.file_size() < largest) {
      files.push_back(read_bytes(entry.path()));
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> seeds(std::vector<std::string> own, const std::set<std::string>& suffixes) {
  const fs::path archive = fs::path(RIDGECRAFT_SHARED_DIR) / "models/formats.tar.xz";
  if (fs::exists(archive)) {
    const TemporaryFolder folder(memory());
    if (std::system(("tar xJf '" + archive.string() + "' -C '" + folder.path().string() + "'").c_str()) ==
        0) {
      const std::vector<std::string> more = collected(folder.path(), suffixes);
      own.insert(own.end(), more.begin(), more.end());
    }
  }
  return own;
}

void try_mutations(const std::vector<std::string>& files, const std::string& name, std::uint64_t seed) {
  Random random(seed);
  Tally tally;
  for (const std::string& file : files) {
    try_file(file, name, tally);
  }
  const std::uint32_t wanted = wanted_mutations();
  for (std::uint32_t i = 0; i < wanted; ++i) {
    // Every other one is our own, which uses the most.
    const std::string& file = random.below(2) == 0 ? files.front() : files[below(random, files.size())];
    try_file(mutated(file, random), name, tally);
  }
  CHECK(tally.read > 0);
  CHECK(tally.refused > wanted / 10);
  if (wanted > 10'000) {
    WARN(name << ": " << wanted << " mutated files, " << tally.read << " read, " << tally.refused
              << " refused");
  }
}

}  // namespace

TEST_CASE("Damaged GLB files are read or refused") {
  try_mutations(seeds({rich_glb()}, {".glb"}), "model.glb", 11);
}

TEST_CASE("Damaged glTF files are read or refused") {
  try_mutations(seeds({rich_gltf()}, {".gltf"}), "model.gltf", 12);
}

TEST_CASE("Damaged 3MF files are read or refused") {
  try_mutations(seeds({rich_3mf()}, {".3mf"}), "model.3mf", 13);
}

TEST_CASE("Damaged PDO files are read or refused") {
  const PdoTestFile file = rich_pdo_file();
  try_mutations({pdo(file), pdo(file, {.version = 4}), pdo(file, {.version = 5, .shift = 99}),
                 pdo(file, {.version = 6, .wide = true, .length_in_bytes = true, .shift = 7})},
                "model.pdo", 15);
}

TEST_CASE("Sound packages with damaged XML are read or refused") {
  Random random(14);
  Tally tally;
  const std::uint32_t wanted = wanted_mutations();
  for (std::uint32_t i = 0; i < wanted; ++i) {
    const std::string model = mutated(rich_model(), random);
    try_file(threemf(model, rich_parts(), i % 2 == 0 ? Packing::stored : Packing::deflated), "model.3mf",
             tally);
  }
  CHECK(tally.refused > wanted / 10);
  if (wanted > 10'000) {
    WARN("XML: " << wanted << " mutated files, " << tally.read << " read, " << tally.refused << " refused");
  }
}
