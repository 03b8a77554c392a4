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
/// folder; commit() gives all files their names; what is never committed is removed. Safe to discard() from
/// another thread.
class PendingFiles {
 public:
  PendingFiles() = default;
  PendingFiles(const PendingFiles&) = delete;
  PendingFiles& operator=(const PendingFiles&) = delete;
  ~PendingFiles() { discard(); }

  /// Writes the bytes under a temporary name. Throws Error(cant_write).
  void add(const std::filesystem::path& target, std::string_view bytes);
  /// Removes this file on commit.
  void remove_on_commit(const std::filesystem::path& target);
  /// Renames everything into place, then removes what is to go. Throws Error(cant_write).
  void commit();
  /// Removes everything that isn't committed; nothing can be added or committed any more. True when an
  /// earlier commit() has put files into place.
  bool discard() noexcept;

 private:
  void require_open() const;

  struct Pending {
    std::filesystem::path temporary;
    std::filesystem::path target;
  };
  std::mutex mutex_;
  std::vector<Pending> files_;
  std::vector<std::filesystem::path> leftovers_;
  bool closed_ = false;
  bool committed_ = false;
};

}  // namespace ridgecraft::cli
