// SPDX-License-Identifier: GPL-3.0-or-later
// A set of files, exchanged as one: by the run that made it, or by a later one where that was killed.
#pragma once

#include <cstddef>
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

/// What became of the files of a set that had got their names when it was put back.
struct PutBack {
  std::size_t restored = 0;                   ///< are as they were before
  std::vector<std::filesystem::path> kept;    ///< stay new: the file system knows no second names
  std::vector<std::filesystem::path> failed;  ///< stay new until another try: its hidden files stay
};

/// Why a set couldn't be exchanged.
struct Failure {
  std::filesystem::path target;
  int error = 0;        ///< of the system
  PutBack before = {};  ///< of the files before it
};

// The order of the steps makes it safe to be killed between any two of them: the journals tell what is to be
// exchanged before anything is; all new files are complete when the first journal decides; and all have
// decided when the first file gets its name. A second name for each old file lets it come back when one of
// the new ones can't get its name, on file systems that know second names.

/// "out/house.svg is", "house.pdf and house.svg are": files and the verb for their number.
[[nodiscard]] std::string names_and(const std::vector<std::filesystem::path>& files, const char* one,
                                    const char* more);

/// Writes the journals, and gives every new file its name. On failure everything is put back.
[[nodiscard]] std::optional<Failure> exchange(std::span<const FolderShare> set);

/// The files of the set that somebody has replaced, edited or removed since its run left it.
[[nodiscard]] std::vector<std::filesystem::path> changed_since(std::span<const FolderShare> set);

/// True where a new file hasn't got its name.
[[nodiscard]] bool is_incomplete(std::span<const FolderShare> set);

/// True where nothing is left to do but to remove hidden files.
[[nodiscard]] bool is_in_place(std::span<const FolderShare> set);

/// Gives every new file its name that hasn't got it yet. On failure everything is put back.
[[nodiscard]] std::optional<Failure> put_in_place(std::span<const FolderShare> set);

/// Brings back what was there before. Files that somebody has changed since stay.
PutBack put_back(std::span<const FolderShare> set);

/// Removes what the set replaces under other names (`removals`), then waits until the disk has all names.
/// Returns a sentence for each file that couldn't be removed.
std::vector<std::string> remove_leftovers(std::span<const FolderShare> set);

/// Removes all hidden files of the set, the journals last. Returns their number.
std::size_t remove_hidden(std::span<const FolderShare> set);

}  // namespace ridgecraft::cli
