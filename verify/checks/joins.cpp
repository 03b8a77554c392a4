// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 5: edges of the nets, pieces as discs with holes, and folds, cuts and joins against the model.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/disjoint_sets.hpp"
#include "verify/checks/checks.hpp"
#include "verify/file/relations.hpp"
#include "verify/file/tolerance.hpp"

namespace ridgecraft::verify {

// Promise 5 against the model: every edge between two model faces is one fold with the model's angle, or one
// cut that is in exactly one join; nothing else is a fold or a join.

namespace {

bool assignment_fits(Assignment assignment, double angle, double tolerance) {
  switch (assignment) {
    case Assignment::flat:
      return std::abs(angle) < flat_fold_deg + tolerance;
    case Assignment::mountain:
      return angle <= -flat_fold_deg + tolerance || angle >= 180.0 - tolerance;
    case Assignment::valley:
      return angle >= flat_fold_deg - tolerance || angle <= -180.0 + tolerance;
    case Assignment::cut:
      break;
  }
  return false;
}

/// The angle's sign says what the assignment says; folded shut both signs hold.
bool sign_fits(const Edge& edge) {
  switch (edge.assignment) {
    case Assignment::flat:
      return edge.angle_deg == 0.0;
    case Assignment::mountain:
      return edge.angle_deg < 0.0 || edge.angle_deg == 180.0;
    case Assignment::valley:
      return edge.angle_deg > 0.0 || edge.angle_deg == -180.0;
    case Assignment::cut:
      break;
  }
  return false;
}

class JoinCheck {
 public:
  JoinCheck(const Case& given, Findings& findings)
      : file_(given.file), relations_(given.relations), given_(given), findings_(findings) {
    explained_.assign(file_.edges.size(), false);
    matched_.assign(file_.joins.size(), false);
    list_joins_by_edge();
  }

  void run() {
    check_reasons();
    const Model& model = file_.model;
    for (Index side = 0; side < model.faces.sides(); ++side) {
      if (model.twin[side] != none && side < model.twin[side]) {
        given_.context.check();
        check_model_edge(side);
      }
    }
    check_other_folds();
    check_other_joins();
    check_edges_in_joins();
  }

 private:
  template <typename Message>
  void add(std::initializer_list<std::pair<const char*, std::size_t>> indices, const Message& message) {
    ++findings_.figures().bad_joins;
    findings_.add(Promise::joins, indices, message);
  }

  [[nodiscard]] std::string name(Index edge) const { return edge_name(file_, relations_, edge); }

  void list_joins_by_edge() {
    for (Index j = 0; j < file_.joins.size(); ++j) {
      const auto [a, b] = file_.joins[j].edges;
      joins_.push_back({a, j});
      if (a != b) {
        joins_.push_back({b, j});
      }
    }
    std::sort(joins_.begin(), joins_.end());
  }

  /// The joins that name an edge, in the order of their indices.
  [[nodiscard]] std::span<const std::pair<Index, Index>> joins_of(Index edge) const {
    const auto begin = std::lower_bound(joins_.begin(), joins_.end(), std::pair<Index, Index>{edge, 0});
    auto end = begin;
    while (end != joins_.end() && end->first == edge) {
      ++end;
    }
    return std::span(joins_).subspan(static_cast<std::size_t>(begin - joins_.begin()),
                                     static_cast<std::size_t>(end - begin));
  }

  [[nodiscard]] std::pair<Index, Index> edges_of(Index join) const {
    return std::minmax(file_.joins[join].edges[0], file_.joins[join].edges[1]);
  }

  void check_reasons() {
    for (Index j = 0; j < file_.joins.size(); ++j) {
      const std::string& why = file_.joins[j].why;
      const bool has_tab = file_.joins[j].tab != none;
      findings_.figures().joins_without_tab += has_tab ? 0U : 1U;
      if (!has_tab && why.empty()) {
        add({{"join", j}},
            [&] { return fmt::format("{} has no tab and doesn't say why", join_name(file_, j)); });
      } else if (has_tab && !why.empty()) {
        add({{"join", j}},
            [&] { return fmt::format("{} has a tab, and says why it has none", join_name(file_, j)); });
      }
    }
  }

  /// The side of a net that a side of the model became, or none where promise 1 or 3 is broken already.
  [[nodiscard]] Index net_side(Index model_side) const {
    const Index face = file_.model.faces.face(model_side);
    const Index net = relations_.net_face[face];
    return net == none ? none : file_.faces.first(net) + (model_side - file_.model.faces.first(face));
  }

  void check_model_edge(Index side) {
    const Index a = net_side(side);
    const Index b = net_side(file_.model.twin[side]);
    for (const Index s : {a, b}) {
      if ((a == none || b == none) && s != none) {
        explained_[file_.side_edge[s]] = true;  // its partner is missing, which was said there
      }
    }
    if (a == none || b == none) {
      return;
    }
    const Index e = file_.side_edge[a];
    const Index f = file_.side_edge[b];
    if (relations_.flaw[e] != EdgeFlaw::sound || relations_.flaw[f] != EdgeFlaw::sound) {
      return;
    }
    if (e == f) {
      check_fold(e, side);
    } else {
      check_cut(a, b, side);
    }
  }

  void check_fold(Index e, Index side) {
    explained_[e] = true;
    const Edge& edge = file_.edges[e];
    const ModelFold fold = model_fold(file_, relations_, side);
    const double apart = std::abs(edge.angle_deg - fold.angle_deg);
    const double error = std::min(apart, 360.0 - apart);
    double& worst = findings_.figures().max_fold_error_deg;
    worst = std::max(worst, error);
    if (error > fold.tolerance_deg) {
      add({{"edge", e}}, [&] {
        return fmt::format("{} is folded by {:.6g} degrees, the model by {:.6g}", name(e), edge.angle_deg,
                           fold.angle_deg);
      });
    } else if (!assignment_fits(edge.assignment, fold.angle_deg, fold.tolerance_deg)) {
      add({{"edge", e}}, [&] {
        return fmt::format("{} is assigned \"{}\", but the model's angle is {:.6g} degrees", name(e),
                           static_cast<char>(edge.assignment), fold.angle_deg);
      });
    } else if (!sign_fits(edge)) {
      add({{"edge", e}}, [&] {
        return fmt::format("the angle {:.6g} of {} doesn't go with its assignment \"{}\"", edge.angle_deg,
                           name(e), static_cast<char>(edge.assignment));
      });
    }
    if (const auto joins = joins_of(e); !joins.empty()) {
      add({{"edge", e}, {"join", joins.front().second}}, [&] {
        return fmt::format("{} is a fold and in {}", name(e), join_name(file_, joins.front().second));
      });
    }
  }

  void check_cut(Index a, Index b, Index side) {
    const Index e = file_.side_edge[a];
    const Index f = file_.side_edge[b];
    Index first = none;
    for (const auto& [edge, j] : joins_of(e)) {
      if (edges_of(j) != std::pair<Index, Index>(std::minmax(e, f))) {
        continue;
      }
      matched_[j] = true;
      if (first == none) {
        first = j;
      } else {
        add({{"join", first}, {"join", j}}, [&, j = j] {
          return fmt::format("{} and {} join the same two edges", join_name(file_, first),
                             join_name(file_, j));
        });
      }
    }
    if (first == none) {
      add({{"edge", e}, {"edge", f}},
          [&] { return fmt::format("the cut between {} and {} is in no join", name(e), name(f)); });
      return;
    }
    const Model& model = file_.model;
    const double truth = length(model.points[model.faces.head(side)] - model.points[model.faces.tail(side)]);
    const double e_length = length_of(a);
    const double f_length = length_of(b);
    if (std::abs(e_length - f_length) > 2.0 * (length_tolerance_mm + length_tolerance_fraction * truth)) {
      add({{"join", first}, {"edge", e}, {"edge", f}}, [&] {
        return fmt::format("{} joins edges of different length, {:.9g} and {:.9g} mm",
                           join_name(file_, first), e_length, f_length);
      });
    }
  }

  [[nodiscard]] double length_of(Index side) const {
    return length(file_.points[file_.faces.head(side)] - file_.points[file_.faces.tail(side)]);
  }

  void check_other_folds() {
    for (Index e = 0; e < file_.edges.size(); ++e) {
      const bool fold = file_.edges[e].assignment != Assignment::cut;
      if (!fold || explained_[e] || relations_.flaw[e] != EdgeFlaw::sound) {
        continue;
      }
      const auto sides = relations_.sides_of(e);
      const bool known = std::all_of(sides.begin(), sides.end(), [this](Index s) {
        return relations_.net_face[file_.face_model[file_.faces.face(s)]] != none;
      });
      if (known) {
        add({{"edge", e}}, [&] { return fmt::format("{} is a fold that the model doesn't have", name(e)); });
      }
    }
  }

  void check_other_joins() {
    for (Index j = 0; j < file_.joins.size(); ++j) {
      const auto [a, b] = file_.joins[j].edges;
      if (!matched_[j]) {
        add({{"join", j}, {"edge", a}, {"edge", b}}, [&, a = a, b = b] {
          return fmt::format("{} joins {} and {}, which are not the two sides of one cut",
                             join_name(file_, j), name(a), name(b));
        });
      }
    }
  }

  void check_edges_in_joins() {
    for (std::size_t i = 1; i < joins_.size(); ++i) {
      const auto& [edge, join] = joins_[i];
      const auto& [previous_edge, previous_join] = joins_[i - 1];
      if (edge == previous_edge && edges_of(join) != edges_of(previous_join)) {
        add({{"edge", edge}, {"join", previous_join}, {"join", join}},
            [&, edge = edge, join = join, previous_join = previous_join] {
              return fmt::format("{} is in {} and in {}", name(edge), join_name(file_, previous_join),
                                 join_name(file_, join));
            });
      }
    }
  }

  const File& file_;
  const Relations& relations_;
  const Case& given_;
  Findings& findings_;
  std::vector<std::pair<Index, Index>> joins_;  ///< (edge, join), sorted
  std::vector<bool> explained_;  ///< per edge: the model says why it is a fold, or another fault does
  std::vector<bool> matched_;    ///< per join: it is the join of a cut
};

// Promise 5, the nets by themselves: edges have the faces that their assignment says, and each piece is one
// disc, with as many round holes as it states.

const char* words_for(EdgeFlaw flaw) {
  switch (flaw) {
    case EdgeFlaw::many_faces:
      return "has more than two faces";
    case EdgeFlaw::same_direction:
      return "has two faces that run along it in the same direction";
    case EdgeFlaw::cut_with_two_faces:
      return "is a cut (\"B\"), but has two faces";
    case EdgeFlaw::fold_with_one_face:
      return "is a fold, but has one face";
    case EdgeFlaw::fold_between_pieces:
      return "is a fold between two pieces";
    case EdgeFlaw::sound:
      break;
  }
  return "is sound";
}

void check_edges(const Case& given, Findings& findings) {
  const File& file = given.file;
  const Relations& relations = given.relations;
  for (Index e = 0; e < file.edges.size(); ++e) {
    if (relations.flaw[e] != EdgeFlaw::sound) {
      ++findings.figures().bad_joins;
      findings.add(Promise::joins, {{"edge", e}}, [&] {
        return fmt::format("{} {}", edge_name(file, relations, e), words_for(relations.flaw[e]));
      });
    }
    if (file.edges[e].assignment == Assignment::cut && file.edges[e].angle_deg != 0.0) {
      ++findings.figures().bad_joins;
      findings.add(Promise::joins, {{"edge", e}}, [&] {
        return fmt::format("{} is a cut (\"B\"), but has the fold angle {:.6g}",
                           edge_name(file, relations, e), file.edges[e].angle_deg);
      });
    }
  }
}

/// Corners that folds don't join around their vertex have to be vertices of their own.
void check_vertices(const Case& given, const std::vector<Index>& fan, Findings& findings) {
  const File& file = given.file;
  std::vector<Index> first_fan(file.points.size(), none);
  std::vector<bool> listed(file.points.size(), false);
  for (Index s = 0; s < file.faces.sides(); ++s) {
    const Index v = file.faces.tail(s);
    if (first_fan[v] == none) {
      first_fan[v] = fan[s];
    } else if (first_fan[v] != fan[s] && !listed[v]) {
      listed[v] = true;
      findings.add(Promise::joins, {{"vertex", v}, {"face", file.faces.face(s)}}, [&] {
        return fmt::format(
            "vertex {} belongs to {} and to faces that no chain of folds around it joins with that one", v,
            face_name(file, file.faces.face(s)));
      });
    }
  }
}

/// What decides about the shape of a piece.
struct Patch {
  std::int64_t faces = 0, corners = 0, edges = 0;
  std::int64_t components = 0;
  std::int64_t borders = 0;  ///< closed loops of cut edges

  [[nodiscard]] std::int64_t euler() const { return corners - edges + faces; }
};

/// Follows each loop of sides without a fold; all its sides belong to one piece.
void count_borders(const File& file, const std::vector<Index>& twin, std::vector<Patch>& patches) {
  std::vector<bool> seen(file.faces.sides(), false);
  for (Index first = 0; first < file.faces.sides(); ++first) {
    if (twin[first] != none || seen[first]) {
      continue;
    }
    ++patches[file.face_piece[file.faces.face(first)]].borders;
    for (Index side = first; !seen[side];) {
      seen[side] = true;
      side = file.faces.next(side);
      while (twin[side] != none) {
        side = file.faces.next(twin[side]);
      }
    }
  }
}

std::vector<Patch> measure_patches(const Case& given, const std::vector<Index>& fan) {
  const File& file = given.file;
  const std::vector<Index>& twin = given.relations.fold_twin;
  std::vector<Patch> patches(file.pieces.size());
  DisjointSets joined(file.faces.faces());
  for (Index s = 0; s < file.faces.sides(); ++s) {
    Patch& patch = patches[file.face_piece[file.faces.face(s)]];
    patch.corners += fan[s] == s ? 1 : 0;
    // Of the two sides of a fold the one with the smaller number counts.
    patch.edges += twin[s] == none || s < twin[s] ? 1 : 0;
    if (twin[s] != none) {
      joined.join(file.faces.face(s), file.faces.face(twin[s]));
    }
  }
  for (Index f = 0; f < file.faces.faces(); ++f) {
    Patch& patch = patches[file.face_piece[f]];
    ++patch.faces;
    patch.components += joined.find(f) == f ? 1 : 0;
  }
  count_borders(file, twin, patches);
  return patches;
}

void check_patch(const File& file, Index p, const Patch& patch, Findings& findings) {
  if (patch.faces == 0) {
    return;
  }
  if (patch.components > 1) {
    findings.add(Promise::joins, {{"piece", p}}, [&] {
      return fmt::format("{} falls into {} parts that no fold joins", piece_name(file, p), patch.components);
    });
  } else if (patch.borders == 0 || patch.euler() != 2 - patch.borders) {
    findings.add(Promise::joins, {{"piece", p}}, [&] {
      return fmt::format(
          "{} is no patch of the plane: its folds close it up (Euler characteristic {}, {} borders)",
          piece_name(file, p), patch.euler(), patch.borders);
    });
  } else if (patch.borders - 1 != file.pieces[p].holes) {
    findings.add(Promise::joins, {{"piece", p}}, [&] {
      return fmt::format("{} has {} holes and states {}", piece_name(file, p), patch.borders - 1,
                         file.pieces[p].holes);
    });
  }
}

}  // namespace

void check_joins(const Case& given, Findings& findings) {
  findings.figures().joins = given.file.joins.size();
  JoinCheck(given, findings).run();
}

void check_patches(const Case& given, Findings& findings) {
  check_edges(given, findings);
  const std::vector<Index> fan = corner_fans(given.file.faces, given.relations.fold_twin);
  check_vertices(given, fan, findings);
  given.context.check();
  const std::vector<Patch> patches = measure_patches(given, fan);
  for (Index p = 0; p < patches.size(); ++p) {
    check_patch(given.file, p, patches[p], findings);
  }
}

}  // namespace ridgecraft::verify
