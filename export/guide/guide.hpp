// SPDX-License-Identifier: GPL-3.0-or-later
// The guide: pages that tell a maker how the model is built from its sheets.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/context.hpp"
#include "export/assembly/assembly.hpp"
#include "export/guide/effort.hpp"
#include "export/sheet/bodies.hpp"
#include "export/sheet/drawing.hpp"
#include "export/sheet/pages.hpp"
#include "export/view/camera.hpp"
#include "prepare/prepared/prepared.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// The pages, and what they say of the work.
struct Guide {
  std::vector<Drawing> pages;
  std::size_t steps = 0;
  Effort effort;
};

/// What a guide is drawn from. Not copied: all that it names must outlive it.
struct GuideSource {
  const prepare::Prepared& model;
  const unfold::Nets& nets;
  const Pages& pages;
  const Assembly& assembly;
  std::size_t sheets = 0;        ///< pages of nets and lists
  std::span<const Body> bodies;  ///< those that draw() has found
  Stance stance;                 ///< as the model stands
};

/// A cover, where each piece is, and the steps in the order of the assembly. Deterministic, whatever the
/// number of threads. Throws Error(interrupted). About O(steps faces log faces), less where that would be
/// long.
[[nodiscard]] Guide draw_guide(const GuideSource& source, const Style& style, const Context& context);

}  // namespace ridgecraft::export_
