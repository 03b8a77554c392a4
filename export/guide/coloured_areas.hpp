// SPDX-License-Identifier: GPL-3.0-or-later
// The model's own colours on a view of it.
#pragma once

#include "base/context.hpp"
#include "export/guide/fit.hpp"
#include "export/sheet/drawing.hpp"
#include "export/view/camera.hpp"
#include "export/view/scene.hpp"
#include "export/view/view.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::paper {

/// Adds the areas that are seen, in the colours of model.look, which must be there: areas where faces have
/// one colour each, and below them one picture, of dots, of all faces that have pictures on them, so that
/// nothing hidden is in the drawing. O(areas x faces of their region + dots x log n). Throws
/// Error(interrupted).
void add_coloured_areas(const prepare::Prepared& model, const Scene& scene, const View& view,
                        const Camera& camera, const Fit& fit, Group& group, const Context& context);

}  // namespace ridgecraft::paper
