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

/// Writes all bytes and makes sure that they reached the disk: a full one often tells only then.
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
  const std::filesystem::path temporary = temporary_name(target);
  const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) {
    refuse(target, errno);
  }
  files_.push_back({temporary, target});
  const int error = write_all(file, bytes);
  const int close_error = ::close(file) == 0 ? 0 : errno;
  if (error != 0 || close_error != 0) {
    refuse(target, error != 0 ? error : close_error);
  }
}

void PendingFiles::remove_on_commit(const std::filesystem::path& target) {
  const std::lock_guard lock(mutex_);
  leftovers_.push_back(target);
}

void PendingFiles::commit() {
  const std::lock_guard lock(mutex_);
  for (const Pending& file : files_) {
    std::error_code error;
    std::filesystem::rename(file.temporary, file.target, error);
    if (error) {
      refuse(file.target, error.value());
    }
  }
  files_.clear();
  for (const std::filesystem::path& leftover : leftovers_) {
    std::error_code error;
    std::filesystem::remove(leftover, error);
    if (error) {
      refuse(leftover, error.value());
    }
  }
  leftovers_.clear();
}

void PendingFiles::discard() noexcept {
  const std::lock_guard lock(mutex_);
  for (const Pending& file : files_) {
    ::unlink(file.temporary.c_str());
  }
  files_.clear();
  leftovers_.clear();
}

}  // namespace ridgecraft::cli
