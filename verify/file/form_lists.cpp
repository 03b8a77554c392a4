// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/file/form_lists.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "verify/file/tolerance.hpp"

namespace ridgecraft::verify {
namespace {

constexpr std::string_view the_file = "the file";
constexpr std::int64_t largest_exact = (std::int64_t{1} << 53) - 1;
constexpr std::int64_t most_holes = 999'999'999;

void expect_object(const Json& value, std::string_view where) {
  if (!value.is_object()) {
    refuse("{} is not an object", where);
  }
}

Page read_page(const Json& json, const std::string& where) {
  expect_object(json, where);
  std::array<double, 2> origin{};
  lengths(member(json, "origin", where), origin, {where, "origin"});
  Page page;
  const Json& size = member(json, "size", where);
  if (size.is_null()) {
    return page;
  }
  std::array<double, 2> extent{};
  std::array<double, 4>& margins = page.margins;
  lengths(size, extent, {where, "size"});
  lengths(member(json, "margins", where), margins, {where, "margins"});
  if (!(extent[0] > 0.0 && extent[1] > 0.0)) {
    refuse("the size of {} is not positive", where);
  }
  if (*std::min_element(margins.begin(), margins.end()) < 0.0) {
    refuse("{} has a negative margin", where);
  }
  if (margins[0] + margins[2] >= extent[0] || margins[1] + margins[3] >= extent[1]) {
    refuse("the margins of {} leave nothing to print on", where);
  }
  page.bounded = true;
  page.low = {origin[0], origin[1]};
  page.high = page.low + Vec2{extent[0], extent[1]};
  page.printable_low = page.low + Vec2{margins[0], margins[1]};
  page.printable_high = page.high - Vec2{margins[2], margins[3]};
  return page;
}

bool is_known_reason(std::string_view reason) {
  constexpr std::array<std::string_view, 8> known = {"part",  "page", "overlap", "tabs",
                                                     "faces", "time", "request", "component"};
  return std::find(known.begin(), known.end(), reason) != known.end();
}

Piece read_piece(const Json& json, std::size_t pages, const std::string& where) {
  expect_object(json, where);
  Piece piece;
  piece.name = text_member(json, "name", where);
  if (const Json& part = member(json, "part", where); !part.is_null()) {
    piece.part = part_number(part, {where, "part"});
  }
  for (const Json& part : list_member(json, "parts", where)) {
    piece.parts.push_back(part_number(part, {where, "parts", piece.parts.size()}));
  }
  piece.page = index_below(member(json, "page", where), pages, {where, "page"});
  piece.reason = text_member(json, "reason", where);
  if (!is_known_reason(piece.reason)) {
    refuse("\"reason\" of {} is {}, which the contract doesn't know", where, quote(piece.reason));
  }
  if (const auto holes = json.find("holes"); holes != json.end()) {
    piece.holes = whole(*holes, 0, most_holes, {where, "holes"});
  }
  return piece;
}

Join read_join(const Json& json, const File& file, std::size_t tabs, const std::string& where) {
  expect_object(json, where);
  Join join;
  join.number = whole(member(json, "number", where), 1, largest_exact, {where, "number"});
  const Json& edges = list_member(json, "edges", where);
  if (edges.size() != 2) {
    refuse("\"edges\" of {} is not a pair", where);
  }
  for (std::size_t k = 0; k < 2; ++k) {
    join.edges[k] = index_below(edges[k], file.edges.size(), {where, "edges", k});
  }
  if (const Json& tab = member(json, "tab", where); !tab.is_null()) {
    join.tab = index_below(tab, tabs, {where, "tab"});
  }
  if (const auto why = json.find("why"); why != json.end() && why->is_string()) {
    join.why = why->get<std::string>();
  }
  return join;
}

void read_tab_edges(const Json& json, std::size_t count, const std::string& where, Tab& tab) {
  const auto edges = json.find("edges");
  if (edges == json.end()) {
    tab.edges = {tab.edge};
    return;
  }
  if (!edges->is_array() || edges->empty()) {
    refuse("\"edges\" of {} is not a list of edges", where);
  }
  for (const Json& edge : *edges) {
    tab.edges.push_back(index_below(edge, count, {where, "edges", tab.edges.size()}));
  }
  std::vector<Index> sorted = tab.edges;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
    refuse("\"edges\" of {} has an edge twice", where);
  }
  if (!std::binary_search(sorted.begin(), sorted.end(), tab.edge)) {
    refuse("\"edge\" of {} is not among its \"edges\"", where);
  }
}

Tab read_tab(const Json& json, std::size_t edges, const std::string& where) {
  expect_object(json, where);
  Tab tab;
  tab.edge = index_below(member(json, "edge", where), edges, {where, "edge"});
  read_tab_edges(json, edges, where, tab);
  for (const Json& corner : list_member(json, "polygon", where)) {
    std::array<double, 2> p{};
    lengths(corner, p, {where, "polygon", tab.polygon.size()});
    tab.polygon.push_back({p[0], p[1]});
  }
  if (tab.polygon.size() < 3) {
    refuse("\"polygon\" of {} has fewer than three corners", where);
  }
  if (json.contains("slit")) {
    const Json& slit = list_member(json, "slit", where);
    if (slit.size() != 2) {
      refuse("\"slit\" of {} doesn't have two ends", where);
    }
    tab.slit.emplace();
    for (std::size_t k = 0; k < 2; ++k) {
      std::array<double, 2> p{};
      lengths(slit[k], p, {where, "slit", k});
      (*tab.slit)[k] = {p[0], p[1]};
    }
  }
  if (const auto foot = json.find("foot"); foot != json.end()) {
    if (*foot != true) {
      refuse("\"foot\" of {} is true, or isn't there", where);
    }
    tab.foot = true;
  }
  for (const Json& join : list_member(json, "joins", where)) {
    tab.numbers.push_back(whole(join, 1, largest_exact, {where, "joins", tab.numbers.size()}));
  }
  return tab;
}

/// Tabs that joins name, then the others.
void read_tabs(const Json& json, File& file) {
  for (const Json& tab : list_member(json, "ridgecraft:tabs", the_file)) {
    const std::string where = fmt::format("tab {}", file.tabs.size());
    file.tabs.push_back(read_tab(tab, file.edges.size(), where));
    if (file.tabs.back().numbers.empty()) {
      refuse("\"joins\" of {} is empty", where);
    }
  }
  if (const auto more = json.find("ridgecraft:more_tabs"); more != json.end()) {
    if (!more->is_array()) {
      refuse("\"ridgecraft:more_tabs\" of the file is not a list");
    }
    for (const Json& tab : *more) {
      file.tabs.push_back(read_tab(tab, file.edges.size(), fmt::format("tab {}", file.tabs.size())));
      file.tabs.back().additional = true;
    }
  }
}

void read_glue(const Json& json, File& file) {
  const auto list = json.find("ridgecraft:glue");
  if (list == json.end()) {
    return;
  }
  if (!list->is_array()) {
    refuse("\"ridgecraft:glue\" of the file is not a list");
  }
  for (const Json& entry : *list) {
    const std::string where = fmt::format("glue spot {}", file.glue.size());
    expect_object(entry, where);
    GlueSpot spot;
    spot.piece = index_below(member(entry, "piece", where), file.pieces.size(), {where, "piece"});
    spot.other = index_below(member(entry, "other", where), file.pieces.size(), {where, "other"});
    for (const Json& outline : list_member(entry, "outlines", where)) {
      if (!outline.is_array() || outline.size() < 3) {
        refuse("an outline of {} has fewer than three corners", where);
      }
      std::vector<Vec2>& corners = spot.outlines.emplace_back();
      for (const Json& corner : outline) {
        std::array<double, 2> p{};
        lengths(corner, p, {where, "outlines", corners.size()});
        corners.push_back({p[0], p[1]});
      }
    }
    if (spot.outlines.empty()) {
      refuse("\"outlines\" of {} is empty", where);
    }
    file.glue.push_back(std::move(spot));
  }
}

/// One index per net face.
std::vector<Index> read_face_indices(const Json& json, const char* key, std::size_t faces,
                                     std::size_t count) {
  const Json& list = list_member(json, key, the_file);
  if (list.size() != faces) {
    refuse("\"{}\" of the file has {} entries for {} faces", key, list.size(), faces);
  }
  std::vector<Index> result;
  result.reserve(faces);
  for (const Json& entry : list) {
    result.push_back(index_below(entry, count, {the_file, key, result.size()}));
  }
  return result;
}

void expect_names_unique(const std::vector<Piece>& pieces) {
  std::set<std::string_view> names;
  for (const Piece& piece : pieces) {
    if (!names.insert(piece.name).second) {
      refuse("two pieces are named {}", quote(piece.name));
    }
  }
}

}  // namespace

std::int64_t part_number(const Json& value, const Spot& spot) {
  return whole(value, -largest_exact, largest_exact, spot);
}

void read_lists(const Json& json, File& file) {
  const std::size_t faces = file.faces.faces();
  file.face_model = read_face_indices(json, "ridgecraft:faces_model", faces, file.model.faces.faces());
  for (const Json& page : list_member(json, "ridgecraft:pages", the_file)) {
    file.pages.push_back(read_page(page, fmt::format("page {}", file.pages.size())));
  }
  for (const Json& piece : list_member(json, "ridgecraft:pieces", the_file)) {
    file.pieces.push_back(read_piece(piece, file.pages.size(), fmt::format("piece {}", file.pieces.size())));
  }
  expect_names_unique(file.pieces);
  file.face_piece = read_face_indices(json, "ridgecraft:faces_piece", faces, file.pieces.size());
  const Json& tabs = list_member(json, "ridgecraft:tabs", the_file);
  for (const Json& join : list_member(json, "ridgecraft:joins", the_file)) {
    file.joins.push_back(read_join(join, file, tabs.size(), fmt::format("join {}", file.joins.size())));
  }
  read_tabs(json, file);
  read_glue(json, file);
}

}  // namespace ridgecraft::verify
