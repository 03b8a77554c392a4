// SPDX-License-Identifier: GPL-3.0-or-later
// One outer skin of a model whose bodies touch or run into each other: what a maker can build.
#pragma once

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::prepare {

/// Unites the solid components of a model exactly: what lies inside others is dropped, faces end where they
/// run into others, and walls that two bodies have against each other go. In which order bodies are given, or
/// whether they only touch in a face, an edge or a corner, makes no difference.
///
/// A component is solid when it is closed, or when each of its openings can be closed by a cap: a flat one (a
/// thousandth of the diagonal), or a bent one whose cap turns out to lie inside others for the most part. A
/// cap that can be seen is left out again at the end, so that the model stays open there; where others run
/// into it, it stays and is counted. A body that one can look into through such an opening, and see what is
/// inside, isn't solid; the side on which a model stands counts as closed. All other components are sheets:
/// they stay as they are but for what lies inside solids.
///
/// Points of bodies that change are laid on a grid of a millionth of the diagonal; faces keep their polygon
/// and material (a cap has no polygon, and the material and object of what is beside it). Other components,
/// and so all models whose bodies don't meet, stay as they are to the last bit. Bodies whose skin wouldn't be
/// sound, because it crosses itself when its points become doubles, or that meet in too many places, stay as
/// they were and are counted.
///
/// At the end components are left out that nobody sees from outside, solid or not.
///
/// O(n log n) for n faces, and about 20 microseconds for each pair of faces that meets. Throws
/// Error(interrupted), Error(out_of_time).
SkinReport unite_bodies(mesh::Model& model, const Context& context);

}  // namespace ridgecraft::prepare
