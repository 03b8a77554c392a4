// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/unfold_options.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "export/sheet/paper.hpp"
#include "segment/segment.hpp"
#include "unfold/panel_parts.hpp"

namespace ridgecraft::job {
namespace {

/// Of the time that is left, so that some is left for unfolding.
constexpr double segmentation_share = 0.5;

IdVector<FaceId, PartId> one_part_per_component(const mesh::Surface& surface) {
  IdVector<FaceId, PartId> part(surface.face_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    part[f] = PartId(surface.component(f).value());
  }
  return part;
}

/// Copies of a body get its parts, where these are its own; all are numbered by their smallest faces again.
void copy_parts(const prepare::TwinBodies& twins, IdVector<FaceId, PartId>& part) {
  if (twins.empty()) {
    return;
  }
  std::size_t next = part.size();
  for (const std::vector<prepare::TwinBody>& kind : twins) {
    for (std::size_t b = 1; b < kind.size(); ++b) {
      std::map<PartId, PartId> image;
      for (std::size_t i = 0; i < kind[b].faces.size(); ++i) {
        const auto [at, fresh] = image.try_emplace(part[kind[0].faces[i]], PartId(next));
        next += fresh ? 1U : 0U;
        part[kind[b].faces[i]] = at->second;
      }
    }
  }
  std::map<PartId, PartId> number;
  for (PartId& p : part) {
    p = number.try_emplace(p, PartId(number.size())).first->second;
  }
}

}  // namespace

IdVector<FaceId, std::uint32_t> author_labels(const mesh::Model& model) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> number;
  IdVector<FaceId, std::uint32_t> labels;
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    const std::pair key(model.object.empty() ? mesh::Soup::none : model.object[f],
                        model.material.empty() ? mesh::Soup::none : model.material[f]);
    labels.push_back(number.try_emplace(key, static_cast<std::uint32_t>(number.size())).first->second);
  }
  return number.size() > 1 ? labels : IdVector<FaceId, std::uint32_t>();
}

Parts find_parts(const prepare::Prepared& prepared, const Options& options, const Context& context) {
  const mesh::Surface& surface = prepared.model.surface;
  if (options.parts == PartsFrom::components) {
    return {one_part_per_component(surface), false};
  }
  try {
    const IdVector<FaceId, std::uint32_t> labels = author_labels(prepared.model);
    const segment::Segmentation found =
        segment::segment(surface, {}, {.concavity = options.concavity},
                         until_deadline(context, segmentation_share), labels.items());
    Parts parts{unfold::parts_of_whole_panels(surface, prepared.panels, found.part), false};
    copy_parts(prepared.twins, parts.of_face);
    return parts;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::out_of_time) {
      throw;
    }
  }
  return {one_part_per_component(surface), true};
}

std::size_t count_parts(const IdVector<FaceId, PartId>& part) {
  std::uint32_t count = 0;
  for (const PartId p : part) {
    count = std::max(count, p.value() + 1);
  }
  return count;
}

namespace {

/// A face of this size fits every sheet; for nets without pages.
constexpr double boundless_mm = 1e9;

}  // namespace

Vec2 room_for_pieces(const Options& options) {
  return options.paper ? export_::piece_area(*options.paper) : Vec2{boundless_mm, boundless_mm};
}

unfold::Options unfold_options(const Options& options, const prepare::Prepared& prepared,
                               unfold::EdgeConstraints constraints) {
  unfold::Options unfolding;
  if (options.paper) {
    const Vec2 area = room_for_pieces(options);
    unfolding.sheet = unfold::Sheet{area.x, area.y};
  }
  unfolding.tabs = options.tabs;
  // A wall of board stands on its edge.
  unfolding.tabs.at_open_bases = options.tabs.at_open_bases && !(options.board.thickness_mm > 0.0);
  unfolding.panel_cuts = options.panel_cuts;
  unfolding.pieces = options.pieces;
  unfolding.constraints = std::move(constraints);
  unfolding.labels = author_labels(prepared.model);
  unfolding.rolls = prepared.rolls.of_edge;
  unfolding.twins = prepared.twins;
  return unfolding;
}

}  // namespace ridgecraft::job
