// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/input_files.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/encodings.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "cli/files/formats.hpp"
#include "job/asked_options.hpp"
#include "mesh/model/soup.hpp"
#include "mesh/reading/files.hpp"
#include "session/project_file.hpp"

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

namespace {

/// The words of a line, between spaces, tabs and commas; what follows a # says nothing.
std::vector<std::string_view> words_of_line(std::string_view line) {
  constexpr std::string_view space = " \t\r,";
  std::vector<std::string_view> words;
  line = line.substr(0, line.find('#'));
  for (std::size_t begin = line.find_first_not_of(space); begin != std::string_view::npos;
       begin = line.find_first_not_of(space)) {
    line.remove_prefix(begin);
    words.push_back(line.substr(0, line.find_first_of(space)));
    line.remove_prefix(words.back().size());
  }
  return words;
}

/// Calls visit(words, number) for each line that has words; lines are counted from 1.
template <class Visit>
void for_each_line(std::string_view text, Visit visit) {
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (const std::vector<std::string_view> words = words_of_line(text.substr(0, end)); !words.empty()) {
      visit(words, number);
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

[[noreturn]] void refuse_line(const std::string& file, std::size_t line, std::string_view reason) {
  throw Error(ErrorKind::unreadable_input, fmt::format("{}, line {}: {}", file, line, reason), file);
}

std::uint32_t number_of(std::string_view word, const std::string& file, std::size_t line) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) {
    refuse_line(file, line, fmt::format("'{}' is no number of a point", word));
  }
  return value;
}

/// Pairs of points, one pair a line.
job::EdgeList pairs_in(const EdgeFile& edges, const mesh::Model& model) {
  const std::uint32_t first = mesh::first_point_number(model.format);
  job::EdgeList list{{}, digest(edges.bytes)};
  for_each_line(edges.bytes, [&](const std::vector<std::string_view>& words, std::size_t line) {
    std::vector<std::uint32_t> pair;
    for (const std::string_view word : words) {
      pair.push_back(number_of(word, edges.name, line));
    }
    if (pair.size() != 2) {
      refuse_line(edges.name, line, "two numbers of points are needed");
    }
    for (const std::uint32_t number : pair) {
      if (number < first || number - first >= model.file_points.size()) {
        refuse_line(edges.name, line,
                    fmt::format("the model has no point {} (its points are {} to {})", number, first,
                                model.file_points.size() - 1 + first));
      }
    }
    list.edges.push_back({pair[0] - first, pair[1] - first});
  });
  return list;
}

class TabLine {
 public:
  TabLine(const std::vector<std::string_view>& words, std::string where)
      : where_(std::move(where)), words_(words) {}

  [[nodiscard]] unfold::EdgeTab read() const {
    unfold::EdgeTab tab;
    tab.where = where_;
    tab.number = number(words_.front());
    if (words_.size() == 1) {
      refuse("after the number of an edge comes none, both, height=, angle= or the name of a piece");
    }
    for (std::size_t i = 1; i < words_.size(); ++i) {
      take(words_[i], tab);
    }
    if (!tab.wanted && words_.size() > 2) {
      refuse("an edge with no tab can't have more asked of it");
    }
    return tab;
  }

 private:
  [[noreturn]] void refuse(const std::string& reason) const {
    throw Error(ErrorKind::unreadable_input, where_ + ": " + reason);
  }

  [[nodiscard]] std::uint32_t number(std::string_view word) const {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || value == 0) {
      refuse(fmt::format("'{}' is no number of an edge", word));
    }
    return value;
  }

  void take(std::string_view word, unfold::EdgeTab& tab) const {
    constexpr std::string_view height = "height=";
    constexpr std::string_view angle = "angle=";
    if (word == "none") {
      tab.wanted = false;
    } else if (word == "both") {
      tab.both = true;
    } else if (word.starts_with(height)) {
      tab.height_mm = value_of("tab-height", "height=", word.substr(height.size()));
    } else if (word.starts_with(angle)) {
      tab.angle = value_of("tab-angle", "angle=", word.substr(angle.size()));
    } else if (word.find('=') != std::string_view::npos || !tab.piece.empty()) {
      refuse(fmt::format(
          "'{}' isn't understood; there may be none, both, height=, angle= and the name of one piece", word));
    } else {
      tab.piece = std::string(word);
    }
  }

  /// As the option takes it.
  [[nodiscard]] double value_of(std::string_view option, const std::string& called,
                                std::string_view text) const {
    try {
      return job::number_of(option_row(option), called, std::string(text));
    } catch (const Error& error) {
      refuse(error.what());
    }
  }

  std::string where_;
  const std::vector<std::string_view>& words_;
};

}  // namespace

EdgeFiles read_edge_files(const EdgeArguments& edges) {
  const auto read = [](const std::string& name) -> std::optional<EdgeFile> {
    if (name.empty()) {
      return std::nullopt;
    }
    // Read before the aggregate begins: g++ 12 destroys its members twice where one of them throws.
    std::string bytes = mesh::read_file(name);
    return EdgeFile{name, std::move(bytes)};
  };
  EdgeFiles files{read(edges.cuts), read(edges.keep), read(edges.from)};
  if (files.from && session::holds_project(files.from->bytes)) {
    files.from->bytes = session::read_project(files.from->name, files.from->bytes).nets;
  }
  return files;
}

std::vector<InputFile> input_files(const EdgeArguments& edges) {
  return {{"--from", edges.from}, {"--cuts", edges.cuts}, {"--keep", edges.keep}};
}

job::EdgeRequests requests_of(const EdgeFiles& files, const mesh::Model& model) {
  job::EdgeRequests requests;
  if (files.cuts) {
    requests.cut = pairs_in(*files.cuts, model);
  }
  if (files.keep) {
    requests.keep = pairs_in(*files.keep, model);
  }
  if (files.from) {
    requests.from = job::OldNets{files.from->name, files.from->bytes};
  }
  return requests;
}

std::vector<unfold::EdgeTab> read_tab_file(const std::string& name, std::string_view bytes) {
  std::vector<unfold::EdgeTab> tabs;
  for_each_line(bytes, [&](const std::vector<std::string_view>& words, std::size_t line) {
    tabs.push_back(TabLine(words, fmt::format("{}, line {}", name, line)).read());
  });
  return tabs;
}

}  // namespace ridgecraft::cli
