// SPDX-License-Identifier: GPL-3.0-or-later
// Which of a model's objects and materials become paper, by the names that its artist gave them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "mesh/model/model.hpp"

namespace ridgecraft::prepare {

/// Names of objects (of groups, where the file names no objects) and of materials. Capitals don't matter; a *
/// at the end stands for any letters: "wheel*". "plate1" stands for all that is in it: "plate1/wheel".
struct Selection {
  std::vector<std::string> only;     ///< where there are any, nothing else is taken
  std::vector<std::string> without;  ///< is left out of what is taken

  [[nodiscard]] bool any() const { return !only.empty() || !without.empty(); }
};

/// The names that the model's faces have: of objects in the file's order, then of materials, each once. O(n).
[[nodiscard]] std::vector<std::string> names_of(const mesh::Model& model);

/// The model with the faces that are selected. Throws Error(usage) for a name that no face has, with those
/// that there are, and where no face is left. O(n log n).
[[nodiscard]] mesh::Model select(mesh::Model model, const Selection& selection);

/// The name of the ground that a scene stands on: flat, wider than all else in two directions, and at one
/// side of it. Nothing where there is none, or where the ground has no name of its own. O(n log n).
[[nodiscard]] std::optional<std::string> ground_name(const mesh::Model& model);

/// A name and how much of the model has it.
struct NamedPart {
  std::string name;
  std::size_t faces = 0;
  double area = 0.0;  ///< in the square of the model's unit
};

/// What each name is of, those with the most faces first. O(n log n).
[[nodiscard]] std::vector<NamedPart> named_parts(const mesh::Model& model);

}  // namespace ridgecraft::prepare
