// SPDX-License-Identifier: GPL-3.0-or-later
// unfold_example MODEL: each body in one net where there is one, and how many faces each has.
#include <iostream>

#include <ridgecraft/base/error.hpp>
#include <ridgecraft/mesh/mesh.hpp>
#include <ridgecraft/prepare/prepare.hpp>
#include <ridgecraft/unfold/unfold.hpp>

using namespace ridgecraft;

int main(int /*count*/, char** arguments) try {
  Context context;
  context.threads = 2;
  prepare::SizeOptions size;
  size.largest_extent_mm = 100.0;
  prepare::SimplifyOptions simplify;
  simplify.mode = prepare::Simplification::keep;
  const prepare::PanelRoom room{{190.0, 265.0}, 0.0};  // what one sheet holds, mm, and no tabs
  const prepare::Prepared prepared =
      prepare::prepare(mesh::read(arguments[1], {}, context), size, simplify, room, context);
  const mesh::Surface& surface = prepared.model.surface;
  IdVector<FaceId, PartId> part(surface.face_count());
  for (const FaceId f : ids<FaceId>(surface.face_count()))
    part[f] = PartId(surface.component(f).value());

  unfold::Options options;
  options.sheet = room.sheet;
  options.tabs.wanted = false;
  options.panel_cuts = unfold::PanelCuts::before_pieces;
  const unfold::Nets nets = unfold::unfold(surface, prepared.panels, part, options, context);
  for (const unfold::Piece& piece : nets.pieces)
    std::cout << piece.name << ' ' << piece.faces.size() << '\n';
} catch (const Error& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
