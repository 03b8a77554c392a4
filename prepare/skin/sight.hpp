// SPDX-License-Identifier: GPL-3.0-or-later
// What can be seen from outside. Private to prepare/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/boxes.hpp"
#include "base/context.hpp"
#include "base/vector.hpp"
#include "mesh/model/model.hpp"

namespace ridgecraft::prepare {

/// A triangle in the way of looks: nothing is seen through walls, and openings are told apart by number.
struct Screen {
  static constexpr std::uint32_t wall = 0xffffffffU;

  std::array<Vec3, 3> corners;
  std::uint32_t opening = wall;
};

class Sight {
 public:
  /// At least one triangle. O(n log n).
  explicit Sight(std::vector<Screen> screens);

  /// From a place beside a surface, on the side that `normal` points to: through which openings one gets out,
  /// each as often as a look of 64 in even directions goes through it and meets no wall. O(log n) a look
  /// where the triangles are spread.
  [[nodiscard]] std::vector<std::uint32_t> openings_seen(Vec3 place, Vec3 normal) const;

  /// From such a place: does one of these looks meet no wall? O(log n) a look, as above.
  [[nodiscard]] bool gets_out(Vec3 place, Vec3 normal) const;

 private:
  bool passes(Vec3 from, Vec3 way, std::vector<std::uint32_t>& openings) const;

  std::vector<Screen> screens_;
  BoxTree<Box3> tree_;
  double diagonal_ = 0.0;
};

/// Leaves out the components from which one can't look out, from no place on either side of their faces, the
/// ground open: the furniture of a house that is closed by sheets. Returns how many. Tried are 64 directions
/// from 4 to 64 places of each face, by its size; one look that gets out is enough. Components of more than
/// 1000 faces stay, and so does what wasn't found to be hidden after 20,000 places: three seconds. O(n log n)
/// for n faces.
std::size_t leave_out_unseen(mesh::Model& model, const Context& context);

}  // namespace ridgecraft::prepare
