// SPDX-License-Identifier: GPL-3.0-or-later
// A set of files, exchanged as one: by the run that made it, or by a later one where that was killed.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/files/set/folder.hpp"
#include "cli/files/set/journal_file.hpp"
#include "cli/files/set/set_journal.hpp"

namespace ridgecraft::cli {

/// What one folder gets of a set. The folder is locked.
struct FolderShare {
  Folder* folder;
  JournalFile* file;
  SetJournal* journal;
};

/// Why a set couldn't be exchanged.
struct Failure {
  std::filesystem::path target;
  int error = 0;              ///< of the system
  bool all_as_before = true;  ///< false where what had been replaced couldn't be brought back, either
};

// The order of the steps makes it safe to be killed between any two of them: the journals tell what is to be
// exchanged before anything is; all new files are complete when the first journal decides; and all have
// decided when the first file gets its name. A second name for each old file lets it come back when one of
// the new ones can't get its name, on file systems that know second names.

/// Writes the journals, and gives every new file its name. On failure everything is put back.
[[nodiscard]] std::optional<Failure> exchange(std::span<const FolderShare> set);

/// True where each file of the set stands as its run left it: nobody has replaced or edited one since.
[[nodiscard]] bool is_untouched(std::span<const FolderShare> set);

/// True where nothing is left to do but to remove hidden files.
[[nodiscard]] bool is_in_place(std::span<const FolderShare> set);

/// Gives every new file its name that hasn't got it yet. On failure everything is put back.
[[nodiscard]] std::optional<Failure> put_in_place(std::span<const FolderShare> set);

/// Brings back what was there before. Files that somebody has changed since stay. False where that failed.
bool put_back(std::span<const FolderShare> set);

/// Removes what the set replaces under other names (`removals`), then waits until the disk has all names.
/// Returns a sentence for each file that couldn't be removed.
std::vector<std::string> remove_leftovers(std::span<const FolderShare> set);

/// Removes all hidden files of the set, the journals last. Returns their number.
std::size_t remove_hidden(std::span<const FolderShare> set);

}  // namespace ridgecraft::cli
