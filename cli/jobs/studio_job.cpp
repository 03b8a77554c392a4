// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/jobs/studio_job.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/encodings.hpp"
#include "base/error.hpp"
#include "cli/files/model_files.hpp"
#include "mesh/reading/files.hpp"

namespace ridgecraft::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view empty_start = R"(<script type="application/json" id="start">{}</script>)";

/// A string of JSON inside a script element: nothing in it ends the element.
std::string script_string(std::string_view text) {
  std::string json = json_string(text);
  for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at)) {
    json.replace(at, 1, "\\u003c");
  }
  return json;
}

std::string start_of(const StudioJob& job) {
  if (job.model.empty()) {
    return "{}";
  }
  const fs::path model(job.model);
  const std::string bytes = mesh::read_file(model);
  std::string json = "{\"name\":" + script_string(model.filename().string()) + ",\"files\":{";
  json += script_string(model.filename().string()) + ":\"" + base64(bytes) + "\"";
  for (const fs::path& file : files_of_model(model)) {
    json += "," + script_string(file.filename().string()) + ":\"" + base64(mesh::read_file(file)) + "\"";
  }
  json += "},\"words\":[";
  for (std::size_t i = 0; i < job.words.size(); ++i) {
    json += (i == 0 ? "" : ",") + script_string(job.words[i]);
  }
  return json + "]}";
}

void write_all(int file, std::string_view bytes, const fs::path& name) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) {
      const int error = errno;
      ::close(file);
      ::unlink(name.c_str());
      throw Error(ErrorKind::cant_write,
                  "can't write " + name.string() + ": " + std::generic_category().message(error));
    }
    bytes.remove_prefix(written < 0 ? 0 : static_cast<std::size_t>(written));
  }
}

/// A folder that only the user reads.
fs::path private_folder() {
  const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
  std::error_code ignored;
  if (runtime != nullptr && *runtime == '/' && fs::is_directory(runtime, ignored) &&
      ::access(runtime, W_OK) == 0) {
    return runtime;
  }
  std::string folder = (fs::temp_directory_path() / "ridgecraft-XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr) {
    throw Error(ErrorKind::cant_write,
                "can't make a folder for the page: " + std::generic_category().message(errno));
  }
  return folder;
}

}  // namespace

fs::path find_studio() {
  std::error_code ignored;
  const fs::path here = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const fs::path& tried :
       {here / "../share/ridgecraft/studio.html", here / "../wasm/studio.html", here / "studio.html"}) {
    if (fs::is_regular_file(tried, ignored)) {
      return fs::weakly_canonical(tried);
    }
  }
  throw Error(
      ErrorKind::unreadable_input,
      "studio.html isn't installed with this program; wasm/build.sh in the program's sources makes it");
}

std::string studio_page(std::string_view studio, const StudioJob& job) {
  const std::size_t at = studio.find(empty_start);
  if (at == std::string_view::npos) {
    throw Error(ErrorKind::unreadable_input, "studio.html isn't of this version of the program");
  }
  std::string page(studio.substr(0, at));
  page += R"(<script type="application/json" id="start">)" + start_of(job) + "</script>";
  return page.append(studio.substr(at + empty_start.size()));
}

fs::path write_private_page(std::string_view page) {
  constexpr std::string_view ending = ".html";
  std::string name = (private_folder() / "ridgecraft-XXXXXX").string().append(ending);
  // Mode 0600, and no other file's name.
  const int file = ::mkstemps(name.data(), static_cast<int>(ending.size()));
  if (file < 0) {
    throw Error(ErrorKind::cant_write, "can't write " + name + ": " + std::generic_category().message(errno));
  }
  write_all(file, page, name);
  ::close(file);
  return name;
}

bool open_in_browser(const fs::path& page) {
  std::string program = "xdg-open";
  std::string argument = page.string();
  const std::array<char*, 3> words{program.data(), argument.data(), nullptr};
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  // What it says is not ours.
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    ::posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
  }
  pid_t child = 0;
  const int failed = ::posix_spawnp(&child, program.c_str(), &actions, nullptr, words.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  return failed == 0 && ::waitpid(child, &status, 0) == child && WIFEXITED(status) &&
         WEXITSTATUS(status) == 0;
}

}  // namespace ridgecraft::cli
