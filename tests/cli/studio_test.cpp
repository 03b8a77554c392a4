// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft studio: a page with a model in it. What the page does is tested in browsers
// (tests/web/studio.mjs).
#include <filesystem>
#include <string>
#include <variant>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "base/encodings.hpp"
#include "base/error.hpp"
#include "cli/arguments/parse.hpp"
#include "cli/jobs/studio_job.hpp"
#include "support/program.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using namespace ridgecraft::cli;
using namespace ridgecraft::test;

namespace {

const std::string before = R"(<script type="application/json" id="start">)";
const std::string frame = "<p>a</p>\n" + before + "{}</script>\n<p>b</p>\n";

StudioJob studio_job(const std::vector<std::string>& words) {
  return std::get<StudioJob>(parse_arguments(words));
}

/// What a page of the studio begins with.
nlohmann::json start_in(const std::string& page) {
  const std::size_t at = page.find(before) + before.size();
  return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
}

std::string studio_refusal(const std::vector<std::string>& words) {
  try {
    static_cast<void>(parse_arguments(words));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("the studio's words are a model and options of the main job", "[studio]") {
  CHECK(studio_job({"studio"}).model.empty());
  CHECK_FALSE(studio_job({"studio"}).no_browser);
  const StudioJob job = studio_job({"studio", "--size", "20cm", "whale.obj", "--no-browser", "--all-tabs"});
  CHECK(job.model == "whale.obj");
  CHECK(job.words == std::vector<std::string>{"--size", "20cm", "--all-tabs"});
  CHECK(job.no_browser);
}

TEST_CASE("the studio refuses what it does itself, and what the main job refuses", "[studio]") {
  CHECK(studio_refusal({"studio", "whale.obj", "-o", "x.pdf"}).find("leave out -o") != std::string::npos);
  CHECK(studio_refusal({"studio", "whale.obj", "--cuts", "x.txt"}).find("leave out -o") != std::string::npos);
  CHECK(studio_refusal({"studio", "-"}).find("standard input") != std::string::npos);
  CHECK(studio_refusal({"studio", "whale.obj", "--size", "big"}).find("--size") != std::string::npos);
  CHECK_FALSE(studio_refusal({"studio", "whale.obj", "shark.obj"}).empty());
}

TEST_CASE("the studio's page has the model, what its materials name, and the words", "[studio]") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "textures");
  const std::string model =
      "mtllib skin.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 3/1 2/1 "
      "1/1\n";
  const std::string picture =
      read_bytes(std::string(RIDGECRAFT_SOURCE_DIR) + "/tests/fuzz/corpus/picture/small.png");
  write_bytes(folder / "a<b>.obj", model);
  write_bytes(folder / "other.mtl", "newmtl b\n");
  write_bytes(folder / "textures/wood.png", picture);
  write_bytes(folder / "secret.png", picture);
  // What lies elsewhere stays there, although a link to it has the name of a picture.
  const TemporaryFolder elsewhere;
  write_bytes(elsewhere / "private.png", picture);
  std::filesystem::create_symlink(elsewhere / "private.png", folder / "link.png");
  write_bytes(folder / "skin.mtl", "newmtl a\nmap_Kd textures/wood.png\nnewmtl b\nmap_Kd link.png\n");
  const StudioJob job{(folder / "a<b>.obj").string(), {"--only", "</script>"}, true};
  const std::string page = studio_page(frame, job);
  CHECK(page.starts_with("<p>a</p>"));
  CHECK(page.ends_with("</script>\n<p>b</p>\n"));
  const nlohmann::json start = start_in(page);
  CHECK(start["name"] == "a<b>.obj");
  CHECK(start["words"] == nlohmann::json{"--only", "</script>"});
  CHECK(start["files"].size() == 3);
  CHECK(start["files"]["a<b>.obj"] == base64(model));
  CHECK(start["files"].contains("skin.mtl"));
  CHECK(start["files"]["wood.png"] == base64(picture));

  CHECK(start_in(studio_page(frame, StudioJob{})).empty());
  CHECK_THROWS_AS(studio_page("<p>another page</p>", job), Error);
  CHECK_THROWS_AS(studio_page(frame, StudioJob{(folder / "none.obj").string(), {}, true}), Error);
}

TEST_CASE("a page for one user is read by nobody else, and no other page's name", "[studio]") {
  const TemporaryFolder folder;
  ::setenv("XDG_RUNTIME_DIR", folder.path().c_str(), 1);
  const std::filesystem::path first = write_private_page("one");
  const std::filesystem::path second = write_private_page("two");
  ::unsetenv("XDG_RUNTIME_DIR");
  CHECK(first != second);
  CHECK(first.parent_path() == folder.path());
  CHECK(first.extension() == ".html");
  CHECK(read_bytes(first) == "one");
  struct stat status = {};
  REQUIRE(::stat(first.c_str(), &status) == 0);
  CHECK((status.st_mode & 0777U) == 0600U);
  const std::filesystem::path elsewhere = write_private_page("three");
  CHECK(elsewhere.parent_path() != folder.path());
  REQUIRE(::stat(elsewhere.parent_path().c_str(), &status) == 0);
  CHECK((status.st_mode & 0777U) == 0700U);
  std::filesystem::remove_all(elsewhere.parent_path());
}

TEST_CASE("where there is no studio.html the program says how to get it", "[studio]") {
  const TemporaryFolder folder;
  // A program of the same bytes with nothing beside it.
  std::filesystem::copy_file(RIDGECRAFT_PROGRAM, folder / "ridgecraft");
  const Outcome outcome = run_command({(folder / "ridgecraft").string(), "studio", "--no-browser"});
  CHECK(outcome.exit_code == 3);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.find("wasm/build.sh") != std::string::npos);
  // And one with a page.
  std::filesystem::create_directory(folder / "bin");
  std::filesystem::create_directories(folder / "share/ridgecraft");
  std::filesystem::rename(folder / "ridgecraft", folder / "bin/ridgecraft");
  write_bytes(folder / "share/ridgecraft/studio.html", frame);
  const Outcome found = run_command({"env", "XDG_RUNTIME_DIR=" + folder.path().string(),
                                     (folder / "bin/ridgecraft").string(), "studio", "--no-browser"});
  CHECK(found.exit_code == 0);
  REQUIRE(found.out.ends_with(".html\n"));
  CHECK(read_bytes(found.out.substr(0, found.out.size() - 1)) == frame);
}
