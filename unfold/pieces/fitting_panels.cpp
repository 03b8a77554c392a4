// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/fitting_panels.hpp"

#include <algorithm>

#include "unfold/net/tolerance.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/pieces/patch_nets.hpp"

namespace ridgecraft::unfold {
namespace {

/// Every face in a panel of its own.
prepare::Panels single_faces(const mesh::Surface& surface) {
  prepare::Panels panels;
  panels.panel = IdVector<FaceId, PanelId>(surface.face_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    panels.panel[f] = PanelId(f.value());
  }
  return panels;
}

/// Whether a panel can lie flat, in one, on the sheet.
bool lies_whole(const mesh::Surface& surface, const prepare::Panels& panels, const std::vector<FaceId>& faces,
                const Room& room) {
  if (faces.size() == 1) {
    return true;  // a face that no sheet holds is refused elsewhere
  }
  const Patch patch = make_patch(surface, panels, faces);
  return lies_as_one(patch, 1, room, net_tolerance(patch.extent));
}

}  // namespace

prepare::Panels fitting_panels(const mesh::Surface& surface, const prepare::Panels& panels, const Room& room,
                               const Context& context, std::vector<std::string>& notes) {
  prepare::Panels fitting;
  fitting.panel = IdVector<FaceId, PanelId>(surface.face_count());
  const prepare::Panels single = single_faces(surface);
  const Room bits{room.sheet, room.strip, 0};
  std::size_t divided = 0;
  for (const std::vector<FaceId>& faces : panels.faces) {
    context.check();
    std::vector<std::vector<FaceId>> shares{faces};
    if (!lies_whole(surface, panels, faces, room)) {
      ++divided;
      shares.clear();
      for (const std::vector<FaceId>& component : connected(surface, faces)) {
        const Patch patch = make_patch(surface, single, component);
        const PatchNets nets = unfold_patch(patch, bits, PanelCuts::only_if_too_large,
                                            net_tolerance(patch.extent), 1, Effort::brief, context);
        for (const auto& piece : lay_out(patch, nets.folds).faces) {
          std::vector<FaceId>& share = shares.emplace_back();
          for (const std::uint32_t f : piece) {
            share.push_back(component[f]);
          }
          std::sort(share.begin(), share.end());
        }
      }
    }
    for (std::vector<FaceId>& share : shares) {
      const PanelId id(fitting.faces.size());
      for (const FaceId f : share) {
        fitting.panel[f] = id;
      }
      fitting.faces.push_back(std::move(share));
    }
  }
  if (divided > 0) {
    notes.push_back(std::to_string(divided) + (divided == 1 ? " flat region is" : " flat regions are") +
                    " larger than the printable area, so cut");
  }
  return fitting;
}

}  // namespace ridgecraft::unfold
