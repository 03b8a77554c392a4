// SPDX-License-Identifier: GPL-3.0-or-later
// What a user may want to know before the long work, as figures; and whether a person could build the result.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/message.hpp"
#include "base/vector.hpp"
#include "mesh/model/model.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/options.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::job {

// What a user may want to know before the long work, as figures; whoever runs the job words them.

/// This model takes very many pages.
struct ManyPages {
  double pages = 0.0;
  bool counted = false;         ///< else the figure is an estimate
  double size_mm = 0.0;         ///< the model's largest extent
  double fewer_pages = 0.0;     ///< as many as a maker finishes, ...
  double size_for_fewer = 0.0;  ///< ... and about the largest extent that takes no more, mm
};

/// So many separate bodies that their pieces and the lists of what found no room on them fill many pages,
/// whatever their size.
struct ManyBodies {
  std::size_t bodies = 0;
  double pages = 0.0;  ///< about, at least
};

/// Half of the folds that are drawn are too short for fingers.
struct ShortFolds {
  double median_mm = 0.0;
  double easy_mm = 0.0;        ///< folds of this length are no trouble; with ...
  double size_for_easy = 0.0;  ///< ... this largest extent, mm, half of them are as long
};

using Remark = std::variant<ManyPages, ManyBodies, ShortFolds>;
/// Called while the job goes on, from its thread. May be empty.
using Listener = std::function<void(const Remark&)>;

/// Where that is so many that a user may want to stop; `counted`: the pages are laid out.
[[nodiscard]] std::optional<ManyPages> many_pages(const mesh::Surface& surface, Vec2 printable, double pages,
                                                  bool counted);
/// The same before the model is brought to its size, by its area alone; nothing where that isn't certain.
[[nodiscard]] std::optional<ManyPages> many_pages(const mesh::Model& model, const prepare::SizeOptions& size,
                                                  Vec2 printable);

/// Where pages are many because bodies are. O(1).
[[nodiscard]] std::optional<ManyBodies> many_bodies(const mesh::Surface& surface);

/// Where half of the folds of at least `hidden_fold_angle` (radians) are too short. O(edges).
[[nodiscard]] std::optional<ShortFolds> short_folds(const prepare::Prepared& prepared,
                                                    double hidden_fold_angle);

// Whether a person could build what comes out, and why not.

/// What of a job to change.
enum class RemedyKind { size, faces, without };

/// A change that helps, as it was tried.
struct Remedy {
  RemedyKind kind = RemedyKind::faces;
  std::string value;   ///< mm of the largest extent, a number of faces, or the name to leave out
  double hours = 0.0;  ///< of work that are expected with it
};

/// "can't be built at 150 mm: 38 % of the folds are shorter than 5 mm; --size 380mm (5.2 hours) can", or "no
/// evening's work: --faces 300 (3.8 hours) would be"; none for a model that can be folded and has no
/// remedies.
[[nodiscard]] std::optional<Message> verdict(const prepare::Prepared& prepared,
                                             const std::vector<Remedy>& remedies);

}  // namespace ridgecraft::job
