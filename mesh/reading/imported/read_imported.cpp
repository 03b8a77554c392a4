// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/imported/read_imported.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/text.hpp"
#include "mesh/reading/files.hpp"
#include "mesh/reading/imported/stream.hpp"
#include "mesh/reading/source.hpp"

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

/// Longer reasons than this don't help.
constexpr std::size_t longest_reason = 160;

class StreamReader {
 public:
  StreamReader(std::string_view stream, FileFormat format, const Source& source)
      : left_(stream), source_(source), pictures_(source, soup_.remarks) {
    soup_.format = format;
  }

  Soup read() {
    expect(imported::start);
    const std::uint32_t kind = index();
    if (kind == imported::kind_refusal) {
      refuse_as_told();
    }
    require(kind == imported::kind_soup);
    read_frame();
    const std::uint32_t moves = index();
    soup_.remarks.add(RepairKind::motion_ignored, moves > 0 ? 1 : 0);
    read_materials();
    read_points();
    read_objects();
    read_polygons();
    expect(imported::end);
    require(left_.empty());
    return std::move(soup_);
  }

 private:
  void require(bool condition) const {
    if (!condition) {
      source_.refuse(ErrorKind::unreadable_input,
                     fmt::format("can't be read: what reads {} files broke off", format_name(soup_.format)));
    }
  }

  [[noreturn]] void refuse_as_told() {
    std::string reason = printable(text());
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    while (reason.ends_with('.') || reason.ends_with(' ')) {
      reason.pop_back();
    }
    if (reason.size() > longest_reason) {
      reason = printable(reason.substr(0, longest_reason)) + " ...";
    }
    // What its words mean, where they are known.
    if (reason.find("<h>") != reason.npos) {
      reason = "it has polygons with holes (<ph>), which aren't read";
    } else if (!reason.empty()) {
      reason = fmt::format("its reader says \"{}\"", reason);
    }
    source_.refuse(ErrorKind::unreadable_input,
                   fmt::format("can't be read as {}{}{}; {}", format_name(soup_.format),
                               reason.empty() ? "" : ": ", reason, way_by_blender()));
  }

  template <class T>
  T take() {
    require(left_.size() >= sizeof(T));
    T value;
    std::memcpy(&value, left_.data(), sizeof(T));
    left_.remove_prefix(sizeof(T));
    return value;
  }
  std::uint32_t index() { return take<std::uint32_t>(); }
  double number() { return take<double>(); }
  /// How many follow, of so many bytes each at least: never more than the stream can hold.
  std::uint32_t count(std::size_t bytes) {
    const std::uint32_t value = index();
    require(value <= left_.size() / bytes);
    return value;
  }
  std::string_view text() {
    const std::uint32_t size = count(1);
    const std::string_view result = left_.substr(0, size);
    left_.remove_prefix(size);
    return result;
  }
  void expect(std::string_view words) {
    require(left_.starts_with(words));
    left_.remove_prefix(words.size());
  }

  void read_frame() {
    const double unit = number();
    if (std::isfinite(unit) && unit > 0.0) {
      soup_.frame.mm_per_unit = unit;
    }
    const std::uint32_t up = index();
    require(up <= imported::axis_untold);
    if (up != imported::axis_untold) {
      soup_.frame.up = static_cast<Axis>(up);
    }
  }

  void read_materials() {
    const std::uint32_t materials = count(2 * sizeof(std::uint32_t));
    for (std::uint32_t i = 0; i < materials; ++i) {
      Material material;
      material.name = printable(text());
      const bool has_colour = index() != 0;
      Colour colour{};
      std::generate(colour.begin(), colour.end(), [this] { return number(); });
      if (has_colour) {
        material.colour = in_range(colour);
        soup_.remarks.add(RepairKind::material_value_corrected, *material.colour == colour ? 0 : 1);
      }
      read_picture(material);
      soup_.materials.push_back(std::move(material));
    }
  }

  void read_picture(Material& material) {
    const std::uint32_t kind = index();
    require(kind <= imported::picture_file);
    const std::string_view told = text();
    if (kind == imported::picture_file && !source_.folder.empty()) {
      PictureFinder::Found found = pictures_.find(source_.folder, told);
      material.texture_file = std::move(found.file);
      material.picture = std::move(found.bytes);
    } else if (kind == imported::picture_file) {
      material.texture_file = printable(told);
    } else if (kind == imported::picture_bytes) {
      const std::string fault = picture_fault(told);
      if (fault.empty()) {
        material.picture = std::make_shared<const std::string>(told);
      }
      soup_.remarks.add(RepairKind::texture_missing, fault.empty() ? 0 : 1,
                        fmt::format("the picture of material {} {}", in_quotes(material.name), fault));
    }
  }

  void read_points() {
    const std::uint32_t points = count(3 * sizeof(double));
    soup_.points.reserve(points);
    for (std::uint32_t i = 0; i < points; ++i) {
      const double x = number();
      const double y = number();
      const double z = number();
      if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
        source_.refuse(ErrorKind::unusable_mesh, fmt::format("a coordinate of point {} is not finite", i));
      }
      soup_.points.push_back({x, y, z});
    }
    const std::uint32_t places = count(2 * sizeof(double));
    soup_.texture_points.reserve(places);
    bad_place_.reserve(places);
    for (std::uint32_t i = 0; i < places; ++i) {
      const Vec2 place{number(), number()};
      // True for what is no number, too.
      bad_place_.push_back(!(std::abs(place.x) <= largest_texture_coordinate &&
                             std::abs(place.y) <= largest_texture_coordinate));
      soup_.texture_points.push_back(bad_place_.back() ? Vec2{} : place);
    }
  }

  void read_objects() {
    const std::uint32_t objects = count(2 * sizeof(std::uint32_t));
    for (std::uint32_t i = 0; i < objects; ++i) {
      const std::uint32_t first = index();
      require(soup_.objects.empty() || soup_.objects.back().first <= first);
      soup_.objects.emplace_back(first, printable(text()));
    }
  }

  void read_polygons() {
    const std::uint32_t polygons = count(sizeof(std::uint32_t));
    std::uint64_t corners = 0;
    soup_.first_corner.reserve(std::size_t{polygons} + 1);
    for (std::uint32_t i = 0; i < polygons; ++i) {
      corners += index();
      require(corners <= left_.size());
      soup_.first_corner.push_back(static_cast<std::uint32_t>(corners));
    }
    require(soup_.objects.empty() || soup_.objects.back().first <= polygons);
    require(count(2 * sizeof(std::uint32_t)) == corners);
    check_repetitions(source_, source_.bytes.size(), soup_.points.size(), corners);
    soup_.corner_point = indices(corners, soup_.points.size(), false);
    soup_.corner_texture = indices(corners, soup_.texture_points.size(), true);
    constexpr std::size_t colours = 0x1000000;
    soup_.corner_colour = indices(corners, colours, true);
    if (std::all_of(soup_.corner_colour.begin(), soup_.corner_colour.end(),
                    [](std::uint32_t colour) { return colour == Soup::none; })) {
      soup_.corner_colour.clear();
    }
    soup_.polygon_material = indices(polygons, soup_.materials.size(), true);
    complete_textures(soup_, bad_place_);
    check_corner_count(source_, soup_);
  }

  std::vector<std::uint32_t> indices(std::uint64_t how_many, std::size_t below, bool may_be_none) {
    require(how_many <= left_.size() / sizeof(std::uint32_t));
    std::vector<std::uint32_t> result;
    result.reserve(how_many);
    for (std::uint64_t i = 0; i < how_many; ++i) {
      result.push_back(index());
      require(result.back() < below || (may_be_none && result.back() == imported::no_index));
    }
    const bool all_none =
        std::all_of(result.begin(), result.end(), [](std::uint32_t i) { return i == imported::no_index; });
    return may_be_none && all_none ? std::vector<std::uint32_t>() : result;
  }

  std::string_view left_;
  const Source& source_;
  Soup soup_;
  PictureFinder pictures_;
  std::vector<bool> bad_place_;
};

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

Soup read_stream(std::string_view stream, FileFormat format, const Source& source) {
  return StreamReader(stream, format, source).read();
}

Soup read_imported(FileFormat format, const Source& source) {
  return read_stream(run_importer(format, source), format, source);
}

}  // namespace ridgecraft::mesh
