// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a project: its model is among its files, whose names are plain; or one sentence.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "session/project_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ridgecraft;
  const auto require = [](bool holds) {
    if (!holds) {
      std::abort();
    }
  };
  try {
    const session::ProjectFile project =
        session::read_project("x.ridgecraft", {reinterpret_cast<const char*>(data), size});
    require(project.files.contains(project.model));
    for (const auto& [name, bytes] : project.files) {
      require(!name.empty() && name != ".." && name.find_first_of("/\\") == std::string::npos);
    }
    const std::string again = session::write_project(project);
    require(session::write_project(session::read_project("x.ridgecraft", again)) == again);
  } catch (const Error& error) {
    require(error.kind() == ErrorKind::unreadable_input);
    require(std::string(error.what()).starts_with("x.ridgecraft"));
  }
  return 0;
}
