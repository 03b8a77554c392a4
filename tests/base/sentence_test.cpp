// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/sentence.hpp"

#include <catch2/catch.hpp>

using namespace ridgecraft;

TEST_CASE("words are listed as people do", "[sentence]") {
  CHECK(listed({}, "and").empty());
  CHECK(listed({"a"}, "and") == "a");
  CHECK(listed({"a", "b"}, "or") == "a or b");
  CHECK(listed({"a", "b", "c"}, "and") == "a, b and c");
  CHECK(counted(1, "page") == "1 page");
  CHECK(counted(0, "page") == "0 pages");
}
