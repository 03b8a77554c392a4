// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 0: bytes become a File, or a reason why they can't. The schema checks each value by itself; what
// has to hold between values is checked here.
#include <algorithm>
#include <set>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "verify/file/file.hpp"
#include "verify/file/schema.hpp"

namespace ridgecraft::verify {

void FaceList::add(std::span<const Index> vertices) {
  const Index number = faces();
  vertex_.insert(vertex_.end(), vertices.begin(), vertices.end());
  face_.insert(face_.end(), vertices.size(), number);
  first_.push_back(static_cast<Index>(vertex_.size()));
}

std::vector<Index> corner_fans(const FaceList& faces, std::span<const Index> twin) {
  DisjointSets fans(faces.sides());
  for (Index side = 0; side < faces.sides(); ++side) {
    if (twin[side] != none) {
      // The twin ends where this side begins.
      fans.join(side, faces.next(twin[side]));
    }
  }
  std::vector<Index> label(faces.sides());
  for (Index side = 0; side < faces.sides(); ++side) {
    label[side] = fans.find(side);
  }
  return label;
}

namespace {

Vec2 read_point(const Json& json) {
  return {json[0].get<double>(), json[1].get<double>()};
}

std::vector<Vec2> read_points(const Json& json) {
  std::vector<Vec2> points;
  points.reserve(json.size());
  std::transform(json.begin(), json.end(), std::back_inserter(points), read_point);
  return points;
}

FaceList read_faces(const Json& json) {
  FaceList faces;
  for (const Json& corners : json) {
    faces.add(corners.get<std::vector<Index>>());
  }
  return faces;
}

struct SideAtEdge {
  std::uint64_t key;
  Index side;
};

/// The sides of all faces, those along one edge next to each other, in the order of their numbers.
std::vector<SideAtEdge> sides_by_edge(const FaceList& faces) {
  std::vector<SideAtEdge> result(faces.sides());
  for (Index s = 0; s < faces.sides(); ++s) {
    result[s] = {edge_key(faces.tail(s), faces.head(s)), s};
  }
  std::sort(result.begin(), result.end(), [](const SideAtEdge& a, const SideAtEdge& b) {
    return a.key != b.key ? a.key < b.key : a.side < b.side;
  });
  return result;
}

std::vector<Index> pair_manifold_sides(const FaceList& faces) {
  const std::vector<SideAtEdge> sides = sides_by_edge(faces);
  std::vector<Index> twin(faces.sides(), none);
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i].key != sides[i - 1].key) {
      continue;
    }
    const Index a = sides[i - 1].side;
    const Index b = sides[i].side;
    if (i > 1 && sides[i - 2].key == sides[i].key) {
      refuse("the model has an edge with more than two faces (faces {}, {} and {})",
             faces.face(sides[i - 2].side), faces.face(a), faces.face(b));
    }
    if (faces.tail(a) == faces.tail(b)) {
      refuse("faces {} and {} of the model run along their edge in the same direction", faces.face(a),
             faces.face(b));
    }
    twin[a] = b;
    twin[b] = a;
  }
  return twin;
}

void expect_one_fan_per_vertex(const Model& model) {
  const std::vector<Index> fan = corner_fans(model.faces, model.twin);
  std::vector<Index> known(model.points.size(), none);
  for (Index s = 0; s < model.faces.sides(); ++s) {
    const Index v = model.faces.tail(s);
    if (known[v] == none) {
      known[v] = fan[s];
    } else if (known[v] != fan[s]) {
      refuse("the faces around vertex {} of the model form more than one fan", v);
    }
  }
}

Model read_model(const Json& json) {
  Model model;
  for (const Json& row : json.at("vertices_coords")) {
    model.points.push_back({row[0].get<double>(), row[1].get<double>(), row[2].get<double>()});
  }
  model.faces = read_faces(json.at("faces_vertices"));
  model.face_part = json.at("ridgecraft:faces_part").get<std::vector<std::int64_t>>();
  model.twin = pair_manifold_sides(model.faces);
  expect_one_fan_per_vertex(model);
  Box3 box;
  for (Index s = 0; s < model.faces.sides(); ++s) {
    box.add(model.points[model.faces.tail(s)]);
  }
  model.size = box.diagonal();
  if (!(model.size > 0.0)) {
    refuse("the model has no extent");
  }
  return model;
}

std::vector<Edge> read_edges(const Json& json) {
  const Json& ends = json.at("edges_vertices");
  const Json& assignments = json.at("edges_assignment");
  const Json& angles = json.at("edges_foldAngle");
  const auto bent = json.find("edges_ridgecraft:bent");
  std::vector<Edge> edges(ends.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    edges[e].ends = {ends[e][0].get<Index>(), ends[e][1].get<Index>()};
    edges[e].assignment = static_cast<Assignment>(assignments[e].get_ref<const std::string&>()[0]);
    edges[e].angle_deg = angles[e].get<double>();
    edges[e].bent = bent != json.end() && (*bent)[e].get<bool>();
  }
  return edges;
}

/// Finds the edge of each side: every edge of a face must be listed, once, and no others.
std::vector<Index> match_sides_with_edges(const FaceList& faces, const std::vector<Edge>& edges) {
  struct Listed {
    std::uint64_t key;
    Index edge;
  };
  std::vector<Listed> listed;
  for (const Edge& edge : edges) {
    listed.push_back({edge_key(edge.ends[0], edge.ends[1]), static_cast<Index>(listed.size())});
  }
  std::sort(listed.begin(), listed.end(), [](const Listed& a, const Listed& b) {
    return a.key != b.key ? a.key < b.key : a.edge < b.edge;
  });
  const auto same = std::adjacent_find(listed.begin(), listed.end(),
                                       [](const Listed& a, const Listed& b) { return a.key == b.key; });
  if (same != listed.end()) {
    refuse("edges {} and {} have the same two ends", same->edge, (same + 1)->edge);
  }
  std::vector<Index> side_edge(faces.sides(), none);
  std::vector<bool> used(edges.size(), false);
  auto at = listed.begin();
  for (const SideAtEdge& side : sides_by_edge(faces)) {
    while (at != listed.end() && at->key < side.key) {
      ++at;
    }
    if (at == listed.end() || at->key != side.key) {
      refuse("edges_vertices lacks the edge of face {} between vertices {} and {}", faces.face(side.side),
             faces.tail(side.side), faces.head(side.side));
    }
    side_edge[side.side] = at->edge;
    used[at->edge] = true;
  }
  if (const auto idle = std::find(used.begin(), used.end(), false); idle != used.end()) {
    refuse("edge {} belongs to no face", idle - used.begin());
  }
  return side_edge;
}

Page read_page(const Json& json, std::size_t number) {
  Page page;
  const Json& size = json.at("size");
  if (size.is_null()) {
    return page;
  }
  const auto margins = json.find("margins");
  if (margins == json.end() || margins->is_null()) {
    refuse("page {} has a size, but no margins", number);
  }
  page.margins = margins->get<std::array<double, 4>>();
  page.bounded = true;
  page.low = read_point(json.at("origin"));
  page.high = page.low + read_point(size);
  page.printable_low = page.low + Vec2{page.margins[0], page.margins[1]};
  page.printable_high = page.high - Vec2{page.margins[2], page.margins[3]};
  if (page.margins[0] + page.margins[2] >= size[0].get<double>() ||
      page.margins[1] + page.margins[3] >= size[1].get<double>()) {
    refuse("the margins of page {} leave nothing to print on", number);
  }
  return page;
}

Piece read_piece(const Json& json) {
  Piece piece;
  piece.name = json.at("name").get<std::string>();
  if (const Json& part = json.at("part"); !part.is_null()) {
    piece.part = part.get<std::int64_t>();
  }
  piece.parts = json.at("parts").get<std::vector<std::int64_t>>();
  piece.page = json.at("page").get<Index>();
  piece.reason = json.at("reason").get<std::string>();
  piece.holes = json.value("holes", std::int64_t{0});
  return piece;
}

void expect_names_unique(const std::vector<Piece>& pieces) {
  std::set<std::string_view> names;
  for (const Piece& piece : pieces) {
    if (!names.insert(piece.name).second) {
      refuse("two pieces are named {}", quote(piece.name));
    }
  }
}

Join read_join(const Json& json) {
  Join join;
  join.number = json.at("number").get<std::int64_t>();
  join.edges = json.at("edges").get<std::array<Index, 2>>();
  if (const Json& tab = json.at("tab"); !tab.is_null()) {
    join.tab = tab.get<Index>();
  }
  if (const auto why = json.find("why"); why != json.end() && why->is_string()) {
    join.why = why->get<std::string>();
  }
  return join;
}

Tab read_tab(const Json& json, bool additional) {
  Tab tab;
  tab.edge = json.at("edge").get<Index>();
  tab.edges = json.value("edges", std::vector<Index>{tab.edge});
  if (std::find(tab.edges.begin(), tab.edges.end(), tab.edge) == tab.edges.end()) {
    refuse("edge {} of a tab is not among its edges", tab.edge);
  }
  tab.polygon = read_points(json.at("polygon"));
  tab.numbers = json.at("joins").get<std::vector<std::int64_t>>();
  tab.additional = additional;
  tab.foot = json.value("foot", false);
  if (const auto slit = json.find("slit"); slit != json.end()) {
    tab.slit = {read_point(slit->at(0)), read_point(slit->at(1))};
  }
  return tab;
}

GlueOutline read_glue(const Json& json) {
  GlueOutline spot{json.at("piece").get<Index>(), json.at("other").get<Index>(), {}};
  for (const Json& outline : json.at("outlines")) {
    spot.outlines.push_back(read_points(outline));
  }
  return spot;
}

EqualPiece read_equal_piece(const Json& json) {
  return {json.at("piece").get<Index>(), json.at("mirrored").get<bool>(), json.value("other_tabs", false)};
}

AssemblyStep read_assembly_step(const Json& json) {
  return {json.at("pieces").get<std::vector<Index>>(), json.at("joins").get<std::vector<std::int64_t>>()};
}

Setting read_setting(const Json& value) {
  if (value.is_boolean()) {
    return value.get<bool>();
  }
  if (value.is_number()) {
    return value.get<double>();
  }
  if (value.is_string()) {
    return value.get<std::string>();
  }
  if (value.is_array() && std::all_of(value.begin(), value.end(), std::mem_fn(&Json::is_number))) {
    return value.get<std::vector<double>>();
  }
  return std::monostate{};
}

/// Calls read(entry) for each entry of the list under the key, if there is one.
template <typename Read>
void for_each_in(const Json& json, const char* key, const Read& read) {
  if (const auto found = json.find(key); found != json.end()) {
    std::for_each(found->begin(), found->end(), read);
  }
}

void read_pieces_and_joins(const Json& json, File& file) {
  file.face_model = json.at("ridgecraft:faces_model").get<std::vector<Index>>();
  file.face_piece = json.at("ridgecraft:faces_piece").get<std::vector<Index>>();
  for_each_in(json, "ridgecraft:pages",
              [&](const Json& page) { file.pages.push_back(read_page(page, file.pages.size())); });
  for_each_in(json, "ridgecraft:pieces",
              [&](const Json& piece) { file.pieces.push_back(read_piece(piece)); });
  expect_names_unique(file.pieces);
  for_each_in(json, "ridgecraft:joins", [&](const Json& join) { file.joins.push_back(read_join(join)); });
  if (json.contains("ridgecraft:chains")) {
    file.chains.emplace();
  }
  for_each_in(json, "ridgecraft:chains", [&](const Json& chain) {
    file.chains->push_back(
        {chain.at("number").get<std::int64_t>(), chain.at("joins").get<std::vector<Index>>()});
  });
  for_each_in(json, "ridgecraft:tabs", [&](const Json& tab) { file.tabs.push_back(read_tab(tab, false)); });
  for_each_in(json, "ridgecraft:more_tabs",
              [&](const Json& tab) { file.tabs.push_back(read_tab(tab, true)); });
}

void read_notes(const Json& json, File& file) {
  for (const auto& [name, value] : json.at("ridgecraft:settings").items()) {
    file.settings.all.emplace_back(name, read_setting(value));
  }
  file.digest = json.value("ridgecraft:model_digest", std::string());
  if (const auto order = json.find("ridgecraft:fold_order"); order != json.end()) {
    file.fold_order = order->get<std::vector<std::vector<std::vector<Index>>>>();
  }
  for_each_in(json, "ridgecraft:equal_pieces", [&](const Json& kind) {
    std::vector<EqualPiece>& pieces = file.equal.emplace_back();
    std::transform(kind.begin(), kind.end(), std::back_inserter(pieces), read_equal_piece);
  });
  if (json.contains("ridgecraft:assembly")) {
    file.assembly.emplace();
  }
  for_each_in(json, "ridgecraft:assembly",
              [&](const Json& step) { file.assembly->push_back(read_assembly_step(step)); });
  for_each_in(json, "ridgecraft:glue", [&](const Json& spot) { file.glue.push_back(read_glue(spot)); });
}

}  // namespace

const Setting* Settings::find(std::string_view name) const {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& entry) { return entry.first == name; });
  return found == all.end() ? nullptr : &found->second;
}

std::optional<double> Settings::number(std::string_view name) const {
  const Setting* const setting = find(name);
  const double* const value = setting == nullptr ? nullptr : std::get_if<double>(setting);
  return value == nullptr ? std::nullopt : std::optional(*value);
}

std::vector<Vec2> File::polygon(Index face) const {
  std::vector<Vec2> corners;
  corners.reserve(faces.size(face));
  for (const Index v : faces.vertices(face)) {
    corners.push_back(points[v]);
  }
  return corners;
}

File read_file(std::string_view bytes) {
  const Json json = parse_json(bytes);
  File file;
  file.remarks = check_form(json);
  file.creator = json.at("file_creator").get<std::string>();
  file.title = json.at("file_title").get<std::string>();
  file.model = read_model(json.at("file_frames").at(0));
  file.points = read_points(json.at("vertices_coords"));
  file.faces = read_faces(json.at("faces_vertices"));
  file.edges = read_edges(json);
  file.side_edge = match_sides_with_edges(file.faces, file.edges);
  read_pieces_and_joins(json, file);
  read_notes(json, file);
  return file;
}

}  // namespace ridgecraft::verify
