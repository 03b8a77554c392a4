// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft studio: a page with the program and a model in it, in a private file of the user's.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "cli/arguments/options.hpp"

namespace ridgecraft::cli {

/// studio.html where it was installed with the program, or built beside it; Error(unreadable_input) that says
/// how to get it where it is neither.
[[nodiscard]] std::filesystem::path find_studio();

/// The page that begins with the job's model: studio.html's bytes with the model, the files that it names
/// beside it, and the words in it. Throws Error(unreadable_input).
[[nodiscard]] std::string studio_page(std::string_view studio, const StudioJob& job);

/// Writes it where only the user reads it: below $XDG_RUNTIME_DIR, else in a new folder for temporary files.
/// The file's path. Throws Error(cant_write).
[[nodiscard]] std::filesystem::path write_private_page(std::string_view page);

/// Asks the desktop to open it. False where there is none, or it doesn't know how.
bool open_in_browser(const std::filesystem::path& page);

}  // namespace ridgecraft::cli
