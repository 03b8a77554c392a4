// SPDX-License-Identifier: GPL-3.0-or-later
// The verbs: each has its options and texts in a file verb_NAME.cpp (those of solid/ share one).
#pragma once

#include <string_view>

#include "cli/arguments/options.hpp"
#include "cli/arguments/verb.hpp"

namespace ridgecraft::cli {

/// Each parses the arguments into a job, or, without arguments, fills in the manual.
[[nodiscard]] Job build_make(const Arguments* arguments, Manual* manual);
[[nodiscard]] Job build_info(const Arguments* arguments, Manual* manual);
[[nodiscard]] Job build_segment(const Arguments* arguments, Manual* manual);
[[nodiscard]] Job build_unfold(const Arguments* arguments, Manual* manual);
[[nodiscard]] Job build_hulls(const Arguments* arguments, Manual* manual);
[[nodiscard]] Job build_cage(const Arguments* arguments, Manual* manual);
[[nodiscard]] Job build_shell(const Arguments* arguments, Manual* manual);
[[nodiscard]] Job build_deform(const Arguments* arguments, Manual* manual);
[[nodiscard]] Job build_verify(const Arguments* arguments, Manual* manual);
[[nodiscard]] Job build_studio(const Arguments* arguments, Manual* manual);
[[nodiscard]] Job build_batch(const Arguments* arguments, Manual* manual);
[[nodiscard]] Job build_formats(const Arguments* arguments, Manual* manual);

/// What build_make returns for --man-page: the text is the caller's to make, from all manuals.
inline constexpr const char* man_page_wanted = "man";

}  // namespace ridgecraft::cli
