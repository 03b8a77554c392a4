// SPDX-License-Identifier: GPL-3.0-or-later
// What runs that were killed have left in a folder: found, told and cleared away by the next one.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "cli/files/set/folder.hpp"
#include "cli/files/set/folder_lock.hpp"
#include "cli/files/set/journal_file.hpp"

namespace ridgecraft::cli {

/// What was found in a folder and is cleared away.
struct LeftBehind {
  std::size_t runs = 0;   ///< that were killed
  std::size_t files = 0;  ///< hidden ones, those in other folders of the same sets included
  std::size_t completed =
      0;  ///< sets whose files were complete, but hadn't all got their names: now they have
  std::size_t put_back = 0;                    ///< sets that had replaced some files, and now none
  std::vector<std::filesystem::path> kept;     ///< new files of such sets that can't be put back
  std::vector<std::filesystem::path> changed;  ///< files of others, for which sets stay incomplete

  LeftBehind& operator+=(const LeftBehind& other);
};

/// "a run that was killed had left 3 hidden files in out, all removed now"; empty where nothing was found.
[[nodiscard]] std::string sentence(const LeftBehind& found, const std::filesystem::path& folder);

/// Clears away what dead runs of the same user have left in the folder: a set whose files were complete gets
/// them into place, unless somebody has changed one of its files since; hidden files go. What a living run
/// has there stays, and so does every file whose name isn't one of temporary_names.hpp. A set with files in
/// several folders is cleared in all of them at once: it stays where one of them can't be locked within
/// `patience`, and for an hour where one can't be reached.
///
/// The folder's lock must be held, `locked` are all folders for which that is so, and `own` is this run's
/// journal in the folder. O(files in the folder), and the renaming.
[[nodiscard]] LeftBehind clear_left_behind(Folder& folder, const JournalFile& own,
                                           std::span<const Folder::Key> locked, const Patience& patience);

}  // namespace ridgecraft::cli
