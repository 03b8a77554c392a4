// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/formats.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/report/summary.hpp"

using namespace ridgecraft::cli;

TEST_CASE("a suffix names one format and the format that suffix", "[formats]") {
  for (const char* text : {".pdf", ".svg", ".fold", ".html", ".png", ".dxf", ".lbrn2", ".eps", ".plt"}) {
    const auto format = paper_format(text);
    REQUIRE(format.has_value());
    CHECK(std::string(suffix(*format)) == text);
    CHECK(paper_suffixes().find(text) != std::string::npos);
  }
  for (const char* text : {"", ".", "pdf", ".PDF", ".ply", ".obj"}) {
    CHECK_FALSE(paper_format(text).has_value());
  }
  CHECK(suffix_of("a.b/C.PdF") == ".pdf");
  CHECK(one_file_per_page(Format::svg));
  CHECK_FALSE(one_file_per_page(Format::pdf));
  CHECK(default_formats() == std::vector{Format::pdf, Format::svg, Format::fold, Format::html});
}

TEST_CASE("the table of presets has a row for each", "[formats]") {
  const std::string text = formats_text(true);
  for (const auto& preset : ridgecraft::export_::presets()) {
    CHECK(text.find("\n" + std::string(preset.name) + " ") != std::string::npos);
  }
}

TEST_CASE("the printed list and the JSON have the same rows", "[formats]") {
  const auto json = nlohmann::json::parse(formats_json());
  const std::string text = formats_text();
  std::size_t rows = 0;
  for (const char* list : {"read", "written", "presets"}) {
    for (const auto& row : json[list]) {
      CHECK(text.find(row["what"].get<std::string>()) != std::string::npos);
      ++rows;
    }
  }
  CHECK(std::count(text.begin(), text.end(), '\n') == static_cast<std::ptrdiff_t>(rows + 3));
}
