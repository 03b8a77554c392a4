// SPDX-License-Identifier: GPL-3.0-or-later
// What the main job writes, where, and what it never leaves behind or replaces.
#include <catch2/catch.hpp>
#include <unistd.h>

#include "cli/program_checks.hpp"
#include "support/page_document.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft::test;
namespace fs = std::filesystem;

TEST_CASE("a model becomes PDF, SVG, FOLD and HTML in the current folder", "[written_files]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  const Outcome outcome = run_program({"house.obj", "--size", "8cm"}, in(folder));
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(folder.names() == std::set<std::string>{"house.obj", "house.pdf", "house-guide.pdf", "house.svg",
                                                "house.fold", "house.html"});
  CHECK(outcome.out.find("wrote house.pdf") != std::string::npos);
  CHECK(read_bytes(folder / "house.pdf").starts_with("%PDF"));
  CHECK(run_program({"verify", "house.fold"}, in(folder)).exit_code == 0);
}

TEST_CASE("a guide stands beside each PDF, unless nobody wants it", "[written_files]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  REQUIRE(run_program({"house.obj", "--size", "8cm", "-o", "a.pdf"}, in(folder)).exit_code == 0);
  CHECK(folder.names() == std::set<std::string>{"house.obj", "a.pdf", "a-guide.pdf"});
  CHECK(read_bytes(folder / "a-guide.pdf").starts_with("%PDF"));
  // Guides are read on any paper, and hold no nets to be checked.
  REQUIRE(run_program({"house.obj", "--size", "8cm", "-o", "a.fold"}, in(folder)).exit_code == 0);
  const Outcome checked = run_program({"verify", "a.fold", "--pages", "a.pdf", "a-guide.pdf"}, in(folder));
  INFO(checked.out);
  CHECK(checked.exit_code == 0);
  // A guide to nets that aren't there any more goes with them; somebody's own file stays.
  REQUIRE(run_program({"house.obj", "--size", "9cm", "--no-guide", "-o", "a.pdf"}, in(folder)).exit_code ==
          0);
  CHECK(folder.names() == std::set<std::string>{"house.obj", "a.pdf", "a.fold"});
  write_bytes(folder / "a-guide.pdf", "mine");
  check_refusal(run_program({"house.obj", "--size", "8cm", "-o", "a.pdf"}, in(folder)), 7, "a-guide.pdf");
  CHECK(run_program({"house.obj", "--size", "8cm", "--no-guide", "-o", "a.pdf"}, in(folder)).exit_code == 0);
  CHECK(read_bytes(folder / "a-guide.pdf") == "mine");
  check_refusal(run_program({"house.obj", "-o", "b.pdf", "-o", "b-guide.pdf"}, in(folder)), 2, "--no-guide");
  CHECK(run_program({"house.obj", "--size", "8cm", "--no-guide", "-o", "b.pdf", "-o", "b-guide.pdf"},
                    in(folder))
            .exit_code == 0);
}

TEST_CASE("a page for browsers stands beside the other files, unless nobody wants it", "[written_files]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  REQUIRE(run_program({"house.obj", "--size", "8cm", "-o", "page.html", "-o", "page.fold"}, in(folder))
              .exit_code == 0);
  CHECK(folder.names() == std::set<std::string>{"house.obj", "page.html", "page.fold"});
  // The nets in it are those of the file, byte by byte: this name needs nothing to be written otherwise.
  const std::string html = read_bytes(folder / "page.html");
  CHECK(html.starts_with("<!doctype html>"));
  CHECK(page_document(html, "fold") == read_bytes(folder / "page.fold"));
  REQUIRE(run_program({"house.obj", "--size", "8cm", "--no-page", "-o", "out"}, in(folder)).exit_code == 0);
  CHECK_FALSE(fs::exists(folder / "out/house.html"));
  CHECK(fs::exists(folder / "out/house.fold"));
  check_refusal(run_program({"house.obj", "--no-page", "-o", "a.html"}, in(folder)), 2, "--no-page");
  // One of an earlier run goes with the files that it belongs to; somebody's own stays.
  REQUIRE(run_program({"house.obj", "--size", "8cm", "-o", "out"}, in(folder)).exit_code == 0);
  REQUIRE(fs::exists(folder / "out/house.html"));
  REQUIRE(run_program({"house.obj", "--size", "9cm", "--no-page", "-o", "out"}, in(folder)).exit_code == 0);
  CHECK_FALSE(fs::exists(folder / "out/house.html"));
  write_bytes(folder / "out/house.html", "mine");
  REQUIRE(run_program({"house.obj", "--size", "9cm", "--no-page", "-o", "out"}, in(folder)).exit_code == 0);
  CHECK(read_bytes(folder / "out/house.html") == "mine");
  // It is a result like others: replaced by those of the same model alone.
  REQUIRE(run_program({"house.obj", "--size", "9cm", "-o", "page.html"}, in(folder)).exit_code == 0);
  write_bytes(folder / "house.obj", std::string(house) + "# edited\n");
  check_refusal(run_program({"house.obj", "--size", "9cm", "-o", "page.html"}, in(folder)), 7, "page.html");
}

TEST_CASE("files of an earlier run with other options are told, and stay", "[written_files]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  REQUIRE(run_program({"house.obj", "--size", "8cm"}, in(folder)).exit_code == 0);
  write_bytes(folder / "house-2.svg", "mine");
  const std::string fold = read_bytes(folder / "house.fold");
  // They are the same nets.
  CHECK(run_program({"house.obj", "--size", "8cm", "-o", "house.pdf"}, in(folder)).err.empty());
  const Outcome larger = run_program({"house.obj", "--size", "9cm", "-o", "house.pdf"}, in(folder));
  REQUIRE(larger.exit_code == 0);
  CHECK(larger.err ==
        "note: house.fold, house.html and house.svg are of an earlier run with other options\n");
  CHECK(read_bytes(folder / "house.fold") == fold);
  CHECK(run_program({"house.obj", "--size", "9cm"}, in(folder)).err.empty());
}

TEST_CASE("a preset's files bear its name and stand beside those for the printer", "[written_files]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  REQUIRE(run_program({"house.obj", "--size", "8cm"}, in(folder)).exit_code == 0);
  REQUIRE(run_program({"house.obj", "--size", "8cm", "--preset", "laser"}, in(folder)).exit_code == 0);
  REQUIRE(run_program({"house.obj", "--size", "8cm", "--preset", "plotter", "--dxf", "plain"}, in(folder))
              .exit_code == 0);
  CHECK(folder.names() == std::set<std::string>{"house.obj", "house.pdf", "house-guide.pdf", "house.svg",
                                                "house.fold", "house.html", "house-laser.svg",
                                                "house-laser.dxf", "house-plotter-mm.dxf",
                                                "house-plotter.plt"});
  CHECK(read_bytes(folder / "house-laser.dxf").find("AC1015") != std::string::npos);
  // The DXF that was asked for wins over the preset's.
  CHECK(read_bytes(folder / "house-plotter-mm.dxf").find("POLYLINE") == std::string::npos);
  // Files of this model may be replaced, others not.
  CHECK(run_program({"house.obj", "--size", "9cm", "--preset", "laser"}, in(folder)).exit_code == 0);
  write_bytes(folder / "house.obj", std::string(house) + "# edited\n");
  check_refusal(run_program({"house.obj", "--size", "9cm", "--preset", "laser"}, in(folder)), 7,
                "house-laser.");
  check_refusal(run_program({"house.obj", "--preset", "chainsaw"}, in(folder)), 2, "lightburn");
}

TEST_CASE("two runs with one seed give the same bytes, with one thread and with two", "[written_files]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  REQUIRE(run_program({"house.obj", "--size", "8cm", "-o", "a", "--threads", "1"}, in(folder)).exit_code ==
          0);
  REQUIRE(run_program({"house.obj", "--size", "8cm", "-o", "b", "--threads", "2"}, in(folder)).exit_code ==
          0);
  for (const char* suffix : {"pdf", "svg", "fold"}) {
    const std::string name = std::string("house.") + suffix;
    CAPTURE(name);
    CHECK(read_bytes(folder.path() / "a" / name) == read_bytes(folder.path() / "b" / name));
  }
}

TEST_CASE("pages left over from an earlier run of the same model are removed", "[written_files]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  write_bytes(folder / "house-9.svg", "<svg>somebody's own</svg>");
  REQUIRE(run_program({"house.obj", "--size", "25cm"}, in(folder)).exit_code == 0);
  REQUIRE(fs::exists(folder / "house-2.svg"));
  CHECK(read_bytes(folder / "house.svg").find("<inkscape:page ") != std::string::npos);
  REQUIRE(run_program({"house.obj", "--size", "8cm"}, in(folder)).exit_code == 0);
  CHECK(folder.names() == std::set<std::string>{"house.obj", "house.pdf", "house-guide.pdf", "house.svg",
                                                "house.fold", "house.html", "house-9.svg"});
  CHECK(read_bytes(folder / "house.svg").find("<inkscape:page ") == std::string::npos);
}

TEST_CASE("with --overwrite, pages of the model whose files are replaced go", "[written_files]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  REQUIRE(run_program({"house.obj", "--size", "25cm", "-o", "out"}, in(folder)).exit_code == 0);
  REQUIRE(fs::exists(folder / "out/house-2.svg"));
  // Another model, and somebody's own page; that of a model of such a name, which no other file is from.
  write_bytes(folder / "house-9.obj", std::string(house) + "# nine\n");
  REQUIRE(run_program({"house-9.obj", "--size", "8cm", "-o", "out/house-9.svg"}, in(folder)).exit_code == 0);
  write_bytes(folder / "out/house-8.svg", "<svg>somebody's own</svg>");
  write_bytes(folder / "house.obj", std::string(house) + "# edited\n");
  check_refusal(run_program({"house.obj", "--size", "8cm", "-o", "out"}, in(folder)), 7, "out/house.");
  CHECK(fs::exists(folder / "out/house-2.svg"));
  const Outcome outcome = run_program({"house.obj", "--size", "8cm", "-o", "out", "--overwrite"}, in(folder));
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder / "out")) {
    names.insert(entry.path().filename().string());
  }
  CHECK(names == std::set<std::string>{"house.pdf", "house-guide.pdf", "house.svg", "house.fold",
                                       "house.html", "house-8.svg", "house-9.svg"});
}

TEST_CASE("a file that a folder brings along, too, is written once", "[written_files]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  fs::create_directory(folder / "real");
  fs::create_directory_symlink("real", folder / "link");
  const Outcome outcome =
      run_program({"house.obj", "--size", "8cm", "-o", "real", "-o", "link/house.pdf"}, in(folder));
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(read_bytes(folder / "real/house.pdf").starts_with("%PDF"));
  CHECK(folder.names() == std::set<std::string>{"house.obj", "real", "link"});
}

TEST_CASE("names as long as the file system allows", "[written_files]") {
  const TemporaryFolder folder;
  const std::string stem(240, 'x');
  write_bytes(folder / "house.obj", house);
  const Outcome outcome = run_program({"house.obj", "--size", "8cm", "-o", stem + ".pdf"}, in(folder));
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(folder.names() == std::set<std::string>{"house.obj", stem + ".pdf", stem + "-guide.pdf"});
  // Where a guide's name would be longer than that, there is none.
  CHECK(run_program({"house.obj", "--size", "8cm", "-o", stem + "0123456789.pdf"}, in(folder)).exit_code ==
        0);
  CHECK(folder.names().size() == 4);
}

TEST_CASE("a file gets the name that was asked for, in capitals, too", "[written_files]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  REQUIRE(run_program({"house.obj", "--size", "25cm", "-o", "X.PDF", "-o", "X.Svg"}, in(folder)).exit_code ==
          0);
  CHECK(fs::exists(folder / "X-2.Svg"));
  const Outcome outcome =
      run_program({"house.obj", "--size", "8cm", "-o", "X.PDF", "-o", "X.Svg"}, in(folder));
  CHECK(outcome.out.find("wrote X.PDF, X.Svg and X-guide.PDF\n") != std::string::npos);
  CHECK(folder.names() == std::set<std::string>{"house.obj", "X.PDF", "X-guide.PDF", "X.Svg"});
}

TEST_CASE("folders are made for results, and go again when there are none", "[written_files]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  RunOptions options = in(folder);
  options.largest_file = 1000;
  check_refusal(run_program({"house.obj", "-o", "a/b/h.pdf"}, options), 7, "h.pdf");
  CHECK(folder.names() == std::set<std::string>{"house.obj"});
  CHECK(run_program({"segment", "house.obj", "-o", "a/b/h.ply"}, in(folder)).exit_code == 0);
  CHECK(fs::exists(folder / "a/b/h.ply"));
}

TEST_CASE("a folder that may be written, but not listed", "[written_files]") {
  if (::geteuid() == 0 && !can_drop_rights()) {
    WARN("skipped: root's rights can't be dropped here");
    return;
  }
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  fs::permissions(folder.path(), fs::perms::all);
  fs::create_directory(folder / "out");
  fs::permissions(folder / "out", fs::perms(0333));
  RunOptions options = in(folder);
  options.as_nobody = true;
  for (int i = 0; i < 2; ++i) {
    const Outcome outcome = run_program({"house.obj", "-o", "out", "--size", "8cm"}, options);
    INFO(outcome.err);
    CHECK(outcome.exit_code == 0);
  }
  fs::permissions(folder / "out", fs::perms(0777));
  CHECK(contents(folder / "out").size() == 5);
}

TEST_CASE("names with spaces and letters of any script work", "[written_files]") {
  const TemporaryFolder folder;
  write_bytes(folder / "Füchsin 狐 & <co>.obj", house);
  const Outcome outcome = run_program({"Füchsin 狐 & <co>.obj", "--size", "8cm"}, in(folder));
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(fs::exists(folder / "Füchsin 狐 & <co>.svg"));
}
