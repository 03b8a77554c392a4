// SPDX-License-Identifier: GPL-3.0-or-later
// A folder that is open: its files by their names, each change of them one step.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace ridgecraft::cli {

/// Called before each step that changes a file system, with the name of the system call. Tests end the
/// process there.
using BeforeStep = std::function<void(std::string_view step)>;

/// An open file, closed at its end.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor() { close(); }

  [[nodiscard]] bool is_open() const { return number_ >= 0; }
  [[nodiscard]] int number() const { return number_; }
  /// 0, or the error of writes that the system had put off.
  int close();
  /// Leaves the closing to somebody else.
  [[nodiscard]] int release() { return std::exchange(number_, -1); }

 private:
  int number_ = -1;
};

/// Another one after somebody has replaced or edited a file. No inode number: FAT gives a file a new one each
/// time it is mounted.
struct FileState {
  std::int64_t bytes = 0;
  std::int64_t changed_ns = 0;  ///< time of the last change of the content, since 1970, by the file system

  friend bool operator==(const FileState&, const FileState&) = default;
};

/// Stays the folder that was opened, whatever becomes of its path. Functions that return int give 0 or the
/// system's error number; those that return a Descriptor give a closed one on failure, with the reason in
/// errno. Names are of files directly in it; a link is meant itself, never what it leads to.
class Folder {
 public:
  /// Which folder it is, whatever path leads there.
  using Key = std::pair<std::uint64_t, std::uint64_t>;

  /// Nothing where it can't be opened; errno tells why.
  [[nodiscard]] static std::optional<Folder> open(const std::filesystem::path& path, BeforeStep before_step);
  /// The same for a path that starts in this folder.
  [[nodiscard]] std::optional<Folder> open_beside(const std::filesystem::path& path) const;

  /// As it was opened: for messages.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] Key key() const { return key_; }
  /// Empty where the folder may not be read.
  [[nodiscard]] std::vector<std::string> names() const;
  /// Nothing where there is no such file, or the folder can't be asked.
  [[nodiscard]] std::optional<FileState> state(const std::string& name) const;
  /// True where the name stands for this open file.
  [[nodiscard]] bool is_named(const std::string& name, const Descriptor& file) const;
  /// True for a plain file of this user.
  [[nodiscard]] bool is_file_of(const std::string& name, uid_t owner) const;

  /// Makes the file, empty and open for writing. EEXIST where the name is taken.
  [[nodiscard]] Descriptor create(const std::string& name, mode_t mode);
  /// Opens a file that exists, for reading and writing as far as `flags` (O_RDWR, O_RDONLY) say.
  [[nodiscard]] Descriptor open_file(const std::string& name, int flags) const;
  [[nodiscard]] int rename(const std::string& from, const std::string& to);
  /// Gives the file a second name.
  [[nodiscard]] int link(const std::string& from, const std::string& to);
  int remove(const std::string& name);
  /// Writes at the end of the file.
  [[nodiscard]] int append(const Descriptor& file, std::string_view bytes);
  /// The same, and waits until the disk has it: a full one often tells only then.
  [[nodiscard]] int append_durably(const Descriptor& file, std::string_view bytes);
  /// Waits until the disk has all names. Where the file system can't promise that, nothing is done about it.
  void sync();

 private:
  Folder(Descriptor folder, std::filesystem::path path, Key key, BeforeStep before_step);
  static std::optional<Folder> open_at(int start, const std::filesystem::path& path,
                                       std::filesystem::path shown, BeforeStep before_step);
  void step(std::string_view name) const;

  Descriptor folder_;
  std::filesystem::path path_;
  Key key_;
  BeforeStep before_step_;
};

}  // namespace ridgecraft::cli
