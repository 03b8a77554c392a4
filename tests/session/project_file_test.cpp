// SPDX-License-Identifier: GPL-3.0-or-later
// A project that is written and read again is the same, and what is damaged is refused with a sentence.
#include "session/project_file.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "base/random.hpp"

using namespace ridgecraft;
using session::ProjectFile;
using session::read_project;
using session::write_project;

namespace {

ProjectFile example() {
  return {.model = "Haus ä.obj",
          .files = {{"Haus ä.obj", std::string(5000, 'v') + "\n"}, {"wood.png", std::string("\0\1\2", 3)}},
          .words = {"--size=20cm", "--paper=A3"},
          .edits = "cut 3 17; join 5 9\npin 12",
          .nets = "{}",
          .digest = "0123456789abcdef"};
}

/// The checksum of archives: polynomial 0xEDB88320, bit by bit.
std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t sum = 0xffffffffU;
  for (const char c : bytes) {
    sum ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) {
      sum = (sum & 1U) != 0 ? sum >> 1U ^ 0xedb88320U : sum >> 1U;
    }
  }
  return ~sum;
}

std::string four_bytes(std::uint32_t value) {
  std::string bytes;
  for (unsigned k = 0; k < 4; ++k) {
    bytes += static_cast<char>(value >> (8U * k) & 0xffU);
  }
  return bytes;
}

void check_equal(const ProjectFile& a, const ProjectFile& b) {
  CHECK(a.model == b.model);
  CHECK(a.files == b.files);
  CHECK(a.words == b.words);
  CHECK(a.edits == b.edits);
  CHECK(a.nets == b.nets);
  CHECK(a.digest == b.digest);
}

}  // namespace

TEST_CASE("a project that was written is read as it was") {
  const std::string bytes = write_project(example());
  CHECK(session::holds_project(bytes));
  check_equal(read_project("x.ridgecraft", bytes), example());
  CHECK(write_project(read_project("x.ridgecraft", bytes)) == bytes);
}

TEST_CASE("a page gives back the project that it holds") {
  ProjectFile project = example();
  project.nets.clear();
  const std::string page =
      session::page_with_project("<!doctype html><body></body></html>", write_project(project));
  CHECK(session::holds_project(page));
  check_equal(read_project("x.html", page), project);
  CHECK_FALSE(session::holds_project("<!doctype html><body></body></html>"));
}

TEST_CASE("a project that is cut off or changed is refused or read, and nothing else") {
  const std::string bytes = write_project(example());
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    CHECK_THROWS_AS(read_project("x.ridgecraft", bytes.substr(0, size)), Error);
  }
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    std::string other = bytes;
    other[random.below(static_cast<std::uint32_t>(other.size()))] = static_cast<char>(random.below(256));
    try {
      static_cast<void>(read_project("x.ridgecraft", other));
    } catch (const Error& error) {
      CHECK(error.kind() == ErrorKind::unreadable_input);
    }
  }
}

TEST_CASE("names that lead out of a project, or are another's, are refused") {
  CHECK_FALSE(session::why_no_project(example()));
  for (const char* name : {"../x.obj", "a/b.obj", "/etc/passwd", "..", "c:x.obj", "tab\t.obj", "WOOD.png"}) {
    INFO(name);
    ProjectFile project = example();
    project.files[name] = "x";
    CHECK(session::why_no_project(project));
    CHECK_THROWS_AS(read_project("x.ridgecraft", write_project(project)), Error);
  }
}

TEST_CASE("only a newer version is called one") {
  const std::string bytes = write_project(example());
  const std::string version = "\"version\": 1";
  const std::size_t at = bytes.find(version);
  REQUIRE(at != std::string::npos);
  for (const auto& [other, sentence] :
       std::vector<std::pair<std::string, std::string>>{{"\"version\": 9", "newer version"},
                                                        {"\"version\": 0", "damaged"},
                                                        {"\"version\":\"\"", "damaged"},
                                                        {"\"versiom\": 1", "damaged"}}) {
    // What isn't packed can be changed where its checksum is, too.
    std::string changed = bytes;
    changed.replace(at, version.size(), other);
    const std::size_t text = changed.find('{');
    const std::size_t size = changed.find("PK\x03\x04", text) - text;
    const std::uint32_t sum = crc32(changed.substr(text, size));
    const std::uint32_t old = crc32(bytes.substr(text, size));
    for (std::size_t i = changed.find(four_bytes(old)); i != std::string::npos;
         i = changed.find(four_bytes(old))) {
      changed.replace(i, 4, four_bytes(sum));
    }
    try {
      static_cast<void>(read_project("x.ridgecraft", changed));
      FAIL("a project with " << other << " is read");
    } catch (const Error& error) {
      CHECK_THAT(error.what(), Catch::Matchers::Contains(sentence));
    }
  }
}

TEST_CASE("nets in a page that are damaged are refused") {
  ProjectFile project = example();
  const std::string page = session::page_with_project(
      R"(<!doctype html><body><script type="text/plain" id="fold">eJwDAAAAAAE=</script></body></html>)",
      write_project(project));
  CHECK(read_project("x.html", page).nets.empty());
  std::string damaged = page;
  damaged.replace(page.find("eJwDAAAAAAE="), 12, "eJwDAAAAAAI=");
  CHECK_THROWS_AS(read_project("x.html", damaged), Error);
}
