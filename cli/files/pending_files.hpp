// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are being written: under a temporary name until all of them are complete.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace ridgecraft::cli {

/// Writes files so that nobody ever sees half of one. add() writes under a temporary name in the target's
/// folder; commit() gives all files their names; what is never committed is removed, folders made for it
/// included. Safe to discard() from another thread.
class PendingFiles {
 public:
  PendingFiles() = default;
  PendingFiles(const PendingFiles&) = delete;
  PendingFiles& operator=(const PendingFiles&) = delete;
  ~PendingFiles() { discard(); }

  /// Writes the bytes under a temporary name, into a folder that is made where it isn't there. No target may
  /// be added twice. Throws Error(cant_write).
  void add(const std::filesystem::path& target, std::string_view bytes);
  /// Removes this file on commit.
  void remove_on_commit(const std::filesystem::path& target);
  /// Renames everything into place, then removes what is to go. Returns a sentence for each file that
  /// couldn't be removed. Throws Error(cant_write) when a file can't get its name; those before it are put
  /// back to what they were as far as the file system allows.
  std::vector<std::string> commit();
  /// Removes everything that isn't committed; nothing can be added or committed any more. True when an
  /// earlier commit() has put files into place.
  bool discard() noexcept;

 private:
  struct Pending {
    std::filesystem::path temporary;
    std::filesystem::path target;
    std::filesystem::path old;  ///< what stood at the target, while it is replaced; empty for none
  };

  void require_open() const;
  void create_folder(const std::filesystem::path& folder);
  void keep_old_files();
  /// Undoes the first `count` renamings.
  void put_back(std::size_t count, const std::vector<bool>& there_before) noexcept;

  std::mutex mutex_;
  std::vector<Pending> files_;
  std::vector<std::filesystem::path> leftovers_;
  std::vector<std::filesystem::path> folders_;  ///< made here, outer ones first
  bool closed_ = false;
  bool committed_ = false;
};

}  // namespace ridgecraft::cli
