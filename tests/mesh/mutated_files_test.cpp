// SPDX-License-Identifier: GPL-3.0-or-later
// Files of glTF, 3MF and PDO with bytes changed, cut out, doubled and swapped: read as a sound soup and
// repaired, or refused with a proper sentence. RIDGECRAFT_MUTATIONS=100000 does so many of each kind; ulimit
// -v tells how much memory they may take.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "format_seeds.hpp"
#include "fuzz/fuzz_reader.hpp"
#include "mesh/mesh.hpp"
#include "mesh/reading/pdo/read_seams.hpp"
#include "package_writer.hpp"
#include "pdo_writer.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
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
