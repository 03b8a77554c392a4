// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/pending_files.hpp"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.hpp"

namespace ridgecraft::cli {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& target, int error) {
  throw Error(ErrorKind::cant_write, "can't write " + target.string() + ": " + std::strerror(error));
}

/// Short, so that it fits wherever the target's name does, and another one for each file of a run.
std::filesystem::path temporary_name(const std::filesystem::path& target, std::size_t number,
                                     const char* ending) {
  return target.parent_path() /
         (".ridgecraft-" + std::to_string(::getpid()) + "-" + std::to_string(number) + ending);
}

int write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) {
        continue;
      }
      return errno;
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace

void PendingFiles::add(const std::filesystem::path& target, std::string_view bytes) {
  const std::lock_guard lock(mutex_);
  require_open();
  create_folder(target.parent_path());
  const std::filesystem::path temporary = temporary_name(target, files_.size(), ".part");
  // Left behind by a run that was killed, under the same process number.
  ::unlink(temporary.c_str());
  const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file < 0) {
    refuse(target, errno);
  }
  files_.push_back({temporary, target, {}});
  int error = write_all(file, bytes);
  // A full disk often tells only when the bytes reach it. Some file systems know no fsync.
  if (error == 0 && ::fsync(file) != 0 && errno != EINVAL && errno != EROFS) {
    error = errno;
  }
  const int close_error = ::close(file) == 0 ? 0 : errno;
  if (error != 0 || close_error != 0) {
    refuse(target, error != 0 ? error : close_error);
  }
}

void PendingFiles::remove_on_commit(const std::filesystem::path& target) {
  const std::lock_guard lock(mutex_);
  leftovers_.push_back(target);
}

void PendingFiles::require_open() const {
  if (closed_) {
    throw Error(ErrorKind::interrupted, "interrupted; nothing was written");
  }
}

void PendingFiles::create_folder(const std::filesystem::path& folder) {
  std::filesystem::path so_far;
  for (const std::filesystem::path& name : folder) {
    so_far /= name;
    std::error_code error;
    if (name.empty() || std::filesystem::is_directory(so_far, error)) {
      continue;
    }
    if (::mkdir(so_far.c_str(), 0777) != 0) {
      const int reason = errno;
      throw Error(ErrorKind::cant_write,
                  "can't create the folder " + so_far.string() + ": " + std::strerror(reason));
    }
    folders_.push_back(so_far);
  }
}

void PendingFiles::keep_old_files() {
  for (std::size_t i = 0; i < files_.size(); ++i) {
    const std::filesystem::path old = temporary_name(files_[i].target, i, ".old");
    ::unlink(old.c_str());
    // A second name for the same file. Where the file system knows none, the old file can't come back.
    if (::link(files_[i].target.c_str(), old.c_str()) == 0) {
      files_[i].old = old;
    }
  }
}

void PendingFiles::put_back(std::size_t count, const std::vector<bool>& there_before) noexcept {
  for (std::size_t i = 0; i < files_.size(); ++i) {
    const Pending& file = files_[i];
    if (i >= count) {
      ::unlink(file.old.c_str());
    } else if (!file.old.empty()) {
      ::rename(file.old.c_str(), file.target.c_str());
    } else if (!there_before[i]) {
      ::unlink(file.target.c_str());
    }
  }
}

std::vector<std::string> PendingFiles::commit() {
  const std::lock_guard lock(mutex_);
  require_open();
  std::vector<bool> there_before;
  for (const Pending& file : files_) {
    std::error_code error;
    there_before.push_back(std::filesystem::exists(std::filesystem::symlink_status(file.target, error)));
  }
  keep_old_files();
  for (std::size_t i = 0; i < files_.size(); ++i) {
    std::error_code error;
    std::filesystem::rename(files_[i].temporary, files_[i].target, error);
    if (error) {
      put_back(i, there_before);
      refuse(files_[i].target, error.value());
    }
  }
  for (const Pending& file : files_) {
    ::unlink(file.old.c_str());
  }
  files_.clear();
  folders_.clear();
  committed_ = true;
  std::vector<std::string> notes;
  for (const std::filesystem::path& leftover : leftovers_) {
    std::error_code error;
    std::filesystem::remove(leftover, error);
    if (error) {
      notes.push_back(leftover.string() + " is of an earlier run and can't be removed: " + error.message());
    }
  }
  leftovers_.clear();
  return notes;
}

bool PendingFiles::discard() noexcept {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  for (const Pending& file : files_) {
    ::unlink(file.temporary.c_str());
  }
  files_.clear();
  leftovers_.clear();
  for (auto folder = folders_.rbegin(); folder != folders_.rend(); ++folder) {
    ::rmdir(folder->c_str());  // stays where somebody else has put something into it
  }
  folders_.clear();
  return committed_;
}

}  // namespace ridgecraft::cli
