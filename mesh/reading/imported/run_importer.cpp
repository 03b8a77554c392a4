// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/imported/run_importer.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "mesh/reading/foreign_content.hpp"

namespace ridgecraft::mesh {
namespace {

/// How often waiting for the other process asks whether to stop.
constexpr int wait_ms = 20;
constexpr std::size_t chunk = std::size_t{1} << 16U;
/// No more than this is read of what it says: more than it may hold itself.
constexpr std::size_t largest_stream = std::size_t{1} << 31U;

/// One end of a pair of sockets.
class Socket {
 public:
  explicit Socket(int number) : number_(number) {}
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  ~Socket() { close(); }
  void close() {
    if (number_ >= 0) {
      ::close(number_);
      number_ = -1;
    }
  }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

/// A process with a socket as its standard input and output; it is killed where nobody waits for its end.
class Process {
 public:
  Process(const std::string& program, const std::string& format, int socket) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, socket, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, socket, STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    // Ctrl-C is for us alone: we end it, and nobody reads that it broke down.
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
    std::array<std::string, 2> words{program, format};
    std::array<char*, 3> arguments{words[0].data(), words[1].data(), nullptr};
    // Nothing of the environment concerns it.
    std::array<char*, 1> environment{nullptr};
    if (posix_spawn(&id_, program.c_str(), &actions, &attributes, arguments.data(), environment.data()) !=
        0) {
      id_ = -1;
    }
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process() {
    if (id_ > 0) {
      ::kill(id_, SIGKILL);
      (void)wait();
    }
  }
  [[nodiscard]] bool runs() const { return id_ > 0; }
  /// As waitpid tells it.
  int wait() {
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = -1;
    return status;
  }

 private:
  pid_t id_ = -1;
};

/// Writes all of the bytes and reads to the end, as either is possible.
std::string converse(Socket& socket, const Source& source) {
  std::string_view to_write = source.bytes;
  std::string stream;
  std::array<char, chunk> buffer{};
  bool writing = true;
  for (;;) {
    source.context.check();
    if (writing && to_write.empty()) {
      ::shutdown(socket.number(), SHUT_WR);
      writing = false;
    }
    pollfd ready{socket.number(), static_cast<short>(writing ? POLLIN | POLLOUT : POLLIN), 0};
    if (::poll(&ready, 1, wait_ms) <= 0) {
      continue;
    }
    if (writing && (ready.revents & POLLOUT) != 0) {
      const ssize_t put = ::send(socket.number(), to_write.data(), std::min(to_write.size(), chunk),
                                 MSG_NOSIGNAL | MSG_DONTWAIT);
      if (put >= 0) {
        to_write.remove_prefix(static_cast<std::size_t>(put));
      } else if (errno != EINTR && errno != EAGAIN) {
        writing = false;  // it has ended without reading all
      }
    }
    if ((ready.revents & (POLLIN | POLLHUP | POLLERR)) != 0) {
      const ssize_t got = ::recv(socket.number(), buffer.data(), buffer.size(), MSG_DONTWAIT);
      if (got == 0 || (got < 0 && errno != EINTR && errno != EAGAIN)) {
        return stream;
      }
      stream.append(buffer.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
      if (stream.size() > largest_stream) {
        source.refuse(ErrorKind::unusable_mesh, "needs more memory than this program allows it");
      }
    }
  }
}

}  // namespace

std::string run_importer(FileFormat format, const Source& source) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    source.refuse(ErrorKind::unreadable_input,
                  "can't be read: the system grants no connection to what reads it");
  }
  Socket here(ends[0]);
  Socket there(ends[1]);
  Process process(source.importer.string(), std::string(format_name(format)), there.number());
  there.close();
  if (!process.runs()) {
    source.refuse(ErrorKind::unreadable_input,
                  "can't be read: " + source.importer.string() + " can't be started");
  }
  std::string stream = converse(here, source);
  const int status = process.wait();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    const bool too_long = WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
    source.refuse(ErrorKind::unreadable_input,
                  fmt::format("can't be read: what reads {} files {} over it; {}", format_name(format),
                              too_long ? "took too long" : "broke down", way_by_blender()));
  }
  return stream;
}

}  // namespace ridgecraft::mesh
