// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/copies.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "prepare/prepared/prepared.hpp"
#include "unfold/net/chains.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/pieces/symmetry.hpp"

namespace ridgecraft::unfold {
namespace {

using prepare::TwinBody;

/// The parts of a body, if no other body has faces in them.
bool has_own_parts(const std::vector<std::size_t>& faces_in_part, const IdVector<FaceId, PartId>& part,
                   const TwinBody& body) {
  std::set<PartId> parts;
  for (const FaceId f : body.faces) {
    parts.insert(part[f]);
  }
  std::size_t faces = 0;
  for (const PartId p : parts) {
    faces += faces_in_part[p.value()];
  }
  return faces == body.faces.size();
}

bool are_divided_alike(const IdVector<FaceId, PartId>& part, const TwinBody& first, const TwinBody& other) {
  std::map<PartId, PartId> image;
  std::map<PartId, PartId> back;
  for (std::size_t i = 0; i < first.faces.size(); ++i) {
    const PartId p = part[first.faces[i]];
    const PartId q = part[other.faces[i]];
    if (image.try_emplace(p, q).first->second != q || back.try_emplace(q, p).first->second != p) {
      return false;
    }
  }
  return true;
}

bool have_equal_constraints(const mesh::Surface& surface, const EdgeConstraints& constraints,
                            const TwinBody& first, const TwinBody& other) {
  if (constraints.empty()) {
    return true;
  }
  for (std::size_t i = 0; i < first.faces.size(); ++i) {
    for (unsigned k = 0; k < 3; ++k) {
      const EdgeId e = surface.edge(prepare::twin_side(first.faces[i], k, first.mirrored));
      const EdgeId image = surface.edge(prepare::twin_side(other.faces[i], k, other.mirrored));
      if (constraints[e] != constraints[image]) {
        return false;
      }
    }
  }
  return true;
}

/// Whether the model's author has set the same faces of both apart, be it by other names and colours.
bool have_equal_borders(const mesh::Surface& surface, const IdVector<FaceId, std::uint32_t>& labels,
                        const TwinBody& first, const TwinBody& other) {
  if (labels.empty()) {
    return true;
  }
  const auto is_border = [&](CornerId side) {
    const FaceId beyond = surface.neighbor(side);
    return beyond.valid() && labels[mesh::face_of(side)] != labels[beyond];
  };
  for (std::size_t i = 0; i < first.faces.size(); ++i) {
    for (unsigned k = 0; k < 3; ++k) {
      if (is_border(prepare::twin_side(first.faces[i], k, first.mirrored)) !=
          is_border(prepare::twin_side(other.faces[i], k, other.mirrored))) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

std::optional<OneOfEach> one_of_each(const UnfoldProblem& whole) {
  if (whole.options.twins.empty()) {
    return std::nullopt;
  }
  std::vector<std::size_t> faces_in_part;
  for (const PartId p : whole.part) {
    faces_in_part.resize(std::max<std::size_t>(faces_in_part.size(), p.value() + 1));
    ++faces_in_part[p.value()];
  }
  std::vector<std::pair<const TwinBody*, const TwinBody*>> copies;  // the first one, and its copy
  std::vector<bool> left_out(whole.surface.face_count(), false);
  for (const std::vector<TwinBody>& kind : whole.options.twins) {
    if (kind.empty() || !has_own_parts(faces_in_part, whole.part, kind[0])) {
      continue;
    }
    for (std::size_t b = 1; b < kind.size(); ++b) {
      if (has_own_parts(faces_in_part, whole.part, kind[b]) &&
          are_divided_alike(whole.part, kind[0], kind[b]) &&
          have_equal_constraints(whole.surface, whole.options.constraints, kind[0], kind[b]) &&
          have_equal_borders(whole.surface, whole.options.labels, kind[0], kind[b])) {
        copies.emplace_back(&kind[0], &kind[b]);
        for (const FaceId f : kind[b].faces) {
          left_out[f.value()] = true;
        }
      }
    }
  }
  if (copies.empty()) {
    return std::nullopt;
  }
  OneOfEach each;
  std::vector<FaceId> faces;
  IdVector<FaceId, std::uint32_t> labels;
  IdVector<FaceId, FaceId> number(whole.surface.face_count());
  for (const FaceId f : ids<FaceId>(whole.surface.face_count())) {
    if (!left_out[f.value()]) {
      number[f] = FaceId(faces.size());
      faces.push_back(f);
      each.part.push_back(whole.part[f]);
      if (!whole.options.labels.empty()) {
        labels.push_back(whole.options.labels[f]);
      }
    }
  }
  each.kept = prepare::part_of(whole.surface, faces);
  each.panels = prepare::panels_of(whole.panels, each.kept.face);
  each.options = whole.options;
  each.options.twins = {};
  each.options.labels = std::move(labels);
  if (!whole.options.constraints.empty()) {
    each.options.constraints = EdgeConstraints(each.kept.edge.size());
    for (const EdgeId e : ids<EdgeId>(each.kept.edge.size())) {
      each.options.constraints[e] = whole.options.constraints[each.kept.edge[e]];
    }
  }
  if (!whole.options.rolls.empty()) {
    for (const EdgeId e : ids<EdgeId>(each.kept.edge.size())) {
      each.options.rolls[e] = whole.options.rolls[each.kept.edge[e]];
    }
    each.options.rolls.resize(each.kept.edge.size());
  }
  for (const auto& [first, other] : copies) {
    CopiedBody& copy = each.copies.emplace_back();
    copy.mirrored = other->mirrored;
    copy.to = other->faces;
    for (const FaceId f : first->faces) {
      copy.from.push_back(number[f]);
    }
  }
  return each;
}

namespace {

/// Of each edge of the whole its number in the kept surface; none of those that aren't kept.
IdVector<EdgeId, EdgeId> numbers_kept(const UnfoldProblem& whole, const OneOfEach& each) {
  IdVector<EdgeId, EdgeId> number(whole.surface.edge_count());
  for (const EdgeId e : ids<EdgeId>(each.kept.edge.size())) {
    number[each.kept.edge[e]] = e;
  }
  return number;
}

}  // namespace

Symmetry symmetry_of(const UnfoldProblem& whole, const OneOfEach& each, const Context& context) {
  const Weights& weights = whole.options.pieces.weights;
  const std::size_t edges = each.kept.edge.size();
  Symmetry result;
  for (const double weight : {1.0, 0.5, 0.5}) {
    result.images.push_back({IdVector<EdgeId, EdgeId>(edges), weight});
  }
  // Where `to` says that an edge of a surface is in the kept one.
  const auto put = [&](const Symmetry& symmetry, const IdVector<EdgeId, EdgeId>& to) {
    const std::size_t first = symmetry.plane ? 0 : 1;
    for (std::size_t i = 0; i < symmetry.images.size(); ++i) {
      for (const EdgeId e : ids<EdgeId>(to.size())) {
        const EdgeId image = symmetry.images[i].edge[e];
        if (to[e].valid()) {
          result.images[first + i].edge[to[e]] = image.valid() ? to[image] : EdgeId();
        }
      }
    }
  };
  const Symmetry of_whole = find_symmetry(whole.surface, weights, context);
  result.plane = of_whole.plane;
  put(of_whole, numbers_kept(whole, each));
  std::set<FaceId> done;  // first faces of bodies
  for (const CopiedBody& copy : each.copies) {
    if (!done.insert(copy.from.front()).second) {
      continue;
    }
    const prepare::PartOf body = prepare::part_of(each.kept.surface, copy.from);
    IdVector<EdgeId, std::uint8_t> own(edges, 0);
    for (const EdgeId e : body.edge) {
      own[e] = 1;
    }
    for (EdgeImages& images : result.images) {
      for (const EdgeId e : ids<EdgeId>(edges)) {
        if (own[e] != 0 || (images.edge[e].valid() && own[images.edge[e]] != 0)) {
          images.edge[e] = EdgeId();
        }
      }
    }
    put(find_symmetry(body.surface, weights, context), body.edge);
  }
  return result;
}

namespace {

// Nets of bodies that are copies of others.

Vec2 mirrored(Vec2 p) {
  return {-p.x, p.y};
}

/// From faces and sides of the kept surface to those of the whole: in the body itself, or in one of its
/// copies.
class WayBack {
 public:
  WayBack(const UnfoldProblem& whole, const OneOfEach& each) : whole_(whole), each_(each) {
    place_.resize(each.kept.face.size());
    copies_.resize(each.kept.face.size());
    for (const CopiedBody& copy : each.copies) {
      for (std::uint32_t i = 0; i < copy.from.size(); ++i) {
        place_[copy.from[i]] = i;
        copies_[copy.from[i]].push_back(&copy);
      }
    }
  }

  /// Where a face's body occurs: null stands for itself.
  [[nodiscard]] std::vector<const CopiedBody*> occurrences(FaceId f) const {
    std::vector<const CopiedBody*> all{nullptr};
    all.insert(all.end(), copies_[f].begin(), copies_[f].end());
    return all;
  }
  [[nodiscard]] FaceId face(FaceId f, const CopiedBody* in) const {
    return in == nullptr ? each_.kept.face[f] : in->to[place_[f]];
  }
  [[nodiscard]] CornerId side(CornerId c, const CopiedBody* in) const {
    return prepare::twin_side(face(mesh::face_of(c), in), c.value() % 3, in != nullptr && in->mirrored);
  }
  [[nodiscard]] EdgeId edge(EdgeId e, const CopiedBody* in) const {
    return whole_.surface.edge(side(each_.kept.surface.sides(e)[0], in));
  }
  [[nodiscard]] std::array<Vec2, 3> flat(const std::array<Vec2, 3>& corners, const CopiedBody* in) const {
    return in == nullptr || !in->mirrored
               ? corners
               : std::array{mirrored(corners[0]), mirrored(corners[2]), mirrored(corners[1])};
  }

 private:
  const UnfoldProblem& whole_;
  const OneOfEach& each_;
  IdVector<FaceId, std::uint32_t> place_;  ///< in CopiedBody::from
  IdVector<FaceId, std::vector<const CopiedBody*>> copies_;
};

std::vector<Vec2> polygon_of(const std::vector<Vec2>& polygon, bool mirrors) {
  if (!mirrors) {
    return polygon;
  }
  // The first two corners are the base's, whose direction turns round as well.
  std::vector<Vec2> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    result.push_back(mirrored(polygon[(polygon.size() + 1 - i) % polygon.size()]));
  }
  return result;
}

/// The part that most of a piece's area belongs to: pieces come by it.
PartId main_part(const UnfoldProblem& whole, const std::vector<FaceId>& faces) {
  std::map<PartId, double> area;
  for (const FaceId f : faces) {
    area[whole.part[f]] += whole.surface.area(f);
  }
  return std::max_element(area.begin(), area.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

Piece copied_piece(const UnfoldProblem& whole, const WayBack& way, const Piece& piece, const CopiedBody* in) {
  Piece copy = piece;
  copy.parts.clear();
  for (FaceId& f : copy.faces) {
    f = way.face(f, in);
    copy.parts.push_back(whole.part[f]);
  }
  std::sort(copy.faces.begin(), copy.faces.end());
  std::sort(copy.parts.begin(), copy.parts.end());
  copy.parts.erase(std::unique(copy.parts.begin(), copy.parts.end()), copy.parts.end());
  for (std::vector<CornerId>& step : copy.folding.steps) {
    for (CornerId& side : step) {
      side = way.side(side, in);
    }
  }
  if (copy.folding.in_the_way) {
    for (FaceId& f : *copy.folding.in_the_way) {
      f = way.face(f, in);
    }
  }
  return copy;
}

}  // namespace

Nets with_copies(const UnfoldProblem& whole, const OneOfEach& each, const Nets& nets) {
  const WayBack way(whole, each);
  Nets all;
  all.notes = nets.notes;
  all.use = IdVector<EdgeId, EdgeUse>(whole.surface.edge_count());
  all.piece = IdVector<FaceId, PieceId>(whole.surface.face_count());
  all.flat = IdVector<FaceId, std::array<Vec2, 3>>(whole.surface.face_count());
  for (const EdgeId e : ids<EdgeId>(nets.use.size())) {
    for (const CopiedBody* in : way.occurrences(mesh::face_of(each.kept.surface.sides(e)[0]))) {
      all.use[way.edge(e, in)] = nets.use[e];
    }
  }
  for (const FaceId f : ids<FaceId>(nets.flat.size())) {
    for (const CopiedBody* in : way.occurrences(f)) {
      all.flat[way.face(f, in)] = way.flat(nets.flat[f], in);
    }
  }
  std::vector<std::pair<PartId, Piece>> drafts;
  for (const Piece& piece : nets.pieces) {
    for (const CopiedBody* in : way.occurrences(piece.faces.front())) {
      Piece copy = copied_piece(whole, way, piece, in);
      const PartId part = main_part(whole, copy.faces);
      drafts.emplace_back(part, std::move(copy));
    }
  }
  std::stable_sort(drafts.begin(), drafts.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [part, piece] : drafts) {
    piece.name = piece_name(all.pieces.size());
    for (const FaceId f : piece.faces) {
      all.piece[f] = PieceId(all.pieces.size());
    }
    all.pieces.push_back(std::move(piece));
  }
  number_joins(whole.surface, all);
  copy_tabs(whole, each, nets, all);
  return all;
}

std::optional<Nets> without_copies(const UnfoldProblem& whole, const OneOfEach& each, const Nets& nets) {
  const WayBack way(whole, each);
  Nets result;
  result.use = IdVector<EdgeId, EdgeUse>(each.kept.edge.size());
  for (const EdgeId e : ids<EdgeId>(each.kept.edge.size())) {
    result.use[e] = nets.use[each.kept.edge[e]];
    for (const CopiedBody* in : way.occurrences(mesh::face_of(each.kept.surface.sides(e)[0]))) {
      if (nets.use[way.edge(e, in)] != result.use[e]) {
        return std::nullopt;
      }
    }
  }
  std::map<PieceId, PieceId> number;
  for (const FaceId f : ids<FaceId>(each.kept.face.size())) {
    const FaceId own = each.kept.face[f];
    for (const CopiedBody* in : way.occurrences(f)) {
      if (nets.flat[way.face(f, in)] != way.flat(nets.flat[own], in)) {
        return std::nullopt;
      }
    }
    result.flat.push_back(nets.flat[own]);
    number.try_emplace(nets.piece[own], PieceId(0));
  }
  for (auto& [old, fresh] : number) {
    Piece piece = nets.pieces[old];
    piece.faces.clear();
    fresh = result.pieces.push_back(std::move(piece));
  }
  for (const FaceId f : ids<FaceId>(each.kept.face.size())) {
    const PieceId p = number.at(nets.piece[each.kept.face[f]]);
    result.piece.push_back(p);
    result.pieces[p].faces.push_back(f);
  }
  return result;
}

void copy_tabs(const UnfoldProblem& whole, const OneOfEach& each, const Nets& tabbed, Nets& nets) {
  const WayBack way(whole, each);
  // Of each edge of the whole the join without copies that it is an image of, and where.
  IdVector<EdgeId, std::pair<JoinId, const CopiedBody*>> source(whole.surface.edge_count());
  for (const JoinId j : ids<JoinId>(tabbed.joins.size())) {
    const EdgeId e = tabbed.joins[j].edge;
    for (const CopiedBody* in : way.occurrences(mesh::face_of(each.kept.surface.sides(e)[0]))) {
      source[way.edge(e, in)] = {j, in};
    }
  }
  nets.tabs = {};
  for (const JoinId j : ids<JoinId>(nets.joins.size())) {
    Join& join = nets.joins[j];
    const auto& [original, in] = source[join.edge];
    const Join& from = tabbed.joins[original];
    join.no_tab = from.no_tab;
    join.too_narrow = from.too_narrow;
    if (from.tab.valid()) {
      const Tab& tab = tabbed.tabs[from.tab];
      join.tab = nets.tabs.push_back(
          {way.side(tab.side, in), j, polygon_of(tab.polygon, in != nullptr && in->mirrored)});
    }
  }
}

}  // namespace ridgecraft::unfold
