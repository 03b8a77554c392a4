// SPDX-License-Identifier: GPL-3.0-or-later
// What each job reports of its work.
#pragma once

#include <string>
#include <vector>

#include "cli/arguments/options.hpp"
#include "cli/jobs/batch_job.hpp"
#include "cli/jobs/make_job.hpp"
#include "cli/jobs/segment_job.hpp"
#include "cli/jobs/solid_jobs.hpp"
#include "cli/report/figures.hpp"
#include "cli/report/messages.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/panels.hpp"
#include "verify/verify.hpp"

namespace ridgecraft::cli {

[[nodiscard]] Summary summary(const MakeJob& job, const MakeResult& result);
[[nodiscard]] Summary summary(const UnfoldJob& job, const MakeResult& result);
[[nodiscard]] Summary summary(const SegmentJob& job, const SegmentResult& result);
[[nodiscard]] Summary summary(const InfoJob& job, const mesh::Model& model, const prepare::Panels& panels);
/// hulls, cage, shell and deform; `model` is the file as the user named it.
[[nodiscard]] Summary summary(const std::string& model, const SolidResult& result);

/// verify; `file` as the user named it.
[[nodiscard]] Summary summary(const std::string& file, const verify::Report& report);

[[nodiscard]] Summary summary(const BatchJob& job, const BatchResult& result);

/// ridgecraft formats
/// The presets alone, or all formats with the presets' names.
[[nodiscard]] std::string formats_text(bool presets = false);
[[nodiscard]] std::string formats_json();

/// {"error": {"code": 3, "message": "...", "reason": {...}}}: what --json prints where a job fails.
[[nodiscard]] std::string error_json(ExitCode code, const Message& message);

/// One line per repair and note, for standard error: "24 points at equal places were joined". `united`: what
/// ran through each other may be one skin now.
[[nodiscard]] std::vector<Message> repair_lines(const mesh::RepairReport& report, bool united = false);

}  // namespace ridgecraft::cli
