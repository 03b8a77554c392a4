// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/pending_files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <functional>
#include <map>
#include <random>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.hpp"
#include "base/text.hpp"

namespace ridgecraft::cli {
namespace {

namespace fs = std::filesystem;

/// Another run may remove a folder that it made, or a file that isn't locked yet, before this one has its
/// lock. That doesn't happen often in a row.
constexpr int most_tries = 20;

constexpr std::string_view part_prefix = ".ridgecraft-";
constexpr std::string_view part_suffix = ".part";
constexpr std::size_t id_digits = 16;

/// Of a run in a folder. Process ids would not do: in containers many runs are process 1.
std::string new_id() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

/// Short, so that it fits wherever the target's name does.
std::string part_name(std::string_view id, std::size_t number) {
  return fmt::format("{}{}-{}{}", part_prefix, id, number, part_suffix);
}

/// The ID in the name of a part; nothing where the name is no such.
std::string_view id_of(std::string_view name) {
  const std::size_t least = part_prefix.size() + id_digits + 2 + part_suffix.size();
  if (name.size() < least || !name.starts_with(part_prefix) || !name.ends_with(part_suffix)) {
    return {};
  }
  const std::string_view id = name.substr(part_prefix.size(), id_digits);
  const std::string_view number = name.substr(part_prefix.size() + id_digits, name.size() - least + 2);
  return id.find_first_not_of("0123456789abcdef") == std::string_view::npos && number.front() == '-' &&
                 number.find_first_not_of("0123456789", 1) == std::string_view::npos
             ? id
             : std::string_view();
}

[[noreturn]] void refuse(const fs::path& target, int error, const std::string& more = {}) {
  throw Error(ErrorKind::cant_write,
              "can't write " + target.lexically_normal().string() + ": " + std::strerror(error) + more);
}

fs::path folder_of(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

/// Waits until the disk has the names in the folder. Where the file system can't promise that, nothing is
/// done about it.
void sync_folder(const fs::path& folder) {
  const Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (opened.is_open()) {
    ::fsync(opened.number());
  }
}

/// Waits until the disk has the bytes: a full one often tells only then. 0, or the system's error number.
int write_durably(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) {
      return errno;
    }
    bytes.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
  }
  // Some file systems know no fsync.
  return ::fsync(file) == 0 || errno == EINVAL || errno == EROFS ? 0 : errno;
}

/// False where another run holds the new file to be left by a killed one, or has removed it already.
bool lock_new_part(int file) {
  struct stat status {};
  const bool busy = ::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  return !busy && ::fstat(file, &status) == 0 && status.st_nlink > 0;
}

/// Whether no run holds the parts of this ID: their first one is there and not locked, or is gone, since a
/// run that renamed it had no others left.
bool is_left_behind(const fs::path& folder, std::string_view id) {
  // A pipe of that name mustn't keep anybody waiting.
  const Descriptor first(
      ::open((folder / part_name(id, 0)).c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (!first.is_open()) {
    return errno == ENOENT;
  }
  struct stat status {};
  return ::fstat(first.number(), &status) == 0 && S_ISREG(status.st_mode) &&
         ::flock(first.number(), LOCK_EX | LOCK_NB) == 0 &&
         ::unlink((folder / part_name(id, 0)).c_str()) == 0;
}

/// Removes what killed runs have left.
void remove_left_parts(const fs::path& folder) {
  std::map<std::string, std::vector<fs::path>, std::less<>> others;  // by ID: all but the first
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (const std::string_view id = id_of(name); !id.empty()) {
      std::vector<fs::path>& parts = others[std::string(id)];
      if (name != part_name(id, 0) && entry->is_regular_file(error) && !entry->is_symlink(error)) {
        parts.push_back(entry->path());
      }
    }
  }
  for (const auto& [id, parts] : others) {
    if (is_left_behind(folder, id)) {
      for (const fs::path& part : parts) {
        ::unlink(part.c_str());
      }
    }
  }
}

}  // namespace

void PendingFiles::add(const fs::path& target, std::string_view bytes) {
  const fs::path folder = folder_of(target);
  const auto known = folders_.find(folder);
  const bool is_first = known == folders_.end();
  const auto write = [&](const Descriptor& file) {
    if (const int error = write_durably(file.number(), bytes); error != 0) {
      ::unlink(parts_.back().path.c_str());
      parts_.pop_back();
      if (is_first) {
        folders_.erase(folder);
      }
      refuse(target, error);
    }
  };
  if (is_first) {
    create_first(target);
    write(folders_.at(folder).lock);
  } else {
    write(create_next(target, known->second));
  }
}

void PendingFiles::create_folders(const fs::path& folder) {
  fs::path so_far;
  for (const fs::path& name : folder) {
    so_far /= name;
    std::error_code error;
    if (fs::is_directory(so_far, error)) {
      continue;
    }
    if (fs::create_directory(so_far, error)) {
      made_folders_.push_back(so_far);
      sync_folder(folder_of(so_far));  // or a power failure takes the folder, with files that the disk has
    } else if (error) {
      std::error_code ignored;
      if (!fs::exists(fs::symlink_status(so_far, ignored)) &&
          (error == std::errc::no_such_file_or_directory || error == std::errc::file_exists)) {
        return;  // another run has just removed it, or the folder around it
      }
      throw Error(ErrorKind::cant_write,
                  "can't create the folder " + so_far.string() + ": " + std::strerror(error.value()));
    }
  }
}

void PendingFiles::create_first(const fs::path& target) {
  const fs::path folder = folder_of(target);
  for (int tries = 1;; ++tries) {
    create_folders(target.parent_path());
    remove_left_parts(folder);  // before anything is written: it may be what fills the disk
    const std::string id = new_id();
    const fs::path path = folder / part_name(id, 0);
    Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    const int error = file.is_open() ? EWOULDBLOCK : errno;
    if (file.is_open() && lock_new_part(file.number())) {
      folders_.emplace(folder, Folder{id, std::move(file), 1});
      parts_.push_back({target, path, true});
      return;
    }
    if ((!file.is_open() && error != ENOENT) || tries == most_tries) {
      refuse(target, error);
    }
  }
}

Descriptor PendingFiles::create_next(const fs::path& target, Folder& folder) {
  const fs::path path = folder_of(target) / part_name(folder.id, folder.parts);
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!file.is_open()) {
    refuse(target, errno);
  }
  ++folder.parts;
  parts_.push_back({target, path});
  return file;
}

std::vector<std::string> PendingFiles::commit(const LastLook& look) {
  const std::vector<fs::path> leftovers = look ? look() : std::vector<fs::path>();
  for (const Part& part : parts_) {
    std::error_code ignored;
    if (fs::is_directory(fs::symlink_status(part.target, ignored))) {
      refuse(part.target, EISDIR);
    }
  }
  // What others take for a sign that a run goes on is renamed last.
  std::stable_partition(parts_.begin(), parts_.end(), [](const Part& part) { return !part.is_locked; });
  const auto sync_all = [&] {
    for (const auto& [folder, parts] : folders_) {
      sync_folder(folder);
    }
  };
  std::vector<std::string> renamed;
  for (const Part& part : parts_) {
    if (::rename(part.path.c_str(), part.target.c_str()) != 0) {
      const int error = errno;
      refuse(part.target, error,
             renamed.empty()
                 ? ""
                 : "; " + listed(renamed, "and") + (renamed.size() == 1 ? " is" : " are") + " new already");
    }
    renamed.push_back(part.target.lexically_normal().string());
  }
  parts_.clear();
  made_folders_.clear();
  sync_all();  // or a power failure takes the earlier files, and the new ones have no name yet
  std::vector<std::string> notes;
  for (const fs::path& file : leftovers) {
    if (::unlink(file.c_str()) != 0 && errno != ENOENT) {
      const int error = errno;
      notes.push_back(file.string() + " is of an earlier run and can't be removed: " + std::strerror(error));
    }
  }
  sync_all();
  return notes;
}

void PendingFiles::discard() noexcept {
  for (const Part& part : parts_) {
    ::unlink(part.path.c_str());
  }
  for (auto folder = made_folders_.rbegin(); folder != made_folders_.rend(); ++folder) {
    ::rmdir(folder->c_str());  // stays where somebody else has put something into it
  }
}

}  // namespace ridgecraft::cli
