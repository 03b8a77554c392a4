// SPDX-License-Identifier: GPL-3.0-or-later
// A model cut at its mirror plane. Private to prepare/.
#pragma once

#include <optional>

#include "mesh/model/surface.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/shares/share.hpp"
#include "prepare/symmetry/mirrors.hpp"

namespace ridgecraft::prepare {

/// The side of a model that has more faces, corners within `on` of the plane laid into it. `all` is the model
/// taken apart. None where a face lies in the plane and is no sheet of its own, as it has no sides. O(n log
/// n).
[[nodiscard]] std::optional<SymmetricShare> halved(const mesh::Surface& model, const mesh::LooseFaces& all,
                                                   const Mirror& mirror, double on);

}  // namespace ridgecraft::prepare
