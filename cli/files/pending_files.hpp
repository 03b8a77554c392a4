// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are being written: each under a temporary name until all of them are complete.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/descriptor.hpp"

namespace ridgecraft::cli {

/// Writes a set of files so that none is ever seen half written. add() writes `.ridgecraft-ID-NUMBER.part` in
/// the target's folder and waits until the disk has it; commit() renames all of them; what is never committed
/// is removed, folders made for it included. A run that is killed leaves old or new files, whole ones, and
/// its
/// `.part` files go when the next run adds a file to the folder. A run has one ID in a folder, and locks
/// (flock) number 0 of it, which is renamed last: the system takes the lock back when the process ends. Where
/// a file system knows no locks, `.part` files of other runs stay. Where it keeps locks to one machine of
/// several that write, one may remove the other's, whose commit() then throws.
class PendingFiles {
 public:
  PendingFiles() = default;
  PendingFiles(const PendingFiles&) = delete;
  PendingFiles& operator=(const PendingFiles&) = delete;
  ~PendingFiles() { discard(); }

  /// Writes the bytes into a folder that is made where it isn't there. No target may be added twice. Throws
  /// Error(cant_write).
  void add(const std::filesystem::path& target, std::string_view bytes);

  /// Called before the first renaming: looks once more whether the targets may be replaced, and throws where
  /// not. Returns files of earlier runs that are to go.
  using LastLook = std::function<std::vector<std::filesystem::path>()>;

  /// Renames everything into place, in the order of add() but for the first file of each folder, which comes
  /// last; then removes what is to go. Returns a sentence for
  /// each file that couldn't be removed. Throws Error(cant_write) when a file can't get its name (the
  /// sentence names those that have it already), and what `look` does.
  std::vector<std::string> commit(const LastLook& look = {});

 private:
  struct Part {
    std::filesystem::path target;
    std::filesystem::path path;  ///< `.part`
    bool is_locked = false;
  };
  /// What a folder has got.
  struct Folder {
    std::string id;
    Descriptor lock;  ///< of its first part
    std::size_t parts = 0;
  };

  void discard() noexcept;
  void create_folders(const std::filesystem::path& folder);
  /// The first part of a folder, locked and open.
  void create_first(const std::filesystem::path& target);
  /// One more, and its file.
  Descriptor create_next(const std::filesystem::path& target, Folder& folder);

  std::vector<Part> parts_;
  std::vector<std::filesystem::path> made_folders_;  ///< outer ones first
  std::map<std::filesystem::path, Folder> folders_;
};

}  // namespace ridgecraft::cli
