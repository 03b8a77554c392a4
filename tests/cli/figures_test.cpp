// SPDX-License-Identifier: GPL-3.0-or-later
// The list of figures that summaries and JSON are made of.
#include "cli/report/figures.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/report/brief.hpp"
#include "cli/report/net_figures.hpp"
#include "cli/report/summary.hpp"

using namespace ridgecraft;
using cli::Line;
using cli::Summary;
using cli::Value;

TEST_CASE("a value is printed as the JSON library reads it", "[figures]") {
  Value value(
      Value::Object{{"none", {}}, {"yes", true}, {"count", std::size_t{7}}, {"less", -3}, {"length", 0.1}});
  value.set("words", Value::List{"a", "b\"\xff"});
  value.set("empty", Value(Value::List{}));
  const auto json = nlohmann::json::parse(cli::json_text(value));
  CHECK(json["none"].is_null());
  CHECK(json["yes"] == true);
  CHECK(json["count"] == 7);
  CHECK(json["less"] == -3);
  CHECK(json["length"] == 0.1);
  CHECK(json["words"] == std::vector<std::string>{"a", "b\"\xEF\xBF\xBD"});
  CHECK(json["empty"].is_array());
  CHECK(cli::json_line(value).find('\n') == std::string::npos);
}

TEST_CASE("one figure is a line for people and a key for machines", "[figures]") {
  Summary summary("gem: 12 faces");
  summary.add("pages", 2, Line::nets, "nets", "3 pieces on 2 pages");
  summary.add("cut_mm", 12.5, "mm");
  summary.add("size_mm", 40.0, Line::size, "size", "40 mm", "mm");
  summary.say(Line::notes, "note", "cut with care");
  summary.add_files({});
  const std::string all =
      "gem: 12 faces\n  size        40 mm\n  nets        3 pieces on 2 pages\n  note        cut with care\n"
      "nothing was written: -o says where to\n";
  CHECK(summary.text(cli::Detail::all) == all);
  // Without a brief form there is only the long one.
  CHECK(summary.text(cli::Detail::brief) == all);
  const auto json = nlohmann::ordered_json::parse(summary.json());
  CHECK(json.dump() == R"({"pages":2,"cut_mm":12.5,"size_mm":40.0,"files":[]})");
}

TEST_CASE("in brief a summary has its brief lines, and one line for all files", "[figures]") {
  const auto brief = [](const std::vector<std::string>& files) {
    Summary summary("gem: 12 faces");
    summary.add("size_mm", 40.0, Line::size, "size", "40 mm", "mm");
    summary.say(Line::brief, "paper", "3 pieces");
    summary.add_files(files);
    CHECK(summary.text(cli::Detail::all).find("  paper       3 pieces\n  size        40 mm\n") !=
          std::string::npos);
    return summary.text(cli::Detail::brief);
  };
  const std::string lines = "gem: 12 faces\n  paper       3 pieces\n";
  CHECK(brief({"a.pdf"}) == lines + "wrote a.pdf\n");
  CHECK(brief({"o/a.pdf", "o/a-1.svg", "o/a-2.svg", "o/a.fold"}) ==
        lines + "wrote into o: a.pdf, a-1.svg, a-2.svg and a.fold\n");
  CHECK(brief({"o/a-1.svg", "o/a-2.svg", "o/a-3.svg"}) == lines + "wrote into o: a-1.svg to a-3.svg\n");
  CHECK(brief({"o/a-1.svg", "o/a-2.svg", "o/a-3.svg", "o/a.svg", "o/a.fold"}) ==
        lines + "wrote into o: a-1.svg to a-3.svg, a.svg and a.fold\n");
  CHECK(brief({"o/a.pdf", "p/a.svg"}) == lines + "wrote o/a.pdf\nwrote p/a.svg\n");
  CHECK(brief({}) == lines + "nothing was written: -o says where to\n");
}

TEST_CASE("what moves is seen sooner where the model is thin", "[figures]") {
  const Box3 cube{{0.0, 0.0, 0.0}, {150.0, 140.0, 130.0}};
  const Box3 pole{{0.0, 0.0, 0.0}, {53.0, 190.0, 12.0}};
  const Box3 sheet{{0.0, 0.0, 0.0}, {150.0, 150.0, 0.0}};
  CHECK(cli::where_it_differs(4.4, cube).empty());
  CHECK(cli::where_it_differs(4.6, cube) ==
        "where it was simplified it differs from the file by up to 4.6 mm, 3 % of its size: with more "
        "--faces it stays nearer");
  CHECK(cli::where_it_differs(1.1, pole).empty());
  CHECK(cli::where_it_differs(3.8, pole) ==
        "where it was simplified it differs from the file by up to 3.8 mm, and it is 12 mm thick: with "
        "more --faces it stays nearer");
  CHECK(cli::where_it_differs(0.9, sheet).empty());
  CHECK(cli::where_it_differs(1.5, sheet).empty());
}

TEST_CASE("rows of piece names are short", "[figures]") {
  unfold::Nets nets;
  for (const char* name : {"A", "B", "C", "D", "E", "F", "G", "H", "I"}) {
    unfold::Piece piece;
    piece.name = name;
    nets.pieces.push_back(std::move(piece));
  }
  const auto named = [&](const std::vector<std::uint32_t>& numbers) {
    std::vector<PieceId> pieces;
    for (const std::uint32_t i : numbers) {
      pieces.emplace_back(i);
    }
    return cli::piece_names(nets, pieces);
  };
  CHECK(named({0}) == "A");
  CHECK(named({0, 1}) == "A, B");
  CHECK(named({1, 2, 3}) == "B to D");
  CHECK(named({0, 2}) == "A, C");
  CHECK(named({0, 1, 2, 3, 4, 5, 8}) == "A, B, C, D, E, F and 1 more");
}

TEST_CASE("what was left out is called bodies whatever else was, and crossings of united bodies are past",
          "[figures]") {
  prepare::Details details;
  details.flat = 2;
  details.low = 1;
  CHECK(cli::details_text(details) ==
        "2 flat bodies that lie on others and 1 body that stands out too little to be folded");
  mesh::RepairReport report;
  report.add(mesh::RepairKind::self_intersections, 112);
  CHECK(english(cli::repair_lines(report).at(0)) == "112 faces run through each other");
  CHECK(english(cli::repair_lines(report, true).at(0)) ==
        "112 faces ran through others: uniting the bodies has mended that");
}
