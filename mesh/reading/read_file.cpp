// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a whole regular file in one go, and nothing that could block or never end.
#include "mesh/reading/read_file.hpp"

#include <cerrno>
#include <memory>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.hpp"
#include "base/printable.hpp"

namespace ridgecraft::mesh {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view reason) {
  const std::string name = printable(file.string());
  throw Error(ErrorKind::unreadable_input, fmt::format("{} {}", name, reason), name);
}

[[noreturn]] void refuse_errno(const std::filesystem::path& file, int number) {
  switch (number) {
    case ENOENT:
    case ENOTDIR:
      refuse(file, "doesn't exist");
    case EACCES:
    case EPERM:
      refuse(file, "can't be opened: no permission to read it");
    default:
      refuse(file, fmt::format("can't be read: {}", std::generic_category().message(number)));
  }
}

void require_regular(const std::filesystem::path& file, const struct stat& status) {
  if (S_ISDIR(status.st_mode)) {
    refuse(file, "is a folder, not a file");
  }
  if (!S_ISREG(status.st_mode)) {
    refuse(file, "is a pipe or device; only regular files are read");
  }
  if (static_cast<std::uint64_t>(status.st_size) > largest_file_size) {
    refuse(file,
           fmt::format("is too large: {} bytes, at most {} are read", status.st_size, largest_file_size));
  }
}

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) {
      ::close(number_);
    }
  }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

}  // namespace

std::string read_file(const std::filesystem::path& file) {
  struct stat status {};
  // Asked before opening, since opening a device can have effects; and again after, in case it was replaced.
  if (::stat(file.c_str(), &status) != 0) {
    refuse_errno(file, errno);
  }
  require_regular(file, status);
  const Descriptor opened(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (opened.number() < 0 || ::fstat(opened.number(), &status) != 0) {
    refuse_errno(file, errno);
  }
  require_regular(file, status);
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t got = ::read(opened.number(), bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got < 0) {
      refuse_errno(file, errno);
    }
    if (got == 0) {
      break;
    }
    filled += static_cast<std::size_t>(got);
  }
  bytes.resize(filled);
  return bytes;
}

}  // namespace ridgecraft::mesh
