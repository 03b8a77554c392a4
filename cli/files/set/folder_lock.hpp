// SPDX-License-Identifier: GPL-3.0-or-later
// One run at a time exchanges the files of a folder.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>

#include "cli/files/set/folder.hpp"

namespace ridgecraft::cli {

/// How long to wait for another run, and what ends the waiting before.
struct Patience {
  std::chrono::milliseconds longest;
  const std::atomic<bool>* cancelled = nullptr;  ///< nullptr: nothing does
};

/// The right to exchange files of one folder: flock on a hidden file in it, so that the system takes it back
/// when the process is killed, and containers with process ids of their own heed it. On a network file system
/// it holds between machines as far as that passes locks on. The folder itself isn't locked: a user may hold
/// that lock around the whole program. The file goes when the lock is given back; whoever had waited for it
/// makes a new one.
///
/// Where there are no locks (a file system without them, no right to open the file), the lock is granted to
/// everybody.
class FolderLock {
 public:
  /// Waits for other runs. Nothing when the time is over. Throws Error(interrupted) when it is cancelled. The
  /// folder must outlive the lock.
  [[nodiscard]] static std::optional<FolderLock> take(Folder& folder, const Patience& patience);

  FolderLock(FolderLock&&) = default;
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock();

  /// True where the last run that held it was killed meanwhile, so that its file was still there.
  [[nodiscard]] bool was_left_behind() const { return left_behind_; }

 private:
  enum class Try { held, busy, gone, impossible };

  explicit FolderLock(Folder& folder) : folder_(&folder) {}
  Try try_once();
  Try open_lock_file();

  Folder* folder_;
  Descriptor file_;    ///< closed where there are no locks
  bool made_ = false;  ///< the lock file, by this run
  bool left_behind_ = false;
};

}  // namespace ridgecraft::cli
