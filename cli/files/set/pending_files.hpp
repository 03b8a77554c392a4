// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are being written: under a temporary name until all of them are complete.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/files/set/file_set.hpp"
#include "cli/files/set/folder.hpp"
#include "cli/files/set/folder_lock.hpp"
#include "cli/files/set/journal_file.hpp"
#include "cli/files/set/left_behind.hpp"
#include "cli/files/set/set_journal.hpp"

namespace ridgecraft::cli {

/// Writes a set of files so that nobody ever sees half of one, and so that the files of one run stay together
/// (docs/reference/files.md). add() writes under a temporary name in the target's folder; commit() gives all
/// files their names; what is never committed is removed, folders made for it included. Where the process is
/// killed, the next run into a folder clears away what it left there. Safe to discard() from another thread.
class PendingFiles {
 public:
  struct Setup {
    /// For another run that is putting files into the same folder: that takes milliseconds, and more than
    /// this only where it was stopped meanwhile.
    std::chrono::milliseconds longest_wait{60'000};
    BeforeStep before_step = {};  ///< for tests
  };

  PendingFiles() = default;
  explicit PendingFiles(Setup setup) : setup_(std::move(setup)) {}
  PendingFiles(const PendingFiles&) = delete;
  PendingFiles& operator=(const PendingFiles&) = delete;
  ~PendingFiles() { discard(); }

  /// Writes the bytes under a temporary name, into a folder that is made where it isn't there. No target may
  /// be added twice. Throws Error(cant_write), Error(interrupted) after discard().
  void add(const std::filesystem::path& target, std::string_view bytes);

  /// Called when no other run can change the folders any more: looks once more whether the targets may be
  /// replaced, and throws where not. Returns files of earlier runs that are to go, in folders of targets.
  using LastLook = std::function<std::vector<std::filesystem::path>()>;

  /// Renames everything into place, then removes what is to go. Returns a sentence for each folder in which a
  /// killed run had left something, and for each file that couldn't be removed. Throws Error(cant_write) when
  /// a file can't get its name (those before it are put back to what they were as far as the file system
  /// allows; the sentence names those that stay new), or when another run doesn't give the folder free;
  /// Error(interrupted) after discard(); and what `look` does.
  std::vector<std::string> commit(const LastLook& look = {});

  /// Removes everything that isn't committed; nothing can be added or committed any more. True when an
  /// earlier commit() has put files into place. Waits for a commit() that is at its renaming.
  bool discard() noexcept;

  /// A sentence for each folder in which a killed run had left something, as far as commit() hasn't returned
  /// it: what was cleared away is told also where this run comes to nothing.
  [[nodiscard]] std::vector<std::string> take_notes();

 private:
  /// A folder that gets files, and this run's hidden files in it.
  struct Place {
    std::unique_ptr<Folder> folder;
    JournalFile file;
    SetJournal journal;
    LeftBehind left_behind;  ///< by others
    unsigned next_number = 0;
  };

  void require_open() const;
  void create_folder(const std::filesystem::path& folder);
  Place* known_place(const Folder& folder);
  Place& place_for(const std::filesystem::path& target);
  int open_place(Folder folder);
  void write_part(Place& place, const std::filesystem::path& target, std::string_view bytes);
  FolderLock lock(Folder& folder) const;
  std::vector<FolderLock> lock_all();
  void clear_left_behind(Place& place, const FolderLock& lock, const std::vector<Folder::Key>& locked) const;
  void note_removals(const std::vector<std::filesystem::path>& files);
  void complete_journals();
  std::vector<FolderShare> shares();
  void note_left_behind();

  Setup setup_;
  std::mutex mutex_;
  std::atomic<bool> cancelled_ = false;
  std::list<Place> places_;
  std::vector<std::filesystem::path> folders_;  ///< made here, outer ones first
  std::vector<std::string> notes_;              ///< not told yet
  bool closed_ = false;
  bool committed_ = false;
};

}  // namespace ridgecraft::cli
