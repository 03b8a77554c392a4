// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 0: JSON becomes a File, or a reason why it can't. Frames, vertices, edges and faces; the lists of
// our own namespace are read in form_lists.cpp.
#include <algorithm>
#include <array>
#include <cmath>

#include "verify/file/form_lists.hpp"
#include "verify/file/form_statements.hpp"
#include "verify/file/tolerance.hpp"

namespace ridgecraft::verify {
namespace {

/// FOLD leaves room for further classes and attributes; one of them must be this. All of them.
std::vector<std::string> read_words(const Json& object, const char* key, std::string_view word,
                                    std::string_view where) {
  std::vector<std::string> words;
  for (const Json& entry : list_member(object, key, where)) {
    words.push_back(entry.is_string() ? entry.get<std::string>() : std::string());
  }
  if (std::find(words.begin(), words.end(), word) == words.end()) {
    refuse("\"{}\" of {} lacks \"{}\"", key, where, word);
  }
  return words;
}

void expect_millimetres(const Json& object, std::string_view where) {
  const std::string& unit = text_member(object, "frame_unit", where);
  if (unit != "mm") {
    refuse("\"frame_unit\" of {} is {}, not \"mm\"", where, quote(unit));
  }
}

/// Corners within range, at least three, none twice. `seen` has one entry per vertex and is kept between
/// faces.
FaceList read_faces(const Json& object, std::size_t vertices, std::string_view where) {
  const Json& rows = list_member(object, "faces_vertices", where);
  if (rows.empty()) {
    refuse("\"faces_vertices\" of {} is empty", where);
  }
  FaceList faces;
  std::vector<Index> corners;
  std::vector<std::size_t> seen(vertices, 0);
  for (std::size_t f = 0; f < rows.size(); ++f) {
    const Spot spot{where, "faces_vertices", f};
    if (!rows[f].is_array() || rows[f].size() < 3) {
      refuse("{} is not a list of three or more corners", spot.words());
    }
    corners.clear();
    for (const Json& entry : rows[f]) {
      const Index v = index_below(entry, vertices, spot);
      if (seen[v] == f + 1) {
        refuse("{} has vertex {} twice", spot.words(), v);
      }
      seen[v] = f + 1;
      corners.push_back(v);
    }
    if (corners.size() > none - 1 - faces.sides()) {
      refuse("\"faces_vertices\" of {} has too many corners", where);
    }
    faces.add(corners);
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

Model read_model(const Json& file) {
  const Json& frames = list_member(file, "file_frames", "the file");
  if (frames.empty() || !frames[0].is_object()) {
    refuse("\"file_frames\" of the file has no frame");
  }
  constexpr std::string_view where = "the model's frame";
  const Json& frame = frames[0];
  Model model;
  model.words.classes = read_words(frame, "frame_classes", "foldedForm", where);
  model.words.attributes = read_words(frame, "frame_attributes", "3D", where);
  expect_millimetres(frame, where);
  if (const auto inherit = frame.find("frame_inherit"); inherit != frame.end() && *inherit != Json(false)) {
    refuse("the model's frame inherits, so it isn't complete in itself");
  }
  for (const Json& row : list_member(frame, "vertices_coords", where)) {
    std::array<double, 3> p{};
    lengths(row, p, {where, "vertices_coords", model.points.size()});
    model.points.push_back({p[0], p[1], p[2]});
  }
  model.faces = read_faces(frame, model.points.size(), where);
  const Json& parts = list_member(frame, "ridgecraft:faces_part", where);
  if (parts.size() != model.faces.faces()) {
    refuse("\"ridgecraft:faces_part\" of {} has {} entries for {} faces", where, parts.size(),
           model.faces.faces());
  }
  for (const Json& part : parts) {
    model.face_part.push_back(part_number(part, {where, "ridgecraft:faces_part", model.face_part.size()}));
  }
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

Assignment read_assignment(const Json& value, const Spot& spot) {
  if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    if (text == "B" || text == "M" || text == "V" || text == "F") {
      return static_cast<Assignment>(text[0]);
    }
  }
  refuse("{} is none of \"B\", \"M\", \"V\", \"F\"", spot.words());
}

void read_edges(const Json& json, File& file) {
  constexpr std::string_view where = "the file";
  const Json& ends = list_member(json, "edges_vertices", where);
  const Json& assignments = list_member(json, "edges_assignment", where);
  const Json& angles = list_member(json, "edges_foldAngle", where);
  if (assignments.size() != ends.size() || angles.size() != ends.size()) {
    refuse("\"edges_vertices\", \"edges_assignment\" and \"edges_foldAngle\" have {}, {} and {} entries",
           ends.size(), assignments.size(), angles.size());
  }
  for (std::size_t e = 0; e < ends.size(); ++e) {
    const Spot spot{where, "edges_vertices", e};
    if (!ends[e].is_array() || ends[e].size() != 2) {
      refuse("{} is not a pair of vertices", spot.words());
    }
    Edge edge;
    edge.ends = {index_below(ends[e][0], file.points.size(), spot),
                 index_below(ends[e][1], file.points.size(), spot)};
    if (edge.ends[0] == edge.ends[1]) {
      refuse("{} has the same vertex at both ends", spot.words());
    }
    edge.assignment = read_assignment(assignments[e], {where, "edges_assignment", e});
    edge.angle_deg = number(angles[e], 180.0, {where, "edges_foldAngle", e});
    file.edges.push_back(edge);
  }
}

/// Finds the edge of each side: every edge of a face must be listed, once, and no others.
void match_sides_with_edges(File& file) {
  struct Listed {
    std::uint64_t key;
    Index edge;
  };
  std::vector<Listed> listed;
  for (const Edge& edge : file.edges) {
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
  file.side_edge.assign(file.faces.sides(), none);
  std::vector<bool> used(file.edges.size(), false);
  auto at = listed.begin();
  for (const SideAtEdge& side : sides_by_edge(file.faces)) {
    while (at != listed.end() && at->key < side.key) {
      ++at;
    }
    if (at == listed.end() || at->key != side.key) {
      refuse("\"edges_vertices\" lacks the edge of face {} between vertices {} and {}",
             file.faces.face(side.side), file.faces.tail(side.side), file.faces.head(side.side));
    }
    file.side_edge[side.side] = at->edge;
    used[at->edge] = true;
  }
  if (const auto idle = std::find(used.begin(), used.end(), false); idle != used.end()) {
    refuse("edge {} belongs to no face", idle - used.begin());
  }
}

void read_head(const Json& json, File& file) {
  constexpr std::string_view where = "the file";
  const Json& spec = member(json, "file_spec", where);
  if (!spec.is_number() || spec.get<double>() != 1.2) {
    refuse("\"file_spec\" of the file is not 1.2");
  }
  file.creator = text_member(json, "file_creator", where);
  file.title = text_member(json, "file_title", where);
  file.file_classes = read_words(json, "file_classes", "multiModel", where);
  file.words.classes = read_words(json, "frame_classes", "creasePattern", where);
  file.words.attributes = read_words(json, "frame_attributes", "2D", where);
  expect_millimetres(json, where);
}

}  // namespace

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
  if (!json.is_object()) {
    refuse("the file is not a JSON object");
  }
  File file;
  read_head(json, file);
  file.model = read_model(json);
  file.frames = json.at("file_frames").size();
  for (const Json& row : list_member(json, "vertices_coords", "the file")) {
    std::array<double, 2> p{};
    lengths(row, p, {"the file", "vertices_coords", file.points.size()});
    file.points.push_back({p[0], p[1]});
  }
  file.faces = read_faces(json, file.points.size(), "the file");
  read_edges(json, file);
  match_sides_with_edges(file);
  read_lists(json, file);
  read_statements(json, file);
  return file;
}

}  // namespace ridgecraft::verify
