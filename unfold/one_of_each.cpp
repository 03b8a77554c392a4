// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/one_of_each.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "prepare/prepared/twin_bodies.hpp"
#include "unfold/pieces/mirror_images.hpp"

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

bool have_equal_wishes(const mesh::Surface& surface, const EdgeWishes& wishes, const TwinBody& first,
                       const TwinBody& other) {
  if (wishes.empty()) {
    return true;
  }
  for (std::size_t i = 0; i < first.faces.size(); ++i) {
    for (unsigned k = 0; k < 3; ++k) {
      const EdgeId e = surface.edge(prepare::twin_side(first.faces[i], k, first.mirrored));
      const EdgeId image = surface.edge(prepare::twin_side(other.faces[i], k, other.mirrored));
      if (wishes[e] != wishes[image]) {
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

std::optional<OneOfEach> one_of_each(const Asked& whole) {
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
          have_equal_wishes(whole.surface, whole.options.wishes, kind[0], kind[b]) &&
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
  if (!whole.options.wishes.empty()) {
    each.options.wishes = EdgeWishes(each.kept.edge.size());
    for (const EdgeId e : ids<EdgeId>(each.kept.edge.size())) {
      each.options.wishes[e] = whole.options.wishes[each.kept.edge[e]];
    }
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
IdVector<EdgeId, EdgeId> numbers_kept(const Asked& whole, const OneOfEach& each) {
  IdVector<EdgeId, EdgeId> number(whole.surface.edge_count());
  for (const EdgeId e : ids<EdgeId>(each.kept.edge.size())) {
    number[each.kept.edge[e]] = e;
  }
  return number;
}

}  // namespace

MirrorImages mirror_images_of(const Asked& whole, const OneOfEach& each) {
  const Weights& weights = whole.options.pieces.weights;
  const IdVector<EdgeId, EdgeId> number = numbers_kept(whole, each);
  MirrorImages result;
  result.edge = IdVector<EdgeId, EdgeId>(each.kept.edge.size());
  bool any = false;
  const auto put = [&](EdgeId e, EdgeId image) {
    result.edge[e] = image;
    any = any || image.valid();
  };
  if (const MirrorImages images = mirror_images(whole.surface, weights); !images.edge.empty()) {
    result.plane = images.plane;
    for (const EdgeId e : ids<EdgeId>(each.kept.edge.size())) {
      const EdgeId image = images.edge[each.kept.edge[e]];
      put(e, image.valid() ? number[image] : EdgeId());
    }
  }
  std::set<FaceId> done;  // first faces of bodies
  for (const CopiedBody& copy : each.copies) {
    if (!done.insert(copy.from.front()).second) {
      continue;
    }
    const prepare::PartOf body = prepare::part_of(each.kept.surface, copy.from);
    const IdVector<EdgeId, EdgeId> images = mirror_images(body.surface, weights).edge;
    for (const EdgeId e : ids<EdgeId>(body.edge.size())) {
      const EdgeId image = images.empty() ? EdgeId() : images[e];
      put(body.edge[e], image.valid() ? body.edge[image] : EdgeId());
    }
  }
  return any ? result : MirrorImages();
}

std::optional<prepare::PartialRotation> turn_of(const Asked& whole, const OneOfEach& each) {
  const std::optional<prepare::PartialRotation> turn = turn_of(whole.surface, whole.options.pieces.weights);
  if (!turn) {
    return std::nullopt;
  }
  const IdVector<EdgeId, EdgeId> number = numbers_kept(whole, each);
  prepare::PartialRotation result{turn->order, IdVector<EdgeId, EdgeId>(each.kept.edge.size())};
  for (const EdgeId e : ids<EdgeId>(each.kept.edge.size())) {
    const EdgeId image = turn->edge[each.kept.edge[e]];
    result.edge[e] = image.valid() ? number[image] : EdgeId();
  }
  return result;
}

}  // namespace ridgecraft::unfold
