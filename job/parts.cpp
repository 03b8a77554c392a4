// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/parts.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "segment/segment.hpp"
#include "unfold/even_parts.hpp"
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

}  // namespace

Parts find_parts(const prepare::Prepared& prepared, const Options& options, const Context& context) {
  const mesh::Surface& surface = prepared.model.surface;
  if (options.parts == PartsFrom::components) {
    return {one_part_per_component(surface), false};
  }
  try {
    const segment::Segmentation found = segment::segment(surface, {}, {.concavity = options.concavity},
                                                         until_deadline(context, segmentation_share));
    return {unfold::even_parts(surface, prepared.panels,
                               unfold::parts_of_whole_panels(surface, prepared.panels, found.part),
                               options.pieces.weights),
            false};
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

}  // namespace ridgecraft::job
