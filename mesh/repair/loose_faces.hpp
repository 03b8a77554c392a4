// SPDX-License-Identifier: GPL-3.0-or-later
// A model's faces taken apart so that a step can change them, and put together again. Private to mesh/.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/context.hpp"
#include "mesh/model/model.hpp"

namespace ridgecraft::mesh {

/// Faces over shared points with what each face carries. material and object are empty or as long as faces.
/// Places in pictures aren't carried along: what a surface looks like is taken before it is changed
/// (mesh/look).
struct LooseFaces {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<std::uint32_t> polygon;
  std::vector<std::uint32_t> material;
  std::vector<std::uint32_t> object;

  /// Appends a copy of `from`'s face i with other corners.
  void add(const LooseFaces& from, std::size_t i, const std::array<std::uint32_t, 3>& corners);
};

[[nodiscard]] LooseFaces take_apart(const Model& model);

/// Do the faces fulfil the invariants of Surface (unused points apart)?
[[nodiscard]] bool is_surface(const LooseFaces& loose);

/// Makes the invariants of Surface true, as repair does (docs/design/mesh.md, step 10): by giving points to
/// several faces separately and turning faces around. No face is dropped or moved in the list. O(n log n).
void make_surface(LooseFaces& loose, const Context& context);

/// Replaces the model's surface; points that no face uses are left out, and faces have no places in pictures
/// any more. The invariants must hold.
void put_together(Model& model, LooseFaces loose);

/// Leaves out the faces that aren't `kept`, one answer for each; materials and objects stay, places in
/// pictures don't.
void keep_faces(Model& model, const std::vector<bool>& kept);

}  // namespace ridgecraft::mesh
