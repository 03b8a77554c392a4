// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft segment: reads, segments, compares, writes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/arguments/options.hpp"
#include "cli/files/pending_files.hpp"
#include "job/stage_clock.hpp"
#include "mesh/model/model.hpp"
#include "segment/evaluate.hpp"
#include "segment/segment.hpp"

namespace ridgecraft::cli {

/// A segmentation beside others of the same model.
struct Comparison {
  struct With {
    std::string file;
    segment::Disagreement disagreement;
  };
  double volume_ratio = 0.0;  ///< volume of the union of the parts' hulls, as a multiple of the model's
  std::vector<With> with;
};

struct SegmentResult {
  mesh::Model model;
  segment::Segmentation segmentation;
  std::optional<Comparison> comparison;
  std::vector<std::string> files;
  std::vector<std::string> file_notes;  ///< PendingFiles::commit
  job::StageSeconds seconds;
};

/// Files appear only when all of them are complete. Throws Error.
[[nodiscard]] SegmentResult make_parts(const SegmentJob& job, const Context& context, PendingFiles& pending);

}  // namespace ridgecraft::cli
