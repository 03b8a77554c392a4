// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/set/folder.hpp"

#include <cerrno>
#include <cstdio>
#include <memory>

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace ridgecraft::cli {
namespace {

int result_of(int returned) {
  return returned == 0 ? 0 : errno;
}

FileState state_of(const struct stat& status) {
  constexpr std::int64_t ns_per_s = 1'000'000'000;
  return {status.st_size, status.st_mtim.tv_sec * ns_per_s + status.st_mtim.tv_nsec};
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

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this != &other) {
    close();
    number_ = std::exchange(other.number_, -1);
  }
  return *this;
}

int Descriptor::close() {
  const int number = std::exchange(number_, -1);
  return number < 0 ? 0 : result_of(::close(number));
}

Folder::Folder(Descriptor folder, std::filesystem::path path, Key key, BeforeStep before_step)
    : folder_(std::move(folder)), path_(std::move(path)), key_(key), before_step_(std::move(before_step)) {}

std::optional<Folder> Folder::open(const std::filesystem::path& path, BeforeStep before_step) {
  return open_at(AT_FDCWD, path, path, std::move(before_step));
}

std::optional<Folder> Folder::open_beside(const std::filesystem::path& path) const {
  return open_at(folder_.number(), path, (path_ / path).lexically_normal(), before_step_);
}

std::optional<Folder> Folder::open_at(int start, const std::filesystem::path& path,
                                      std::filesystem::path shown, BeforeStep before_step) {
  constexpr int flags = O_DIRECTORY | O_CLOEXEC;
  Descriptor folder(::openat(start, path.c_str(), O_RDONLY | flags));
#ifdef O_PATH
  if (!folder.is_open() && errno == EACCES) {
    // Files can be written into a folder that may not be listed.
    folder = Descriptor(::openat(start, path.c_str(), O_PATH | flags));
  }
#endif
  struct stat status {};
  if (!folder.is_open() || ::fstat(folder.number(), &status) != 0) {
    return std::nullopt;
  }
  return Folder(std::move(folder), std::move(shown), {status.st_dev, status.st_ino}, std::move(before_step));
}

void Folder::step(std::string_view name) const {
  if (before_step_) {
    before_step_(name);
  }
}

std::vector<std::string> Folder::names() const {
  std::vector<std::string> names;
  // A descriptor of its own: where a listing stands belongs to the open folder.
  Descriptor again(::openat(folder_.number(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  DIR* const listing = again.is_open() ? ::fdopendir(again.number()) : nullptr;
  if (listing == nullptr) {
    return names;
  }
  static_cast<void>(again.release());  // closedir() closes it
  while (const dirent* entry = ::readdir(listing)) {
    names.emplace_back(entry->d_name);
  }
  ::closedir(listing);
  return names;
}

std::optional<FileState> Folder::state(const std::string& name) const {
  struct stat status {};
  if (::fstatat(folder_.number(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) {
    return std::nullopt;
  }
  return state_of(status);
}

bool Folder::is_named(const std::string& name, const Descriptor& file) const {
  struct stat named {};
  struct stat opened {};
  return ::fstatat(folder_.number(), name.c_str(), &named, AT_SYMLINK_NOFOLLOW) == 0 &&
         ::fstat(file.number(), &opened) == 0 && named.st_dev == opened.st_dev &&
         named.st_ino == opened.st_ino;
}

bool Folder::is_file_of(const std::string& name, uid_t owner) const {
  struct stat status {};
  return ::fstatat(folder_.number(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 &&
         S_ISREG(status.st_mode) && status.st_uid == owner;
}

Descriptor Folder::create(const std::string& name, mode_t mode) {
  step("open");
  constexpr int flags = O_RDWR | O_CREAT | O_EXCL | O_APPEND | O_NOFOLLOW | O_CLOEXEC;
  return Descriptor(::openat(folder_.number(), name.c_str(), flags, mode));
}

Descriptor Folder::open_file(const std::string& name, int flags) const {
  // A pipe of that name mustn't keep anybody waiting.
  return Descriptor(
      ::openat(folder_.number(), name.c_str(), flags | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
}

int Folder::rename(const std::string& from, const std::string& to) {
  step("rename");
  return result_of(::renameat(folder_.number(), from.c_str(), folder_.number(), to.c_str()));
}

int Folder::link(const std::string& from, const std::string& to) {
  step("link");
  return result_of(::linkat(folder_.number(), from.c_str(), folder_.number(), to.c_str(), 0));
}

int Folder::remove(const std::string& name) {
  step("unlink");
  return result_of(::unlinkat(folder_.number(), name.c_str(), 0));
}

int Folder::append(const Descriptor& file, std::string_view bytes) {
  step("write");
  return write_all(file.number(), bytes);
}

int Folder::append_durably(const Descriptor& file, std::string_view bytes) {
  if (const int error = append(file, bytes); error != 0) {
    return error;
  }
  step("fsync");
  const int error = result_of(::fsync(file.number()));
  // Some file systems know no fsync.
  return error == EINVAL || error == EROFS ? 0 : error;
}

void Folder::sync() {
  step("fsync");
  ::fsync(folder_.number());
}

}  // namespace ridgecraft::cli
