// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/set/folder_lock.hpp"

#include <array>
#include <cerrno>
#include <string>
#include <thread>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.hpp"
#include "cli/files/set/temporary_names.hpp"

namespace ridgecraft::cli {
namespace {

/// Written by whoever holds the lock: so a file with these words that nobody has locked is of a killed run,
/// and an empty one may be of a run that is about to lock it.
constexpr std::string_view words = "Ridgecraft is putting files into this folder.\n";

/// Exchanging a set of files takes milliseconds.
constexpr std::chrono::milliseconds between_tries{5};

enum class Content { empty, ours, foreign };

Content content_of(const Descriptor& file) {
  std::array<char, words.size() + 1> bytes{};
  const ssize_t length = ::pread(file.number(), bytes.data(), bytes.size(), 0);
  if (length == 0) {
    return Content::empty;
  }
  const bool ours = length > 0 && std::string_view(bytes.data(), static_cast<std::size_t>(length)) == words;
  return ours ? Content::ours : Content::foreign;
}

bool is_plain(const Descriptor& file) {
  struct stat status {};
  return ::fstat(file.number(), &status) == 0 && S_ISREG(status.st_mode);
}

}  // namespace

FolderLock::Try FolderLock::open_lock_file() {
  const std::string name(lock_name);
  file_ = folder_->create(name, 0666);
  made_ = file_.is_open();
  if (made_) {
    // Every user of the folder may have to wait for it, whatever the umask is.
    ::fchmod(file_.number(), 0666);
    return Try::held;
  }
  if (errno != EEXIST) {
    return Try::impossible;
  }
  file_ = folder_->open_file(name, O_RDWR);
  if (!file_.is_open() && errno == EACCES) {
    file_ = folder_->open_file(name, O_RDONLY);
  }
  if (!file_.is_open()) {
    return errno == ENOENT ? Try::gone : Try::impossible;
  }
  return is_plain(file_) && content_of(file_) != Content::foreign ? Try::held : Try::impossible;
}

FolderLock::Try FolderLock::try_once() {
  const std::string name(lock_name);
  if (const Try opened = open_lock_file(); opened != Try::held) {
    return opened;
  }
  if (::flock(file_.number(), LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK || errno == EINTR) {
      return Try::busy;
    }
    if (made_) {
      folder_->remove(name);
    }
    return Try::impossible;
  }
  if (!folder_->is_named(name, file_)) {
    return Try::gone;  // whoever held it has removed it; others lock another file by now
  }
  left_behind_ = content_of(file_) == Content::ours;
  if (!left_behind_) {
    // Without them the lock holds as well.
    [[maybe_unused]] const int ignored = folder_->append(file_, words);
  }
  return Try::held;
}

std::optional<FolderLock> FolderLock::take(Folder& folder, const Patience& patience) {
  const auto end = std::chrono::steady_clock::now() + patience.longest;
  FolderLock lock(folder);
  for (;;) {
    if (patience.cancelled != nullptr && *patience.cancelled) {
      throw Error(ErrorKind::interrupted, "interrupted; nothing was written");
    }
    switch (lock.try_once()) {
      case Try::held:
        return lock;
      case Try::impossible:
        lock.file_.close();
        return lock;
      case Try::gone:
      case Try::busy:
        lock.file_.close();
        break;
    }
    if (std::chrono::steady_clock::now() > end) {
      return std::nullopt;
    }
    std::this_thread::sleep_for(between_tries);
  }
}

FolderLock::~FolderLock() {
  if (file_.is_open()) {
    folder_->remove(std::string(lock_name));
  }
}

}  // namespace ridgecraft::cli
