// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies with spikes: a net for them is hard to find. For the benchmark and the tests alike.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/model/surface.hpp"

namespace ridgecraft::bench {

struct SpikyBody {
  std::string name;  ///< kind and faces: "ball 208"
  mesh::Surface surface;
};

/// An icosahedron whose faces are divided in four `divisions` times and pushed out to a sphere; `spikes`
/// faces, drawn at random, bear a pyramid. 20 * 4^divisions + 2 * spikes faces.
[[nodiscard]] mesh::Surface spiky_ball(int divisions, std::size_t spikes, double height, std::uint64_t seed);

/// A box of a * b * c unit cubes, each square of its sides two triangles; `spikes` of them bear a pyramid.
/// 4 (ab + bc + ca) + 2 * spikes faces. Heights are multiples of the side of a square with twice the face's
/// area.
[[nodiscard]] mesh::Surface spiky_box(int a, int b, int c, std::size_t spikes, double height,
                                      std::uint64_t seed);

/// Balls of 208 and 576 faces (spikes on 64 of 80 and on 128 of 320) and boxes of 346 (on 107 of 132), two of
/// each.
[[nodiscard]] std::vector<SpikyBody> spiky_family();

}  // namespace ridgecraft::bench
