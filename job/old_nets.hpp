// SPDX-License-Identifier: GPL-3.0-or-later
// The two kinds of files that nets made before come in.
#pragma once

#include <string_view>

#include "job/options.hpp"
#include "verify/file/file.hpp"

namespace ridgecraft::job {

/// Whether it is to be read as a FOLD file; else it is a model's file that holds nets.
[[nodiscard]] bool is_fold_file(const OldNets& old);

/// Throws Error(unreadable_input) with the file's name. O(n log n).
[[nodiscard]] verify::File read_fold_file(const OldNets& old);

/// Which names of their model the nets of a FOLD file were made of; all, where the bytes are no such file.
/// O(n).
[[nodiscard]] prepare::Selection selection_of(std::string_view fold_file);

}  // namespace ridgecraft::job
