// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/pending_files.hpp"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

#include "mesh/error.hpp"

namespace ridgecraft::cli {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& target, int error) {
  throw Error(ErrorKind::cant_write, "can't write " + target.string() + ": " + std::strerror(error));
}

std::filesystem::path temporary_name(const std::filesystem::path& target) {
  return target.parent_path() /
         ("." + target.filename().string() + "." + std::to_string(::getpid()) + ".part");
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
  const std::filesystem::path temporary = temporary_name(target);
  // Left behind by a run that was killed, under the same process number.
  ::unlink(temporary.c_str());
  const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file < 0) {
    refuse(target, errno);
  }
  files_.push_back({temporary, target});
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

void PendingFiles::commit() {
  const std::lock_guard lock(mutex_);
  require_open();
  for (const Pending& file : files_) {
    std::error_code error;
    std::filesystem::rename(file.temporary, file.target, error);
    if (error) {
      refuse(file.target, error.value());
    }
  }
  files_.clear();
  committed_ = true;
  for (const std::filesystem::path& leftover : leftovers_) {
    std::error_code error;
    std::filesystem::remove(leftover, error);
    if (error) {
      refuse(leftover, error.value());
    }
  }
  leftovers_.clear();
}

bool PendingFiles::discard() noexcept {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  for (const Pending& file : files_) {
    ::unlink(file.temporary.c_str());
  }
  files_.clear();
  leftovers_.clear();
  return committed_;
}

}  // namespace ridgecraft::cli
