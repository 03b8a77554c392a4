// SPDX-License-Identifier: GPL-3.0-or-later
// What the summaries of all jobs have in common.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/jobs/pipeline.hpp"
#include "cli/telling/sentence.hpp"
#include "mesh/model/repair_report.hpp"

namespace ridgecraft::cli {

using Json = nlohmann::ordered_json;

/// Rounded to a thousandth, so that JSON shows no noise.
[[nodiscard]] double rounded(double value);

[[nodiscard]] Json repairs_json(const mesh::RepairReport& report);

/// Seconds by stage, and "total".
[[nodiscard]] Json seconds_json(const StageClock& clock);
/// "1.25 s (read 0.20, segment 1.05)"
[[nodiscard]] std::string seconds_text(const StageClock& clock);

/// A line for each file; the middle of a long list is left out.
[[nodiscard]] std::string written_text(const std::vector<std::string>& files);

}  // namespace ridgecraft::cli
