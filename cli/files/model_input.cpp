// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/model_input.hpp"

#include <array>
#include <cerrno>
#include <filesystem>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.hpp"
#include "cli/files/formats.hpp"
#include "mesh/reading/files.hpp"

namespace ridgecraft::cli {
namespace {

constexpr std::string_view dash = "-";
constexpr const char* standard_input = "standard input";
/// How often waiting for the other end of a pipe asks whether to stop.
constexpr int wait_ms = 50;
/// What a pipe holds on Linux.
constexpr std::size_t chunk = std::size_t{1} << 16U;

[[noreturn]] void refuse(const std::string& reason) {
  throw Error(ErrorKind::unreadable_input, std::string(standard_input) + " " + reason, standard_input);
}

[[noreturn]] void refuse_errno(int number) {
  switch (number) {
    case EBADF:
      refuse("is closed, but the model is to be read from it (-)");
    case EISDIR:
      refuse("is a folder, not a file");
    default:
      refuse("can't be read: " + std::generic_category().message(number));
  }
}

/// Bytes that came; 0 at the end. Never waits without asking whether to stop.
std::size_t read_some(std::array<char, chunk>& buffer, const Context& context) {
  for (;;) {
    context.check();
    pollfd ready{STDIN_FILENO, POLLIN, 0};
    const int count = ::poll(&ready, 1, wait_ms);
    if (count == 0 || (count < 0 && errno == EINTR)) {
      continue;
    }
    const ssize_t got = ::read(STDIN_FILENO, buffer.data(), buffer.size());
    if (got >= 0) {
      return static_cast<std::size_t>(got);
    }
    if (errno != EINTR && errno != EAGAIN) {
      refuse_errno(errno);
    }
  }
}

std::string read_standard_input(const Context& context) {
  struct stat status {};
  if (::fstat(STDIN_FILENO, &status) != 0) {
    refuse_errno(errno);
  }
  if (::isatty(STDIN_FILENO) == 1) {
    refuse(
        "is the terminal: with - a model is expected from a pipe or a file, as in: ridgecraft - < whale.obj");
  }
  std::string bytes;
  std::array<char, chunk> buffer{};
  for (std::size_t got = read_some(buffer, context); got > 0; got = read_some(buffer, context)) {
    // A device such as /dev/zero may never end.
    if (S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode)) {
      refuse("is a device; only files and pipes are read");
    }
    bytes.append(buffer.data(), got);
    if (bytes.size() > mesh::largest_file_size) {
      refuse(fmt::format("is too large: at most {} bytes are read", mesh::largest_file_size));
    }
  }
  return bytes;
}

/// Who names a file of nets as the model is told how pages are made of them.
void refuse_nets(const std::string& file, const Error& error) {
  std::error_code ignored;
  if (error.kind() == ErrorKind::unreadable_input && suffix_of(file) == ".fold" &&
      std::filesystem::is_regular_file(file, ignored) && std::filesystem::file_size(file, ignored) > 0) {
    throw Error(error.kind(), error.what() + ("; pages of nets are made by: ridgecraft MODEL --from " + file),
                file);
  }
}

}  // namespace

std::filesystem::path importer_program() {
  std::error_code ignored;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", ignored);
  if (self.empty()) {
    return {};
  }
  const std::filesystem::path folder = self.parent_path();
  for (const std::filesystem::path& program : std::array{
           folder / "ridgecraft-import", folder.parent_path() / "libexec/ridgecraft/ridgecraft-import"}) {
    if (::access(program.c_str(), X_OK) == 0) {
      return program;
    }
  }
  return {};
}

std::string shown_name(const std::string& model) {
  return model == dash ? standard_input : model;
}

std::string results_name(const std::string& model) {
  return model == dash ? "model" : std::filesystem::path(model).stem().string();
}

mesh::Model read_model(const std::string& model, const mesh::ReadOptions& asked, const Context& context) {
  mesh::ReadOptions options = asked;
  options.importer = importer_program();
  if (model != dash) {
    try {
      return mesh::read(std::filesystem::path(model), options, context);
    } catch (const Error& error) {
      refuse_nets(model, error);
      throw;
    }
  }
  context.report("reading", 0.0);
  return mesh::read(mesh::ModelFile{.bytes = read_standard_input(context),
                                    .name = standard_input,
                                    .title = results_name(model),
                                    .folder = {}},
                    options, context);
}

}  // namespace ridgecraft::cli
