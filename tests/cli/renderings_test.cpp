// SPDX-License-Identifier: GPL-3.0-or-later
// A page looks the same whichever of its files is opened, and by whatever program.
#include <cstdlib>
#include <string>

#include <catch2/catch.hpp>

#include "cli/program_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft::test;

TEST_CASE("PDF, SVG and PNG show the same", "[renderings][slow]") {
  for (const std::string program :
       {"pdftocairo -v", "inkscape --version", "/usr/bin/python3 -c 'import PIL, numpy'"}) {
    if (std::system((program + " >/dev/null 2>&1").c_str()) != 0) {
      WARN("skipped: " << program << " doesn't run here");
      return;
    }
  }
  const std::string source = RIDGECRAFT_SOURCE_DIR;
  for (const std::string name : {"fox_head", "penguin"}) {  // two pages each, in colours
    CAPTURE(name);
    const TemporaryFolder folder;
    const Outcome outcome = run_program({source + "/samples/" + name + ".obj", "--no-guide", "-o", "page.pdf",
                                         "-o", "page.svg", "-o", "page.png"},
                                        in(folder));
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const auto file = [&](const std::string& of_page) { return " '" + (folder / of_page).string() + "'"; };
    CHECK(std::system(("/usr/bin/python3 '" + source + "/tests/cli/renderings.py'" + file("page-1.png") +
                       file("page.pdf") + file("page-1.svg"))
                          .c_str()) == 0);
  }
}
