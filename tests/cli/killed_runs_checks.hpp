// SPDX-License-Identifier: GPL-3.0-or-later
// What the tests of killed runs share: sets of files in two folders, runs that die at a step, and what is
// left.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/files/set/pending_files.hpp"
#include "support/temporary_folder.hpp"

namespace ridgecraft::test {

using Notes = std::vector<std::string>;

/// Does a later run have something to tell? Not of a lock file that has no words yet: its run may be just
/// about to lock it.
[[nodiscard]] bool is_to_be_told(const std::filesystem::path& folder);

/// The number of hidden files, also while they come and go.
[[nodiscard]] std::size_t hidden_in(const std::filesystem::path& folder);

/// Without hidden files, and without the one that only the next run writes.
[[nodiscard]] Contents visible(const std::filesystem::path& folder);

/// Kills the process before its step of this number, from 0.
[[nodiscard]] cli::BeforeStep death_at(int step);

/// Does the work in a process of its own; true when it came to its end.
[[nodiscard]] bool in_child(const std::function<void()>& work);

/// In two folders, a and b: one file is replaced in each by the new set, one is new, one goes.
void write_old_set(const std::filesystem::path& folder);
void write_new_set(const std::filesystem::path& folder, const cli::BeforeStep& before_step);

/// What any later run does, into one folder.
Notes write_next(const std::filesystem::path& folder, const cli::BeforeStep& before_step = {});

/// Both sets, as they are when nobody dies.
struct BothSets {
  Contents before;
  Contents after;
  std::vector<std::string> steps;  ///< of writing the new one
};
[[nodiscard]] BothSets both_sets();

/// Two hidden files of each run, killed before it puts anything in place.
void leave_hidden_files(const std::filesystem::path& folder, int runs = 1);

}  // namespace ridgecraft::test
