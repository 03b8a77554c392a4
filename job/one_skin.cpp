// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/one_skin.hpp"

#include <cstddef>
#include <utility>

#include "prepare/clean_bodies.hpp"
#include "prepare/skin/skin.hpp"

namespace ridgecraft::job {
namespace {

/// Whether bodies meet along so many lines that their skin is finer than what it is made of: the inside of a
/// machine. Nothing makes that coarse enough to be folded, and its bodies can be.
bool is_tangle(std::size_t faces_of_skin, std::size_t faces_of_bodies) {
  constexpr std::size_t most_faces = 8000;
  constexpr std::size_t finer = 2;
  return faces_of_skin > most_faces && faces_of_skin > finer * faces_of_bodies;
}

}  // namespace

bool OneSkin::changed() const {
  return skin.united > 0 || skin.unseen > 0 || cleanup.left_out.count() > 0 || cleanup.proxies.count > 0 ||
         cleanup.thin_walls.walls > 0 || cleanup.simplified.faces_before > 0;
}

OneSkin one_skin(mesh::Model model, const prepare::SizeOptions& size,
                 const prepare::SimplifyOptions& simplify, const Context& context) {
  OneSkin result;
  result.model = std::move(model);
  result.cleanup = prepare::clean_bodies(result.model, size, simplify, context);
  mesh::Model apart = result.model;
  result.skin = prepare::unite_bodies(result.model, context);
  if (result.skin.united > 0 && is_tangle(result.model.surface.face_count(), apart.surface.face_count())) {
    const std::size_t tangled = result.skin.united + result.skin.left_crossing;
    result.model = std::move(apart);
    result.skin = {};
    result.skin.left_crossing = tangled;
  }
  if (result.skin.united > 0) {
    result.cleanup.left_out += prepare::leave_out_details(result.model, size, simplify, context);
  }
  return result;
}

}  // namespace ridgecraft::job
