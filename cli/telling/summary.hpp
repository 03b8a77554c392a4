// SPDX-License-Identifier: GPL-3.0-or-later
// What a job did: a few lines for a person, or one JSON object for a machine.
#pragma once

#include <string>

#include "cli/exit_code.hpp"
#include "cli/jobs/pipeline.hpp"

namespace ridgecraft::cli {

[[nodiscard]] std::string summary(const PaperJob& job, const PaperResult& result);
[[nodiscard]] std::string summary_json(const PaperJob& job, const PaperResult& result);

[[nodiscard]] std::string summary(const SegmentJob& job, const SegmentResult& result);
[[nodiscard]] std::string summary_json(const SegmentJob& job, const SegmentResult& result);

[[nodiscard]] std::string summary(const UnfoldJob& job, const UnfoldResult& result);
[[nodiscard]] std::string summary_json(const UnfoldJob& job, const UnfoldResult& result);

/// info MODEL
[[nodiscard]] std::string summary(const InfoJob& job, const mesh::Model& model,
                                  const prepare::Panels& panels);
[[nodiscard]] std::string summary_json(const InfoJob& job, const mesh::Model& model,
                                       const prepare::Panels& panels);

/// verify FILE
[[nodiscard]] std::string summary(const VerifyJob& job, const verify::Report& report);

/// {"error": {"code": 3, "message": "..."}}: what --json prints where a job fails.
[[nodiscard]] std::string error_json(ExitCode code, const std::string& sentence);

/// One line per repair and note, for standard error: "24 points at equal places were joined".
[[nodiscard]] std::vector<std::string> repair_lines(const mesh::RepairReport& report);

}  // namespace ridgecraft::cli
