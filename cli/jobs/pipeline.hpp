// SPDX-License-Identifier: GPL-3.0-or-later
// The jobs: stages called in order, their results kept for the summary.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/arguments/options.hpp"
#include "cli/files/pending_files.hpp"
#include "cli/jobs/time_limit.hpp"
#include "mesh/mesh.hpp"
#include "prepare/prepare.hpp"
#include "segment/agreement.hpp"
#include "segment/segment.hpp"
#include "unfold/net/nets.hpp"
#include "verify/verify.hpp"

namespace ridgecraft::cli {

/// Wall seconds per stage, in the order in which they ran.
class StageClock {
 public:
  /// Runs a stage, reports it as progress, and takes its time.
  template <class Stage>
  auto operator()(const char* name, const Context& context, const Stage& stage) {
    context.check();
    context.report(name, 0.0);
    const auto start = std::chrono::steady_clock::now();
    auto result = stage();
    seconds_.emplace_back(name,
                          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    return result;
  }
  [[nodiscard]] const std::vector<std::pair<std::string, double>>& seconds() const { return seconds_; }
  [[nodiscard]] double total() const;

 private:
  std::vector<std::pair<std::string, double>> seconds_;
};

/// Narrower strips of paper can neither be cut out nor folded by hand, mm.
inline constexpr double sliver_mm = 1.0;

/// What the main job made.
struct PaperResult {
  prepare::Prepared prepared;
  std::size_t polygons = 0;  ///< in the file
  std::size_t slivers = 0;   ///< faces on paper thinner than sliver_mm: nobody can cut or fold them
  std::size_t parts = 0;
  unfold::Nets nets;
  paper::Pages pages;
  std::optional<double> share_saving_a_page;  ///< of the size, where a slightly smaller model would
  paper::DrawReport drawn;
  verify::Figures figures;  ///< of the check of the finished nets
  std::vector<std::string> files;
  StageClock clock;
};

/// ridgecraft MODEL: reads, prepares, segments, unfolds, lays out, checks and writes. Files appear only when
/// all of them are complete. Before the long work, `remark` is told what a user may want to stop for:
/// hundreds of pages. Throws Error.
[[nodiscard]] PaperResult make_paper(const PaperJob& job, const RunContext& run, PendingFiles& pending,
                                     const std::function<void(const std::string&)>& remark);

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
  StageClock clock;
};

[[nodiscard]] SegmentResult make_parts(const SegmentJob& job, const RunContext& run, PendingFiles& pending);

struct UnfoldResult {
  prepare::Prepared prepared;
  std::size_t parts = 0;
  unfold::Nets nets;
  verify::Figures figures;
  std::vector<std::string> files;
  StageClock clock;
};

[[nodiscard]] UnfoldResult make_nets(const UnfoldJob& job, const RunContext& run, PendingFiles& pending);

}  // namespace ridgecraft::cli
